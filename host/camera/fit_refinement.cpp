#include "camera/fit_refinement.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <opencv2/core.hpp>

#include "camera/rotations.h"

namespace gloam {
namespace {

/// Parameters: turn (3), position (3), logarithms of fx and fy, cx, cy.
constexpr int parameter_count = 10;
using Row = cv::Matx<double, 1, parameter_count>;
using Normal = cv::Matx<double, parameter_count, parameter_count>;
using Vector = cv::Vec<double, parameter_count>;

/// Error of one pixel, and what each parameter changes of it.
struct PixelError {
  double x = 0, y = 0;
  Row dx, dy;
  bool is_seen = false;
};

PixelError error_of(const Camera& camera, const PositionedPixel& pixel) {
  PixelError error;
  const glm::dmat3& turn = camera.pose->world_to_view;
  const glm::dvec3 v = turn * (pixel.world - camera.pose->position);
  const double depth = -v.z;
  if (!camera.orthographic && !(depth > 1e-12)) return error;
  error.is_seen = true;
  const double inverse = camera.orthographic ? 1 : 1 / depth;
  const double x = camera.fx * v.x * inverse, y = -camera.fy * v.y * inverse;
  error.x = camera.cx + x - pixel.pixel.x;
  error.y = camera.cy + y - pixel.pixel.y;
  // By the point in view space, then by the turn (v + w x v) and the position (v - turn * step).
  const double along = camera.orthographic ? 0 : inverse;
  const glm::dvec3 x_by_point(camera.fx * inverse, 0, x * along), y_by_point(0, -camera.fy * inverse, y * along);
  for (int k = 0; k < 3; ++k) {
    glm::dvec3 axis(0.0);
    axis[k] = 1;
    const glm::dvec3 by_turn = glm::cross(axis, v), by_step = -turn[k];
    error.dx(0, k) = glm::dot(x_by_point, by_turn);
    error.dy(0, k) = glm::dot(y_by_point, by_turn);
    error.dx(0, 3 + k) = glm::dot(x_by_point, by_step);
    error.dy(0, 3 + k) = glm::dot(y_by_point, by_step);
  }
  error.dx(0, 6) = x;
  error.dy(0, 7) = y;
  error.dx(0, 8) = 1;
  error.dy(0, 9) = 1;
  return error;
}

/// The free directions as columns. An orthographic camera's position is that of its principal point; an assumption ties others.
cv::Mat free_directions(bool orthographic, FitAssumption assumption) {
  std::vector<std::vector<int>> groups = {{0}, {1}, {2}};
  if (!orthographic) groups.insert(groups.end(), {{3}, {4}, {5}});
  if (assumption == FitAssumption::none)
    groups.insert(groups.end(), {{6}, {7}});
  else
    groups.push_back({6, 7});
  if (assumption != FitAssumption::centred_lens || orthographic) groups.insert(groups.end(), {{8}, {9}});
  cv::Mat directions = cv::Mat::zeros(parameter_count, int(groups.size()), CV_64F);
  for (size_t g = 0; g < groups.size(); ++g)
    for (const int parameter : groups[g]) directions.at<double>(parameter, int(g)) = 1;
  return directions;
}

glm::dmat3 turned(const glm::dmat3& rotation, const glm::dvec3& by) {
  // Cayley's map: exact rotations, and by small angles the same as the exponential.
  const glm::dvec3 w = 0.5 * by;
  const glm::dmat3 skew(0, w.z, -w.y, -w.z, 0, w.x, w.y, -w.x, 0), one(1.0);
  return glm::inverse(one - skew) * (one + skew) * rotation;
}

Camera moved(Camera camera, const cv::Mat& step) {
  const auto at = [&](int i) { return step.at<double>(i); };
  camera.pose->world_to_view = turned(camera.pose->world_to_view, {at(0), at(1), at(2)});
  camera.pose->position += glm::dvec3(at(3), at(4), at(5));
  camera.fx *= std::exp(std::clamp(at(6), -1.0, 1.0));
  camera.fy *= std::exp(std::clamp(at(7), -1.0, 1.0));
  camera.cx += at(8);
  camera.cy += at(9);
  return camera;
}

bool is_finite(const Camera& camera) {
  const glm::dvec3 p = camera.pose->position;
  const glm::dmat3& m = camera.pose->world_to_view;
  return std::isfinite(camera.fx + camera.fy + camera.cx + camera.cy + p.x + p.y + p.z + glm::dot(m[0], m[1]) +
                       glm::dot(m[2], m[2])) &&
         camera.fx > 0 && camera.fy > 0;
}

class Refinement {
 public:
  Refinement(const Camera& start, const std::vector<PositionedPixel>& pixels, FitAssumption assumption)
      : pixels_(pixels), directions_(free_directions(start.orthographic, assumption)) {
    for (const PositionedPixel& pixel : pixels) expected_.push_back(expected_error(start, pixel));
  }

