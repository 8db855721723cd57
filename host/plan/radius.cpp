#include "gloam/radius.h"

#include <algorithm>
#include <cmath>

#include "gloam/error.h"
#include "gloam/margin.h"
#include "gloam/option.h"
#include "gloam/projection.h"

namespace gloam {
namespace {

/// About the largest number of depths, over all views, that the median is taken from: enough for three digits.
constexpr double samples = 65536;

/// A radius of fewer pixels finds hardly any occluder.
constexpr double least_pixels = 2;
/// A radius that is this much smaller than the default was most likely meant in another unit.
constexpr double far_below_default = 1.0 / 8;

double rounded_to_two_digits(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1);
  // By way of text, so that 0.38 is the double nearest to 0.38.
  return std::stod(fmt::format("{:.1e}", std::round(value / unit) * unit));
}

/// Of the picture: a margin has no say in a radius, which would change with it.
double longer_side(const Frame& frame) {
  const Window picture = picture_within(frame.window, frame.display);
  return std::max(picture.width(), picture.height());
}

const PlannedPass* first_with_radius(const Plan& plan) {
  const auto has_radius = [](const PlannedPass& planned) {
    const auto& parameters = planned.technique->parameters;
    return std::any_of(parameters.begin(), parameters.end(), is_radius);
  };
  const auto found = std::find_if(plan.passes.begin(), plan.passes.end(), has_radius);
  return found == plan.passes.end() ? nullptr : &*found;
}

/// Three digits, and no exponent below a million.
std::string in_pixels(double pixels) {
  return pixels >= 100 && pixels < 1e6 ? fmt::format("{:.0f}", pixels) : fmt::format("{:.3g}", pixels);
}

std::string suggested(const std::string& name, double radius, double pixels) {
  return fmt::format("{} reaches {}", option(name, fmt::format("{:g}", radius)), in_pixels(pixels));
}

}  // namespace

bool is_radius(const Parameter& parameter) {
  return (parameter.name == "radius" || parameter.name == "length") && parameter.unit == "scene units";
}

std::string radius_parameter(const ParameterList& parameters) {
  const auto found = std::find_if(parameters.begin(), parameters.end(), is_radius);
  return found == parameters.end() ? "" : found->name;
}

const char* name_of(RadiusSource source) {
  switch (source) {
    case RadiusSource::flag:
      return "flag";
    case RadiusSource::truth:
      return "truth";
    case RadiusSource::scene:
      return "scene";
    default:
      return "frame";
  }
}

namespace {

/// The same of the surfaces in a part of the frame.
std::optional<double> pixels_at_median_depth(const Frame& frame, const Window& part) {
  const double all = double(part.width()) * part.height() * double(frame.views.size());
  const int step = std::max(1, int(std::ceil(std::sqrt(all / samples))));
  std::vector<double> pixels;
  for (const View& view : frame.views) {
    const Plane* depth = view.find("depth");
    if (!depth || !view.camera) continue;
    const Channel& z = depth->channels.front();
    for (int y = part.y0 - frame.window.y0; y < part.y1 - frame.window.y0; y += step) {
      for (int x = part.x0 - frame.window.x0; x < part.x1 - frame.window.x0; x += step) {
        if (!is_background(z.at(x, y))) pixels.push_back(pixels_per_unit(*view.camera, z.at(x, y)));
      }
    }
  }
  if (pixels.empty()) return {};
  const auto middle = pixels.begin() + std::ptrdiff_t(pixels.size() / 2);
  std::nth_element(pixels.begin(), middle, pixels.end());
  return *middle > 0 && std::isfinite(*middle) ? std::optional(*middle) : std::nullopt;
}

}  // namespace

std::optional<double> pixels_at_median_depth(const Frame& frame) {
  const Window picture = picture_within(frame.window, frame.display);
  const std::optional<double> pixels = pixels_at_median_depth(frame, picture);
  return pixels || picture == frame.window ? pixels : pixels_at_median_depth(frame, frame.window);
}

std::optional<double> radius_made_from(const Frame& frame) {
  const std::optional<double> pixels = pixels_at_median_depth(frame);
  if (!pixels) return {};
  const double radius = rounded_to_two_digits(default_radius_share * longer_side(frame) / *pixels);
  // Kernels hold the radius as float.
  return std::clamp(radius, 1e-30, 1e30);
}

std::optional<double> stated_radius(const Frame& frame) {
  const auto stated = frame.numbers.find("aoRadius");
  return stated == frame.numbers.end() ? std::nullopt : std::optional(stated->second);
}

Radius default_radius(const Frame& frame, std::optional<double> stated) {
  if (stated) return {*stated, RadiusSource::scene};
  return {radius_made_from(frame).value_or(1), RadiusSource::frame};
}

std::optional<Radius> radius_of(const Plan& plan, const PlanRequest& request, RadiusSource from) {
  const PlannedPass* planned = first_with_radius(plan);
  if (!planned) return {};
  const std::string name = radius_parameter(planned->technique->parameters);
  const bool is_given = std::any_of(request.settings.begin(), request.settings.end(), [&](const auto& setting) {
    return setting.first == name || setting.first == planned->technique->name + "." + name;
  });
  return Radius{planned->values.number(name), is_given ? RadiusSource::flag : from, name};
}

std::optional<double> cap_of(const Plan& plan) {
  for (const PlannedPass& planned : plan.passes) {
    if (planned.values.has("max_reach")) return planned.values.number("max_reach");
  }
  return {};
}

std::string warning_about(const Radius& radius, const Frame& frame, std::optional<double> cap) {
  const std::optional<double> per_unit = pixels_at_median_depth(frame);
  const std::optional<double> made = radius_made_from(frame);
  if (radius.from == RadiusSource::frame || !per_unit) return "";
  const std::string instead = suggested(radius.name, *made, *made * *per_unit);
  const double most = cap.value_or(1) * frame.width();
  if (radius.value == 0)
    return fmt::format("{} 0: nothing is within reach, so {} everywhere; {} pixels", radius.name,
                       radius.name == "radius" ? "AO is 1" : "nothing is shaded", instead);
  if (std::isinf(radius.value))
    return fmt::format("{} inf: every occluder counts that lies within {} pixels{}", radius.name, in_pixels(most),
                       cap ? fmt::format(", which is max_reach {:g}", *cap) : "");
  const double pixels = radius.value * *per_unit;
  const std::string reaches = fmt::format("{} {:g} scene units reaches {} pixels at the median depth", radius.name,
                                          radius.value, in_pixels(pixels));
  if (pixels < std::max(least_pixels, far_below_default * default_radius_share * longer_side(frame)))
    return fmt::format("{}: few occluders are that near; {}", reaches, instead);
  if (pixels > most)
    return fmt::format("{}, but most pixels are searched only up to {}{}; {}", reaches, in_pixels(most),
                       cap ? fmt::format(" (max_reach {:g})", *cap) : ", the image's width", instead);
  return "";
}

std::string in_words(const Radius& radius, const Frame& frame) {
  const char* const from[] = {"given", "the truth's", "the scene's", "made from the frame"};
  const std::optional<double> pixels = pixels_at_median_depth(frame);
  return fmt::format("{} {:g} scene units ({}){}", radius.name, radius.value, from[int(radius.from)],
                     pixels ? fmt::format(": {} pixels at the median depth", in_pixels(radius.value * *pixels))
                            : ": the frame shows no surface");
}

}  // namespace gloam
