#include "papers/shi2022.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "papers/back_check.h"
#include "papers/eyes.h"
#include "papers/study.h"
#include "papers/timed_table.h"

namespace gloam::bench {
namespace {

constexpr double metres_apart = 0.065;
/// Unlike the other scenes it shows a surface at nearly every pixel, as the paper's timed frames do.
constexpr StandIn gallery{"gallery", "Sponza"};
constexpr std::array<const char*, 3> scenes = {"courtyard", "colonnade", "gallery"};
constexpr const char* long_walls = "corridor";  ///< seen at flat angles, as figure 5 needs
constexpr int quarter = 4;                      ///< of the size of images that rays are traced for

/// Section 4.3: 10 directions of 4 samples. Its filter has 13 taps.
const Settings ten_by_four = {{"directions", "10"}, {"steps", "4"}};

Asked raw(const std::string& technique) { return {technique, ten_by_four}; }

Asked filtered_by_13_taps(const std::string& technique) { return with(filtered(raw(technique)), "half_width", "6"); }

// --- Times

/// Stages at the tables' sizes: 1920x1080, and the 2468x2740 of a headset in the same relation.
using TimedStages = std::array<Stage, 2>;

TimedStages timed_stages(Study& study) {
  const Shot shot{.scene = gallery.scene, .eyes_apart = metres_apart};
  const int width = study.options().width, height = study.options().height;
  study.tell("capturing what is timed");
  return {study.stage(shot, width, height), study.stage(shot, width * 2468 / 1920, height * 2740 / 1080)};
}

/// The paper's milliseconds: both sizes, each at full and at half resolution.
using PaperTimes = std::array<std::optional<double>, 4>;

struct Row {
  std::string name;
  Asked asked;
  std::vector<std::string> passes;
  std::string view;  ///< empty: both views
  PaperTimes paper;
  bool is_base = false;
};

Asked at_resolution(Asked asked, int resolution) {
  asked.resolution = resolution;
  return asked;
}

void measure_both_sizes(Study& study, const TimedStages& stages, const std::string& name,
                        const std::vector<Row>& rows) {
  for (size_t i = 0; i < stages.size(); ++i) {
    std::vector<Entry> entries;
    for (const int resolution : {1, 2}) {
      const std::string column = fmt::format("{}, {}", size_of(stages[i]), resolution == 1 ? "full" : "half");
      for (const Row& row : rows)
        entries.push_back({row.name, column, at_resolution(row.asked, resolution), &stages[i],
                           row.paper[2 * i + size_t(resolution) - 1], row.is_base, passes_named(row.passes), row.view});
    }
    measure(study, {.name = name, .base = "the mono total", .parts_name = {}}, entries);
  }
}

void table_1(Study& study, const TimedStages& stages) {
  const PaperTimes mono = {0.98, 0.24, 3.33, 0.75}, visibility = {0.06, 0.02, 0.19, 0.05};
  const std::vector<std::string> all = {"visibility", "half-occlusion", "estimate", "reproject", "newly visible"};
  const Asked mono_ao = raw("hbao+"), stereo_ao = raw("stereo-ao"),
              as_the_paper = with(stereo_ao, "other_eye", "everywhere");
  measure_both_sizes(
      study, stages, fmt::format("Table 1: raw estimation, {} for {}", gallery.scene, gallery.of),
      {{"mono: O left", mono_ao, {"estimate"}, "left", mono},
       {"mono: O right", mono_ao, {"estimate"}, "right", mono},
       {"mono: total", mono_ao, {"estimate"}, "", {1.96, 0.48, 6.66, 1.50}, true},
       {"stereo: L left", stereo_ao, {"visibility"}, "left", visibility},
       {"stereo: L right", stereo_ao, {"visibility"}, "right", visibility},
       {"stereo: where the eyes may differ", stereo_ao, {"half-occlusion"}, "right", {}},
       {"stereo: O left", stereo_ao, {"estimate"}, "left", {}},
       {"stereo: O right, reprojected", stereo_ao, {"reproject"}, "right", {0.07, 0.02, 0.21, 0.06}},
       {"stereo: O right, newly visible", stereo_ao, {"newly visible"}, "right", {0.42, 0.15, 2.01, 0.62}},
       {"stereo: total", stereo_ao, all, "", {}},
       {"everywhere: O left", as_the_paper, {"estimate"}, "left", {2.36, 0.60, 8.12, 2.02}},
       {"everywhere: total", as_the_paper, all, "", {2.97, 0.81, 10.72, 2.80}}});
}

void table_2(Study& study, const TimedStages& stages) {
  // The paper has no times of filters at half resolution.
  const auto full = [](double smaller, double larger) { return PaperTimes{smaller, {}, larger, {}}; };
  const std::vector<std::string> passes = {"horizontal", "vertical", "blend"};
  const Asked mono_ao = filtered_by_13_taps("hbao+"), stereo_ao = filtered_by_13_taps("stereo-ao");
  std::vector<Row> rows;
  for (const char* eye : {"left", "right"}) {
    rows.push_back({fmt::format("mono: {}, X", eye), mono_ao, {"horizontal"}, eye, full(0.12, 0.40)});
    rows.push_back({fmt::format("mono: {}, Y", eye), mono_ao, {"vertical"}, eye, full(0.12, 0.40)});
  }
  rows.push_back({"mono: total", mono_ao, passes, "", full(0.48, 1.60), true});
  for (const char* eye : {"left", "right"}) {
    rows.push_back({fmt::format("stereo: {}, X", eye), stereo_ao, {"horizontal"}, eye, full(0.32, 1.12)});
    rows.push_back({fmt::format("stereo: {}, Y", eye), stereo_ao, {"vertical"}, eye, full(0.32, 1.11)});
    rows.push_back({fmt::format("stereo: {}, blend", eye), stereo_ao, {"blend"}, eye, {}});
  }
  rows.push_back({"stereo: total", stereo_ao, passes, "", full(1.28, 4.46)});
  measure_both_sizes(study, stages, fmt::format("Table 2: filter of 13 taps, {} for {}", gallery.scene, gallery.of),
                     rows);
}

/// Section 3.3, figure 7.
void figure_7(Study& study, const TimedStages& stages) {
  const std::string figure = "Figure 7: rows and columns against squares, 13x13 taps (paper: 46.57 dB)";
  const Stage& s = stages.front();
  const Asked rows = filtered_by_13_taps("stereo-ao"), squares = with(rows, "filter", "stereo2d");
  const auto filter = passes_named({"horizontal", "vertical", "square", "blend"});
  measure(study,
          {.name = "Figure 7: the filter over squares (paper: about 3 times)",
           .base = "rows and columns",
           .parts_name = {}},
          {{"rows and columns", size_of(s), rows, &s, {}, true, filter},
           {"squares", size_of(s), squares, &s, {}, false, filter}});
  const double difference = study.error(s, study.images(s, rows), study.images(s, squares));
  study.fact(figure, size_of(s), "PSNR of one to the other", -20 * std::log10(difference), "dB");
}

// --- How far the eyes disagree

/// A column of figure 10: which of the steps are stereo.
struct Letter {
  const char *letter, *estimate, *other_eye, *reproject, *filter;
};
constexpr std::array<Letter, 5> letters = {{{"A", "mono", "near", "off", "mono"},
                                            {"B", "stereo", "everywhere", "off", "mono"},
                                            {"C", "stereo", "near", "on", "mono"},
                                            {"D", "stereo", "near", "on", "stereo"},
                                            {"E", "mono", "near", "on", "mono"}}};

std::string name_of(const Letter& l) {
  return fmt::format("{}: estimate {}, reproject {}, filter {}", l.letter, l.estimate, l.reproject, l.filter);
}

Asked asked_of(const Letter& l) {
  Asked asked = filtered_by_13_taps("stereo-ao");
  asked.settings.insert(
      asked.settings.end(),
      {{"estimate", l.estimate}, {"other_eye", l.other_eye}, {"reproject", l.reproject}, {"filter", l.filter}});
  return asked;
}

const Letter& d_of_the_paper = letters[3];

/// F of figure 10, from two independent halves.
struct Traced {
  std::array<Image, 2> halves;
  Image mean;
  int rays = 0;  ///< of both halves
};

Image mean_of(const Image& a, const Image& b) {
  Image mean;
  for (const auto& [view, plane] : a) {
    Plane& sum = mean.emplace(view, plane.clone()).first->second;
    const Channel& other = b.at(view).channels[0];
    const Layout& layout = other.layout();
    for (int y = 0; y < layout.height; ++y) {
      for (int x = 0; x < layout.width; ++x) {
        float& value = sum.channels[0].at(x, y);
        value = (value + other.at(x, y)) / 2;
      }
    }
  }
  return mean;
}

/// Rays of a half, rounded up to a number that can be traced.
int rays_of_a_half(const PaperOptions& options) { return (options.rays + 63) / 64 * 32; }

Traced traced_halves(Study& study, const Stage& s, const std::string& scene) {
  Traced t;
  AoReferenceOptions rays{.samples = rays_of_a_half(study.options())};
  t.rays = 2 * rays.samples;
  for (uint32_t half = 0; half < 2; ++half) {
    rays.seed = half;
    rays.progress = [&](double share) { study.tell(fmt::format("rays of {}", scene), (half + share) / 2); };
    t.halves[half] = study.traced(s, rays);
  }
  t.mean = mean_of(t.halves[0], t.halves[1]);
  return t;
}

/// RMSE of the mean of that many independent rays, each of which meets something or not.
double predicted_noise(const Stage& s, const Traced& t) {
  double sum = 0;
  long long count = 0;
  for (const auto& [view, mask] : s.surfaces) {
    const Channel& open = t.mean.at(view).channels[0];
    for (int y = 0; y < s.frame.height(); ++y) {
      for (int x = 0; x < s.frame.width(); ++x) {
        if (!mask[size_t(y) * size_t(s.frame.width()) + size_t(x)]) continue;
        const double p = open.at(x, y);
        sum += p * (1 - p);
        ++count;
      }
    }
  }
  return std::sqrt(sum / double(count) / t.rays);
}

void state_noise(Study& study, const Stage& s, const std::string& scene, const Traced& t) {
  const std::string noise = "Figure 10: noise of F", by_rays = "Figure 10: F with half of the rays, and with all";
  study.fact(noise, scene, "half the difference of its halves", study.error(s, t.halves[0], t.halves[1]) / 2, "RMSE");
  study.fact(noise, scene, "of independent rays, sqrt(p (1 - p) / rays)", predicted_noise(s, t), "RMSE");
  const auto add = [&](const std::string& column, const Image& ao) {
    study.fact(by_rays, scene, column, in_hundred_thousandths(inconsistency(s, ao).both), inconsistency_unit);
  };
  add("first half", t.halves[0]);
  add("second half", t.halves[1]);
  add("all", t.mean);
}

/// Figures and two panels for one of the letters on one scene.
struct Ablation {
  Study& study;
  const Stage& stage;
  std::string scene;
  const Image& truth;
  std::optional<double> of_a = {};
  std::vector<Panel> images = {}, errors = {};

