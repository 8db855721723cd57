#include "compare/flip.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace gloam {
namespace {

using std::numbers::pi;
using Colour = cv::Vec3d;

// --- Colour spaces

/// Linear sRGB to XYZ, under D65.
const cv::Matx33d to_xyz(10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794,  //
                         2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897,    //
                         1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382);
const cv::Matx33d from_xyz = to_xyz.inv();
const Colour white = to_xyz * Colour(1, 1, 1);

Colour relative_xyz(const Colour& linear) {
  const Colour xyz = to_xyz * linear;
  return {xyz[0] / white[0], xyz[1] / white[1], xyz[2] / white[2]};
}

Colour opponents(double x, double y, double z) { return {116 * y - 16, 500 * (x - y), 200 * (y - z)}; }

/// Linear opponents: luminance, red-green, blue-yellow.
Colour to_ycxcz(const Colour& linear) {
  const Colour xyz = relative_xyz(linear);
  return opponents(xyz[0], xyz[1], xyz[2]);
}

Colour from_ycxcz(const Colour& c) {
  const double y = (c[0] + 16) / 116, x = y + c[1] / 500, z = y - c[2] / 200;
  return from_xyz * Colour(x * white[0], y * white[1], z * white[2]);
}

/// L*a*b*, with weaker colours where it is dark (Hunt effect).
Colour to_hunt_lab(const Colour& linear) {
  const auto compressed = [](double t) {
    constexpr double delta = 6.0 / 29;
    return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29;
  };
  const Colour xyz = relative_xyz(linear);
  Colour lab = opponents(compressed(xyz[0]), compressed(xyz[1]), compressed(xyz[2]));
  lab[1] *= 0.01 * lab[0];
  lab[2] *= 0.01 * lab[0];
  return lab;
}

/// Distance for large colour differences: of lightness, plus that of the other two.
double hyab(const Colour& a, const Colour& b) { return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]); }

template <typename To>
cv::Mat each(const cv::Mat& image, To to) {
  cv::Mat out(image.size(), CV_64FC3);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) out.at<Colour>(y, x) = to(image.at<Colour>(y, x));
  }
  return out;
}

Colour kept_in_cube(Colour c) {
  for (int i = 0; i < 3; ++i) c[i] = std::clamp(c[i], 0.0, 1.0);
  return c;
}

// --- Filters

/// Contrast sensitivity of an opponent channel: a sum of two Gaussians over the visual angle, in degrees.
struct Sensitivity {
  double a1, b1, a2, b2;
};
constexpr double widest = 0.04;
const Sensitivity sensitivities[3] = {{1, 0.0047, 0, 1e-5}, {1, 0.0053, 0, 1e-5}, {34.1, widest, 13.5, 0.025}};

int sensitivity_radius(double pixels_per_degree) {
  return int(std::ceil(3 * std::sqrt(widest / (2 * pi * pi)) * pixels_per_degree));
}

template <typename Weight>
cv::Mat kernel_of(int radius, Weight weight) {
  cv::Mat kernel(2 * radius + 1, 2 * radius + 1, CV_64F);
  for (int y = -radius; y <= radius; ++y) {
    for (int x = -radius; x <= radius; ++x) kernel.at<double>(y + radius, x + radius) = weight(x, y);
  }
  return kernel;
}

cv::Mat sensitivity_kernel(const Sensitivity& s, double pixels_per_degree) {
  cv::Mat kernel = kernel_of(sensitivity_radius(pixels_per_degree), [&](int x, int y) {
    const double square = double(x * x + y * y) / (pixels_per_degree * pixels_per_degree);
    const auto term = [&](double a, double b) { return a * std::sqrt(pi / b) * std::exp(-pi * pi * square / b); };
    return term(s.a1, s.b1) + term(s.a2, s.b2);
  });
  return kernel / cv::sum(kernel)[0];
}

cv::Mat filtered(const cv::Mat& image, const cv::Mat& kernel) {
  cv::Mat out;
  cv::filter2D(image, out, CV_64F, kernel, {-1, -1}, 0, cv::BORDER_REPLICATE);
  return out;
}

