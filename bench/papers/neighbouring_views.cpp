#include "papers/neighbouring_views.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "gloam/run.h"
#include "papers/display_stage.h"
#include "papers/eyes.h"
#include "papers/timed_table.h"
#include "plan/key_views.h"

namespace gloam::bench {
namespace {

constexpr std::array<const char*, 2> techniques = {"lightfield-ssao", "lightfield-hbao+"};

/// Distances between key views; 0: reuse=off.
constexpr std::array<int, 4> spacings = {0, 2, 4, 8};

std::string name_of(int spacing) { return spacing == 0 ? "reuse=off" : fmt::format("reuse=on, key_views={}", spacing); }

Asked asked_of(const std::string& technique, int spacing) {
  const Asked alone = filtered({.technique = technique, .settings = {}});
  if (spacing == 0) return alone;
  return with(with(alone, "reuse", "on"), "key_views", std::to_string(spacing));
}

/// Numbers of consecutive views.
using Numbers = std::vector<size_t>;

/// Views that are not key views.
Numbers between_keys(const Frame& frame, int spacing) {
  Numbers between;
  const std::vector<KeyViewRole> roles = key_view_roles(int(frame.views.size()), spacing);
  for (size_t i = 0; i < roles.size(); ++i) {
    if (!roles[i].is_key) between.push_back(i);
  }
  return between;
}

/// Nine views about the middle: for every spacing the first eight, and the pairs of neighbours, contain their share of key views.
Numbers about(size_t middle, const Frame& frame) {
  Numbers numbers;
  const size_t first = middle > 4 ? middle - 4 : 0;
  for (size_t i = first; i < std::min(first + 9, frame.views.size()); ++i) numbers.push_back(i);
  return numbers;
}

Foreground surfaces_of(const Stage& s, const Numbers& views) {
  Foreground surfaces;
  for (const size_t i : views) {
    const std::string& name = s.frame.views[i].name;
    surfaces.emplace(name, s.surfaces.at(name));
  }
  return surfaces;
}

double pixels_in_all(const Foreground& surfaces) {
  double pixels = 0;
  for (const auto& [view, mask] : surfaces) pixels += pixels_of(mask);
  return pixels;
}

// --- Times

void state_times_per_view(Study& study, const std::string& table, size_t views) {
  std::vector<report::PaperFigure> per_view;
  for (const report::PaperFigure& time : study.result.times) {
    if (time.table != table) continue;
    per_view.push_back(time);
    per_view.back().column = "per view";
    *per_view.back().ms /= double(views);
  }
  std::move(per_view.begin(), per_view.end(), std::back_inserter(study.result.times));
}

void state_times(Study& study, const Stage& s, const std::string& technique) {
  const size_t views = s.frame.views.size();
  const std::string table = fmt::format("Section 5: {} modules, {}", views, technique),
                    column = fmt::format("{} views", views);
  std::vector<Entry> entries;
  for (const int spacing : spacings)
    entries.push_back({name_of(spacing), column, asked_of(technique, spacing), &s, {}, spacing == 0});
  measure(study,
          {.name = table,
           .base = "reuse=off",
           .parts_name = table + ", its passes",
           .parts = {{"estimate", passes_named({"estimate"})},
                     {"reuse", passes_named({"reuse"})},
                     {"newly visible", passes_named({"newly visible"})},
                     {"Gaussian", passes_named({"horizontal", "vertical"})}}},
          entries);
  state_times_per_view(study, table, views);
}

// --- Errors

/// Mean over pairs of neighbours, in `inconsistency_unit`.
double inconsistency_of_neighbours(const Frame& frame, const Numbers& views, const Image& ao) {
  double sum = 0;
  for (size_t k = 0; k + 1 < views.size(); ++k)
    sum += in_hundred_thousandths(inconsistency(frame, {views[k], views[k + 1]}, ao).both);
  return sum / double(views.size() - 1);
}

/// Difference between two images of a view, as the errors of a panel.
StereoErrors difference_of(const Plane& test, const Plane& expected, const Mask& surfaces) {
  const Layout& layout = test.channels[0].layout();
  StereoErrors errors{Channel(layout, std::numeric_limits<float>::quiet_NaN()), {}, {}};
  for (size_t i = 0; i < surfaces.size(); ++i) {
    const int x = int(i) % layout.width, y = int(i) / layout.width;
    errors.pixels.push_back(surfaces[i] ? StereoPixel::counted : StereoPixel::background);
    if (surfaces[i]) errors.error.at(x, y) = std::abs(test.channels[0].at(x, y) - expected.channels[0].at(x, y));
  }
  return errors;
}

Image converged(const Study& study, const Stage& s, const std::string& technique, const Numbers& views) {
  Asked asked = asked_of(technique, 0);
  for (const auto& [name, value] : find_technique(technique).converged) asked = with(asked, name, value);
  return image_of(run(study.plan_of(s, asked), views_of(s.frame, views), study.device()).frame, "ao");
}

/// Compares the results of one technique over all views, spacing by spacing.
class Comparison {
 public:
  Comparison(Study& study, const Stage& s, const std::string& technique, size_t middle, const Image& truth)
      : study_(study),
        s_(s),
        technique_(technique),
        middle_(s.frame.views[middle].name),
        about_(about(middle, s.frame)),
        truth_(truth),
        converged_(converged(study, s, technique, about_)) {}

