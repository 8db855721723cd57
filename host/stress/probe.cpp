#include "stress/probe.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "base/files.h"
#include "base/lists.h"
#include "gloam/exr.h"
#include "stress/case.h"
#include "stress/frames.h"

namespace gloam::stress {

bool Probe::tries(const std::string& conditions) {
  ++trial_;
  if (subject_.trial && *subject_.trial != trial_) return false;
  conditions_ = conditions;
  if (subject_.begins) subject_.begins(trial_, conditions);
  return true;
}

void Probe::goes_on() const {
  if (subject_.begins) subject_.begins(trial_, conditions_);
}

bool Probe::has_failed(const std::string& what) const {
  return std::any_of(findings_.begin(), findings_.end(), [&](const Finding& f) { return f.what == what && !f.held(); });
}

void Probe::measure(const std::string& what, const Measured& measured, double bound) {
  auto known = std::find_if(findings_.begin(), findings_.end(), [&](const Finding& f) { return f.what == what; });
  const bool is_new = known == findings_.end();
  if (is_new) known = findings_.insert(findings_.end(), {what, 0, bound, {}, trial_, conditions_});
  const bool is_worse = std::isnan(measured.value) ? !std::isnan(known->worst) : measured.value > known->worst;
  if (!is_new && !is_worse) return;
  known->worst = measured.value;
  known->place = measured.place;
  known->trial = trial_;
  known->conditions = conditions_;
}

void Probe::measure_violation(const std::string& what, const Frame& outputs) {
  const Place place = first_violation(outputs);
  measure(what, {place.plane.empty() ? 0.0 : 1.0, place}, 0);
}

void Probe::measure_bits(const std::string& what, const Frame& outputs, const Frame& expected) {
  if (same_bits(outputs, expected)) return measure(what, 0.0, 0);
  Difference d = difference(outputs, expected);
  // Zeros of different signs, or NaNs, differ although their difference is 0.
  d.max = std::max(d.max, double(std::numeric_limits<float>::denorm_min()));
  measure(what, d, 0);
}

void Probe::passes_over(const std::string& reason) { add_new(passed_over_, reason); }

Frame Probe::outputs(Frame& frame, const Settings& settings, const RunOptions& options) const {
  return outputs(frame, settings, options, device());
}

Frame Probe::outputs(Frame& frame, const Settings& settings, const RunOptions& options, Device& device) const {
  const Plan plan = plan_for(technique(), frame, settings);
  Frame out = std::move(run(plan, frame, device, options).frame);
  keep(frame, out, plan, options);
  return out;
}

Frame Probe::outputs(const Plan& plan, const Frame& frame, const RunOptions& options) const {
  Frame out = std::move(run(plan, frame, device(), options).frame);
  keep(frame, out, plan, options);
  return out;
}

namespace {

/// The settings of a trial as text: every parameter of every technique of the plan.
std::string settings_text(const std::string& conditions, const Plan& plan, const RunOptions& options) {
  std::string text = fmt::format("{}\n{}, seed {}\n", conditions, text_of(options), options.seed);
  std::vector<std::string> lines;
  for (const PlannedPass& planned : plan.passes) {
    for (const Parameter& p : planned.technique->parameters)
      add_new(lines, fmt::format("{}.{}={}\n", planned.technique->name, p.name, planned.values.text(p.name)));
  }
  for (const std::string& line : lines) text += line;
  return text;
}

}  // namespace

void Probe::keep(const Frame& frame, const Frame& outputs, const Plan& plan, const RunOptions& options) const {
  if (subject_.folder.empty() || !subject_.trial || *subject_.trial != trial_) return;
  ++kept_;
  const std::filesystem::path folder = subject_.folder;
  const std::string name = fmt::format("{}_case{}_trial{}_{}", technique().name, number_, trial_, kept_);
  write_frame(folder / (name + "_frame.exr"), frame);
  write_frame(folder / (name + "_made.exr"), outputs);
  write_text(folder / (name + "_settings.txt"), settings_text(conditions_, plan, options));
}

std::vector<RunOptions> Probe::all_ways() const {
  if (is_quick()) return two_ways();
  std::vector<RunOptions> all;
  for (const int lanes : usual_lanes(device())) {
    for (const Math math : {Math::precise, Math::fast}) all.push_back({.math = math, .lanes = lanes});
  }
  return all;
}

std::vector<RunOptions> Probe::two_ways() const { return stress::two_ways(device()); }

std::vector<RunOptions> Probe::ways_of_rare_settings() const {
  return is_quick() ? std::vector<RunOptions>{two_ways().front()} : two_ways();
}

Settings Probe::usual_samples() const { return is_quick() ? few_samples(technique()) : Settings{}; }

std::string Probe::opt_out(const std::string& part) const {
  for (const OptOut& out : opt_outs(technique())) {
    if (out.number != number_ || out.part != part) continue;
    if (!part.empty()) add_new(opted_out_parts_, part + ": " + out.reason);
    return out.reason;
  }
  return "";
}

std::string text_of(const RunOptions& options) {
  return fmt::format("{}, {}", options.lanes == 0 ? "lanes auto" : fmt::format("lanes {}", options.lanes),
                     options.math == Math::fast ? "fast" : "precise");
}

std::string normals_text(bool with_normals) { return with_normals ? "exact normals" : "normals from depth"; }

std::string text_of(const Camera& camera) {
  if (camera.slits) return "light-field module";
  return camera.orthographic ? "orthographic" : "perspective";
}

}  // namespace gloam::stress
