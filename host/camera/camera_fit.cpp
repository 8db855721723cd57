#include "camera/camera_fit.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <optional>

#include "camera/camera_range.h"
#include "camera/fit_refinement.h"
#include "camera/fit_start.h"
#include "gloam/error.h"
#include "gloam/projection.h"

namespace gloam {
namespace {

using Pixels = std::vector<PositionedPixel>;

constexpr size_t fewest_pixels = 40, most_refined = 1200;
constexpr double most_wild = 0.35;                     ///< share of positions that a camera need not explain
constexpr double half_pixel = 0.5, most_rounding = 3;  ///< pixels
/// What has to be told for a camera: the aspect to 0.3 %, the principal point to 3 pixels, the focal length to 2 %.
constexpr double largest_aspect_error = 0.003, largest_centre_error = 3, largest_focal_error = 0.02;

/// About `count` of them, evenly spread.
Pixels thinned(const Pixels& pixels, size_t count) {
  if (pixels.size() <= count) return pixels;
  Pixels some;
  for (size_t i = 0; i < count; ++i) some.push_back(pixels[i * pixels.size() / count]);
  return some;
}

/// The best of the refinements from each start of a kind.
std::optional<Refined> best_refinement(const std::vector<Camera>& starts, bool orthographic, FitAssumption assumption,
                                       const Pixels& pixels) {
  std::optional<Refined> best;
  for (const Camera& start : starts) {
    if (start.orthographic != orthographic) continue;
    const std::optional<Refined> refined = refine_camera(start, pixels, assumption);
    if (!refined) continue;
    // Costs are in units of an expected error that depends on the start: errors in pixels do not.
    if (!best || median_error(refined->camera, pixels) < median_error(best->camera, pixels)) best = refined;
  }
  return best;
}

Camera with_square_pixels(Camera camera, double pixel_aspect) {
  camera.fx = std::sqrt(camera.fx * camera.fy / pixel_aspect);
  camera.fy = camera.fx * pixel_aspect;
  return camera;
}

Camera with_centred_lens(Camera camera, const Window& display) {
  camera.cx = (display.x0 + display.x1) / 2.0;
  camera.cy = (display.y0 + display.y1) / 2.0;
  return camera;
}

bool tells_all(const Refined& refined) {
  const bool tells_centre = refined.camera.orthographic || refined.centre_error <= largest_centre_error;
  return refined.aspect_error <= largest_aspect_error && tells_centre;
}

struct Chosen {
  Refined refined;
  FitAssumption assumption = FitAssumption::none;
};

/// The simplest camera that explains the positions as well: fewer parameters follow less noise. Where the positions do not tell the
/// aspect or the principal point, the simpler camera is an assumption.
Chosen simplest(const Refined& full, const std::vector<Camera>& starts, const Pixels& pixels, const FitPrior& prior) {
  Chosen chosen{full};
  const bool orthographic = full.camera.orthographic;
  for (const FitAssumption assumption : {FitAssumption::square_pixels, FitAssumption::centred_lens}) {
    if (orthographic && assumption == FitAssumption::centred_lens) break;
    std::vector<Camera> simpler = {chosen.refined.camera};
    if (!tells_all(chosen.refined)) simpler.insert(simpler.end(), starts.begin(), starts.end());
    for (Camera& start : simpler) {
      start = with_square_pixels(start, prior.pixel_aspect);
      if (assumption == FitAssumption::centred_lens) start = with_centred_lens(start, prior.display);
    }
    const std::optional<Refined> found = best_refinement(simpler, orthographic, assumption, pixels);
    if (!found) continue;
    const double scale = chosen.refined.sigma * chosen.refined.sigma;
    const bool is_as_good = found->cost <= chosen.refined.cost + 12 * scale;
    const bool is_needed = !tells_all(chosen.refined);
    if (!is_as_good && !is_needed) continue;
    chosen.refined = *found;
    if (is_needed) chosen.assumption = assumption;
  }
  return chosen;
}

/// Positions near to what the camera explains.
Pixels explained(const Camera& camera, const Pixels& pixels) {
  const std::vector<double> errors = position_errors(camera, pixels);
  const double limit = 5 * share_below(errors, 0.5) + 0.1;
  Pixels some;
  for (size_t i = 0; i < pixels.size(); ++i)
    if (errors[i] <= limit) some.push_back(pixels[i]);
  return some;
}

bool is_plane(const Pixels& pixels) {
  if (pixels.empty()) return true;
  const Spread spread = spread_of(pixels);
  double rounding = 0;
  for (const PositionedPixel& pixel : pixels) rounding += pixel.rounding / double(pixels.size());
  return spread.deviations.z <= std::max(1e-4 * spread.deviations.x, 3 * rounding);
}

bool is_line(const Pixels& pixels) {
  const Spread spread = spread_of(pixels);
  return !(spread.deviations.y > 1e-5 * spread.deviations.x) || !(spread.deviations.x > 0);
}

/// Depths that hardly differ say little of the perspective.
bool has_one_distance(const Camera& camera, const Pixels& pixels) {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  for (const PositionedPixel& pixel : pixels) {
    const double depth = -(camera.pose->world_to_view * (pixel.world - camera.pose->position)).z;
    low = std::min(low, depth);
    high = std::max(high, depth);
  }
  return high < 1.02 * low;
}

/// A place from where an orthographic camera sees all of them before it, with the principal point in the middle of the image.
void step_back(Camera& camera, const Pixels& pixels, const Window& display) {
  const Camera middle = with_centred_lens(camera, display);
  const glm::dvec3 aside((middle.cx - camera.cx) / camera.fx, (camera.cy - middle.cy) / camera.fy, 0);
  camera.pose->position += glm::transpose(camera.pose->world_to_view) * aside;
  camera.cx = middle.cx;
  camera.cy = middle.cy;
  std::vector<double> z;
  for (const PositionedPixel& pixel : pixels)
    z.push_back((camera.pose->world_to_view * (pixel.world - camera.pose->position)).z);
  const double extent = 6 * glm::length(spread_of(pixels).deviations);
  const glm::dvec3 back = glm::transpose(camera.pose->world_to_view) * glm::dvec3(0, 0, 1);
  camera.pose->position += (share_below(std::move(z), 1) + extent) * back;
}

std::string why_not_told(const Refined& refined, const Pixels& pixels) {
  if (is_plane(pixels))
    return "all of them lie in one plane that nearly faces the camera: its distance and the focal length cannot be "
           "told apart";
  if (has_one_distance(refined.camera, pixels))
    return "all of them lie at nearly one distance: it and the focal length cannot be told apart";
  return fmt::format("they leave the focal length open by {:.0f} %", std::min(100 * refined.focal_error, 999.0));
}

std::string why_outside_range(const Camera& camera, const Window& display) {
  for (const double scale : {camera.fx, camera.fy})
    if (!is_sensible_scale(scale, camera.orthographic))
      return fmt::format("they give {:g} pixels to the unit, and {} make sense", scale,
                         sensible_scale(camera.orthographic));
  if (std::max(std::abs(camera.cx - display.x0), std::abs(camera.cy - display.y0)) > farthest_centre)
    return "they put the principal point over 1e6 pixels away";
  return "";
}

/// Why a camera that is told does not do: its errors.
std::string why_unexplained(const CameraFit& fit, double allowed, const std::vector<double>& errors) {
  if (!(fit.median <= allowed))
    return fmt::format(
        "the best camera leaves {:.3g} pixels (median), and {:.2g} are allowed: another projection, a moved "
        "lens, or positions of another image",
        fit.median, allowed);
  const double far = 10 * std::max(allowed, fit.median);
  const auto wild = std::count_if(errors.begin(), errors.end(), [&](double error) { return error > far; });
  if (double(wild) > most_wild * double(errors.size()))
    return fmt::format("{:.0f} % of them lie over {:.2g} pixels off the best camera",
                       100.0 * double(wild) / double(errors.size()), far);
  return "";
}

CameraFit refused(std::string why) {
  CameraFit fit;
  fit.why_refused = std::move(why);
  return fit;
}

/// Of the perspective and the orthographic camera the one that explains the positions; the latter where both do. A plane looks the
/// same through both.
std::optional<Refined> better_kind(const std::vector<Camera>& starts, const Pixels& pixels) {
  const auto perspective = best_refinement(starts, false, FitAssumption::none, pixels);
  const auto parallel = best_refinement(starts, true, FitAssumption::none, pixels);
  if (!parallel || is_plane(explained(parallel->camera, pixels))) return perspective;
  if (!perspective) return parallel;
  const double limit = std::max(0.01, 1.2 * median_error(perspective->camera, pixels));
  return median_error(parallel->camera, pixels) <= limit ? parallel : perspective;
}

}  // namespace

std::vector<double> position_errors(const Camera& camera, const Pixels& pixels) {
  std::vector<double> errors;
  errors.reserve(pixels.size());
  for (const PositionedPixel& pixel : pixels) {
    const glm::dvec3 v = camera.pose->world_to_view * (pixel.world - camera.pose->position);
    const double along = camera.orthographic ? 1 : -v.z;
    const double x = camera.cx + camera.fx * v.x / along, y = camera.cy - camera.fy * v.y / along;
    errors.push_back(along > 0 ? std::hypot(x - pixel.pixel.x, y - pixel.pixel.y)
                               : std::numeric_limits<double>::infinity());
  }
  return errors;
}

double share_below(std::vector<double> values, double share) {
  const size_t at = std::min(values.size() - 1, size_t(share * double(values.size())));
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(at), values.end());
  return values[at];
}