/// Colours as an observer at that distance sees them.
cv::Mat as_seen(const cv::Mat& ycxcz, double pixels_per_degree) {
  std::vector<cv::Mat> channels;
  cv::split(ycxcz, channels);
  for (size_t i = 0; i < 3; ++i)
    channels[i] = filtered(channels[i], sensitivity_kernel(sensitivities[i], pixels_per_degree));
  cv::Mat out;
  cv::merge(channels, out);
  return each(out, [](const Colour& c) { return to_hunt_lab(kept_in_cube(from_ycxcz(c))); });
}

// --- Features

/// Width of the edge detector, degrees.
constexpr double feature_width = 0.082;

double feature_deviation(double pixels_per_degree) { return 0.5 * feature_width * pixels_per_degree; }
int feature_radius(double pixels_per_degree) { return int(std::ceil(3 * feature_deviation(pixels_per_degree))); }

/// First or second derivative of a Gaussian along x: positive weights add up to 1, negative ones to -1.
cv::Mat feature_kernel(bool is_point, double pixels_per_degree) {
  const double deviation = feature_deviation(pixels_per_degree), variance = deviation * deviation;
  cv::Mat kernel = kernel_of(feature_radius(pixels_per_degree), [&](int x, int y) {
    const double bell = std::exp(-double(x * x + y * y) / (2 * variance));
    return (is_point ? x * x / variance - 1 : -x) * bell;
  });
  const double positive = cv::sum(cv::max(kernel, 0))[0], negative = -cv::sum(cv::min(kernel, 0))[0];
  return cv::max(kernel, 0) / positive + cv::min(kernel, 0) / negative;
}

/// Strength of edges or points in a lightness image, whatever their direction.
cv::Mat features(const cv::Mat& lightness, bool is_point, double pixels_per_degree) {
  const cv::Mat kernel = feature_kernel(is_point, pixels_per_degree);
  cv::Mat strength;
  cv::magnitude(filtered(lightness, kernel), filtered(lightness, kernel.t()), strength);
  return strength;
}

cv::Mat feature_difference(const cv::Mat& test, const cv::Mat& truth, double pixels_per_degree) {
  const auto lightness = [](const cv::Mat& ycxcz) {
    cv::Mat y;
    cv::extractChannel(ycxcz, y, 0);
    return cv::Mat((y + 16) / 116);
  };
  const cv::Mat a = lightness(test), b = lightness(truth);
  const auto difference = [&](bool is_point) {
    return cv::Mat(cv::abs(features(a, is_point, pixels_per_degree) - features(b, is_point, pixels_per_degree)));
  };
  cv::Mat root;
  cv::sqrt(cv::max(difference(false), difference(true)) / std::sqrt(2.0), root);
  return root;
}

// --- Differences of colour

constexpr double colour_exponent = 0.7;

/// Maps a distance to 0..1, where small differences take most of the range.
double redistributed(double distance) {
  static const double most =
      std::pow(hyab(to_hunt_lab(Colour(0, 1, 0)), to_hunt_lab(Colour(0, 0, 1))), colour_exponent);
  constexpr double knee = 0.4, height = 0.95;
  const double error = std::pow(distance, colour_exponent), bend = knee * most;
  return error < bend ? height / bend * error : height + (error - bend) / (most - bend) * (1 - height);
}

// --- Greys: along a line

/// A filter of two dimensions as the product of two lines.
struct Lines {
  cv::Mat along, across;
};

template <typename Weight>
cv::Mat line_of(int radius, Weight weight) {
  cv::Mat line(2 * radius + 1, 1, CV_64F);
  for (int x = -radius; x <= radius; ++x) line.at<double>(x + radius) = weight(double(x));
  return line;
}

cv::Mat sensitivity_line(double pixels_per_degree) {
  const cv::Mat line = line_of(sensitivity_radius(pixels_per_degree), [&](double x) {
    return std::exp(-pi * pi * x * x / (pixels_per_degree * pixels_per_degree) / sensitivities[0].b1);
  });
  return line / cv::sum(line)[0];
}

