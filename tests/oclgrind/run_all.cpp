// Runs every technique once on small frames, one pixel per work-item: to be watched by oclgrind, which finds accesses
// out of bounds.
#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "gloam/error.h"
#include "support/frames.h"
#include "support/techniques.h"

namespace gloam::test {
namespace {

/// Loops of more turns than this read nothing else, and take minutes to interpret.
constexpr double most_turns = 20;

/// The defaults, and each choice, switch and count at both its ends by itself.
std::vector<Settings> settings_of(const Technique& technique, Frame& frame) {
  std::vector<Settings> all = {{}};
  for (const PlannedPass& planned : plan_for(technique, frame).passes) {
    for (const Parameter& p : planned.technique->parameters) {
      if (p.type == Parameter::Type::floating || planned.technique != &technique) continue;
      const bool is_count = p.type == Parameter::Type::integer;
      for (const double end : {p.min, is_count ? std::min(p.max, most_turns) : p.max}) {
        const std::string text = p.type == Parameter::Type::choice    ? p.choices[size_t(end)]
                                 : p.type == Parameter::Type::boolean ? (end != 0 ? "on" : "off")
                                                                      : fmt::format("{}", int(end));
        const Settings one = {{technique.name + "." + p.name, text}};
        if (std::find(all.begin(), all.end(), one) == all.end()) all.push_back(one);
      }
    }
  }
  return all;
}

/// On frames that are smaller still: oclgrind interprets every sample, and there are hundreds of them per pixel.
int run_variants(const Technique& technique) {
  int passes = 0;
  for (const Shot& shot : {perspective(17, 9), orthographic(17, 9, 2)}) {
    Frame frame = shoot(shot, room());
    for (const Settings& settings : settings_of(technique, frame)) {
      const Plan plan = plan_for(technique, frame, settings);
      run(plan, frame, device(), {.math = Math::precise, .lanes = 1});
      passes += int(plan.passes.size());
    }
  }
  return passes;
}

/// Every `parts`-th technique, from `part` on.
int run_all(size_t part, size_t parts) {
  int passes = 0;
  for (size_t i = part; i < registry().size(); i += parts) {
    const Technique& technique = registry()[i];
    for (const Shot& shot : {perspective(33, 17), perspective(1, 1)}) {
      for (const bool with_normals : {true, false}) {
        Frame frame = shoot(shot, room(), with_normals);
        const Plan plan = plan_for(technique, frame);
        run(plan, frame, device(), {.math = with_normals ? Math::precise : Math::fast, .lanes = 1});
        passes += int(plan.passes.size());
      }
    }
    passes += run_variants(technique);
    std::printf("%s\n", technique.name.c_str());
  }
  std::printf("ran %d passes on %s\n", passes, device().info().platform.c_str());
  return passes > 0 ? 0 : 1;
}

}  // namespace
}  // namespace gloam::test

/// Two numbers: which part of the techniques, and of how many parts.
int main(int argc, char** argv) {
  if (argc != 3) return 2;
  try {
    return gloam::test::run_all(size_t(std::atoi(argv[1])), size_t(std::atoi(argv[2])));
  } catch (const gloam::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
