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
  std::optional<Camera> previous_camera = {};  ///< camera of the frame before, for motion vectors
};

/// Which surfaces under a pixel centre a stochastic depth map is made of: all, as in the paper; those behind the nearest; or of these the
/// ones that may be within the radius of something that the view shows.
enum class StochasticSurfaces { all, hidden, relevant };
/// Names in the order of the enumerators.
const std::vector<std::string>& stochastic_surfaces();

/// Which samples hold a surface: a stratified random subset, as in the paper; or the first the nearest, the second the next one.
enum class StochasticSubset { stratified, nearest };
const std::vector<std::string>& stochastic_subsets();

/// A stochastic depth map (kernels/shared/both/stochastic.h), with the bits that `stochastic-depth` makes with the same choices,
/// of frames without a margin: it numbers pixels from the picture's first.
struct StochasticOptions {
  int samples = 0;  ///< depths per pixel, 0 to 16: planes stochastic.00 ...
  /// Of a stratified map: the share of the samples that each surface is offered to, 0 to 1, used as float; and the seed, at least 0, with the
  /// same effect as `RunOptions::seed` for `stochastic-depth`.
  double alpha = 0.25;
  int seed = 0;
  StochasticSurfaces surfaces = StochasticSurfaces::hidden;
  StochasticSubset subset = StochasticSubset::nearest;
  /// Of relevant surfaces: the radius of the technique that reads the map, scene units, above 0, used as float. None: the scene's
  /// (`suitable_radius`).
  std::optional<double> radius = {};
  double max_reach = 0.25;  ///< and the technique's cap on it on the screen, in widths of the window, 0 to 1
};
/// Whether a map is made, and of relevant surfaces.
bool is_of_relevant(const StochasticOptions& options);

struct CaptureOptions {
  int width = 1920, height = 1080;       ///< of the picture: the display window, which the cameras are of
  int margin_x = 0, margin_y = 0;        ///< pixels around it, on the left and the right, at the top and the bottom
  std::vector<std::string> planes = {};  ///< names of `capture_planes()`; depth is always captured
  int peel = 0;                          ///< depth layers per pixel, 0 to 64: planes peel.00 ... and peel_count
  bool peel_light = false;  ///< also colour and normal of each layer: planes peel_color_r.00 ... peel_normal_z.00 ...
  StochasticOptions stochastic = {};   ///< of every view
  const Outlines* outlines = nullptr;  ///< outlines of the tracer's scene, for plane outline_count; null: no such plane
  std::vector<CaptureView> views = {};
  /// The tracer's scene in the frame before, of the same meshes with vertices in other places, for the motion of objects; null: only
  /// cameras move.
  const Scene* previous_scene = nullptr;
  /// Adds a second view, "view2", by `secondary_camera`, to the only view: degrees, -90 to 90, not 0. If the first view has no
  /// name, it becomes "main".
  std::optional<double> second_view = {};
  /// Replaces the only view by two, "left" and "right", by `stereo_cameras`; the view's cameras, now and before, are the middle
  /// between them.
  std::optional<StereoRig> stereo = {};
  std::function<void(int done, int of)> progress = {};
};

struct CaptureResult {
  Frame frame;
  long long surfaces = 0;  ///< pixels that show a surface
  long long rays = 0;      ///< through pixels (twice where outlines are counted) and towards the sun
  double seconds = 0;      ///< total time to fill the planes
  /// Part of `seconds` for choosing the stochastic depths: mean over the threads.
  double stochastic_seconds = 0;
  double outline_seconds = 0;            ///< part of `seconds` for counting outlines: mean over the threads
  std::optional<VisibleDepths> visible;  ///< depths that the second view is made to cover
};

/// The planes that can be captured: depth, normal, albedo, color, roughness, reflectance, position, back_depth, instance, motion,
/// ambient, metallic.
const std::vector<std::string>& capture_planes();
/// Those that are captured without a word: all but motion, which needs the frame before, ambient and metallic.
std::vector<std::string> usual_capture_planes();

/// Samples a scene at pixel centres. Planes as in docs/gbuffer.md; `peel_count` is the number of all surfaces under the pixel
/// centre, stored or not. `instance` is the mesh's index + 1; 0 is background. `outline_count` is the number of outlines that
/// contain the eye (`Outlines::around`) plus the signed crossings from there to the visible surface, or to the far plane.
/// Attributes of the frame: its scene (gloamScene), what its colour holds (gloamColorHolds: "ambient,shadows"), how its stochastic depths were
/// made (gloamStochasticSurfaces, gloamStochasticSubset, of a stratified map gloamStochasticAlpha and gloamStochasticSeed, of relevant surfaces
/// gloamStochasticRadius, scene units, and gloamStochasticReach), its outlines (gloamOutlines, their extent in scene units, gloamOutlineMethod, and gloamOutlineAngle,
/// degrees), the turn of its second view (gloamSecondView, degrees) and the placement of its eyes (gloamStereo and
/// gloamConvergence, scene units, gloamToeIn, degrees). Near and far planes of cameras clip.
/// Throws UsageError for an unknown plane; for a size or a number of layers or samples out of range; for a second view or a pair of
/// eyes with several views, or both at once; for a second view with motion; for a rig that `stereo_cameras` refuses; for a previous
/// scene of other meshes; for a margin around the views of a display, and for a map of relevant surfaces there. Pixels of the picture are the same with any margin,
/// but in a map of relevant surfaces: what the margin shows has relevant ones too. Throws Error for a camera without a pose, and for a second view if the first shows nothing.
CaptureResult capture(const Tracer& tracer, const CaptureOptions& options);

/// The radius of ambient occlusion that suits a capture: the scene's own, or one made from the depths of these views (radius.h). None
/// where nothing is visible.
std::optional<double> suitable_radius(const Tracer& tracer, const CaptureOptions& options);

}  // namespace gloam
