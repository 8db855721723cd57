#include "report/conditions.h"

#include <algorithm>
#include <cmath>

#include "base/lists.h"
#include "gloam/error.h"
#include "report/levels.h"

namespace gloam::report {
namespace {

/// Of the error. On one device a result has the same bits every time; a change of the code may round otherwise. On another device fast
/// maths rounds otherwise, which moved errors by up to 5e-6 (docs/benchmarking.md).
constexpr double tolerance_of_one_device = 1e-4, tolerance_of_two_devices = 1e-3;

std::string words(const SetFacts& set) {
  if (set.name.empty()) return "no set";
  const std::string seed = set.seed ? fmt::format(", seed {:.0f}", *set.seed) : "";
  return fmt::format("{} ({} part{}, hash {})", set.name, set.part.empty() ? "public" : set.part, seed,
                     set.hash.empty() ? "unknown" : set.hash.substr(0, 12));
}

void check_sets(const Source& first, const Source& second) {
  const SetFacts &a = first.measurements.set, &b = second.measurements.set;
  const bool same = a.name == b.name && a.part == b.part && a.seed == b.seed && a.hash == b.hash;
  if (same) return;
  throw Error(
      "{} is of {} and {} of {}: frames of the same name differ, so nothing can be compared; measure both on one set "
      "(gloam set verify DIR tells which one a folder is)",
      first.name, words(a), second.name, words(b));
}

bool differ(const Number& a, const Number& b, double tolerance) {
  if (!a || !b) return a.has_value() != b.has_value();
  return std::fabs(*a - *b) > tolerance * std::max(std::fabs(*a), std::fabs(*b));
}

const Scene* find(const Measurements& m, const std::string& name) {
  const auto found = std::find_if(m.scenes.begin(), m.scenes.end(), [&](const Scene& s) { return s.name == name; });
  return found == m.scenes.end() ? nullptr : &*found;
}

void compare_scenes(const Measurements& a, const Measurements& b, Conditions& c) {
  constexpr double rounding = 1e-5;
  const bool other_rays = differ(a.rays, b.rays, 0);
  for (const Scene& scene : a.scenes) {
    const Scene* other = find(b, scene.name);
    if (!other) continue;
    if (differ(scene.radius, other->radius, rounding)) {
      c.other_radius.push_back(scene.name);
      c.other_truth.push_back(scene.name);
    } else if (other_rays || differ(scene.truth_noise, other->truth_noise, rounding)) {
      c.other_truth.push_back(scene.name);
    }
  }
  if (!c.other_radius.empty())
    c.notes.push_back(
        fmt::format("the radius differs on {}: rows of other work, not compared", enumerate(c.other_radius)));
  if (c.other_truth.size() > c.other_radius.size())
    c.notes.push_back(fmt::format("truths differ (rays: {} and {}): errors are not compared; times are",
                                  a.rays ? fmt::format("{:.0f}", *a.rays) : "unknown",
                                  b.rays ? fmt::format("{:.0f}", *b.rays) : "unknown"));
}

/// Whether the rows of a file have enough rounds in each process; adds a note where not.
bool has_rounds(const Source& source, Conditions& c) {
  const std::vector<Row>& rows = source.measurements.rows;
  const auto most = std::max_element(rows.begin(), rows.end(), [](const Row& a, const Row& b) {
    return a.hbao_plus_rounds.ms.size() < b.hbao_plus_rounds.ms.size();
  });
  const size_t rounds = most == rows.end() ? 0 : most->hbao_plus_rounds.ms.size();
  if (rounds >= fewest_rounds_of_level) return true;
  if (rounds == 0)
    c.notes.push_back(fmt::format(
        "{}: keeps no rounds (of an older gloam, or without ratios to hbao+): times are not compared, errors are; "
        "measure it again with this gloam",
        source.name));
  else
    c.notes.push_back(
        fmt::format("{}: {} a row cannot tell how noisy they are: times are not compared, errors are; measure at least "
                    "{} (--rounds 9)",
                    source.name, rounds == 1 ? "1 round" : fmt::format("{} rounds", rounds), fewest_rounds_of_level));
  return false;
}

}  // namespace

Conditions conditions_of(const Source& first, const Source& second) {
  check_sets(first, second);
  const Measurements &a = first.measurements, &b = second.measurements;
  Conditions c;
  c.one_device = a.device == b.device && a.driver == b.driver && a.cpu == b.cpu;
  c.error_tolerance = c.one_device ? tolerance_of_one_device : tolerance_of_two_devices;
  if (!c.one_device)
    c.notes.push_back(
        fmt::format("devices differ ({}, {} and {}, {}): ratios are compared, which say what suits a device; errors up "
                    "to {:g} % apart count as the same, since devices round differently",
                    a.device, a.driver, b.device, b.driver, 100 * c.error_tolerance));
  compare_scenes(a, b, c);
  const bool first_has = has_rounds(first, c), second_has = has_rounds(second, c);
  c.have_rounds = first_has && second_has;
  return c;
}

}  // namespace gloam::report