namespace {

/// Median error in the image that the rounding of positions explains, pixels.
double rounding_in_image(const Camera& camera, const Pixels& pixels) {
  std::vector<double> errors;
  for (const PositionedPixel& pixel : pixels) {
    const double depth = -(camera.pose->world_to_view * (pixel.world - camera.pose->position)).z;
    const double per_unit = camera.orthographic ? camera.fx : depth > 0 ? camera.fx / depth : 0;
    errors.push_back(1.1774 * pixel.rounding * per_unit);
  }
  return share_below(std::move(errors), 0.5);
}

}  // namespace

double allowed_error(const Camera& camera, const Pixels& pixels) {
  return std::clamp(2 * rounding_in_image(camera, pixels), half_pixel, most_rounding);
}

CameraFit fit_camera(const Pixels& pixels, const FitPrior& prior) {
  if (pixels.size() < fewest_pixels)
    return refused(
        fmt::format("{} of the pixels looked at show one, and a fit takes {}", pixels.size(), fewest_pixels));
  if (is_line(pixels)) return refused("all of them lie in one line or in one point");
  const Pixels some = thinned(pixels, most_refined);
  const std::vector<Camera> starts = linear_cameras(some, prior);
  const std::optional<Refined> full = better_kind(starts, some);
  if (!full) return refused("no camera explains them");
  const Chosen chosen = simplest(*full, starts, some, prior);
  CameraFit fit;
  fit.camera = chosen.refined.camera;
  fit.assumption = chosen.assumption;
  fit.used = pixels.size();
  const std::vector<double> errors = position_errors(fit.camera, pixels);
  fit.median = share_below(errors, 0.5);
  fit.percentile_99 = share_below(errors, 0.99);
  fit.rounding = rounding_in_image(fit.camera, pixels);
  fit.why_refused = why_unexplained(fit, allowed_error(fit.camera, pixels), errors);
  if (fit.why_refused.empty() && !(chosen.refined.focal_error <= largest_focal_error))
    fit.why_refused = why_not_told(chosen.refined, explained(fit.camera, pixels));
  if (fit.why_refused.empty()) fit.why_refused = why_outside_range(fit.camera, prior.display);
  if (fit.camera.orthographic) step_back(fit.camera, explained(fit.camera, pixels), prior.display);
  return fit;
}

}  // namespace gloam