/// As `feature_kernel`, whose signs change along x alone.
Lines feature_lines(bool is_point, double pixels_per_degree) {
  const double deviation = feature_deviation(pixels_per_degree), variance = deviation * deviation;
  const int radius = feature_radius(pixels_per_degree);
  const auto bell = [&](double x) { return std::exp(-x * x / (2 * variance)); };
  const cv::Mat across = line_of(radius, bell);
  const cv::Mat along = line_of(radius, [&](double x) { return (is_point ? x * x / variance - 1 : -x) * bell(x); });
  const double positive = cv::sum(cv::max(along, 0))[0], negative = -cv::sum(cv::min(along, 0))[0];
  return {cv::max(along, 0) / positive + cv::min(along, 0) / negative, across / cv::sum(across)[0]};
}

cv::Mat filtered(const cv::Mat& image, const cv::Mat& along_x, const cv::Mat& along_y) {
  cv::Mat out;
  cv::sepFilter2D(image, out, CV_32F, along_x, along_y, {-1, -1}, 0, cv::BORDER_REPLICATE);
  return out;
}

cv::Mat grey_features(const cv::Mat& grey, const Lines& lines) {
  cv::Mat strength;
  cv::magnitude(filtered(grey, lines.along, lines.across), filtered(grey, lines.across, lines.along), strength);
  return strength;
}

/// Lightness of a linear grey.
double lightness_of(double v) {
  constexpr double delta = 6.0 / 29;
  return 116 * (v > delta * delta * delta ? std::cbrt(v) : v / (3 * delta * delta) + 4.0 / 29) - 16;
}

}  // namespace

int flip_reach(double pixels_per_degree) {
  return std::max(sensitivity_radius(pixels_per_degree), feature_radius(pixels_per_degree));
}

cv::Mat flip_map(const cv::Mat& test, const cv::Mat& truth, double pixels_per_degree) {
  const auto opponent = [](const Colour& c) { return to_ycxcz(kept_in_cube(c)); };
  const cv::Mat a = each(test, opponent), b = each(truth, opponent);
  const cv::Mat features = feature_difference(a, b, pixels_per_degree);
  const cv::Mat seen_a = as_seen(a, pixels_per_degree), seen_b = as_seen(b, pixels_per_degree);
  cv::Mat map(a.size(), CV_64F);
  for (int y = 0; y < map.rows; ++y) {
    for (int x = 0; x < map.cols; ++x) {
      const double colour = redistributed(hyab(seen_a.at<Colour>(y, x), seen_b.at<Colour>(y, x)));
      map.at<double>(y, x) = std::pow(colour, 1 - features.at<double>(y, x));
    }
  }
  return map;
}

cv::Mat grey_flip_map(const cv::Mat& test, const cv::Mat& truth, double pixels_per_degree) {
  const cv::Mat line = sensitivity_line(pixels_per_degree);
  const Lines edge = feature_lines(false, pixels_per_degree), point = feature_lines(true, pixels_per_degree);
  const cv::Mat a = filtered(test, line, line), b = filtered(truth, line, line);
  const cv::Mat edges = cv::abs(grey_features(test, edge) - grey_features(truth, edge));
  const cv::Mat points = cv::abs(grey_features(test, point) - grey_features(truth, point));
  cv::Mat map(test.size(), CV_64F);
  for (int y = 0; y < map.rows; ++y) {
    for (int x = 0; x < map.cols; ++x) {
      const auto seen = [&](const cv::Mat& image) { return std::clamp(double(image.at<float>(y, x)), 0.0, 1.0); };
      const double colour = redistributed(std::abs(lightness_of(seen(a)) - lightness_of(seen(b))));
      const double feature =
          std::sqrt(double(std::max(edges.at<float>(y, x), points.at<float>(y, x))) / std::sqrt(2.0));
      map.at<double>(y, x) = std::pow(colour, 1 - feature);
    }
  }
  return map;
}

}  // namespace gloam