  std::optional<Refined> run(Camera camera) {
    double damping = 1e-4;
    for (int i = 0; i < 60; ++i) {
      scale_ = scale_of(camera);
      double cost = accumulate(camera);
      bool is_better = false;
      double gain = 0;
      for (int attempt = 0; attempt < 8 && !is_better; ++attempt, damping *= 10) {
        const Camera next = moved(camera, step(damping));
        if (!is_finite(next)) continue;
        const double next_cost = cost_of(next);
        if (!(next_cost < cost)) continue;
        is_better = true;
        gain = (cost - next_cost) / cost;
        camera = next;
        damping *= 1e-2;
      }
      if (!is_better || gain < 1e-10) break;
      damping = std::max(damping, 1e-12);
    }
    camera.pose->world_to_view = nearest_rotation(camera.pose->world_to_view);
    if (!is_finite(camera)) return {};
    return result(camera);
  }

 private:
  /// Of a position, by its rounding: pixels.
  double expected_error(const Camera& camera, const PositionedPixel& pixel) const {
    const double depth = -(camera.pose->world_to_view * (pixel.world - camera.pose->position)).z;
    const double per_unit = camera.orthographic ? camera.fx : depth > 0 ? camera.fx / depth : 0;
    return std::hypot(least_error, std::min(pixel.rounding * per_unit, 1e6));
  }

  double norm_of(const PixelError& error, size_t i) const {
    return error.is_seen ? std::hypot(error.x, error.y) / expected_[i] : 1e9;
  }

  /// From the median, which wild positions move little. At least 1, the expected error.
  double scale_of(const Camera& camera) const {
    std::vector<double> norms;
    for (size_t i = 0; i < pixels_.size(); ++i) norms.push_back(norm_of(error_of(camera, pixels_[i]), i));
    return std::max(share_below(std::move(norms), 0.5) / 1.1774, 1.0);  // median of a Rayleigh distribution
  }

  double limit() const { return 9 * scale_ * scale_; }
  double robust(double square) const { return square / (1 + square / limit()); }
  double weight(double square) const { return 1 / std::pow(1 + square / limit(), 2); }

  double cost_of(const Camera& camera) const {
    double cost = 0;
    for (size_t i = 0; i < pixels_.size(); ++i) {
      const double norm = norm_of(error_of(camera, pixels_[i]), i);
      cost += robust(norm * norm);
    }
    return cost;
  }

