// Runs in which every kernel is at work: those of each technique, and those that plans add. oclgrind watches the runs, a second
// OpenCL repeats them, and their kernels are compiled to SPIR-V.
#pragma once

#include <string>
#include <vector>

#include "support/stress.h"

namespace gloam::test {

/// A plan and the frame that it runs on.
struct KernelRun {
  std::string what;  ///< "gtao, masked"
  Frame frame;
  Plan plan;
  Math math = Math::precise;
};

struct Coverage {
  int width = 0, height = 0;  ///< of the images
  /// Every choice and switch, and both ends of every count. Otherwise the defaults, with few samples.
  bool every_setting = false;
};

/// The runs of one technique: by a perspective and an orthographic camera, with normals and without, on a single pixel; with a mask;
/// at half resolution; on the modules of light-field displays.
std::vector<KernelRun> runs_of(const Technique& technique, const Coverage& coverage);

/// The runs of what plans add to any technique: two estimates of one image, accumulation over time.
std::vector<KernelRun> runs_of_plans(const Coverage& coverage);

/// The runs of one technique with each preset, all extras, further planes that it may read; at each resolution, by tiles, over time.
/// For what looks at kernels without running them: many samples take long.
std::vector<KernelRun> runs_of_presets(const Technique& technique, const Coverage& coverage);

}  // namespace gloam::test
