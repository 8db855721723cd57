#include "measure/checks.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include "gloam/planes.h"
#include "gloam/run.h"
#include "measure/plans.h"

namespace gloam::bench {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// Techniques over one view and one depth layer: planes, and frames of another size, have no more.
std::vector<const Technique*> over_one_layer(const std::vector<const Technique*>& techniques) {
  std::vector<const Technique*> some;
  for (const Technique* t : techniques) {
    if (!reads_layers(*t) && t->views == 1) some.push_back(t);
  }
  return some;
}

/// The result with default settings.
Frame filtered(const Technique& technique, const Frame& frame, double radius, Device& device) {
  return run(whole_plan({&technique, "", radius}, planes_of(frame), "the frame"), frame, device).frame;
}

Frame unfiltered(const Technique& technique, const Frame& frame, double radius, Device& device) {
  return run(unfiltered_plan({&technique, "", radius}, planes_of(frame), "the frame"), frame, device).frame;
}

Channel every_second(const Channel& from, float outside) {
  const Layout layout = reduced(from.layout(), 2);
  Channel to(layout, outside);
  for (int y = 0; y < layout.height; ++y) {
    for (int x = 0; x < layout.width; ++x) to.at(x, y) = from.at(2 * x, 2 * y);
  }
  return to;
}

std::string size_of(const Frame& frame) { return fmt::format("{}x{}", frame.width(), frame.height()); }

/// Compares the pixels of the smaller image that show a surface.
ScaleChange change(const Frame& fine, const Channel& fine_ao, const Frame& coarse, const Channel& coarse_ao) {
  const Channel& depth = coarse.views.front().planes.at("depth").channels[0];
  double sum = 0, sum_absolute = 0;
  long long count = 0;
  for (int y = 0; y < coarse.height(); ++y) {
    for (int x = 0; x < coarse.width(); ++x) {
      if (is_background(depth.at(x, y))) continue;
      const double off = double(fine_ao.at(2 * x, 2 * y)) - coarse_ao.at(x, y);
      sum += off;
      sum_absolute += std::abs(off);
      ++count;
    }
  }
  ScaleChange facts{.from = size_of(coarse), .to = size_of(fine)};
  if (count > 0) {
    facts.mean_change = sum / double(count);
    facts.mae = sum_absolute / double(count);
  }
  return facts;
}

// --- Planes

struct PlaneCase {
  std::string camera;
  double tilt, direction;  // degrees
  Frame frame;
};

Camera camera_named(const std::string& name, int width, int height, double distance) {
  Camera camera;
  camera.source = "made";
  camera.orthographic = name == "orthographic";
  // 60 degrees wide; an orthographic camera sees as much of the plane.
  camera.fx = camera.fy = 0.5 * width / std::tan(30 * degree) / (camera.orthographic ? distance : 1);
  camera.cx = (name == "off-axis" ? 0.2 : 0.5) * width;
  camera.cy = (name == "off-axis" ? 0.7 : 0.5) * height;
  return camera;
}

/// The image of a plane through (0, 0, -distance). Background where it lies behind the eye, or further away than a million
/// distances.
PlaneCase plane_case(const std::string& name, double tilt, double direction, int width, int height, double distance) {
  PlaneCase made{name, tilt, direction, {}};
  const Camera camera = camera_named(name, width, height, distance);
  const double sine = std::sin(tilt * degree);
  const glm::dvec3 normal(-sine * std::cos(direction * degree), -sine * std::sin(direction * degree),
                          std::cos(tilt * degree));
  const Layout layout(width, height);
  Plane depth{"depth", {}}, normals{"normal", {}};
  depth.channels.emplace_back(layout, INFINITY);
  for (int c = 0; c < 3; ++c) normals.channels.emplace_back(layout, 0.0f);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double across = (x + 0.5 - camera.cx) / camera.fx, up = -(y + 0.5 - camera.cy) / camera.fy;
      // (origin + z * direction - (0, 0, -distance)) . normal = 0, with z counted along the view axis.
      const glm::dvec3 origin = camera.orthographic ? glm::dvec3(across, up, 0) : glm::dvec3(0);
      const glm::dvec3 ray = camera.orthographic ? glm::dvec3(0, 0, -1) : glm::dvec3(across, up, -1);
      const double z = glm::dot(glm::dvec3(0, 0, -distance) - origin, normal) / glm::dot(ray, normal);
      if (!(z > 0 && z < 1e6 * distance)) continue;
      depth.channels[0].at(x, y) = float(z);
      for (int c = 0; c < 3; ++c) normals.channels[size_t(c)].at(x, y) = float(normal[c]);
    }
  }
  made.frame.display = made.frame.window = {0, 0, width, height};
  View& view = made.frame.views.emplace_back();
  view.camera = camera;
  view.planes.emplace("depth", std::move(depth));
  view.planes.emplace("normal", std::move(normals));
  return made;
}

