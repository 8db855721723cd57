#include "camera/fit_start.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <opencv2/core.hpp>
#include <optional>

#include "base/random.h"
#include "camera/rotations.h"

namespace gloam {
namespace {

using Pixels = std::vector<PositionedPixel>;
using Maker = std::function<std::optional<Camera>(const Pixels&)>;

/// Pixel coordinates about 1 in size, which keeps the linear equations well conditioned.
struct ImageScale {
  glm::dvec2 centre;
  double size;
  explicit ImageScale(const Window& display)
      : centre((display.x0 + display.x1) / 2.0, (display.y0 + display.y1) / 2.0),
        size(std::max(display.width(), display.height()) / 2.0) {}
  glm::dvec2 operator()(const glm::dvec2& pixel) const { return (pixel - centre) / size; }
};

/// The unit vector x with the least |A x|, for A^T A.
cv::Mat least_direction(const cv::Mat& square) {
  cv::Mat values, vectors;
  cv::eigen(square, values, vectors);
  return vectors.row(vectors.rows - 1);
}

/// Adds the two equations of one pixel for the rows of a projection of `n` coordinates: (p1 - x p3) c = 0, (p2 - y p3) c = 0.
template <size_t n>
void add_equations(cv::Mat& square, const std::array<double, n>& c, const glm::dvec2& image) {
  constexpr int count = int(n);
  std::array<double, 3 * n> across{}, down{};
  for (size_t i = 0; i < n; ++i) {
    across[i] = down[n + i] = c[i];
    across[2 * n + i] = -image.x * c[i];
    down[2 * n + i] = -image.y * c[i];
  }
  for (int a = 0; a < 3 * count; ++a)
    for (int b = 0; b < 3 * count; ++b)
      square.at<double>(a, b) += across[size_t(a)] * across[size_t(b)] + down[size_t(a)] * down[size_t(b)];
}

/// The camera of a projection of positions (columns: by x, y, z, 1) to scaled image coordinates; none for singular ones.
std::optional<Camera> camera_of_projection(const cv::Matx34d& p, const Pixels& pixels, const ImageScale& image,
                                           const glm::dvec3& centre, double size) {
  glm::dvec3 row[3];
  for (int r = 0; r < 3; ++r) row[r] = {p(r, 0), p(r, 1), p(r, 2)};
  const double scale = glm::length(row[2]);
  if (!(scale > 0)) return {};
  int before = 0;
  for (const PositionedPixel& pixel : pixels)
    before += glm::dot(row[2], (pixel.world - centre) / size) + p(2, 3) > 0 ? 1 : -1;
  const double sign = (before >= 0 ? 1 : -1) / scale;
  for (glm::dvec3& r : row) r *= sign;
  const glm::dvec3 last = sign * glm::dvec3(p(0, 3), p(1, 3), p(2, 3));
  const double x = glm::dot(row[0], row[2]), y = glm::dot(row[1], row[2]);
  const glm::dvec3 right = row[0] - x * row[2], down = row[1] - y * row[2];
  Camera camera;
  camera.fx = glm::length(right) * image.size;
  camera.fy = glm::length(down) * image.size;
  camera.cx = image.centre.x + image.size * x;
  camera.cy = image.centre.y + image.size * y;
  const glm::dmat3 rows(row[0], row[1], row[2]);
  const double volume = glm::determinant(rows);
  if (!(camera.fx > 0 && camera.fy > 0) || !(std::abs(volume) > 1e-12) || !std::isfinite(volume)) return {};
  Pose pose;
  const glm::dmat3 axes = glm::transpose(glm::dmat3(glm::normalize(right), -glm::normalize(down), -row[2]));
  if (!(std::abs(glm::determinant(axes)) > 0.1)) return {};
  pose.world_to_view = nearest_rotation(axes);
  pose.position = centre - size * (glm::inverse(glm::transpose(rows)) * last);
  camera.pose = pose;
  return camera;
}

/// The direct linear transform (Abdel-Aziz and Karara 1971; Hartley and Zisserman, section 7.1).
std::optional<Camera> from_space(const Pixels& pixels, const ImageScale& image) {
  const Spread spread = spread_of(pixels);
  const double size = glm::length(spread.deviations);
  if (!(size > 0)) return {};
  cv::Mat square = cv::Mat::zeros(12, 12, CV_64F);
  for (const PositionedPixel& pixel : pixels) {
    const glm::dvec3 w = (pixel.world - spread.centre) / size;
    add_equations<4>(square, {w.x, w.y, w.z, 1}, image(pixel.pixel));
  }
  const cv::Mat p = least_direction(square);
  cv::Matx34d projection;
  for (int i = 0; i < 12; ++i) projection(i / 4, i % 4) = p.at<double>(i);
  return camera_of_projection(projection, pixels, image, spread.centre, size);
}

/// The square of the focal length, in scaled pixels, by which a plane's axes are at right angles and equally long (Zhang 2000), for
/// square pixels and a centred lens; none if the plane does not tell.
std::optional<double> focal_square(const cv::Matx33d& h) {
  double squares = 0, products = 0;
  const auto add = [&](double in_image, double along) {  // in_image / f^2 + along = 0
    squares += in_image * in_image;
    products += in_image * along;
  };
  add(h(0, 0) * h(0, 1) + h(1, 0) * h(1, 1), h(2, 0) * h(2, 1));
  add(h(0, 0) * h(0, 0) + h(1, 0) * h(1, 0) - h(0, 1) * h(0, 1) - h(1, 1) * h(1, 1),
      h(2, 0) * h(2, 0) - h(2, 1) * h(2, 1));
  const double inverse = -products / squares;
  if (!(inverse > 1e-6) || !std::isfinite(inverse)) return {};
  return 1 / inverse;
}

/// From positions in a plane. Their world is taken as right-handed: a plane looks the same in a mirrored one.
std::optional<Camera> from_plane(const Pixels& pixels, const ImageScale& image, double pixel_aspect) {
  const Spread spread = spread_of(pixels);
  const double size = glm::length(spread.deviations);
  if (!(size > 0)) return {};
  cv::Mat square = cv::Mat::zeros(9, 9, CV_64F);
  for (const PositionedPixel& pixel : pixels) {
    const glm::dvec3 w = glm::transpose(spread.axes) * (pixel.world - spread.centre) / size;
    const glm::dvec2 place = image(pixel.pixel);
    add_equations<3>(square, {w.x, w.y, 1}, {place.x, place.y / pixel_aspect});
  }
  const cv::Mat found = least_direction(square);
  cv::Matx33d h;
  for (int i = 0; i < 9; ++i) h(i / 3, i % 3) = found.at<double>(i);
  const double focal = std::sqrt(focal_square(h).value_or(2.0));
  glm::dvec3 column[3];
  for (int c = 0; c < 3; ++c) column[c] = {h(0, c) / focal, h(1, c) / focal, h(2, c)};
  const double length = std::sqrt(glm::length(column[0]) * glm::length(column[1]));
  if (!(length > 0)) return {};
  for (glm::dvec3& c : column) c *= (column[2].z < 0 ? -1 : 1) / length;
  const glm::dvec3 normal = glm::cross(column[0], column[1]);
  const glm::dmat3 to_camera = glm::dmat3(column[0], column[1], normal) * glm::transpose(spread.axes);
  cv::Matx34d projection;
  for (int c = 0; c < 3; ++c) {
    projection(0, c) = to_camera[c].x * focal;
    projection(1, c) = to_camera[c].y * focal * pixel_aspect;
    projection(2, c) = to_camera[c].z;
  }
  projection(0, 3) = column[2].x * focal;
  projection(1, 3) = column[2].y * focal * pixel_aspect;
  projection(2, 3) = column[2].z;
  return camera_of_projection(projection, pixels, image, spread.centre, size);
}

std::optional<Camera> orthographic(const Pixels& pixels) {
  const Spread spread = spread_of(pixels);
  const double size = glm::length(spread.deviations);
  if (!(size > 0)) return {};
  cv::Mat left = cv::Mat::zeros(int(pixels.size()), 4, CV_64F), right = cv::Mat::zeros(int(pixels.size()), 2, CV_64F);
  for (int i = 0; i < left.rows; ++i) {
    const PositionedPixel& pixel = pixels[size_t(i)];
    const glm::dvec3 w = (pixel.world - spread.centre) / size;
    for (int c = 0; c < 3; ++c) left.at<double>(i, c) = w[c];
    left.at<double>(i, 3) = 1;
    right.at<double>(i, 0) = pixel.pixel.x;
    right.at<double>(i, 1) = pixel.pixel.y;
  }
  cv::Mat found;
  if (!cv::solve(left.t() * left, left.t() * right, found, cv::DECOMP_SVD)) return {};
  glm::dvec3 across, down;
  for (int c = 0; c < 3; ++c) across[c] = found.at<double>(c, 0), down[c] = found.at<double>(c, 1);
  Camera camera;
  camera.orthographic = true;
  camera.fx = glm::length(across) / size;
  camera.fy = glm::length(down) / size;
  camera.cx = found.at<double>(3, 0);
  camera.cy = found.at<double>(3, 1);
  const glm::dvec3 axis = glm::normalize(across), up = -glm::normalize(down);
  if (!(camera.fx > 0 && camera.fy > 0) || !(std::abs(glm::dot(axis, up)) < 0.5)) return {};
  Pose pose;
  pose.world_to_view = nearest_rotation(glm::transpose(glm::dmat3(axis, up, glm::cross(axis, up))));
  pose.position = spread.centre;
  camera.pose = pose;
  return camera;
}

/// About `count` of them, evenly spread.
Pixels some_of(const Pixels& pixels, size_t count) {
  const size_t step = std::max<size_t>(1, pixels.size() / count);
  Pixels some;
  for (size_t i = 0; i < pixels.size(); i += step) some.push_back(pixels[i]);
  return some;
}

constexpr double good_enough = 0.05;  ///< pixels: no wild position spoils it

/// Of all pixels, or of the small sample whose camera has the least median error (Rousseeuw 1984), made anew from all pixels that
/// agree with it.
std::optional<Camera> best_camera(const Pixels& pixels, size_t sample_size, const Maker& make) {
  constexpr int samples = 200;
  std::optional<Camera> best = make(pixels);
  const Pixels judges = some_of(pixels, 300);
  double least = best ? median_error(*best, judges) : INFINITY;
  Random random(1);
  for (int i = 0; i < samples && least > good_enough; ++i) {
    Pixels sample;
    for (size_t k = 0; k < sample_size; ++k) sample.push_back(pixels[random.below(pixels.size())]);
    const std::optional<Camera> camera = make(sample);
    const double error = camera ? median_error(*camera, judges) : INFINITY;
    if (error < least) least = error, best = camera;
  }
  for (int i = 0; i < 3 && best && least > good_enough; ++i) {
    Pixels agreeing;
    const std::vector<double> errors = position_errors(*best, pixels);
    for (size_t k = 0; k < pixels.size(); ++k)
      if (errors[k] < 3 * least) agreeing.push_back(pixels[k]);
    const std::optional<Camera> camera = agreeing.size() < 2 * sample_size ? std::nullopt : make(agreeing);
    const double error = camera ? median_error(*camera, judges) : INFINITY;
    if (!(error < least)) break;
    least = error;
    best = camera;
  }
  return best;
}

}  // namespace

double median_error(const Camera& camera, const std::vector<PositionedPixel>& pixels) {
  return share_below(position_errors(camera, pixels), 0.5);
}

Spread spread_of(const Pixels& pixels) {
  Spread spread;
  for (const PositionedPixel& pixel : pixels) spread.centre += pixel.world / double(pixels.size());
  cv::Matx33d sums = cv::Matx33d::zeros();
  for (const PositionedPixel& pixel : pixels) {
    const glm::dvec3 d = pixel.world - spread.centre;
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) sums(a, b) += d[a] * d[b] / double(pixels.size());
  }
  cv::Mat values, vectors;
  cv::eigen(cv::Mat(sums), values, vectors);
  for (int i = 0; i < 3; ++i) {
    spread.deviations[i] = std::sqrt(std::max(values.at<double>(i), 0.0));
    for (int c = 0; c < 3; ++c) spread.axes[i][c] = vectors.at<double>(i, c);
  }
  spread.axes[2] = glm::cross(spread.axes[0], spread.axes[1]);
  return spread;
}

std::vector<Camera> linear_cameras(const Pixels& pixels, const FitPrior& prior) {
  const ImageScale image(prior.display);
  std::vector<Camera> cameras;
  const auto add = [&](size_t sample_size, const Maker& make) {
    if (const auto camera = best_camera(pixels, sample_size, make)) cameras.push_back(*camera);
  };
  add(7, [&](const Pixels& some) { return from_space(some, image); });
  // The positions of a plane leave the first one open, however well it explains them; wild ones make a plane look thick.
  const glm::dvec3 spread = spread_of(pixels).deviations;
  const bool is_settled = !cameras.empty() && median_error(cameras.front(), pixels) < good_enough;
  if (!is_settled || spread.z < 0.01 * spread.x)
    add(6, [&](const Pixels& some) { return from_plane(some, image, prior.pixel_aspect); });
  add(6, orthographic);
  return cameras;
}

}  // namespace gloam
