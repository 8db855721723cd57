// Runs every technique once on small frames, one pixel per work-item, under oclgrind, which finds accesses out of bounds. The
// long run covers all choices, switches and counts; every run covers the defaults with few samples. With precise mathematics it
// prints the bits, which must be those of other devices.
#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "gloam/error.h"
#include "scene/fingerprint.h"
#include "support/light_field.h"
#include "support/long.h"
#include "support/stress.h"
#include "support/techniques.h"

namespace gloam::test {
namespace {

// Wide and low: a row has more floats than the guard, so that one row too far lies outside the buffer; and few pixels, since
// oclgrind interprets every sample, of which a pixel has hundreds.
constexpr int width = 65, height = 3;
static_assert(width > Layout::guard);

/// Loops with more iterations than this, or than by default, read nothing new, and take minutes to interpret.
constexpr int most_turns = 8;

/// Every value of a choice or a switch, and both ends of a count.
std::vector<int> values_of(const Parameter& p, int usual) {
  if (p.type == Parameter::Type::integer) return {int(p.min), std::min(int(p.max), std::max(usual, most_turns))};
  std::vector<int> all;
  for (int value = int(p.min); value <= int(p.max); ++value) all.push_back(value);
  return all;
}

/// Each choice, switch and count at values other than the default, one at a time.
std::vector<Settings> settings_of(const Technique& technique, Frame& frame) {
  std::vector<Settings> all;
  for (const PlannedPass& planned : plan_for(technique, frame).passes) {
    for (const Parameter& p : planned.technique->parameters) {
      if (p.type == Parameter::Type::floating || p.type == Parameter::Type::file || planned.technique != &technique) continue;
      const int usual = int(planned.values.number(p.name));
      for (const int value : values_of(p, usual)) {
        if (value == usual) continue;
        const std::string text = p.type == Parameter::Type::choice    ? p.choices[size_t(value)]
                                 : p.type == Parameter::Type::boolean ? (value ? "on" : "off")
                                                                      : fmt::format("{}", value);
        all.push_back({{technique.name + "." + p.name, text}});
      }
    }
  }
  return all;
}

/// Runs variants on a single row, with few samples otherwise: the defaults run on more rows anyway, and reads outside one row are
/// outside the image.
int run_variants(const Technique& technique) {
  int passes = 0;
  if (!is_long_run()) return 0;
  Frame frame = shoot(perspective(width, 1), room());
  for (const Settings& variant : settings_of(technique, frame)) {
    Settings settings = few_samples(technique);
    settings.insert(settings.end(), variant.begin(), variant.end());
    const Plan plan = plan_for(technique, frame, settings);
    run(plan, frame, device(), {.math = Math::precise, .lanes = 1});
    passes += int(plan.passes.size());
  }
  return passes;
}

std::string bits_of(const Frame& frame) {
  Fingerprint fingerprint;
  for (const View& view : frame.views) {
    for (const auto& [name, plane] : view.planes) {
      for (const Channel& channel : plane.channels) {
        for (int y = 0; y < frame.height(); ++y)
          fingerprint.add_bytes(channel.row(y), size_t(frame.width()) * sizeof(float));
      }
    }
  }
  return fingerprint.text();
}

/// With its defaults, and with normals or without.
int run_defaults(const Technique& technique, const Shot& shot, bool with_normals) {
  Frame frame = shoot(shot, room(), with_normals);
  const Plan plan = plan_for(technique, frame, is_long_run() ? Settings{} : few_samples(technique));
  run(plan, frame, device(), {.math = with_normals ? Math::precise : Math::fast, .lanes = 1});
  return int(plan.passes.size());
}

/// Prints the bits for as few pixels as show everything near each other: in a lower image nearly all samples would lie outside.
int tell_bits(const Technique& technique) {
  Frame frame = shoot(perspective(20, 15), room());
  const Plan plan = plan_for(technique, frame, few_samples(technique));
  const Frame out = std::move(run(plan, frame, device(), {.math = Math::precise, .lanes = 1}).frame);
  std::printf("bits of %s: %s\n", technique.name.c_str(), bits_of(out).c_str());
  return int(plan.passes.size());
}

/// Runs with a mask that leaves out most pixels, at full and at half resolution; 0 for a technique that cannot be restricted.
int run_masked(const Technique& technique) {
  Frame frame = shoot(perspective(width, height), room());
  plan_for(technique, frame);  // adds invented planes
  plane_of(frame, "mask").channels[0].at(width / 2, 1) = 1;
  int passes = 0;
  for (const int resolution : {1, 2}) {
    if (resolution > 1 && !is_long_run()) continue;
    try {
      const Plan plan = make_plan({.outputs = {technique.name},
                                   .with = technique.extras,
                                   .settings = few_samples(technique),
                                   .mask = "mask",
                                   .resolution = resolution},
                                  plane_names(frame), "the frame has not");
      run(plan, frame, device(), {.math = Math::precise, .lanes = 1});
      passes += int(plan.passes.size());
    } catch (const UsageError&) {
      return 0;
    }
  }
  return passes;
}

/// Runs at half resolution, where two views that agree are upsampled together; 0 for a technique of one view.
int run_reduced(const Technique& technique) {
  if (technique.views != 2) return 0;
  Frame frame = shoot(perspective(width, height), room());
  plan_for(technique, frame);  // adds invented planes
  const Plan plan = make_plan({.outputs = {technique.name}, .settings = few_samples(technique), .resolution = 2},
                              plane_names(frame), "the frame has not");
  run(plan, frame, device(), {.math = Math::precise, .lanes = 1});
  return int(plan.passes.size());
}

/// Runs on modules whose rays change evenly over the image and on others, with views that read one another; 0 for a technique
/// whose views do not.
int run_modules(const Technique& technique) {
  if (!technique.key_views) return 0;
  int passes = 0;
  for (const NamedDisplay& test : display_cases()) {
    const Frame frame = shoot_modules(test.display, width, height, room());
    for (const char* key_views : {"2", "3"}) {
      if (key_views != std::string("2") && !is_long_run()) continue;
      Settings settings = few_samples(technique);
      settings.insert(settings.end(), {{"reuse", "on"}, {"key_views", key_views}});
      const Plan plan =
          make_plan({.outputs = {technique.name}, .settings = settings}, plane_names(frame), "the frame has not");
      run(plan, frame, device(), {.math = Math::precise, .lanes = 1});
      passes += int(plan.passes.size());
    }
  }
  return passes;
}

/// Runs two estimates of one image: another technique where a mask is not set, and fewer samples by tiles. The passes around the
/// estimates are the same for all techniques.
int run_second_estimates() {
  int passes = 0;
  Frame frame = shoot(perspective(width, height), room());
  plane_of(frame, "mask").channels[0].at(width / 2, 1) = 1;
  for (PlanRequest request : {PlanRequest{.outputs = {"ssao"}, .mask = "mask", .elsewhere = "alchemy"},
                              PlanRequest{.outputs = {"ssao"}, .preset = "medium", .adaptive = "low"},
                              PlanRequest{.outputs = {"ssao"}, .mask = "mask", .adaptive = "low"}}) {
    const Plan plan = make_plan(request, plane_names(frame), "the frame has not");
    run(plan, frame, device(), {.math = Math::precise, .lanes = 1});
    passes += int(plan.passes.size());
  }
  return passes;
}

/// Runs what accumulates over time, with motion and without; the passes are the same for all techniques.
int run_over_time() {
  int passes = 0;
  for (const bool with_motion : {true, false}) {
    Frame frame = shoot(perspective(width, height), room());
    for (const char* plane : {"history_ao", "history_depth", "history_frames"}) plane_of(frame, plane);
    if (with_motion) plane_of(frame, "motion");
    frame.views[0].camera->pose = Pose();
    frame.views[0].camera_before = frame.views[0].camera;
    const Plan plan = make_plan({.outputs = {"ssao"}, .temporal = true}, plane_names(frame), "the frame has not");
    run(plan, frame, device(), {.math = Math::precise, .lanes = 1});
    passes += int(plan.passes.size());
  }
  return passes;
}

/// Runs everything that a technique does on any frame.
int run_all_of(const Technique& technique) {
  int passes = run_defaults(technique, perspective(width, height), true);
  passes += run_defaults(technique, orthographic(width, height, 4), false);
  for (const bool with_normals : {true, false}) passes += run_defaults(technique, perspective(1, 1), with_normals);
  return passes + run_variants(technique) + run_masked(technique) + run_reduced(technique) + run_modules(technique);
}

/// Every `parts`-th technique, from `part` on; `bits_only`: only the printing of bits.
int run_all(size_t part, size_t parts, bool bits_only) {
  int passes = part == 0 && !bits_only ? run_second_estimates() + run_over_time() : 0;
  for (size_t i = part; i < registry().size(); i += parts) {
    passes += tell_bits(registry()[i]);
    if (!bits_only) passes += run_all_of(registry()[i]);
  }
  std::printf("ran %d passes on %s\n", passes, device().info().platform.c_str());
  return passes > 0 ? 0 : 1;
}

}  // namespace
}  // namespace gloam::test

/// Arguments: the part of the techniques, the number of parts, and "bits" to print only the bits.
int main(int argc, char** argv) {
  const bool bits_only = argc == 4 && std::string(argv[3]) == "bits";
  if (argc != 3 && !bits_only) return 2;
  try {
    return gloam::test::run_all(size_t(std::atoi(argv[1])), size_t(std::atoi(argv[2])), bits_only);
  } catch (const gloam::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
