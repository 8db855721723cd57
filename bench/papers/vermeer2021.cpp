#include "papers/vermeer2021.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "papers/hidden_occluders.h"
#include "papers/pop_in.h"
#include "papers/study.h"
#include "papers/timed_table.h"

namespace gloam::bench {
namespace {

constexpr std::array<int, 5> sample_counts = {1, 2, 4, 8, 16};
constexpr int layers_in_times = 8, layers_in_errors = 32;

constexpr StandIn sponza{"colonnade", "Sponza"}, sibenik{"gallery", "Sibenik"}, san_miguel{"courtyard", "San Miguel"},
    hairball{"hairball", "Hairball"};

/// The paper's section 4: 8 directions of 4 samples, or 32 points.
Settings samples_of_the_paper(const std::string& technique) {
  const std::vector<Parameter>& parameters = find_technique(technique).parameters;
  const auto has = [&](const char* name) {
    return std::any_of(parameters.begin(), parameters.end(), [&](const Parameter& p) { return p.name == name; });
  };
  if (has("directions")) return {{"directions", "8"}, {"steps", "4"}};
  return {{has("points") ? "points" : "samples", "32"}};
}

Asked regular(const std::string& name, int resolution = 1) { return {name, samples_of_the_paper(name), resolution}; }

/// Over gloam's own map.
Asked hidden(const std::string& name, int samples, const std::string& early_out, int resolution = 1) {
  Settings settings = samples_of_the_paper("sd-" + name);
  settings.insert(settings.end(), {{"samples", std::to_string(samples)}, {"early_out", early_out}});
  return {"sd-" + name, settings, resolution};
}

/// Over the paper's map.
Asked stochastic(const std::string& name, int samples, const std::string& early_out, int resolution = 1) {
  Asked asked = hidden(name, samples, early_out, resolution);
  asked.settings.insert(asked.settings.end(), {{"surfaces", "all"}, {"subset", "stratified"}, {"alpha", "0.2"}});
  return asked;
}

Asked over_all_layers(const std::string& name) { return {"dp-" + name, samples_of_the_paper(name)}; }

std::string samples_name(int samples) { return fmt::format("{} sample{}", samples, samples == 1 ? "" : "s"); }

// --- Times

bool is_estimate(const std::string& pass) { return pass.find("/estimate") != std::string::npos; }
bool is_map(const std::string& pass) { return pass == "stochastic-depth/map"; }
bool is_sort(const std::string& pass) { return pass.find("/sort") != std::string::npos; }

TimedTable table(const std::string& name, const std::string& base) {
  return {name, base, name + ", making the map", {{"map", is_map}, {"sort", is_sort}}};
}

void table_1(Study& study) {
  const Stage stage = study.timed_stage({sponza.scene, layers_in_times});
  struct Column {
    const char *technique, *name;
    std::array<std::optional<double>, 6> paper = {};  ///< regular, then by number of samples
  };
  // The paper's SSAO weighs the cosine by a falloff (McGuire 2011), as alchemy and sao do, each with its own; the points of a ball
  // that ssao counts are not in the paper.
  const std::array<std::optional<double>, 6> of_mcguire = {0.926, 1.192, 1.460, 2.161, 3.557, 5.967};
  const std::array<Column, 5> columns = {{{"alchemy", "SSAO: alchemy", of_mcguire},
                                          {"sao", "SSAO: sao", of_mcguire},
                                          {"hbao", "HBAO", {0.734, 1.124, 1.302, 1.762, 2.528, 4.823}},
                                          {"hbao+", "HBAO+", {0.694, 1.081, 1.372, 1.978, 3.212, 5.527}},
                                          {"ssao", "ssao, not in the paper"}}};
  std::vector<Entry> entries;
  for (const Column& c : columns) {
    entries.push_back({"regular", c.name, regular(c.technique), &stage, c.paper[0], true, is_estimate});
    for (size_t i = 0; i < sample_counts.size(); ++i)
      entries.push_back({samples_name(sample_counts[i]), c.name, stochastic(c.technique, sample_counts[i], "on"),
                         &stage, c.paper[i + 1], false, is_estimate});
    for (const int samples : sample_counts)
      entries.push_back({samples_name(samples) + ", early_out=below",
                         c.name,
                         stochastic(c.technique, samples, "below"),
                         &stage,
                         {},
                         false,
                         is_estimate});
  }
  measure(study, table(fmt::format("Table 1: AO alone, {} for {}", sponza.scene, sponza.of), "the regular technique"),
          entries);
}

void table_2(Study& study) {
  struct Column {
    StandIn scene;
    std::array<double, 6> full, half;  ///< regular, then by number of samples; with the map
  };
  const std::array<Column, 4> columns = {
      {{sponza, {1.042, 1.259, 1.577, 2.313, 3.837, 7.005}, {0.226, 0.382, 0.436, 0.622, 1.038, 1.922}},
       {sibenik, {0.848, 1.344, 1.506, 2.131, 3.667, 6.727}, {0.179, 0.333, 0.412, 0.579, 0.979, 1.805}},
       {san_miguel, {0.608, 2.285, 2.508, 3.243, 4.619, 7.323}, {0.195, 1.127, 1.165, 1.312, 1.697, 2.473}},
       {hairball, {0.252, 1.718, 1.900, 2.494, 3.739, 5.993}, {0.077, 0.774, 0.841, 1.074, 1.452, 2.427}}}};
  for (const Column& c : columns) {
    const Stage stage = study.timed_stage({c.scene.scene, layers_in_times});
    const std::string column = fmt::format("{} for {}", c.scene.scene, c.scene.of);
    std::vector<Entry> entries;
    for (const int resolution : {1, 2}) {
      const std::array<double, 6>& paper = resolution == 1 ? c.full : c.half;
      const std::string size = resolution == 1 ? "full" : "half";
      entries.push_back({fmt::format("regular HBAO+, {}", size), column, regular("hbao+", resolution), &stage, paper[0],
                         resolution == 1});
      for (size_t i = 0; i < sample_counts.size(); ++i)
        entries.push_back({fmt::format("{}, {}", samples_name(sample_counts[i]), size), column,
                           stochastic("hbao+", sample_counts[i], "on", resolution), &stage, paper[i + 1]});
    }
    measure(study, table("Table 2: HBAO+ with its map", "regular HBAO+ at full resolution"), entries);
  }
}

void table_3_of_vermeer(Study& study) {
  const Stage one = study.timed_stage({sibenik.scene, layers_in_times}),
              two = study.timed_stage({.scene = sibenik.scene, .layers = layers_in_times, .second_view = 30});
  // Milliseconds with the map: one camera; two, at full and at half resolution, and with the second alone at half.
  const std::array<std::array<double, 4>, 4> paper = {{{1.344, 2.852, 0.615, 2.157},
                                                       {1.506, 2.885, 0.698, 2.462},
                                                       {2.131, 3.836, 0.873, 3.116},
                                                       {3.667, 5.419, 1.223, 4.523}}};
  std::vector<Entry> entries;
  for (size_t i = 0; i < paper.size(); ++i) {
    const std::string column = samples_name(sample_counts[i]);
    const Asked single = stochastic("hbao+", sample_counts[i], "on");
    Asked both = single, half = single;  // half: both views
    both.technique = half.technique = "multiview";
    half.resolution = 2;
    entries.push_back({"one camera", column, single, &one, paper[i][0], true});
    entries.push_back({"two, full resolution", column, both, &two, paper[i][1]});
    entries.push_back({"two, half resolution", column, half, &two, paper[i][2]});
    entries.push_back(
        {"two, the second alone at half", column, with(both, "other_resolution", "half"), &two, paper[i][3]});
  }
  measure(study, table(fmt::format("Table 3: two views, {} for {}", sibenik.scene, sibenik.of), "one camera"), entries);
}

/// Not in the paper: making and reading its map, and gloam's own.
void table_of_maps(Study& study) {
  const auto makes = [](const std::string& pass) { return pass.rfind("stochastic-depth/", 0) == 0; };
  const auto reads = [](const std::string& pass) { return is_sort(pass) || is_estimate(pass); };
  const Asked paper = stochastic("hbao", 4, "below"), usual = hidden("hbao", 4, "below");
  const std::vector<std::pair<const char*, Asked>> maps = {{"the paper's", paper},
                                                           {"hidden, alpha 0.25", with(usual, "subset", "stratified")},
                                                           {"nearest hidden", usual},
                                                           {"nearest relevant", with(usual, "surfaces", "relevant")}};
  std::vector<Stage> stages;
  for (const StandIn& scene : {sponza, hairball}) stages.push_back(study.timed_stage({scene.scene, layers_in_times}));
  std::vector<Entry> entries;
  for (const Stage& stage : stages) {
    const std::string scene = &stage == &stages.front() ? sponza.scene : hairball.scene;
    for (const auto& [name, asked] : maps) {
      entries.push_back({name, scene + ", making", asked, &stage, {}, &asked == &maps.front().second, makes});
      entries.push_back({name, scene + ", reading", asked, &stage, {}, &asked == &maps.front().second, reads});
    }
  }
  measure(study, {"Maps of 4 samples, HBAO: not in the paper", "the paper's map", ""}, entries);
}

// --- What the figures show

void figure_3(Study& study) {
  study.tell("figure 3");
  const std::string figure = "Figure 3: a slab whose sides lie along the view";
  const Stage s = study.small_stage({.scene = "slab", .layers = layers_in_errors, .second_view = 30});
  const Plane truth = study.truth(s);
  std::vector<Panel> panels;
  for (const char* falloff : {"none", "quadratic"}) {
    for (const char* technique : {"dp-hbao+", "sd-hbao+", "multiview"}) {
      Asked asked = std::string(technique) == "dp-hbao+" ? over_all_layers("hbao+") : stochastic("hbao+", 4, "below");
      asked.technique = technique;
      const Plane ao = study.image(s, with(asked, "falloff", falloff));
      study.fact(figure, technique, fmt::format("falloff={}", falloff), study.error(s, ao, truth), "RMSE to the truth");
      if (std::string(falloff) == "none") panels.push_back({technique, ao.clone()});
      if (asked.technique != "multiview") continue;
      const Plane low = study.image(s, with(with(asked, "falloff", falloff), "other_resolution", "half"));
      study.fact(figure, "multiview, the second view at half", fmt::format("falloff={}", falloff),
                 study.error(s, low, truth), "RMSE to the truth");
    }
  }
  panels.push_back({"ray-traced", truth.clone()});
  study.picture(figure, "No layer holds the sides, so that only a second view finds them (falloff=none).",
                "figure_3.png", panels, 2);
}

/// Errors to all layers with the same samples, and to rays with HBAO's own falloff.
void figures_4_and_5(Study& study) {
  const std::string gap = "Gap to all layers that stochastic depth closes (HBAO, RMSE, unfiltered)",
                    error = "Error to all layers (HBAO, unfiltered)", traced = "Error to rays (HBAO, unfiltered)";
  std::vector<Panel> shown;
  for (const char* scene : {"colonnade", "corridor", "courtyard", "fence", "hairball"}) {
    study.tell(fmt::format("figures 4 and 5: {}", scene));
    const Stage s = study.small_stage({scene, layers_in_errors});
    const Plane truth = study.truth(s, &find_technique("hbao"));
    const Plane all = study.image(s, over_all_layers("hbao")), one = study.image(s, regular("hbao"));
    const double whole = study.error(s, one, all);
    study.fact(error, scene, "regular", whole, "RMSE");
    study.fact(traced, scene, "regular", study.error(s, one, truth), "RMSE");
    const auto add = [&](const std::string& column, const Asked& asked) {
      const Plane ao = study.image(s, asked);
      const double left = study.error(s, ao, all);
      study.fact(gap, scene, column, 1 - left / whole, "share");
      study.fact(error, scene, column, left, "RMSE");
      study.fact(traced, scene, column, study.error(s, ao, truth), "RMSE");
    };
    for (const int samples : sample_counts) add(samples_name(samples), stochastic("hbao", samples, "below"));
    for (const char* factor : {"1.2", "1.3", "1.5", "2"})
      add(fmt::format("4, compensation {}", factor), with(stochastic("hbao", 4, "below"), "compensation", factor));
    add("4, early_out=on", stochastic("hbao", 4, "on"));
    for (const char* alpha : {"0.2", "0.25", "0.3"}) {
      Asked asked = with(stochastic("hbao", 4, "below"), "alpha", alpha);
      if (std::string(alpha) != "0.2") add(fmt::format("4, alpha {}", alpha), asked);
      add(fmt::format("4, hidden, alpha {}", alpha), with(asked, "surfaces", "hidden"));
    }
    for (const int samples : sample_counts)
      add(fmt::format("{}, nearest hidden", samples), hidden("hbao", samples, "below"));
    study.fact(traced, scene, "all layers", study.error(s, all, truth), "RMSE");
    shown.push_back({fmt::format("{}: one layer", scene), study.image(s, filtered(regular("hbao")))});
    shown.push_back({"4 stochastic samples", study.image(s, filtered(stochastic("hbao", 4, "below")))});
    shown.push_back({"all layers", study.image(s, filtered(over_all_layers("hbao")))});
  }
  study.picture("Figure 4: one layer, four stochastic samples, all layers", "HBAO, 8 x 4 samples, filtered.",
                "figure_4.png", shown, 3);

  const Stage close = study.small_stage({.scene = sponza.scene, .layers = layers_in_errors, .camera = 1});
  std::vector<Panel> panels;
  panels.push_back({"one layer", study.image(close, filtered(regular("hbao")))});
  for (const int samples : sample_counts)
    panels.push_back({samples_name(samples), study.image(close, filtered(stochastic("hbao", samples, "below")))});
  study.picture("Figure 5: sample counts", fmt::format("Close to a capital of {}.", sponza.scene), "figure_5.png",
                panels, 3);
}

void figure_6(Study& study) {
  study.tell("figure 6");
  const Stage s = study.small_stage({sibenik.scene, layers_in_errors});
  std::vector<Panel> panels;
  Plane full;
  for (const int resolution : {1, 2}) {
    Plane ao = study.image(s, filtered(stochastic("hbao", 4, "below", resolution)));
    if (resolution == 2)
      study.fact("Figure 6: half resolution", sibenik.scene, "half to full", study.error(s, ao, full), "RMSE");
    panels.push_back({resolution == 1 ? "full resolution" : "half resolution", ao.clone()});
    full = std::move(ao);
  }
  study.picture("Figure 6: half resolution", "SD-HBAO with 4 samples, filtered.", "figure_6.png", panels, 2);
}

void figure_7(Study& study) {
  study.tell("figure 7");
  const Stage s = study.small_stage({san_miguel.scene, layers_in_errors});
  std::vector<Panel> panels;
  const std::vector<std::pair<std::string, Asked>> shown = {
      {"one layer", regular("hbao")},
      {"2 samples", stochastic("hbao", 2, "below")},
      {"2 samples, counted twice", with(stochastic("hbao", 2, "below"), "compensation", "2")},
      {"all layers", over_all_layers("hbao")}};
  for (const auto& [name, asked] : shown) panels.push_back({name, study.image(s, filtered(asked))});
  study.picture("Figure 7: compensation", "HBAO, filtered.", "figure_7.png", panels, 2);
}

void figure_8(Study& study) {
  const std::string figure = "Figure 8: layers before the occluder (mean of what HBAO takes, over one of all layers)";
  std::vector<Panel> panels;
  for (const int sheets : {0, 1, 5, 10}) {
    study.tell(fmt::format("figure 8: {} sheets", sheets));
    const Stage s = study.small_stage({"pillar", layers_in_errors, {{"sheets", std::to_string(sheets)}}});
    const double all = study.mean_taken(s, study.image(s, over_all_layers("hbao")));
    const auto add = [&](const std::string& column, const Asked& asked) {
      study.fact(figure, fmt::format("{} extra layers", sheets), column,
                 study.mean_taken(s, study.image(s, asked)) / all, "share");
      if (column != "one layer")
        panels.push_back({fmt::format("{} layers, {}", sheets, column), study.image(s, filtered(asked))});
    };
    add("one layer", regular("hbao"));
    add("4 samples", stochastic("hbao", 4, "below"));
    add("compensation 2", with(stochastic("hbao", 4, "below"), "compensation", "2"));
    add("alpha 0.1", with(stochastic("hbao", 4, "below"), "alpha", "0.1"));
    const Asked usual = hidden("hbao", 4, "below"), relevant = with(usual, "surfaces", "relevant");
    add("nearest hidden", usual);
    add("nearest relevant", relevant);
    add("relevant, alpha 0.25", with(with(relevant, "subset", "stratified"), "alpha", "0.25"));
  }
  study.picture(figure, "SD-HBAO with 4 samples, filtered.", "figure_8.png", panels, 3);
}

/// Mean angle between two planes of unit vectors, degrees, where both have one.
double mean_angle(const Stage& s, const Plane& a, const Plane& b) {
  double sum = 0, count = 0;
  for (int y = 0; y < s.frame.height(); ++y) {
    for (int x = 0; x < s.frame.width(); ++x) {
      double product = 0, square = 0;
      for (size_t i = 0; i < 3; ++i) {
        product += double(a.channels[i].at(x, y)) * b.channels[i].at(x, y);
        square += double(b.channels[i].at(x, y)) * b.channels[i].at(x, y);
      }
      if (square < 0.5) continue;
      sum += std::acos(std::clamp(product, -1.0, 1.0)) * 180 / M_PI;
      ++count;
    }
  }
  return count > 0 ? sum / count : 0;
}

void figure_9(Study& study) {
  study.tell("figure 9");
  const std::string figure = "Figure 9: bent normals";
  const Stage s = study.small_stage({sponza.scene, layers_in_errors});
  const auto bent = [&](Asked asked) {
    asked.plane = "bent_normal";
    return study.image(s, asked);
  };
  const Plane all = bent(over_all_layers("hbao"));
  std::vector<Panel> panels;
  const std::vector<std::pair<std::string, Asked>> shown = {{"one layer", regular("hbao")},
                                                            {"4 samples", stochastic("hbao", 4, "below")},
                                                            {"16 samples", stochastic("hbao", 16, "below")}};
  for (const auto& [name, asked] : shown) {
    Plane plane = bent(asked);
    study.fact(figure, "mean angle to those of all layers", name, mean_angle(s, plane, all), "degrees");
    panels.push_back({name, std::move(plane)});
  }
  panels.push_back({"all layers", all.clone()});
  study.picture(figure, "HBAO, unfiltered.", "figure_9.png", panels, 2);
}

// --- What the issue of hidden geometry comes to

void histogram(Study& study) {
  const std::string figure = "Layer of the nearest hidden occluder";
  for (const char* scene : {"fence", "hairball", "colonnade", "corridor"}) {
    study.tell(fmt::format("hidden occluders of {}", scene));
    const Stage s = study.small_stage({scene, layers_in_errors});
    const std::vector<long long> counts = layers_of_hidden_occluders(s.frame, s.radius);
    long long all = 0, deeper = 0;
    for (const long long n : counts) all += n;
    for (size_t k = 0; k < counts.size(); ++k) {
      if (k < 6)
        study.fact(figure, scene, std::to_string(k + 1), double(counts[k]) / double(std::max(all, 1LL)), "share");
      else
        deeper += counts[k];
    }
    study.fact(figure, scene, "7 to 31", double(deeper) / double(std::max(all, 1LL)), "share");
  }
}

PaperResult remake_vermeer(Device& device, const PaperOptions& options) {
  Study study(device, options);
  study.result.notes = {
      fmt::format("Built-in scenes stand for the paper's: {} for {}, {} for {}, {} for {}, {} for {}.", sponza.scene,
                  sponza.of, sibenik.scene, sibenik.of, san_miguel.scene, san_miguel.of, hairball.scene, hairball.of),
      "The paper's GPU rasterises the map from the scene. Here it is made from eight peeled layers, which is another "
      "work; so tables 2 and 3 compare totals of unlike parts, and the times of making the map stand apart.",
      "`early_out=on` is the paper's section 3.3; `below`, the default, leaves out only what cannot count.",
      "The map is the paper's (surfaces=all, subset=stratified, alpha=0.2) but where 'hidden' or 'relevant' is said.",
      "The pass `sort` brings the samples of the map into the order in which they are read; it is in the totals."};
  table_1(study);
  table_2(study);
  table_3_of_vermeer(study);
  table_of_maps(study);
  figure_3(study);
  figures_4_and_5(study);
  figure_6(study);
  figure_7(study);
  figure_8(study);
  figure_9(study);
  histogram(study);
  pop_in(study, {{"one layer", regular("hbao")},
                 {"1 sample", stochastic("hbao", 1, "below")},
                 {"2 samples", stochastic("hbao", 2, "below")},
                 {"4 samples", stochastic("hbao", 4, "below")},
                 {"all layers", over_all_layers("hbao")}});
  return std::move(study.result);
}

}  // namespace

Paper vermeer2021() {
  return {"vermeer2021", "Stochastic-Depth Ambient Occlusion (Vermeer, Scandolo, Eisemann 2021)", 256, remake_vermeer};
}

}  // namespace gloam::bench
