// Writes loggia.exr, a small captured frame, and loggia_ao_ref.exr, its ray-cast ambient occlusion.
//
// Usage: generate_data FOLDER [RAYS]      RAYS per pixel, 16384 by default
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gloam/exr.h"
#include "gloam/frame.h"
#include "gloam/planes.h"
#include "loggia.h"

namespace {

using namespace gloam;
using namespace gloam::analytic;

constexpr int width = 480, height = 270;

/// Mantissa bits kept: relative steps of 1/1024 in colours, 1/65536 in components of normals.
constexpr int colour_bits = 9, normal_bits = 15;

/// The reference is stored in steps of 1/4096: an error of 7e-5 RMS, well under its noise.
constexpr double ao_steps = 4096;

/// Rounds to `bits` bits of mantissa. More bits are of no use, and zeros compress.
float rounded(float value, int bits) {
  const uint32_t step = 1u << (23 - bits);
  uint32_t pattern;
  std::memcpy(&pattern, &value, sizeof pattern);
  pattern = (pattern + step / 2) & ~(step - 1);
  std::memcpy(&value, &pattern, sizeof value);
  return value;
}

Plane& add_plane(View& view, const std::string& name) {
  const PlaneKind kind = plane_kind(name);
  Plane plane{name, {}};
  for (size_t i = 0; i < kind.components.size(); ++i) plane.channels.emplace_back(Layout(width, height), kind.outside);
  return view.planes.emplace(name, std::move(plane)).first->second;
}

Frame empty_frame(const std::vector<std::string>& planes) {
  Frame frame;
  frame.display = frame.window = {0, 0, width, height};
  frame.views.resize(1);
  frame.views[0].camera = loggia_camera(width, height);
  for (const std::string& name : planes) add_plane(frame.views[0], name);
  return frame;
}

void store(Plane& plane, int x, int y, const glm::vec3& value, int bits) {
  for (int i = 0; i < 3; ++i) plane.channels[size_t(i)].at(x, y) = rounded(value[i], bits);
}

void shade_pixel(const Scene& scene, View& view, int x, int y) {
  const Camera& camera = *view.camera;
  const Ray ray = camera_ray(camera, x + 0.5, y + 0.5);
  const std::optional<Hit> hit = first_hit(scene, ray);
  glm::vec3 colour = loggia_background(ray.direction), albedo(0), normal(0);
  float depth = std::numeric_limits<float>::infinity();
  if (hit) {
    const glm::dvec3 position = ray.origin + hit->distance * ray.direction;
    depth = float(view_depth(camera, position));
    normal = glm::vec3(camera.pose->world_to_view * hit->normal);
    albedo = hit->object->albedo;
    colour = loggia_radiance(scene, position, *hit, uint32_t(y * width + x));
  }
  view.planes.at("depth").channels[0].at(x, y) = depth;
  store(view.planes.at("normal"), x, y, normal, normal_bits);
  store(view.planes.at("albedo"), x, y, albedo, colour_bits);
  store(view.planes.at("color"), x, y, colour, colour_bits);
}

Frame render(const Scene& scene) {
  Frame frame = empty_frame({"depth", "normal", "albedo", "color"});
#pragma omp parallel for schedule(dynamic)
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) shade_pixel(scene, frame.views[0], x, y);
  return frame;
}

/// Noise of the reference, from the two halves of each pixel's rays.
struct Noise {
  long long pixels = 0;
  double sum_of_squares = 0, largest = 0;
  void add(const Visibility& visibility) {
    const double error = visibility.half_difference / 2;
    ++pixels;
    sum_of_squares += error * error;
    largest = std::max(largest, std::abs(error));
  }
  void add(const Noise& other) {
    pixels += other.pixels;
    sum_of_squares += other.sum_of_squares;
    largest = std::max(largest, other.largest);
  }
  double rms() const { return std::sqrt(sum_of_squares / double(std::max(1LL, pixels))); }
};

Frame reference(const Scene& scene, const Frame& captured, int rays, Noise& noise) {
  Frame frame = empty_frame({"depth", "ao"});
  View& view = frame.views[0];
  view.planes.at("depth") = captured.views[0].planes.at("depth").clone();
  Channel& ao = view.planes.at("ao").channels[0];
#pragma omp parallel for schedule(dynamic)
  for (int y = 0; y < height; ++y) {
    Noise row;
    for (int x = 0; x < width; ++x) {
      const Ray ray = camera_ray(*view.camera, x + 0.5, y + 0.5);
      const std::optional<Hit> hit = first_hit(scene, ray);
      ao.at(x, y) = 1;
      if (!hit) continue;
      const Visibility visibility = ambient_visibility(scene, ray.origin + hit->distance * ray.direction, hit->normal,
                                                       loggia_ao_radius, rays, uint32_t(y * width + x));
      ao.at(x, y) = float(std::round(visibility.ao * ao_steps) / ao_steps);
      row.add(visibility);
    }
#pragma omp critical
    noise.add(row);
  }
  return frame;
}

/// Adds the attributes that gloam reference writes: `compare`, `pick` and `bench` use the radius.
void describe(Frame& reference, int rays, const Noise& noise) {
  reference.numbers = {{"aoRadius", loggia_ao_radius}, {"aoSamples", rays}, {"aoNoise", noise.rms()}};
  reference.attributes = {
      {"aoFalloff", "none"},
      {"aoDefinition", "cosine-weighted share of directions in which nothing is nearer than aoRadius"}};
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void generate(const std::filesystem::path& folder, int rays) {
  const auto start = std::chrono::steady_clock::now();
  const Scene scene = loggia_scene();
  const Frame frame = render(scene);
  write_frame(folder / "loggia.exr", frame);
  fmt::print("loggia.exr: {} x {}, {} objects, {:.1f} s\n", width, height, scene.objects.size(), seconds_since(start));

  const auto reference_start = std::chrono::steady_clock::now();
  Noise noise;
  Frame truth = reference(scene, frame, rays, noise);
  describe(truth, rays, noise);
  write_frame(folder / "loggia_ao_ref.exr", truth);
  const double background = 1 - double(noise.pixels) / (width * height);
  fmt::print("loggia_ao_ref.exr: {} rays per pixel, {:.1f} s\n", rays, seconds_since(reference_start));
  fmt::print("background {:.2f} % of the pixels\n", 100 * background);
  fmt::print("noise of the reference: RMS {:.5f}, largest {:.5f}\n", noise.rms(), noise.largest);
}

}  // namespace

int main(int argc, char** argv) {
  const int rays = argc == 3 ? std::atoi(argv[2]) : 16384;
  if (argc < 2 || argc > 3 || rays < 2) {
    fmt::print(stderr, "usage: generate_data FOLDER [RAYS]\n");
    return 2;
  }
  try {
    generate(argv[1], rays);
  } catch (const std::exception& error) {
    fmt::print(stderr, "generate_data: {}\n", error.what());
    return 1;
  }
  return 0;
}
