#include "measure/document.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <thread>

#include "base/command_line.h"
#include "base/json_text.h"
#include "measure/commit.h"
#include "measure/intervals.h"

namespace gloam::bench {

namespace {

/// Six digits: what a timer and the machine's load leave of a figure.
Json shortened(double value) { return std::stod(fmt::format("{:.6g}", value)); }

Json rounds_of(const Series& series) {
  Json rounds = Json::array();
  for (const double value : series) rounds.push_back(shortened(value));
  return rounds;
}

/// Null where there is none: of few rounds, or of none.
Json interval_of(const Series& series) {
  const std::optional<Interval> interval = interval_of_median(series);
  return interval ? Json{shortened(interval->low), shortened(interval->high)} : Json(nullptr);
}

/// As `milliseconds`, with every round.
Json milliseconds_and_rounds(const Series& ms) {
  Json document = milliseconds(ms);
  document["interval"] = interval_of(ms);
  document["rounds"] = rounds_of(ms);
  return document;
}

/// A ratio's rounds and interval, under the ratio's name.
void add_rounds(Json& document, const std::string& ratio, const RoundRatios& rounds) {
  document[ratio + "_interval"] = interval_of(rounds.ms);
  document[ratio + "_rounds"] = rounds_of(rounds.ms);
  if (rounds.cpu.empty()) return;
  document["cpu_" + ratio + "_interval"] = interval_of(rounds.cpu);
  document["cpu_" + ratio + "_rounds"] = rounds_of(rounds.cpu);
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

Json samples_of(const Row& row) {
  const Technique& technique = source_of(*row.variation.technique);
  const ParameterValues* values = values_of(row.timed->plan(), technique.name);
  return technique.samples && values ? Json(technique.samples(*values)) : Json(nullptr);
}

const char* resolution_name(int resolution) { return resolution == 1 ? "full" : resolution == 2 ? "half" : "quarter"; }

Json document_of(const Ladder& l) {
  return {{"t0w", or_null(l.t0w)},           {"t1", or_null(l.t1)}, {"t2", or_null(l.t2)},
          {"t12", or_null(l.t12)},           {"t3", or_null(l.t3)}, {"t4_bias", or_null(l.t4_bias)},
          {"t4_noise", or_null(l.t4_noise)}, {"t5", or_null(l.t5)}};
}

Json document_of(const AgainstNaive& part) {
  return {{"part", part.part},
          {"ms", milliseconds(part.ms)},
          {"naive_ms", milliseconds(part.naive_ms)},
          {"ratio", part.ratio},
          {"mean_difference", or_null(part.mean_difference)},
          {"max_difference", or_null(part.greatest_difference)}};
}

std::optional<double> ratio_to_naive(const Row& row) {
  return row.against_naive.empty() ? std::optional<double>() : row.against_naive.front().ratio;
}

/// By count, for the settings that were counted: presets as they are.
Json count_of_pass(const Row& row, const std::string& pass) {
  const Variation& v = row.variation;
  const std::optional<PassCount> count =
      v.variant.empty() && v.settings.empty() ? count_of(v.technique->name, v.preset, pass) : std::nullopt;
  if (!count) return nullptr;
  return {{"operations", count->operations},
          {"loads", count->loads},
          {"bytes_loaded", count->bytes_loaded},
          {"bytes_stored", count->bytes_stored}};
}

Json document_of(const Peaks& peaks) {
  return {{"copy_gb_per_s", or_null(peaks.copy_gb_per_s)},
          {"gather_g_per_s", or_null(peaks.gather_g_per_s)},
          {"fma_gflops", or_null(peaks.fma_gflops)}};
}

Json figures_of(const Row& row) {
  const Variation& v = row.variation;
  Json passes = Json::array(), spent_on = Json::array(), naive = Json::array();
  for (const TimedPlan::Pass& pass : row.timed->passes())
    passes.push_back(
        {{"name", pass.name}, {"ms", milliseconds(pass.ms)}, {"per_pixel", count_of_pass(row, pass.name)}});
  for (const Share& share : row.spent_on) spent_on.push_back({{"what", share.what}, {"share", share.share}});
  for (const AgainstNaive& part : row.against_naive) naive.push_back(document_of(part));
  return {{"technique", v.technique->name},
          {"preset", v.name()},
          {"variant", v.variant},
          {"depths", depths_of(*v.technique)},
          {"views", v.technique->views},
          {"settings", settings_of(row.timed->plan(), *v.technique)},
          {"samples", samples_of(row)},
          {"resolution", resolution_name(v.resolution)},
          {"math", v.math == Math::fast ? "fast" : "precise"},
          {"real", v.real == Real::float32 ? "float" : "double"},
          {"storage", v.storage == Storage::float32 ? "float" : "half"},
          {"scene", row.scene},
          {"effect", row.effect},
          {"width", row.width},
          {"height", row.height},
          {"lanes", row.timed->lanes()},
          {"ms", milliseconds_and_rounds(row.ms)},
          {"passes", passes},
          {"own_floor_ms", row.own_floor_ms.empty() ? Json(nullptr) : Json(median(row.own_floor_ms))},
          {"ratio_to_own_floor", or_null(row.to_own_floor)},
          {"spent_on", spent_on},
          {"ratio_to_naive", or_null(ratio_to_naive(row))},
          {"naive", naive},
          {"ratio_to_native", or_null(row.to_native)},
          {"ratio_to_gather_floor", or_null(row.to_gather_floor)},
          {"ratio_to_copy_floor", or_null(row.to_copy_floor)},
          {"copy_floor_ms", or_null(row.copy_floor_ms)},
          {"ratio_to_hbao_plus", or_null(row.to_hbao_plus)},
          {"rmse_to_truth", or_null(row.errors.rmse)},
          {"bias", or_null(row.errors.bias)},
          {"ssim", or_null(row.similarity.ssim)},
          {"flip", or_null(row.similarity.flip)},
          {"flicker", nullptr},
          {"inconsistency", or_null(row.inconsistency)},
          {"kind", nullptr},
          {"ladder", document_of(row.ladder)},
          {"image", or_null(row.image)}};
}

Json document_of(const Row& row) {
  Json document = figures_of(row);
  document["cpu_ms"] = row.cpu_ms.empty() ? Json(nullptr) : milliseconds_and_rounds(row.cpu_ms);
  add_rounds(document, "ratio_to_hbao_plus", row.to_hbao_plus_rounds);
  add_rounds(document, "ratio_to_gather_floor", row.to_gather_floor_rounds);
  add_rounds(document, "ratio_to_copy_floor", row.to_copy_floor_rounds);
  return document;
}

}  // namespace

Json document_of(const SceneFacts& scene) {
  Json document = {{"name", scene.name},
                   {"class", scene.scene_class},
                   {"effect", scene.effect},
                   {"size", {scene.width, scene.height}},
                   {"radius", scene.radius.value},
                   {"radius_from", name_of(scene.radius.from)},
                   {"radius_pixels", scene.radius_pixels},
                   {"truth_noise", or_null(scene.truth_noise)},
                   {"truth_rays", or_null(scene.truth_rays)},
                   {"truth_image", or_null(scene.truth_image)},
                   {"white", scene.white},
                   {"peaks", document_of(scene.peaks)},
                   {"base",
                    {{"name", scene.base},
                     {"rmse_to_truth", or_null(scene.base_errors.rmse)},
                     {"bias", or_null(scene.base_errors.bias)}}}};
  if (scene.traced) {
    document["made"] = scene.made;
    document["reused"] = scene.reused;
  }
  return document;
}

namespace {

Json document_of(const GrowthFacts& facts) {
  Json points = Json::array();
  for (const GrowthPoint& p : facts.growth.points) points.push_back({{"x", p.x}, {"ms", p.ms}});
  return {{"technique", facts.technique},
          {"over", facts.growth.over},
          {"scene", facts.scene},
          {"exponent", or_null(exponent(facts.growth.points))},
          {"points", points}};
}

Json document_of(const ConvergedFacts& facts) {
  return {{"technique", facts.technique->name},
          {"scene", facts.scene},
          {"effect", facts.effect},
          {"depths", depths_of(*facts.technique)},
          {"views", facts.technique->views},
          {"rmse_to_truth", or_null(facts.errors.rmse)},
          {"bias", or_null(facts.errors.bias)}};
}

Json document_of(const ScaleFacts& facts) {
  return {{"technique", facts.technique},     {"scene", facts.scene},      {"from", facts.from}, {"to", facts.to},
          {"mean_change", facts.mean_change}, {"mae", facts.mean_absolute}};
}

Json document_of(const PlaneFacts& facts) {
  return {{"technique", facts.technique}, {"plane", facts.plane}, {"least", facts.least},
          {"mean", facts.mean},           {"tilt", facts.tilt},   {"direction", facts.direction},
          {"camera", facts.camera},       {"x", facts.x},         {"y", facts.y}};
}

Json document_of(const Skipped& s) {
  return {{"technique", s.technique}, {"preset", or_null(s.preset)}, {"scene", or_null(s.scene)}, {"why", s.why}};
}

Json document_of(const LeftOut& l) {
  return {{"technique", or_null(l.technique)},
          {"preset", or_null(l.preset)},
          {"variant", l.variant},
          {"scene", l.scene},
          {"effect", l.effect},
          {"what", l.what}};
}

template <typename Thing>
Json list_of(const std::vector<Thing>& things) {
  Json list = Json::array();
  for (const Thing& thing : things) list.push_back(document_of(thing));
  return list;
}

std::string utc_day() {
  const auto today = std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now());
  const std::chrono::year_month_day day(today);
  return fmt::format("{:04}-{:02}-{:02}", int(day.year()), unsigned(day.month()), unsigned(day.day()));
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

Json origin_of(const DeviceInfo& device) {
  return {{"device", device.name},
          {"cpu", cpu_model()},
          {"cores", std::thread::hardware_concurrency()},
          {"driver", fmt::format("{} {}", device.platform, device.driver)},
          {"date", utc_day()},
          {"commit", commit},
          {"gloam", GLOAM_VERSION},
          {"command", command_line()},
          {"set", nullptr}};
}

/// Those of the largest frame: planes of small ones stay in caches.
static Peaks peaks_of(const std::vector<SceneFacts>& scenes) {
  const auto pixels = [](const SceneFacts& scene) { return long(scene.width) * scene.height; };
  const auto largest = std::max_element(
      scenes.begin(), scenes.end(), [&](const SceneFacts& a, const SceneFacts& b) { return pixels(a) < pixels(b); });
  return largest == scenes.end() ? Peaks{} : largest->peaks;
}

/// Rays per pixel of the truths; none if they differ, or one does not state it.
static std::optional<double> rays_of(const std::vector<SceneFacts>& scenes) {
  std::optional<double> rays;
  for (const SceneFacts& scene : scenes) {
    if (!scene.truth_rays || (rays && *rays != *scene.truth_rays)) return {};
    rays = scene.truth_rays;
  }
  return rays;
}

Json document_of(const Measurement& measurement, const MeasureOptions& options, const DeviceInfo& device) {
  Json results = Json::array();
  for (const auto& row : measurement.rows) results.push_back(document_of(*row));
  Json document = origin_of(device);
  document.update({{"rounds", options.rounds},
                   {"rays", or_null(rays_of(measurement.scenes))},
                   {"peaks", document_of(peaks_of(measurement.scenes))},
                   {"scenes", list_of(measurement.scenes)},
                   {"results", results},
                   {"growth", list_of(measurement.growth)},
                   {"converged", list_of(measurement.converged)},
                   {"scales", list_of(measurement.scales)},
                   {"planes", list_of(measurement.planes)},
                   {"skipped", list_of(measurement.skipped)},
                   {"left_out", list_of(measurement.left_out)},
                   {"paper", Json::array()}});
  return document;
}

}  // namespace gloam::bench
