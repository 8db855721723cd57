// Hard case 18: two eyes at any distance, swapped, with different cameras, and one that sees nothing.
#include <algorithm>
#include <cmath>

#include "gloam/normalise.h"
#include "gloam/planes.h"
#include "stress/case.h"
#include "stress/eyes.h"
#include "stress/frames.h"

namespace gloam::stress {
namespace {

/// All planes that the technique reads, for eyes at this distance.
Frame frame_of_eyes(const Technique& technique, const Shot& left, const Shot& right, double apart) {
  Frame frame =
      shoot_pair({eye_at(left, {0, 0, 0}), eye_at(right, {apart, 0, 0})}, room(), [](const glm::dvec3&) { return 1; });
  for (View& view : frame.views) view.planes.erase("ao");
  plan_for(technique, frame);
  return frame;
}

/// Settings that turn every choice between one eye and both to one eye.
Settings for_one_eye(const Technique& technique) {
  Settings settings;
  for (const Parameter& p : technique.parameters) {
    const bool has_mono = std::find(p.choices.begin(), p.choices.end(), "mono") != p.choices.end();
    if (has_mono) settings.emplace_back(technique.name + "." + p.name, "mono");
    if (p.name.starts_with("reproject")) settings.emplace_back(technique.name + "." + p.name, "off");
  }
  return settings;
}

bool is_for_two(Probe& probe) {
  if (probe.technique().views == 2) return true;
  probe.passes_over("uses one eye at a time");
  return false;
}

/// Eyes in one place see the same as one eye, except for the rounding of a point projected onto itself.
void eyes_in_one_place(Probe& probe) {
  if (!is_for_two(probe)) return;
  const Settings one = for_one_eye(probe.technique());
  if (!probe.opt_out("one place").empty()) return;
  if (one.empty()) return probe.passes_over("has no form for one eye to compare with");
  const Shot shot = perspective(80, 60);
  for (const RunOptions& way : probe.two_ways()) {
    if (!probe.tries(fmt::format("eyes in one place, {}", text_of(way)))) continue;
    Frame frame = frame_of_eyes(probe.technique(), shot, shot, 0);
    const Frame both = probe.outputs(frame, few_samples(probe.technique()), way),
                mono = probe.outputs(frame, few_samples(probe.technique()) + one, way);
    const Difference d = difference(both, mono);
    probe.measure("eyes in one place: share of values more than 2e-3 from one eye's",
                  {share_over(both, mono, 2e-3), d.place}, 1e-2);
    probe.measure("eyes in one place: mean difference to one eye's", {d.mean, d.place}, 1e-3);
  }
}

Frame swapped(const Frame& frame) {
  Frame other = clone(frame);
  std::swap(other.views[0], other.views[1]);
  return other;
}

void swapped_eyes(Probe& probe) {
  const Technique& technique = probe.technique();
  if (!is_for_two(probe)) return;
  if (makes_first_view_only(technique)) return probe.passes_over("makes an image of the first eye alone");
  const auto primary = std::find_if(technique.parameters.begin(), technique.parameters.end(),
                                    [](const Parameter& p) { return p.name == "primary"; });
  const Settings second =
      primary == technique.parameters.end() ? Settings{} : Settings{{technique.name + ".primary", "right"}};
  for (const double apart : {0.0, 0.065, 0.5}) {
    for (const RunOptions& way : probe.two_ways()) {
      if (!probe.tries(fmt::format("swapped eyes {} apart, {}", apart, text_of(way)))) continue;
      Frame frame = frame_of_eyes(technique, perspective(80, 60), perspective(80, 60), apart);
      Frame other = swapped(frame);
      const Frame first = probe.outputs(frame, few_samples(technique), way);
      const Frame exchanged = swapped(probe.outputs(other, few_samples(technique) + second, way));
      probe.measure_bits("swapped eyes: difference to swapped results", exchanged, first);
    }
  }
}

/// Makes one eye see nothing, or a hand before it.
void blind(View& view, float depth) {
  for (auto& [name, plane] : view.planes) {
    if (plane_kind(name).meaning != PlaneKind::view_depth) continue;
    Channel& values = plane.channels[0];
    for (int y = 0; y < values.layout().height; ++y) std::fill_n(values.row(y), values.layout().width, depth);
  }
}

void eyes_of_every_kind(Probe& probe) {
  if (!is_for_two(probe)) return;
  const auto look = [&](const std::string& name, const std::function<Frame()>& make) {
    for (const RunOptions& way : probe.two_ways()) {
      if (!probe.tries(fmt::format("{}, {}", name, text_of(way)))) continue;
      Frame frame = make();
      probe.measure_violation("value out of its range: eyes of every kind",
                              probe.outputs(frame, few_samples(probe.technique()), way));
    }
  };
  const Shot shot = perspective(80, 60), wide = perspective(80, 60, 120);
  for (const double apart : {0.0, 1e-12, 1e-6, 0.065, 1.0, 1e3, 1e9})
    look(fmt::format("eyes {} apart", apart),
         [&, apart] { return frame_of_eyes(probe.technique(), shot, shot, apart); });
  look("eyes of different angles", [&] { return frame_of_eyes(probe.technique(), shot, wide, 0.065); });
  look("one eye orthographic", [&] { return frame_of_eyes(probe.technique(), shot, orthographic(80, 60, 4), 0.065); });
  for (const float depth : {INFINITY, 1e-6f}) {
    for (const size_t eye : {0, 1}) {
      look(fmt::format("eye {} sees {}", eye, depth < 1 ? "a hand before it" : "nothing"), [&, depth, eye] {
        Frame frame = frame_of_eyes(probe.technique(), shot, shot, 0.065);
        blind(frame.views[eye], depth);
        normalise(frame);
        return frame;
      });
    }
  }
}

}  // namespace

namespace case_files {

std::vector<Case> two_eyes() {
  return {{18,
           "two eyes",
           "Two eyes in one place give the results of one eye; swapped eyes swap the results, bit for bit; any "
           "distance, different "
           "cameras and an eye that sees nothing give values in their range.",
           {eyes_in_one_place, swapped_eyes, eyes_of_every_kind}}};
}

}  // namespace case_files
}  // namespace gloam::stress
