// Hard cases 1 and 7: arbitrary values in the planes.
#include <cmath>
#include <limits>

#include "gloam/normalise.h"
#include "gloam/planes.h"
#include "stress/case.h"
#include "stress/draw.h"
#include "stress/frames.h"
#include "stress/surfaces.h"

namespace gloam::stress {
namespace {

const char* const out_of_range = "value out of its range";

/// Reports the smallest draw that shows the same fault, which a person can examine: one is enough.
void measure_smallest(Probe& probe, const Draw& drawn) {
  if (probe.has_failed(out_of_range)) return;
  const auto made_of = [&](const Draw& one) {
    probe.goes_on();  // each new size and setting compiles
    Frame frame = clone(one.frame);
    return outputs_of(probe.technique(), frame, one.settings, one.options, probe.device());
  };
  const Draw smallest = shrunk(clone(drawn), [&](const Draw& one) { return !violation(made_of(one)).empty(); });
  Frame frame = clone(smallest.frame);
  const Frame out = probe.outputs(frame, smallest.settings, smallest.options);
  Place place = first_violation(out);
  place.holds += fmt::format(" in the smallest frame that shows it: {}", smallest.text());
  probe.measure(out_of_range, {1, place}, 0);
}

void any_input(Probe& probe) {
  const int frames = probe.frames(60, 1000);
  for (int number = 1; number <= frames; ++number) {
    if (!probe.tries(fmt::format("random frame {} of seed {}", number, probe.seed()))) continue;
    Draw drawn = draw(probe.technique(), probe.device(), probe.extent(), probe.seed(), uint32_t(number));
    const Frame out = probe.outputs(drawn.frame, drawn.settings, drawn.options);
    if (violation(out).empty())
      probe.measure(out_of_range, 0.0, 0);
    else
      measure_smallest(probe, drawn);
  }
}

/// Each float parameter at both ends of its range, and each choice and switch, one at a time.
void extremes(Probe& probe) {
  if (probe.is_quick()) return;
  Draw drawn = draw(probe.technique(), probe.device(), probe.extent(), probe.seed(), 0);
  std::vector<Settings> all = variants(probe.technique(), drawn.frame);
  for (const Parameter& p : probe.technique().parameters) {
    if (p.type != Parameter::Type::floating) continue;
    for (const double value : {p.min, p.max}) all.push_back({{probe.technique().name + "." + p.name, exact(value)}});
  }
  for (const Shot& shot : usual_shots()) {
    for (const Settings& settings : all) {
      for (const RunOptions& way : probe.two_ways()) {
        if (!probe.tries(fmt::format("{}, {}, {}", text_of(settings), text_of(shot.camera), text_of(way)))) continue;
        Frame frame = shoot(shot, room());
        probe.measure_violation(out_of_range, probe.outputs(frame, settings, way));
      }
    }
  }
}

// --- Row 7

void set_normals(Frame& frame, const std::function<float(float, int, int)>& change) {
  for (Channel& channel : plane_of(frame, "normal").channels) {
    for (int y = 0; y < frame.height(); ++y) {
      for (int x = 0; x < frame.width(); ++x) channel.at(x, y) = change(channel.at(x, y), x, y);
    }
  }
  normalise(frame);
}

struct Change {
  const char* name;
  float (*change)(float, int, int);
};

const Change changes[] = {{"zero", [](float, int, int) { return 0.0f; }},
                          {"NaN", [](float, int, int) { return nan; }},
                          {"NaN and zero here and there",
                           [](float n, int x, int y) { return (x + y) % 3 == 0   ? nan
                                                              : (x * y) % 5 == 0 ? 0
                                                                                 : n; }},
                          {"facing away", [](float n, int, int) { return -n; }},
                          {"infinite", [](float n, int, int) { return n * infinity; }}};

void normals_of_no_use(Probe& probe) {
  for (const RunOptions& way : probe.two_ways()) {
    for (const Change& change : changes) {
      if (!probe.tries(fmt::format("normals {}, {}", change.name, text_of(way)))) continue;
      Frame frame = shoot(perspective(80, 60), room());
      set_normals(frame, change.change);
      probe.measure_violation("value out of its range: normals zero, NaN, infinite, facing away",
                              probe.outputs(frame, probe.usual_samples(), way));
    }
  }
}

// A normal scaled to another length and back is within two roundings of each component.
void normals_of_any_length(Probe& probe) {
  if (!probe.opt_out("any length").empty()) return;
  // The mean instead of the largest difference if the technique states why a pixel may differ.
  const bool by_mean = !probe.opt_out("lengths").empty();
  for (const RunOptions& way : probe.two_ways()) {
    Lazy<Frame> expected([&] {
      Frame unit = shoot(perspective(80, 60), room());
      return probe.outputs(unit, probe.usual_samples(), way);
    });
    for (const float length : {1000.0f, 1e-20f, 0.5f, 1e18f}) {
      if (!probe.tries(fmt::format("normals of length {}, {}", length, text_of(way)))) continue;
      Frame frame = shoot(perspective(80, 60), room());
      set_normals(frame, [&](float n, int, int) { return n * length; });
      const Difference d = difference(probe.outputs(frame, probe.usual_samples(), way), expected.get());
      probe.measure(fmt::format("normals of any length: {} difference to unit ones", by_mean ? "mean" : "largest"),
                    {by_mean ? d.mean : d.max, d.place}, 1e-5);
    }
  }
}

/// In an image of one pixel every sample is the point itself.
void sample_on_the_point_itself(Probe& probe) {
  for (const Shot& shot : {perspective(1, 1), orthographic(1, 1, 1)}) {
    for (const RunOptions& way : probe.two_ways()) {
      if (!probe.tries(fmt::format("one pixel, {}, {}", text_of(shot.camera), text_of(way)))) continue;
      Frame frame = shoot(shot, tilted_plane(2, 0.5, 1));
      const Plan plan = plan_for(probe.technique(), frame, few_samples(probe.technique()));
      const Frame out = probe.outputs(plan, frame, way);
      probe.measure_violation("value out of its range in an image of one pixel", out);
      if (!probe.opt_out("open").empty() || unit_interval_outputs(plan).empty()) continue;
      probe.measure("distance from open with nothing but the point itself", distance_from_open(plan, out), 0);
    }
  }
}

}  // namespace

namespace case_files {

std::vector<Case> inputs() {
  return {
      {1,
       "any input",
       "Planes with NaN, infinities, zeros, negative numbers, denormals and floats of any size, cameras and "
       "settings of any kind: every output is finite and in its range.",
       {any_input, extremes}},
      {7,
       "normals of no use",
       "Normals that are zero, NaN, infinite, of any length or facing away, and samples on the point itself, give a "
       "defined result.",
       {normals_of_no_use, normals_of_any_length, sample_on_the_point_itself}}};
}

}  // namespace case_files
}  // namespace gloam::stress