  void state() {
    for (const int spacing : spacings) {
      study_.tell(fmt::format("errors: {}, {}", technique_, name_of(spacing)));
      RunResult result = run(study_.plan_of(s_, asked_of(technique_, spacing)), s_.frame, study_.device());
      const long long listed = result.listed["newly_visible"];
      const Image ao = image_of(std::move(result.frame), "ao");
      if (spacing > 0) state_shares(spacing, double(listed));
      state_errors(spacing, ao);
      add_panel(spacing, ao);
      if (spacing == 0)
        for (const auto& [view, plane] : ao) alone_.emplace(view, plane.clone());
    }
    fact("inconsistency of neighbours", "converged", inconsistency_of_neighbours(s_.frame, about_, converged_),
         inconsistency_unit);
    study_.picture(
        fmt::format("Reuse: {}", technique_),
        fmt::format("AO of {}, and by how much it is off that of reuse=off, {:g} times.", middle_, error_magnification),
        fmt::format("reuse_{}.png", technique_ == techniques[0] ? "ssao" : "hbao_plus"), panels_, 2);
  }

 private:
  void fact(const std::string& what, const std::string& row, double value, const std::string& unit) const {
    study_.fact(fmt::format("{} modules: {}", s_.frame.views.size(), what), row, technique_, value, unit);
  }

  void state_shares(int spacing, double listed) const {
    const double between = pixels_in_all(surfaces_of(s_, between_keys(s_.frame, spacing))),
                 all = pixels_in_all(s_.surfaces);
    fact("newly computed, of the surfaces between key views", name_of(spacing), listed / between, "share");
    fact("computed, of all surfaces", name_of(spacing), (all - between + listed) / all, "share");
  }

  void state_errors(int spacing, const Image& ao) const {
    const std::string row = name_of(spacing);
    const Numbers eight(about_.begin(), about_.begin() + long(std::min<size_t>(8, about_.size())));
    fact("RMSE to converged AO, eight modules in the middle", row, rmse(ao, converged_, surfaces_of(s_, eight)),
         "RMSE");
    fact("RMSE to rays, the middle module", row, rmse(ao, truth_, s_.surfaces), "RMSE");
    fact("inconsistency of neighbours", row, inconsistency_of_neighbours(s_.frame, about_, ao), inconsistency_unit);
    if (spacing == 0) return;
    fact("RMSE to reuse=off", row, rmse(ao, alone_, s_.surfaces), "RMSE");
    fact("RMSE to reuse=off, between key views", row,
         rmse(ao, alone_, surfaces_of(s_, between_keys(s_.frame, spacing))), "RMSE");
  }

  void add_panel(int spacing, const Image& ao) {
    const Plane& shown = ao.at(middle_);
    panels_.push_back({name_of(spacing), shown.clone()});
    if (spacing == 0) return;
    const Plane& alone = alone_.at(middle_);
    panels_.push_back({fmt::format("{}: off that of reuse=off", name_of(spacing)), alone.clone(),
                       difference_of(shown, alone, s_.surfaces.at(middle_))});
  }

  Study& study_;
  const Stage& s_;
  std::string technique_, middle_;
  Numbers about_;
  const Image& truth_;
  Image converged_, alone_;  ///< alone: reuse=off
  std::vector<Panel> panels_;
};

}  // namespace

void neighbouring_views(Study& study, const Stage& s, size_t middle, const Image& truth) {
  for (const char* technique : techniques) state_times(study, s, technique);
  for (const char* technique : techniques) Comparison(study, s, technique, middle, truth).state();
}

}  // namespace gloam::bench