  void add(const std::string& name, const Image& ao) {
    StereoInconsistency result = inconsistency(stage, ao);
    const std::string figure = fmt::format("Figure 10, {}: ", size_of(stage));
    if (!of_a) of_a = result.both.mean;
    study.fact(figure + "mean inconsistency", name, scene, in_hundred_thousandths(result.both), inconsistency_unit);
    study.fact(figure + "of A's inconsistency", name, scene, result.both.mean / *of_a, "share");
    for (size_t i = 0; i < 2; ++i)
      study.fact(figure + "of each eye", name, fmt::format("{}, {}", scene, stage.frame.views[i].name),
                 in_hundred_thousandths(result.views[i].figures), inconsistency_unit);
    if (&ao != &truth) study.fact(figure + "error to F", name, scene, study.error(stage, ao, truth), "RMSE");
    const Plane& left = ao.at(stage.frame.views[0].name);
    images.push_back({name, left.clone()});
    errors.push_back(
        {fmt::format("{}: mean {:.1f} / 100 000", name.substr(0, 1), in_hundred_thousandths(result.views[0].figures)),
         left.clone(), std::move(result.views[0])});
  }
};

/// Three letters in a row, their errors below them, then the next three.
std::vector<Panel> in_threes(std::vector<Panel> images, std::vector<Panel> errors) {
  std::vector<Panel> panels;
  for (size_t first = 0; first < images.size(); first += 3) {
    for (std::vector<Panel>* row : {&images, &errors}) {
      for (size_t i = first; i < std::min(first + 3, row->size()); ++i) panels.push_back(std::move((*row)[i]));
    }
  }
  return panels;
}

void figure_10(Study& study, const Stage& s, const std::string& scene, const Traced& t) {
  Ablation ablation{study, s, scene, t.mean};
  for (const Letter& l : letters) ablation.add(name_of(l), study.images(s, asked_of(l)));
  ablation.add("F: traced", t.mean);
  study.picture(fmt::format("Figure 10: {}", scene),
                fmt::format("AO of the left eye, and below it the inconsistency, {:g} times; purple does not count.",
                            error_magnification),
                fmt::format("figure_10_{}.png", scene),
                in_threes(std::move(ablation.images), std::move(ablation.errors)), 3);
}

/// Only the letters at the size of the tables: F would take hours.
void figure_10_in_full(Study& study, const Stage& s, const std::string& scene) {
  for (const Letter& l : letters)
    study.fact(fmt::format("Figure 10, {}: mean inconsistency", size_of(s)), name_of(l), scene,
               in_hundred_thousandths(inconsistency(s, study.images(s, asked_of(l))).both), inconsistency_unit);
}

void figure_9(Study& study, const Stage& s, const std::string& scene, const Traced& t) {
  const std::string figure = "Figure 9: the normal-check";
  const Image d = study.images(s, asked_of(d_of_the_paper));
  std::vector<Panel> panels;
  for (const auto& [name, ao] : {std::pair<std::string, const Image&>{"F", t.mean}, {"D", d}}) {
    for (const bool checked : {false, true}) {
      StereoOptions options;
      if (!checked) options.normal_check.reset();
      StereoInconsistency result = inconsistency(s, ao, options);
      const std::string row = fmt::format("{}, {}", name, checked ? "normals within 6 degrees" : "any normals");
      study.fact(figure, row, scene, in_hundred_thousandths(result.both), inconsistency_unit);
      if (name == "F")
        study.fact(figure + ": surfaces that do not count", checked ? "normals within 6 degrees" : "any normals", scene,
                   result.both.rejected_share(), "share");
      panels.push_back({fmt::format("{}: mean {:.1f} / 100 000", row, in_hundred_thousandths(result.views[0].figures)),
                        ao.at(s.frame.views[0].name).clone(), std::move(result.views[0])});
    }
  }
  study.picture(fmt::format("{}, {}", figure, scene),
                fmt::format("Inconsistency of the left eye, {:g} times; purple does not count.", error_magnification),
                fmt::format("figure_9_{}.png", scene), panels, 2);
}

PaperResult remake_shi(Device& device, const PaperOptions& options) {
  Study study(device, options);
  study.result.notes = {
      fmt::format(
          "Built-in scenes stand for the paper's: {} for {} where times are measured, since it shows a surface at "
          "nearly every pixel as the paper's frames do; {} for the others. Eyes {:g} apart.",
          gallery.scene, gallery.of, fmt::join(scenes, ", "), metres_apart),
      "HBAO+ with 10 x 4 samples, a filter of 13 x 13 taps. Times at half resolution are without the passes that bring "
      "images there and back.",
      "`everywhere` looks at the other eye for every pixel, as the paper does, and so does B; the others only where "
      "that can differ.",
      "The paper's filter looks at both eyes in its passes X and Y. Here each eye is filtered by itself, and one pass "
      "more, `blend`, puts both together; the total has all three.",
      "The paper's figure 5 takes the nearest pixel whatever it shows; here `no-back-check` still asks that its depth "
      "be within 2 % of the pixel's own, and `reproject=on` that the way back ends where it began and one of the "
      "pixels "
      "around shows the surface.",
      fmt::format(
          "F is traced with {} rays per pixel, and `error to F` is to it. No falloff dims what its rays meet, and "
          "no filter blurs it: so it is darker than A to E and has sharper edges, where eyes disagree most.",
          rays_of_a_half(options) * 2)};
  {
    const TimedStages stages = timed_stages(study);
    table_1(study, stages);
    table_2(study, stages);
    figure_7(study, stages);
  }
  for (const char* scene : scenes) {
    study.tell(fmt::format("figures 9 and 10: {}", scene));
    const Stage s = study.small_stage({.scene = scene, .eyes_apart = metres_apart}, quarter);
    const Traced t = traced_halves(study, s, scene);
    figure_10(study, s, scene, t);
    state_noise(study, s, scene, t);
    figure_9(study, s, scene, t);
  }
  for (const char* scene : {scenes[0], scenes[1], scenes[2], long_walls}) {
    study.tell(fmt::format("figures 5 and 10 in full: {}", scene));
    const Stage s = study.timed_stage({.scene = scene, .eyes_apart = metres_apart});
    figure_10_in_full(study, s, scene);
    figure_5(study, s, scene, raw("stereo-ao"), asked_of(d_of_the_paper));
  }
  return std::move(study.result);
}

}  // namespace

Paper shi2022() {
  return {"shi2022", "Stereo-consistent screen-space ambient occlusion (Shi, Billeter, Eisemann 2022)", 4096,
          remake_shi};
}

}  // namespace gloam::bench
