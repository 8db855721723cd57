// Flicker: how a sequence's error changes from frame to frame, on the surfaces that two neighbouring frames show.
#pragma once

#include <optional>
#include <vector>

#include "gloam/frame.h"
#include "gloam/metrics.h"

namespace gloam {

/// How the place of a surface in the frame before is known.
enum class MotionSource {
  plane,    ///< the frame's plane `motion`
  cameras,  ///< the depth, and the cameras of both frames; surfaces stand still
  still     ///< neither: the image is taken to stand still
};

/// "plane", "cameras and depth", "none, the image is taken to stand still"
std::string in_words(MotionSource source);

/// What a frame says about where its surfaces are. All planes cover `window`.
struct Surfaces {
  Window window;                 ///< in the coordinates of the camera's image, pixels
  std::optional<Camera> camera;  ///< counts with a pose only
  std::optional<Channel> depth;  ///< planar view-space distance, scene units; background +inf
  /// x, y: the pixel in the frame before minus the pixel now, pixels, y down; NaN where it is not known.
  std::optional<Plane> motion;
};

MotionSource motion_source(const Surfaces& now, const Surfaces& before);

/// One view of a frame, with its truth. Test and truth have the size of the surfaces' window, and of the mask.
struct SequenceFramePlanes {
  Plane test, truth;
  Mask foreground;
  Surfaces surfaces;
};

/// Sums over pixels of pairs of neighbouring frames (n-1, n). Those of several pairs or views may be added.
///
/// A pixel of n is comparable if frame n-1 shows its surface: of the four pixels around its place there, those count that show a
/// surface at the depth expected (within 5 %, along the surface's slope; with cameras for the depth as they see it, else the same
/// depth), and their bilinear weights add up to a half at least.
struct FlickerSums {
  long long pixels = 0, comparable = 0;      ///< foreground of n; of these comparable
  long long values = 0;                      ///< comparable pixels times components
  double squared = 0, truth_squared = 0;     ///< (change of test - change of truth)^2, (change of truth)^2
  long long new_values = 0, old_values = 0;  ///< of pixels first seen within the last frames, and of the others
  double new_squared_error = 0, old_squared_error = 0;  ///< (test - truth)^2

  FlickerSums& operator+=(const FlickerSums& other);
  /// RMSE of the test's change from frame to frame against the truth's; none without a comparable pixel.
  std::optional<double> flicker() const;
  /// Root of the mean square of the truth's own change.
  std::optional<double> truth_change() const;
  /// Share of the foreground that is comparable.
  std::optional<double> share() const;
  /// RMSE at pixels whose surface came into view within the last `FlickerMeter::young` frames, and at all others.
  std::optional<double> new_rmse() const, old_rmse() const;
  /// Share of the values that are at pixels first seen within the last frames.
  std::optional<double> new_share() const;
};

/// Measures one view of a sequence, frame after frame. Keeps one frame.
class FlickerMeter {
 public:
  /// A surface is new for so many frames, that in which it comes into view included.
  static constexpr int young = 8;

  /// Adds the frame that follows the last one; the sums of the pair, none for the first frame. Throws Error if the planes differ in
  /// size or components, from each other or from the frame before.
  std::optional<FlickerSums> add(SequenceFramePlanes frame);
  /// The next frame is a first one: what comes before it is not known.
  void begin_anew();
  /// How the motion of the last pair was known.
  std::optional<MotionSource> source() const { return source_; }

 private:
  std::optional<SequenceFramePlanes> before_;
  std::vector<unsigned char>
      age_;  ///< frames since a pixel's surface came into view; `always` if it was in the first frame
  std::optional<MotionSource> source_;
};

}  // namespace gloam