/// What one technique has read so far on planes.
struct Reading {
  const Technique* technique;
  std::string plane;
  Frame (*make)(const Technique&, const Frame&, double radius, Device&);
  PlaneReading least = {.least = INFINITY};
  double sum = 0;
  long long count = 0;
  bool has_failed = false;
};

void read_plane(Reading& reading, const PlaneCase& test, const Channel& ao) {
  const Channel& depth = test.frame.views.front().planes.at("depth").channels[0];
  for (int y = 0; y < test.frame.height(); ++y) {
    for (int x = 0; x < test.frame.width(); ++x) {
      if (is_background(depth.at(x, y))) continue;
      const double value = ao.at(x, y);
      reading.sum += value;
      ++reading.count;
      if (value < reading.least.least) reading.least = {"", "", value, 1, test.tilt, test.direction, test.camera, x, y};
    }
  }
}

/// The changes of a technique's result between neighbouring sizes of a frame, the largest size first.
std::vector<ScaleChange> changes_of(const Technique& technique, const std::array<const Frame*, 3>& sizes, double radius,
                                    Device& device) {
  std::vector<ScaleChange> all;
  std::optional<Frame> finer;
  for (size_t i = 0; i < sizes.size(); ++i) {
    Frame result = filtered(technique, *sizes[i], radius, device);
    const Channel& ao = result.views.front().planes.at("ao").channels[0];
    if (finer) {
      const Channel& fine_ao = finer->views.front().planes.at("ao").channels[0];
      all.push_back(change(*sizes[i - 1], fine_ao, *sizes[i], ao));
    }
    finer = std::move(result);
  }
  return all;
}

/// Adds the result on one plane, unless the technique failed on an earlier one.
void read(Reading& reading, const PlaneCase& test, double radius, Device& device, const OnFailure& on_failure) {
  if (reading.has_failed) return;
  try {
    const Frame result = reading.make(*reading.technique, test.frame, radius, device);
    read_plane(reading, test, result.views.front().planes.at(reading.plane).channels[0]);
  } catch (const Error& error) {
    reading.has_failed = true;
    on_failure(*reading.technique, error);
  }
}

}  // namespace

Frame every_second_pixel(const Frame& frame) {
  Frame out;
  const int width = (frame.width() + 1) / 2, height = (frame.height() + 1) / 2;
  out.display = out.window = {0, 0, width, height};
  for (const View& view : frame.views) {
    View& copy = out.views.emplace_back(View{.name = view.name, .camera = view.camera, .origin = view.origin});
    if (Camera* camera = copy.camera ? &*copy.camera : nullptr) {
      camera->fx *= 0.5;
      camera->fy *= 0.5;
      camera->cx = 0.5 * (camera->cx - frame.window.x0) + 0.25;
      camera->cy = 0.5 * (camera->cy - frame.window.y0) + 0.25;
    }
    for (const auto& [name, plane] : view.planes) {
      Plane& target = copy.planes.emplace(name, Plane{name, {}}).first->second;
      for (const Channel& channel : plane.channels)
        target.channels.push_back(every_second(channel, plane_kind(name).outside));
    }
  }
  return out;
}

std::vector<ScaleChange> measure_scales(const std::vector<const Technique*>& techniques, const Frame& frame,
                                        const std::string& scene, double radius, Device& device,
                                        const OnFailure& on_failure) {
  std::vector<ScaleChange> all;
  const Frame half = every_second_pixel(frame), quarter = every_second_pixel(half);
  for (const Technique* technique : over_one_layer(techniques)) {
    try {
      for (ScaleChange& facts : changes_of(*technique, {&frame, &half, &quarter}, radius, device)) {
        facts.technique = technique->name;
        facts.scene = scene;
        all.push_back(std::move(facts));
      }
    } catch (const Error& error) {
      on_failure(*technique, error);
    }
  }
  return all;
}

std::vector<PlaneReading> measure_planes(const std::vector<const Technique*>& techniques, int width, int height,
                                         Device& device, const OnFailure& on_failure) {
  constexpr double distance = 2, radius = 0.5;
  std::vector<Reading> readings;
  for (const Technique* t : over_one_layer(techniques)) {
    readings.push_back({t, own_plane(*t), unfiltered});
    if (own_plane(*t) != "ao") readings.push_back({t, "ao", filtered});
  }
  for (const char* camera : {"perspective", "off-axis", "orthographic"}) {
    for (const double tilt : {0.0, 30.0, 60.0, 80.0, 85.0}) {
      for (const double direction : {0.0, 45.0, 90.0}) {
        const PlaneCase test = plane_case(camera, tilt, direction, width, height, distance);
        for (Reading& reading : readings) read(reading, test, radius, device, on_failure);
      }
    }
  }
  std::vector<PlaneReading> all;
  for (Reading& reading : readings) {
    if (reading.has_failed) continue;
    PlaneReading facts = reading.least;
    facts.technique = reading.technique->name;
    facts.plane = reading.plane;
    if (reading.count > 0) facts.mean = reading.sum / double(reading.count);
    all.push_back(facts);
  }
  return all;
}

}  // namespace gloam::bench
