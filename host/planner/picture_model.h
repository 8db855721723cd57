// The error of a picture that options of several effects make, expected before any of them runs.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace gloam {

/// What a look at few pixels sees of the changes that effects make to the picture: linear colour, over all channels of surfaces.
struct SeenChanges {
  /// Planes of effects, and kinds of light that the image does not show (`hidden_light` and so on).
  std::vector<std::string> names;
  /// Mean product of two changes: symmetric, in squares of the colour's unit.
  std::vector<std::vector<double>> products;
  /// Of each: how much of its change fewer pixels tell, those between filled in.
  std::map<std::string, double> kept_when_coarser;
};

/// Light of what stands in the way, which ambient occlusion takes away and the image does not show: albedo (1 - ao) times the light around.
inline constexpr const char* hidden_light = "hidden_light";
/// The same with the mean light of all surfaces.
inline constexpr const char* hidden_even_light = "hidden_even_light";
/// Light of what rays do not find in the image: reflectance (1 - found) times the light around.
inline constexpr const char* light_not_found = "light_not_found";

/// An effect's plane as an option computes it, compared with the plane as its best option does: the change by it is `kept` times the best
/// one's, and what is left of the difference has `noise` times the best one's mean square, and nothing in common with anything else.
struct UsedPlane {
  std::string plane;
  double kept = 1, noise = 0;
};

/// What is expected of the best options' changes C of the picture, and of the true change T, which all of them aim at.
struct PictureModel {
  std::vector<std::string> planes;
  std::vector<std::vector<double>> products;  ///< mean of C_i C_j
  std::vector<double> with_truth;             ///< mean of C_i T
  std::vector<double> uncertainty;            ///< standard deviation of `with_truth`
  double truth = 0;                           ///< mean of T^2
  double truth_uncertainty = 0;               ///< standard deviation of that
};

/// Of a picture's error: the mean square that is expected, and the standard deviation of that.
struct ExpectedSquare {
  double square = 0, deviation = 0;
  double error() const;        ///< the root
  double uncertainty() const;  ///< standard deviation of the root
};

/// |T - sum of the used changes|^2. Planes that the model does not know change nothing.
ExpectedSquare expected_square(const PictureModel& model, const std::vector<UsedPlane>& used);

/// Of the used changes together.
double mean_square_change(const PictureModel& model, const std::vector<UsedPlane>& used);

/// What data/effect_errors.json makes of a look, which was fitted to traced pictures of built-in scenes; or the file that the environment
/// variable GLOAM_EFFECT_ERRORS names, fitted to others. `go_together`: whether a picture uses all of these planes. Throws Error for a file that
/// is no such table.
PictureModel model_of(const SeenChanges& seen, const std::function<bool(const std::vector<std::string>&)>& go_together);

/// Of a plane by an option at a preset and every `resolution`-th pixel. What samples, and pixels that are filled in, cost depends on the
/// frame's detail. What the file does not name is taken for what it says of ambient occlusion, at the preset medium.
UsedPlane plane_by(const std::string& plane, const std::string& preset, int resolution, const SeenChanges& seen);

}  // namespace gloam
