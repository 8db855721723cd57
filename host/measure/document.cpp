#include "measure/document.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <thread>

#include "base/command_line.h"
#include "base/json_text.h"
#include "gloam/planes.h"
#include "measure/commit.h"
#include "measure/intervals.h"
#include "measure/naive.h"
#include "results/bound.h"

namespace gloam::bench {

namespace {

/// Six digits: what a timer and the machine's load leave of a figure.
double shortened(double value) { return std::stod(fmt::format("{:.6g}", value)); }

std::vector<double> shortened(const Series& series) {
  std::vector<double> all;
  for (const double value : series) all.push_back(shortened(value));
  return all;
}

/// Empty where there is none: of few rounds, or of none.
std::vector<double> interval_of(const Series& series) {
  const std::optional<Interval> interval = interval_of_median(series);
  return interval ? std::vector{shortened(interval->low), shortened(interval->high)} : std::vector<double>();
}

RoundRatios with_intervals(const RoundRatios& rounds) {
  return {shortened(rounds.ms), shortened(rounds.cpu), interval_of(rounds.ms), interval_of(rounds.cpu)};
}

/// The settings that --set accepts: names without a dot are the technique's own.
Json settings_of(const Plan& plan, const Technique& technique) {
  Json settings = Json::object();
  for (const PlannedPass& planned : plan.passes) {
    for (const Parameter& p : planned.values.table()) {
      const std::string name = planned.technique == &technique ? p.name : planned.technique->name + "." + p.name;
      const bool is_number = p.type == Parameter::Type::floating || p.type == Parameter::Type::integer;
      const std::string text = planned.values.text(p.name);
      settings[name] =
          is_number && std::isfinite(planned.values.number(p.name)) ? Json::parse(text, nullptr, false) : Json(text);
      if (settings[name].is_discarded()) settings[name] = text;
    }
  }
  return settings;
}

std::optional<double> samples_of(const Row& row) {
  const Technique& technique = source_of(*row.variation.technique);
  const ParameterValues* values = values_of(row.timed->plan(), technique.name);
  if (!technique.samples || !values) return {};
  return technique.samples(*values);
}

const char* resolution_name(int resolution) { return resolution == 1 ? "full" : resolution == 2 ? "half" : "quarter"; }

/// Adds what a plan says of a pass to what was counted of it.
void add_planes(report::PassCount& count, const PlannedPass& planned) {
  const Pass& pass = planned.pass;
  for (const std::vector<Binding>* list : {&pass.reads, &pass.writes}) {
    for (const Binding& binding : *list)
      count.bytes_of_planes += double(sizeof(float) * plane_kind(binding.plane).components.size()) *
                               std::max(binding.layers, 1) / (pass.scale * pass.scale);
  }
  count.looks_around = pass.footprint.is_wide;
}

/// With counts for the settings that were counted: presets as they are.
std::vector<report::Pass> passes_of(const Row& row) {
  const Variation& v = row.variation;
  const bool is_counted = v.variant.empty() && v.settings.empty();
  std::vector<report::Pass> passes;
  for (const TimedPlan::Pass& pass : row.timed->passes()) {
    std::optional<report::PassCount> count =
        is_counted ? count_of(v.technique->name, v.preset, pass.name) : std::nullopt;
    for (const PlannedPass& planned : row.timed->plan().passes) {
      if (!count || planned.label() != pass.name) continue;
      // How many pixels are on a list depends on the frame.
      if (define_of(planned.pass, "LISTED") != 0)
        count.reset();
      else
        add_planes(*count, planned);
    }
    passes.push_back({pass.name, times_of(pass.ms), count});
  }
  return passes;
}

report::Row result_of(const Row& row) {
  const Variation& v = row.variation;
  report::Row made{.technique = v.technique->name,
                   .preset = v.name(),
                   .variant = v.variant,
                   .scene = row.scene,
                   .effect = row.effect,
                   .reads = reads_of(*v.technique),
                   .ms = times_and_rounds(row.ms),
                   .rmse_to_truth = row.errors.rmse,
                   .bias = row.errors.bias,
                   .ssim = row.similarity.ssim,
                   .flip = row.similarity.flip,
                   .inconsistency = row.inconsistency,
                   .ratio_to_hbao_plus = row.to_hbao_plus,
                   .ratio_to_gather_floor = row.to_gather_floor,
                   .ratio_to_copy_floor = row.to_copy_floor,
                   .ratio_to_native = row.to_native,
                   .hbao_plus_rounds = with_intervals(row.to_hbao_plus_rounds),
                   .gather_floor_rounds = with_intervals(row.to_gather_floor_rounds),
                   .copy_floor_rounds = with_intervals(row.to_copy_floor_rounds),
                   .ratio_to_own_floor = row.to_own_floor,
                   .copy_floor_ms = row.copy_floor_ms,
                   .ladder = row.ladder,
                   .naive = row.against_naive,
                   .spent_on = row.spent_on,
                   .passes = passes_of(row),
                   .width = row.width,
                   .height = row.height,
                   .lanes = row.timed->lanes(),
                   .samples = samples_of(row),
                   .resolution = resolution_name(v.resolution),
                   .math = v.math == Math::fast ? "fast" : "precise",
                   .real = v.real == Real::float32 ? "float" : "double",
                   .storage = v.storage == Storage::float32 ? "float" : "half",
                   .settings = settings_of(row.timed->plan(), *v.technique),
                   .image = row.image};
  if (!row.own_floor_ms.empty()) made.own_floor_ms = median(row.own_floor_ms);
  if (!row.cpu_ms.empty()) made.cpu_ms = times_and_rounds(row.cpu_ms);
  if (!row.against_naive.empty()) made.ratio_to_naive = row.against_naive.front().ratio;
  return made;
}

std::string utc_day() {
  const auto today = std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now());
  const std::chrono::year_month_day day(today);
  return fmt::format("{:04}-{:02}-{:02}", int(day.year()), unsigned(day.month()), unsigned(day.day()));
}

/// Those of the largest frame: planes of small ones stay in caches.
Peaks peaks_of(const std::vector<report::Scene>& scenes) {
  const auto pixels = [](const report::Scene& scene) { return *scene.width * *scene.height; };
  const auto largest =
      std::max_element(scenes.begin(), scenes.end(),
                       [&](const report::Scene& a, const report::Scene& b) { return pixels(a) < pixels(b); });
  return largest == scenes.end() ? Peaks{} : largest->peaks.value_or(Peaks{});
}

/// Says of each pass what limits it on its scene's frame.
void add_bounds(report::Measurements& made) {
  for (report::Row& row : made.rows) {
    const auto scene = std::find_if(made.scenes.begin(), made.scenes.end(),
                                    [&](const report::Scene& s) { return s.name == row.scene; });
    if (scene == made.scenes.end() || !scene->peaks || !row.width || !row.height) continue;
    for (report::Pass& pass : row.passes)
      pass.bound = bound_of(pass, *scene->peaks, *row.width * *row.height, row.lanes.value_or(1));
  }
}

/// Rays per pixel of the truths; none if they differ, or one does not state it.
std::optional<double> rays_of(const std::vector<report::Scene>& scenes) {
  std::optional<double> rays;
  for (const report::Scene& scene : scenes) {
    if (!scene.truth_rays || (rays && *rays != *scene.truth_rays)) return {};
    rays = scene.truth_rays;
  }
  return rays;
}

}  // namespace

