// Runs every technique once on small frames, one pixel per work-item: to be watched by oclgrind, which finds accesses
// out of bounds.
#include <cstdio>

#include "gloam/error.h"
#include "support/frames.h"
#include "support/techniques.h"

namespace gloam::test {
namespace {

int run_all() {
  int passes = 0;
  for (const Technique& technique : registry()) {
    for (const Shot& shot : {perspective(33, 17), perspective(1, 1)}) {
      for (const bool with_normals : {true, false}) {
        Frame frame = shoot(shot, room(), with_normals);
        const Plan plan = plan_for(technique, frame);
        run(plan, frame, device(), {.math = with_normals ? Math::precise : Math::fast, .lanes = 1});
        passes += int(plan.passes.size());
      }
    }
    std::printf("%s\n", technique.name.c_str());
  }
  std::printf("ran %d passes on %s\n", passes, device().info().platform.c_str());
  return passes > 0 ? 0 : 1;
}

}  // namespace
}  // namespace gloam::test

int main() {
  try {
    return gloam::test::run_all();
  } catch (const gloam::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
