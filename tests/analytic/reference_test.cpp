// The ray-traced reference against ambient occlusion in closed form (hard case 16), within 2e-3 at every pixel.
#include "gloam/scene/reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "gloam/error.h"
#include "gloam/scene/capture.h"
#include "scene/built_in/mesh_builder.h"
#include "support/long.h"
#include "support/traced_scene.h"

namespace gloam::reference_test {
namespace {

using glm::dvec3;
using glm::vec3;
using test::add_floor;
using test::corner_of_meshes;
using test::frame_of;
using test::mesh_of;
using test::scene_with;

constexpr double bound = 2e-3;
constexpr int samples = 65536;

struct Traced {
  Frame captured;
  AoReference reference;
};

Traced traced(const Scene& scene, const AoReferenceOptions& options, int width = 32, int height = 18) {
  const Tracer tracer(scene);
  Traced result;
  result.captured = frame_of(tracer, width, height);
  result.reference = ao_reference(tracer, result.captured, options);
  return result;
}

AoReferenceOptions options_with(double radius) {
  AoReferenceOptions options;
  options.radius = radius;
  options.samples = samples;
  return options;
}

/// Compares with `truth(position, mesh)` where that is a number; it must be one for at least a quarter of the pixels.
template <typename Truth>
void expect_truth(const Traced& traced, Truth truth) {
  const View& view = traced.captured.views[0];
  const auto& position = view.planes.at("position").channels;
  const Channel& instance = view.planes.at("instance").channels[0];
  const Channel& ao = traced.reference.frame.views[0].planes.at("ao").channels[0];
  int compared = 0;
  double worst = 0, sum = 0;
  for (int y = 0; y < traced.captured.height(); ++y) {
    for (int x = 0; x < traced.captured.width(); ++x) {
      if (instance.at(x, y) == 0) {
        EXPECT_EQ(ao.at(x, y), 1) << "background at " << x << ", " << y;
        continue;
      }
      const dvec3 p = view.origin + dvec3(position[0].at(x, y), position[1].at(x, y), position[2].at(x, y));
      const double expected = truth(p, int(instance.at(x, y)));
      if (std::isnan(expected)) continue;
      const double error = ao.at(x, y) - expected;
      EXPECT_NEAR(ao.at(x, y), expected, bound) << "at pixel " << x << ", " << y;
      worst = std::max(worst, std::abs(error));
      sum += error * error;
      ++compared;
    }
  }
  EXPECT_GE(4 * compared, traced.captured.width() * traced.captured.height());
  std::printf("compared %d pixels: worst %.1e, RMS %.1e; own estimate of the noise %.1e\n", compared, worst,
              std::sqrt(sum / std::max(1, compared)), traced.reference.noise);
  // The stated noise must be of the size of the actual error.
  if (worst > 1e-4) {
    EXPECT_GT(traced.reference.noise, 0.2 * std::sqrt(sum / compared));
  }
}

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

TEST(Reference, TiltedPlaneIsOpen) {
  for (const char* tilt : {"0", "60", "89"}) {
    const Scene scene = load_scene("plane", {{"tilt", tilt}});
    AoReferenceOptions options = options_with(0.5);
    options.samples = 256;
    expect_truth(traced(scene, options), [](const dvec3&, int) { return 1.0; });
  }
}

// A sphere of radius r at distance d, wholly above the plane, takes (r/d)^2 cos: its solid angle's projection.
TEST(Reference, SphereOverPlane) {
  Scene scene = scene_with(looking_at("main", {0, 3, 6}, {0, 0, 0}, 50));
  add_floor(scene, 100);
  const dvec3 centre(0, 1.5, 0);
  const double r = 1;
  scenes::add_sphere(mesh_of(scene, "sphere"), vec3(centre), float(r), 1024, 512);
  expect_truth(traced(scene, options_with(std::numeric_limits<double>::infinity())), [&](const dvec3& p, int mesh) {
    if (mesh != 1) return unknown;
    const double d = glm::distance(p, centre);
    return 1 - r * r / (d * d) * (centre.y / d);
  });
}

// A wall without end, of height h, at distance a: 1/2 (1 - a / sqrt(a^2 + h^2)) is closed.
TEST(Reference, CanyonFloor) {
  ONLY_IN_LONG_RUN();
  Scene scene = scene_with(looking_at("main", {0, 1.9, 3}, {0, 0, -1}, 50));
  const float h = 2, half_width = 1, length = 4000;
  scenes::add_quad(mesh_of(scene, "floor"), {-half_width, 0, length}, {half_width, 0, length}, {half_width, 0, -length},
                   {-half_width, 0, -length}, 8);
  scenes::add_quad(mesh_of(scene, "left"), {-half_width, 0, length}, {-half_width, 0, -length},
                   {-half_width, h, -length}, {-half_width, h, length}, 8);
  scenes::add_quad(mesh_of(scene, "right"), {half_width, 0, -length}, {half_width, 0, length}, {half_width, h, length},
                   {half_width, h, -length}, 8);
  expect_truth(traced(scene, options_with(std::numeric_limits<double>::infinity())), [&](const dvec3& p, int mesh) {
    if (mesh != 1 || p.z < -200) return unknown;
    const auto wall = [&](double a) { return 0.5 * (1 - a / std::hypot(a, double(h))); };
    return 1 - wall(p.x + half_width) - wall(half_width - p.x);
  });
}

// Directions that meet a wall at distance a within R are those with x > a/R: a segment of the disc that cosine-weighted
// directions fill evenly.
TEST(Reference, CornerWithinARadius) {
  const double radius = 0.8;
  expect_truth(traced(corner_of_meshes(), options_with(radius)), [&](const dvec3& p, int mesh) {
    const double a = mesh == 1 ? p.x : p.y;
    if (a < 1e-6) return unknown;
    const double c = a / radius;
    return c >= 1 ? 1.0 : 1 - (std::acos(c) - c * std::sqrt(1 - c * c)) / glm::pi<double>();
  });
}

// The same corner with HBAO+'s own falloff, against the integral over the disc in fine steps.
TEST(Reference, CornerWithAFalloff) {
  const double radius = 0.8;
  const Technique& hbao_plus = find_technique("hbao+");
  const ParameterValues values(hbao_plus.parameters);
  AoReferenceOptions options = options_with(radius);
  options.falloff = "hbao+";
  options.contribution = [&](double cosine, double distance) {
    return hbao_plus.contribution(values, cosine, distance);
  };
  const double bias = values.number("bias");
  const auto integral = [&](double a) {
    const int steps = 600;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
      const double x = (i + 0.5) / steps;  // sine towards the wall
      if (a / x >= radius) continue;
      const double weight = 1 - (a / x / radius) * (a / x / radius), reach = std::sqrt(1 - x * x);
      for (int k = 0; k < steps; ++k) {
        const double y = reach * (2 * (k + 0.5) / steps - 1), cosine = std::sqrt(std::max(0.0, 1 - x * x - y * y));
        if (cosine > bias) sum += weight * (cosine - bias) / cosine * (2 * reach / steps) / steps;
      }
    }
    return 1 - sum / glm::pi<double>();
  };
  expect_truth(traced(corner_of_meshes(), options, 16, 9), [&](const dvec3& p, int mesh) {
    const double a = mesh == 1 ? p.x : p.y;
    return a < 1e-6 ? unknown : integral(a);
  });
}

// --- Other promises of the reference

TEST(Reference, NothingDependsOnTheOrigin) {
  Scene near = corner_of_meshes(), far = corner_of_meshes();
  far.origin = {1e7, -3e6, 2e7};
  for (SceneCamera& camera : far.cameras) camera.pose.position += far.origin;
  AoReferenceOptions options = options_with(0.8);
  options.samples = 256;
  const Traced a = traced(near, options), b = traced(far, options);
  const Channel& at_origin = a.reference.frame.views[0].planes.at("ao").channels[0];
  const Channel& far_away = b.reference.frame.views[0].planes.at("ao").channels[0];
  double worst = 0;
  for (int y = 0; y < 18; ++y)
    for (int x = 0; x < 32; ++x) worst = std::max(worst, std::abs(double(at_origin.at(x, y)) - far_away.at(x, y)));
  EXPECT_LE(worst, 0.02);  // a few of 256 rays at the edge of the radius
}

TEST(Reference, SameSeedSameBitsAndItsNoiseFallsWithSamples) {
  AoReferenceOptions options = options_with(0.8);
  options.samples = 64;
  const AoReference a = traced(corner_of_meshes(), options).reference,
                    b = traced(corner_of_meshes(), options).reference;
  for (int y = 0; y < 18; ++y)
    for (int x = 0; x < 32; ++x)
      ASSERT_EQ(a.frame.views[0].planes.at("ao").channels[0].at(x, y),
                b.frame.views[0].planes.at("ao").channels[0].at(x, y));
  options.samples = 1024;
  EXPECT_LT(traced(corner_of_meshes(), options).reference.noise, 0.5 * a.noise);
  EXPECT_EQ(a.frame.numbers.at("aoSamples"), 64);
  EXPECT_FLOAT_EQ(float(a.frame.numbers.at("aoRadius")), 0.8f);
}

TEST(Reference, GoesOnWhereItWasInterrupted) {
  const Scene scene = corner_of_meshes();
  const Tracer tracer(scene);
  AoReferenceOptions options = options_with(0.8);
  options.samples = 256;
  const Traced whole = traced(scene, options);
  std::string folder = (std::filesystem::temp_directory_path() / "gloam-reference-XXXXXX").string();
  ASSERT_NE(mkdtemp(folder.data()), nullptr);
  options.checkpoint = folder + "/ref.exr.partial";
  options.checkpoint_seconds = 0;
  options.progress = [](double share) {
    if (share > 0.5) throw std::runtime_error("interrupted");
  };
  EXPECT_THROW(ao_reference(tracer, whole.captured, options), std::runtime_error);
  ASSERT_TRUE(std::filesystem::exists(options.checkpoint));
  options.progress = {};
  // Another computation does not resume the checkpoint ...
  AoReferenceOptions other = options;
  other.checkpoint_seconds = 1e9;
  other.seed = 1;
  const std::filesystem::path copy = folder + "/other.exr.partial";
  std::filesystem::copy(options.checkpoint, copy);
  other.checkpoint = copy;
  EXPECT_EQ(ao_reference(tracer, whole.captured, other).resumed_share, 0);
  other.seed = options.seed;
  other.falloff_parameters = "bias=0.5";
  EXPECT_EQ(ao_reference(tracer, whole.captured, other).resumed_share, 0);
  // ... and the same one does, and ends with the same bits.
  const AoReference resumed = ao_reference(tracer, whole.captured, options);
  EXPECT_GE(resumed.resumed_share, 0.4);
  EXPECT_LT(resumed.rays, whole.reference.rays);
  EXPECT_TRUE(std::filesystem::exists(options.checkpoint)) << "it stays until the result is in safety";
  EXPECT_EQ(resumed.noise, whole.reference.noise);
  for (int y = 0; y < 18; ++y)
    for (int x = 0; x < 32; ++x)
      ASSERT_EQ(resumed.frame.views[0].planes.at("ao").channels[0].at(x, y),
                whole.reference.frame.views[0].planes.at("ao").channels[0].at(x, y));
  std::filesystem::remove_all(folder);
}

// A full disk loses the checkpoint, not the result.
TEST(Reference, ACheckpointThatCannotBeWrittenIsOnlyANote) {
  const Scene scene = corner_of_meshes();
  AoReferenceOptions options = options_with(0.8);
  options.samples = 32;
  options.checkpoint = "/nonexistent/folder/ref.exr.partial";
  options.checkpoint_seconds = 0;
  const Traced result = traced(scene, options);
  ASSERT_EQ(result.reference.notes.size(), 1u);
  EXPECT_NE(result.reference.notes[0].find("interruption"), std::string::npos) << result.reference.notes[0];
}

// A small object on a huge floor: the floor's large triangles must not move the start of rays.
TEST(Reference, LargeTrianglesDoNoHarm) {
  const auto with_floor = [](float half) {
    Scene scene = scene_with(looking_at("main", {0.5, 0.6, 1}, {0, 0, 0}, 50));
    add_floor(scene, half);
    scenes::add_box(mesh_of(scene, "box"), {-0.2f, 0, -0.2f}, {0.2f, 0.3f, 0.2f});
    AoReferenceOptions options = options_with(0.5);
    options.samples = 1024;
    return traced(scene, options);
  };
  const Traced small = with_floor(10);
  for (const float half : {1e3f, 1e5f}) {
    const Traced large = with_floor(half);
    double worst = 0;
    for (int y = 0; y < 18; ++y)
      for (int x = 0; x < 32; ++x)
        worst = std::max(worst, std::abs(double(small.reference.frame.views[0].planes.at("ao").channels[0].at(x, y)) -
                                         large.reference.frame.views[0].planes.at("ao").channels[0].at(x, y)));
    EXPECT_LE(worst, 0.005) << half;
    std::printf("floor of %g: worst difference %.1e\n", half, worst);
  }
}

TEST(Reference, RefusesTheFrameOfAnotherScene) {
  Scene scene = corner_of_meshes(), other = corner_of_meshes();
  const Tracer tracer(scene);
  CaptureOptions options;
  options.width = 32, options.height = 18;
  options.views = {{"", camera_for(scene.cameras.front(), 32, 18), {}}};
  const Frame frame = capture(tracer, options).frame;
  for (Mesh& mesh : other.meshes)
    for (vec3& p : mesh.positions) p -= vec3(1, 1, 0);
  const Tracer wrong(other);
  try {
    ao_reference(wrong, frame, options_with(0.5));
    FAIL() << "a frame of another scene was taken";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("is not what the frame shows"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace gloam::reference_test