std::string cpu_model() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const size_t colon = line.find(": ");
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

report::Measurements results_on(const DeviceInfo& device) {
  report::Measurements made;
  made.device = device.name;
  made.cpu = cpu_model();
  made.cores = std::thread::hardware_concurrency();
  if (!device.name.empty()) made.driver = fmt::format("{} {}", device.platform, device.driver);
  made.date = utc_day();
  made.commit = commit;
  made.gloam = GLOAM_VERSION;
  made.command = command_line();
  return made;
}

report::Milliseconds times_of(const Series& ms) {
  if (ms.empty()) return {};
  const auto [least, most] = std::minmax_element(ms.begin(), ms.end());
  return {median(ms), *least, *most};
}

report::Milliseconds times_and_rounds(const Series& ms) {
  report::Milliseconds times = times_of(ms);
  times.rounds = shortened(ms);
  times.interval = interval_of(ms);
  return times;
}

report::Reads reads_of(const Technique& technique) { return {depths_of(technique), technique.views}; }

report::Scene scene_of(const std::string& name, const std::string& scene_class, const std::string& effect,
                       const Frame& frame, const Radius& radius) {
  report::Scene scene{.name = name, .scene_class = scene_class, .effect = effect};
  scene.width = frame.width();
  scene.height = frame.height();
  scene.radius = radius.value;
  scene.radius_from = name_of(radius.from);
  scene.radius_pixels = median_reach(frame, radius.value);
  scene.peaks = Peaks{};
  return scene;
}

report::Measurements results_of(const Measurement& measurement, const MeasureOptions& options,
                                const DeviceInfo& device) {
  report::Measurements made = results_on(device);
  made.rounds = options.rounds;
  made.rays = rays_of(measurement.scenes);
  made.peaks = peaks_of(measurement.scenes);
  made.scenes = measurement.scenes;
  for (const auto& row : measurement.rows) made.rows.push_back(result_of(*row));
  add_bounds(made);
  made.growth = measurement.growth;
  made.converged = measurement.converged;
  made.scales = measurement.scales;
  made.planes = measurement.planes;
  made.skipped = measurement.skipped;
  made.left_out = measurement.left_out;
  return made;
}

}  // namespace gloam::bench