  /// Sums the normal equations; returns the cost.
  double accumulate(const Camera& camera) {
    normal_ = Normal::zeros();
    gradient_ = Vector::all(0);
    double cost = 0;
    for (size_t i = 0; i < pixels_.size(); ++i) {
      const PixelError error = error_of(camera, pixels_[i]);
      const double norm = norm_of(error, i), square = norm * norm;
      cost += robust(square);
      if (!error.is_seen) continue;
      const double w = weight(square) / (expected_[i] * expected_[i]);
      for (int a = 0; a < parameter_count; ++a) {
        gradient_[a] += w * (error.dx(0, a) * error.x + error.dy(0, a) * error.y);
        for (int b = 0; b <= a; ++b)
          normal_(a, b) += w * (error.dx(0, a) * error.dx(0, b) + error.dy(0, a) * error.dy(0, b));
      }
    }
    for (int a = 0; a < parameter_count; ++a)
      for (int b = a + 1; b < parameter_count; ++b) normal_(a, b) = normal_(b, a);
    return cost;
  }

  /// The normal equations of the free directions with a unit diagonal, so that units do not matter: N = scales N' scales.
  struct Scaled {
    cv::Mat normal, scales;  ///< n x n, n x 1
  };

  Scaled scaled_normal() const {
    Scaled scaled{directions_.t() * cv::Mat(normal_) * directions_, {}};
    scaled.scales = cv::Mat(scaled.normal.rows, 1, CV_64F);
    for (int i = 0; i < scaled.normal.rows; ++i)
      scaled.scales.at<double>(i) = 1 / std::sqrt(std::max(scaled.normal.at<double>(i, i), 1e-300));
    scaled.normal = scaled.normal.mul(scaled.scales * scaled.scales.t());
    return scaled;
  }

  cv::Mat step(double damping) const {
    Scaled scaled = scaled_normal();
    for (int i = 0; i < scaled.normal.rows; ++i) scaled.normal.at<double>(i, i) += damping;
    const cv::Mat gradient = directions_.t() * cv::Mat(gradient_);
    cv::Mat found;
    cv::solve(scaled.normal, -gradient.mul(scaled.scales), found, cv::DECOMP_SVD);
    return directions_ * found.mul(scaled.scales);
  }

  /// Standard deviation of the parameter combination `sum` (one weight for each parameter).
  double deviation(const cv::Mat& covariance, const Vector& sum) const {
    return std::sqrt(std::max(cv::Mat(cv::Mat(sum).t() * covariance * cv::Mat(sum)).at<double>(0), 0.0));
  }

  cv::Mat covariance() const {
    const Scaled scaled = scaled_normal();
    cv::Mat values, vectors;
    cv::eigen(scaled.normal, values, vectors);
    cv::Mat inverse = cv::Mat::zeros(scaled.normal.size(), CV_64F);
    for (int i = 0; i < values.rows; ++i)
      inverse += vectors.row(i).t() * vectors.row(i) / std::max(values.at<double>(i), 1e-14);
    inverse = inverse.mul(scaled.scales * scaled.scales.t()) * (scale_ * scale_);
    return directions_ * inverse * directions_.t();
  }

  Refined result(const Camera& camera) {
    scale_ = scale_of(camera);
    Refined refined{camera, accumulate(camera), scale_};
    const cv::Mat inverse = covariance();
    const auto unit = [](int a, double first, int b, double second) {
      Vector sum = Vector::all(0);
      sum[a] += first;
      sum[b] += second;
      return sum;
    };
    refined.focal_error = deviation(inverse, unit(6, 0.5, 7, 0.5));
    refined.aspect_error = deviation(inverse, unit(6, 1, 7, -1));
    refined.centre_error = std::max(deviation(inverse, unit(8, 1, 8, 0)), deviation(inverse, unit(9, 1, 9, 0)));
    return refined;
  }

  const std::vector<PositionedPixel>& pixels_;
  cv::Mat directions_;
  std::vector<double> expected_;
  double scale_ = 1;
  Normal normal_;
  Vector gradient_;
};

}  // namespace

std::optional<Refined> refine_camera(const Camera& start, const std::vector<PositionedPixel>& pixels,
                                     FitAssumption assumption) {
  return Refinement(start, pixels, assumption).run(start);
}

}  // namespace gloam
