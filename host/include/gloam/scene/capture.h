// A G-buffer of a scene.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gloam/frame.h"
#include "gloam/scene/outlines.h"
#include "gloam/scene/secondary_camera.h"
#include "gloam/scene/stereo_cameras.h"
#include "gloam/scene/tracer.h"

namespace gloam {

/// One eye.
struct CaptureView {
  std::string name = {};                       ///< "" for the only view
  Camera camera = {};                          ///< with a pose
  std::optional<Camera> previous_camera = {};  ///< of the frame before, for motion vectors
};

/// A stochastic depth map of all surfaces under the pixel centre (kernels/shared/sampling/stochastic.h).
struct StochasticOptions {
  int samples = 0;     ///< depths per pixel, 0 to 16: planes stochastic.00 ...
  double alpha = 0.2;  ///< share of the samples that a surface is offered to, 0 to 1; used as float
  int seed = 0;        ///< at least 0; what `RunOptions::seed` is to the technique `stochastic-depth`
};

struct CaptureOptions {
  int width = 1920, height = 1080;
  std::vector<std::string> planes = {};  ///< of `capture_planes()`; depth is always there
  int peel = 0;                          ///< depth layers per pixel, 0 to 64: planes peel.00 ... and peel_count
  StochasticOptions stochastic = {};     ///< of every view
  const Outlines* outlines = nullptr;    ///< of the tracer's scene: plane outline_count of every view; none where null
  std::vector<CaptureView> views = {};
  /// Beside the only view a second one, "view2", by `secondary_camera`: degrees, -90 to 90, not 0. A view without a name
  /// becomes "main" then.
  std::optional<double> second_view = {};
  /// In place of the only view two, "left" and "right", by `stereo_cameras`; the view's camera is the middle between them.
  std::optional<StereoRig> stereo = {};
  std::function<void(int done, int of)> progress = {};
};

struct CaptureResult {
  Frame frame;
  long long surfaces = 0;  ///< pixels that show one
  long long rays = 0;      ///< through pixels (twice where outlines are counted) and towards the sun
  double seconds = 0;      ///< of tracing, all that it takes to fill the planes
  /// Of these, choosing what the stochastic depth map keeps: the mean over the threads.
  double stochastic_seconds = 0;
  double outline_seconds = 0;            ///< of these, counting outlines: the mean over the threads
  std::optional<VisibleDepths> visible;  ///< what the second view is made to hold
};

/// What can be captured: depth, normal, albedo, color, roughness, reflectance, position, back_depth, instance, motion.
const std::vector<std::string>& capture_planes();

/// Point-sampled at pixel centres. Every plane as docs/gbuffer.md has it; `peel_count` is the number of all surfaces
/// under the pixel centre, stored or not. `instance` is the mesh's index + 1; 0 is background. `outline_count` is how many
/// outlines the eye is in (`Outlines::around`) and the crossings from there to the visible surface, or to the far plane.
/// The frame says in its attributes which scene it shows (gloamScene), how its stochastic depth map was made
/// (gloamStochasticAlpha, gloamStochasticSeed), with which outlines (gloamOutlines, their extent in scene units,
/// gloamOutlineMethod, and gloamOutlineAngle, degrees), by how much its second view is turned (gloamSecondView, degrees) and how
/// its eyes stand to each other (gloamStereo and gloamConvergence, scene units, and gloamToeIn, degrees).
/// Cameras' near and far planes clip.
/// Throws UsageError for an unknown plane, a size, a number of layers or samples out of range, a second view or a pair of
/// eyes where there are several views or motion, both at once, and a rig that `stereo_cameras` refuses; Error for a
/// camera without a pose, and for a second view where the first shows nothing.
CaptureResult capture(const Tracer& tracer, const CaptureOptions& options);

}  // namespace gloam
