// Captured planes against known properties of the scene.
#include "gloam/scene/capture.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdio>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <set>

#include "gloam/error.h"
#include "gloam/normalise.h"
#include "gloam/planes.h"
#include "scene/built_in/mesh_builder.h"
#include "support/stress.h"
#include "support/techniques.h"

namespace gloam::capture_test {
namespace {

using glm::dvec3;
using glm::vec3;

/// Three boxes in a row on a floor, at z = 0, -2 and -4; a sheet without thickness at z = -5.
Scene boxes() {
  Scene scene;
  scene.name = "boxes";
  scenes::add_material(scene, "red", {0.8f, 0.1f, 0.1f}, 0.3f);
  scenes::add_material(scene, "gold", {1.0f, 0.8f, 0.3f}, 0.2f, 1);
  for (int i = 0; i < 3; ++i) {
    const float z = -2.0f * float(i);
    scenes::add_box(scenes::add_mesh(scene, "box", i == 1 ? 1 : 0), {-0.5f, 0, z - 0.5f}, {0.5f, 1, z + 0.5f});
  }
  scenes::add_quad(scenes::add_mesh(scene, "sheet", 0), {-3, -3, -5}, {3, -3, -5}, {3, 3, -5}, {-3, 3, -5});
  scene.cameras = {looking_at("main", {0, 0.5, 6}, {0, 0.5, 0}, 40)};
  return scene;
}

CaptureResult captured(const Scene& scene, const Camera& camera, int width, int height, int peel = 0,
                       const std::optional<Camera>& previous = {}) {
  const Tracer tracer(scene);
  CaptureOptions options;
  options.width = width, options.height = height;
  options.planes = capture_planes();
  options.peel = peel;
  options.views = {{"", camera, previous}};
  return capture(tracer, options);
}

float value(const Frame& frame, const std::string& plane, int x, int y, size_t component = 0) {
  return frame.views[0].planes.at(plane).channels[component].at(x, y);
}

TEST(Capture, LightOfLayers) {
  const Scene scene = boxes();
  const Tracer tracer(scene);
  CaptureOptions options;
  options.width = 65, options.height = 33;
  options.planes = {"normal", "color"};
  options.peel = 3;
  options.peel_light = true;
  options.views = {{"", camera_for(scene.cameras[0], 65, 33), {}}};
  const Frame frame = capture(tracer, options).frame;
  const auto light = [&](const std::string& stack, int layer, int x, int y) {
    return value(frame, layer_name(stack, layer), x, y);
  };
  for (int y = 0; y < 33; ++y) {
    for (int x = 0; x < 65; ++x) {
      if (value(frame, "peel_count", x, y) == 0) continue;
      EXPECT_EQ(light("peel_color_r", 0, x, y), value(frame, "color", x, y, 0));
      EXPECT_EQ(light("peel_normal_z", 0, x, y), value(frame, "normal", x, y, 2));
    }
  }
  // The back of the first box faces away from the eye, the front of the second, of gold and so black, faces the eye.
  EXPECT_NEAR(light("peel_normal_z", 1, 32, 16), -1, 1e-5);
  EXPECT_NEAR(light("peel_normal_z", 2, 32, 16), 1, 1e-5);
  EXPECT_GT(light("peel_color_r", 1, 32, 16), 0.05);
  EXPECT_EQ(light("peel_color_r", 2, 32, 16), 0);
  options.peel = 0;
  EXPECT_THROW(capture(tracer, options), UsageError);
}

TEST(Capture, LayersBackFacesAndInstances) {
  const Scene scene = boxes();
  const Frame frame = captured(scene, camera_for(scene.cameras[0], 65, 33), 65, 33, 8).frame;
  const int x = 32, y = 16;  // straight through the middle of all boxes
  EXPECT_NEAR(value(frame, "depth", x, y), 5.5, 1e-6);
  EXPECT_NEAR(value(frame, "back_depth", x, y), 6.5, 1e-6) << "the first box's own back, not the next box";
  EXPECT_EQ(value(frame, "instance", x, y), 1);
  EXPECT_EQ(value(frame, "peel_count", x, y), 7);
  const double expected[] = {5.5, 6.5, 7.5, 8.5, 9.5, 10.5, 11};
  for (int i = 0; i < 7; ++i) EXPECT_NEAR(value(frame, fmt::format("peel.{:02}", i), x, y), expected[i], 1e-5) << i;
  EXPECT_TRUE(std::isinf(value(frame, "peel.07", x, y)));
  // The sheet has no back.
  EXPECT_EQ(value(frame, "instance", 55, 5), 4);
  EXPECT_TRUE(std::isinf(value(frame, "back_depth", 55, 5)));
}

TEST(Capture, FewerLayersStoredThanThere) {
  const Scene scene = boxes();
  const Frame frame = captured(scene, camera_for(scene.cameras[0], 65, 33), 65, 33, 2).frame;
  EXPECT_EQ(value(frame, "peel_count", 32, 16), 7);
  EXPECT_NEAR(value(frame, "peel.01", 32, 16), 6.5, 1e-5);
  EXPECT_EQ(frame.views[0].find("peel.02"), nullptr);
}

TEST(Capture, Materials) {
  const Scene scene = boxes();
  SceneCamera above = looking_at("above", {0, 4, -2}, {0, 0, -2.001}, 30);
  const Frame frame = captured(scene, camera_for(above, 33, 33), 33, 33).frame;
  EXPECT_EQ(value(frame, "instance", 16, 16), 2);
  EXPECT_FLOAT_EQ(value(frame, "albedo", 16, 16, 1), 0.8f);
  EXPECT_FLOAT_EQ(value(frame, "roughness", 16, 16), 0.2f);
  EXPECT_FLOAT_EQ(value(frame, "reflectance", 16, 16, 2), 0.3f) << "a metal reflects its base colour";
  EXPECT_EQ(value(frame, "color", 16, 16), 0) << "a metal has no diffuse light";
  EXPECT_EQ(value(frame, "ambient", 16, 16), 0);
  EXPECT_EQ(value(frame, "metallic", 16, 16), 1);
}

TEST(Capture, AmbientLightIsThePartOfColourThatIsOfTheSky) {
  Scene scene = boxes();
  for (Material& material : scene.materials) material.metallic = 0;
  scene.light.sun = {3, 2, 1};
  const Camera camera = camera_for(scene.cameras[0], 65, 33);
  const Frame lit = captured(scene, camera, 65, 33).frame;
  EXPECT_EQ(lit.attributes.at("gloamColorHolds"), "ambient,shadows");
  scene.light.sun = {0, 0, 0};
  const Frame dark = captured(scene, camera, 65, 33).frame;
  int sunny = 0;
  for (int y = 0; y < 33; ++y)
    for (int x = 0; x < 65; ++x)
      for (size_t i = 0; i < 3; ++i) {
        const float ambient = value(lit, "ambient", x, y, i);
        if (is_background(value(lit, "depth", x, y))) {
          EXPECT_EQ(ambient, 0);
          continue;
        }
        EXPECT_GT(ambient, 0);
        EXPECT_EQ(ambient, value(dark, "color", x, y, i)) << x << " " << y;
        EXPECT_LE(ambient, value(lit, "color", x, y, i)) << x << " " << y;
        sunny += ambient < value(lit, "color", x, y, i);
      }
  EXPECT_GT(sunny, 100);
}

/// Position, depth and pixel are consistent for every kind of camera.
void expect_positions_on_pixel_centres(const Scene& scene, const Camera& camera) {
  const Frame frame = captured(scene, camera, 64, 36).frame;
  const View& view = frame.views[0];
  int surfaces = 0;
  for (int y = 0; y < 36; ++y) {
    for (int x = 0; x < 64; ++x) {
      if (is_background(value(frame, "depth", x, y))) continue;
      ++surfaces;
      const dvec3 world = view.origin + dvec3(value(frame, "position", x, y, 0), value(frame, "position", x, y, 1),
                                              value(frame, "position", x, y, 2));
      const dvec3 v = camera.pose->world_to_view * (world - camera.pose->position);
      EXPECT_NEAR(-v.z, value(frame, "depth", x, y), 1e-5 * -v.z);
      const double divisor = camera.orthographic ? 1 : -v.z;
      EXPECT_NEAR(camera.cx + camera.fx * v.x / divisor, x + 0.5, 2e-4);
      EXPECT_NEAR(camera.cy - camera.fy * v.y / divisor, y + 0.5, 2e-4);
      double length = 0;
      for (size_t i = 0; i < 3; ++i) length += value(frame, "normal", x, y, i) * value(frame, "normal", x, y, i);
      EXPECT_NEAR(length, 1, 1e-5);
    }
  }
  EXPECT_GT(surfaces, 100);
}

TEST(Capture, PerspectiveOffAxisAndOrthographic) {
  const Scene scene = boxes();
  SceneCamera seen = looking_at("main", {1, 2, 6}, {0, 0.5, -1}, 50);
  expect_positions_on_pixel_centres(scene, camera_for(seen, 64, 36));
  Camera off_axis = camera_for(seen, 64, 36);
  off_axis.cx += 11.5, off_axis.cy -= 4.25, off_axis.fy *= 1.3;
  expect_positions_on_pixel_centres(scene, off_axis);
  seen.orthographic = true;
  seen.width = 6;
  expect_positions_on_pixel_centres(scene, camera_for(seen, 64, 36));
}

TEST(Capture, NearAndFarClip) {
  const Scene scene = boxes();
  Camera camera = camera_for(scene.cameras[0], 65, 33);
  camera.near = 6;
  EXPECT_NEAR(value(captured(scene, camera, 65, 33).frame, "depth", 32, 16), 6.5, 1e-6);
  camera.far = 6.2;
  EXPECT_TRUE(std::isinf(value(captured(scene, camera, 65, 33).frame, "depth", 32, 16)));
}

TEST(Capture, MotionPointsToThePreviousFrame) {
  const Scene scene = boxes();
  const Camera now = camera_for(scene.cameras[0], 65, 33);
  Camera before = now;
  before.pose->position += dvec3(0.25, 0.1, 0);
  const Frame frame = captured(scene, now, 65, 33, 0, before).frame;
  const double z = value(frame, "depth", 32, 16);
  EXPECT_NEAR(value(frame, "motion", 32, 16, 0), -0.25 * now.fx / z, 1e-4)
      << "a camera further right saw it further left";
  EXPECT_NEAR(value(frame, "motion", 32, 16, 1), 0.1 * now.fy / z, 1e-4)
      << "and from further up, further down: y is down";
}

TEST(Capture, BackFacesAreTurnedToTheViewer) {
  Scene scene = boxes();
  scene.cameras = {looking_at("behind", {0, 0.5, -9}, {0, 0.5, 0}, 40)};
  const Frame frame = captured(scene, camera_for(scene.cameras[0], 33, 33), 33, 33).frame;
  EXPECT_EQ(value(frame, "instance", 16, 16), 4);
  EXPECT_NEAR(value(frame, "normal", 16, 16, 2), 1, 1e-6);
}

TEST(Capture, TexturesRepeatAndStartAtTheTopLeft) {
  Scene scene = boxes();
  scene.textures.push_back({"four", 2, 2, {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 0}});
  scene.materials[0].albedo = vec3(1);
  scene.materials[0].albedo_texture = 0;
  Mesh& sheet = scene.meshes[3];
  sheet.uvs = {{0, 3}, {3, 3}, {0, 0}, {3, 0}};  // the quad's corners, rows from below
  scene.meshes.erase(scene.meshes.begin(), scene.meshes.begin() + 3);
  const SceneCamera seen = looking_at("main", {0, 0, 1}, {0, 0, 0}, 90);  // 6 units of depth: all of the sheet
  const Frame solid = captured(scene, camera_for(seen, 48, 24), 48, 24).frame;
  // The sheet spans pixels 12 to 36 across; each repeat has 8 pixels, each texel 4.
  // Pixel (14, 2) lies an eighth of a texel right of and below the red one's centre.
  EXPECT_NEAR(value(solid, "albedo", 14, 2, 0), 0.875 * 0.875 + 0.125 * 0.125, 1e-3);
  EXPECT_NEAR(value(solid, "albedo", 18, 2, 1), 1, 0.2);
  EXPECT_NEAR(value(solid, "albedo", 14, 6, 2), 1, 0.2);
  EXPECT_NEAR(value(solid, "albedo", 22, 10, 0), value(solid, "albedo", 14, 2, 0), 1e-3) << "repeats";
  // Where the texture is transparent there is a hole.
  scene.materials[0].alpha_cutoff = 0.5f;
  const Frame holed = captured(scene, camera_for(seen, 48, 24), 48, 24, 1).frame;
  EXPECT_TRUE(std::isinf(value(holed, "depth", 18, 6)));
  EXPECT_EQ(value(holed, "peel_count", 18, 6), 0);
  EXPECT_NEAR(value(holed, "depth", 14, 2), 6, 1e-5);
}

TEST(Capture, AboutTheSameAtAnyDistanceFromTheOrigin) {
  Scene far = boxes();
  far.origin = {1e7, 2e6, -3e7};
  for (SceneCamera& camera : far.cameras) camera.pose.position += far.origin;
  const Scene near = boxes();
  const Frame a = captured(near, camera_for(near.cameras[0], 65, 33), 65, 33).frame;
  const Frame b = captured(far, camera_for(far.cameras[0], 65, 33), 65, 33).frame;
  for (int y = 0; y < 33; ++y) {
    for (int x = 0; x < 65; ++x) {
      if (is_background(value(a, "depth", x, y))) continue;
      EXPECT_NEAR(value(a, "depth", x, y), value(b, "depth", x, y), 1e-6 * value(a, "depth", x, y));
      EXPECT_NEAR(value(a, "position", x, y), value(b, "position", x, y), 1e-5);
    }
  }
}

// --- Stochastic depth

/// An object with many surfaces under a pixel, made once for all tests.
const Scene& fence() {
  static const Scene scene = load_scene("fence", {});
  return scene;
}
const Tracer& fence_tracer() {
  static const Tracer tracer(fence());
  return tracer;
}

constexpr int fence_width = 200, fence_height = 150;

/// The paper's map: of all surfaces, at random.
StochasticOptions of_the_paper(int samples, double alpha = 0.2, int seed = 0) {
  return {samples, alpha, seed, StochasticSurfaces::all, StochasticSubset::stratified};
}

/// Depth, all layers, and a stochastic depth map if there are samples.
Frame captured_fence(const StochasticOptions& stochastic, bool orthographic = false) {
  SceneCamera camera = fence().cameras[0];
  camera.orthographic = orthographic;
  camera.width = 6;
  CaptureOptions options;
  options.width = fence_width, options.height = fence_height;
  options.peel = 64;
  options.stochastic = stochastic;
  options.views = {{"", camera_for(camera, fence_width, fence_height), {}}};
  return capture(fence_tracer(), options).frame;
}

Frame captured_fence(int samples, double alpha = 0.2, int seed = 0) {
  return captured_fence(of_the_paper(samples, alpha, seed));
}

/// The map's and the peeled layers' channels of one view.
struct Layered {
  std::vector<const Channel*> samples, surfaces;
  const Channel* count;
  explicit Layered(const View& view) : count(&view.planes.at("peel_count").channels[0]) {
    for (int i = 0; i < 64; ++i) {
      if (const Plane* plane = view.find(layer_name("stochastic", i))) samples.push_back(&plane->channels[0]);
      if (const Plane* plane = view.find(layer_name("peel", i))) surfaces.push_back(&plane->channels[0]);
    }
  }
  int layers(int x, int y) const { return int(count->at(x, y)); }
  /// The samples, among the first ones, that hold a surface.
  uint32_t holders(int x, int y, int layer, int first = 16) const {
    uint32_t held = 0;
    for (int j = 0; j < std::min(first, int(samples.size())); ++j)
      held |= uint32_t(samples[size_t(j)]->at(x, y) == surfaces[size_t(layer)]->at(x, y)) << j;
    return held;
  }
  /// Whether at least this many surfaces lie under the pixel, no two at one depth (which would go into the same samples).
  bool has(int x, int y, int number) const {
    if (layers(x, y) < number) return false;
    for (int i = 1; i < number; ++i) {
      if (surfaces[size_t(i)]->at(x, y) == surfaces[size_t(i - 1)]->at(x, y)) return false;
    }
    return true;
  }
};

template <typename Visit>
void for_pixels(Visit visit) {
  for (int y = 0; y < fence_height; ++y) {
    for (int x = 0; x < fence_width; ++x) visit(x, y);
  }
}

TEST(StochasticCapture, HasThePlanesAndSaysHowTheyWereMade) {
  for (const int samples : {1, 4, 16}) {
    const Frame frame = captured_fence(samples, 0.3, 12345);
    EXPECT_EQ(Layered(frame.views[0]).samples.size(), size_t(samples));
    EXPECT_EQ(frame.numbers.at("gloamStochasticAlpha"), 0.3);
    EXPECT_EQ(frame.attributes.at("gloamStochasticSeed"), "12345");
    EXPECT_EQ(frame.attributes.at("gloamStochasticSurfaces"), "all");
    EXPECT_EQ(frame.attributes.at("gloamStochasticSubset"), "stratified");
    int held = 0;
    for_pixels([&](int x, int y) { held += std::isfinite(value(frame, "stochastic.00", x, y)); });
    EXPECT_GT(held, fence_width * fence_height / 20);
  }
  const Frame none = captured_fence(0);
  EXPECT_EQ(none.views[0].find("stochastic.00"), nullptr);
  EXPECT_EQ(none.numbers.count("gloamStochasticAlpha"), 0u);
  EXPECT_EQ(none.attributes.count("gloamStochasticSurfaces"), 0u);
  const Frame usual = captured_fence(StochasticOptions{.samples = 4});
  EXPECT_EQ(usual.attributes.at("gloamStochasticSurfaces"), "hidden");
  EXPECT_EQ(usual.attributes.at("gloamStochasticSubset"), "nearest");
  EXPECT_EQ(usual.numbers.count("gloamStochasticAlpha"), 0u) << "nothing is random";
  EXPECT_EQ(usual.attributes.count("gloamStochasticSeed"), 0u);
}

TEST(StochasticCapture, AlphaOfZeroHoldsNothingAndOfOneTheDepth) {
  for (const int samples : {1, 4, 16}) {
    const Frame nothing = captured_fence(samples, 0), all = captured_fence(samples, 1);
    int differing = 0;
    for_pixels([&](int x, int y) {
      for (int j = 0; j < samples; ++j) {
        differing += value(nothing, layer_name("stochastic", j), x, y) != std::numeric_limits<float>::infinity();
        differing += value(all, layer_name("stochastic", j), x, y) != value(all, "depth", x, y);
      }
    });
    EXPECT_EQ(differing, 0);
  }
}

TEST(StochasticCapture, EverySampleHoldsASurfaceOfItsPixelOrNothing) {
  const Frame frame = captured_fence(16);
  const Layered layered(frame.views[0]);
  int strangers = 0;
  for_pixels([&](int x, int y) {
    for (const Channel* sample : layered.samples) {
      bool known = std::isinf(sample->at(x, y));
      for (int i = 0; i < layered.layers(x, y); ++i) known |= layered.surfaces[size_t(i)]->at(x, y) == sample->at(x, y);
      strangers += !known;
    }
  });
  EXPECT_EQ(strangers, 0);
}

/// A mean with its standard error.
struct Mean {
  double sum = 0, squares = 0;
  long long count = 0;
  void add(double v) { sum += v, squares += v * v, ++count; }
  double mean() const { return sum / double(count); }
  double error() const { return std::sqrt((squares / double(count) - mean() * mean()) / double(count)); }
};

/// A sample holds layer i with probability alpha (1 - alpha)^(i - 1): it was offered this layer and none before it. Layers are
/// counted from `first` on, the first that is offered; those before it are never held.
void expect_layer_counts(const Layered& layered, int samples, double alpha, const std::string& what, int first = 0) {
  for (int layer = 0; layer < 3 + first; ++layer) {
    Mean held;
    for_pixels([&](int x, int y) {
      if (layered.has(x, y, 3 + first)) held.add(std::popcount(layered.holders(x, y, layer, samples)));
    });
    const double expected = layer < first ? 0 : samples * alpha * std::pow(1 - alpha, layer - first);
    ASSERT_GT(held.count, 1000) << what;
    EXPECT_LT(std::abs(held.mean() - expected), 4 * held.error() + 1e-6)
        << what << ", layer " << layer << ": " << held.mean() << " +- " << held.error() << ", expected " << expected;
    std::printf("%s, layer %d: mean %.4f, expected %.4f, %+.1f standard errors over %lld pixels\n", what.c_str(),
                layer + 1, held.mean(), expected, held.error() > 0 ? (held.mean() - expected) / held.error() : 0.0,
                held.count);
  }
}

TEST(StochasticCapture, LayersAreHeldAsOftenAsAlphaSays) {
  for (const int samples : {1, 4, 16}) {
    for (const double alpha : {0.2, 0.35}) {
      const Frame frame = captured_fence(samples, alpha);
      expect_layer_counts(Layered(frame.views[0]), samples, alpha, fmt::format("{} samples, alpha {}", samples, alpha));
    }
  }
}

TEST(StochasticCapture, AmongHiddenLayersAlphaSaysHowOftenAndTheNearestSurfaceIsNeverHeld) {
  for (const int samples : {1, 4, 5, 16}) {
    for (const double alpha : {0.25, 0.35}) {
      StochasticOptions options = of_the_paper(samples, alpha);
      options.surfaces = StochasticSurfaces::hidden;
      const Frame frame = captured_fence(options);
      expect_layer_counts(Layered(frame.views[0]), samples, alpha,
                          fmt::format("hidden, {} samples, alpha {}", samples, alpha), 1);
    }
  }
}

/// The default: sample j is hidden surface j, as far as there are so many.
TEST(StochasticCapture, TheNearestSurfacesAreHeldFrontToBack) {
  for (const auto surfaces : {StochasticSurfaces::all, StochasticSurfaces::hidden}) {
    StochasticOptions options = {.samples = 5};
    options.surfaces = surfaces;
    options.subset = StochasticSubset::nearest;
    const Frame frame = captured_fence(options);
    const Layered layered(frame.views[0]);
    int differing = 0, held = 0;
    for_pixels([&](int x, int y) {
      std::vector<float> expected;
      for (int i = 0; i < layered.layers(x, y); ++i) {
        const float surface = layered.surfaces[size_t(i)]->at(x, y);
        if (surfaces == StochasticSurfaces::all || surface > layered.surfaces[0]->at(x, y)) expected.push_back(surface);
      }
      expected.resize(5, std::numeric_limits<float>::infinity());
      for (size_t j = 0; j < 5; ++j) {
        differing += layered.samples[j]->at(x, y) != expected[j];
        held += std::isfinite(expected[j]);
      }
    });
    EXPECT_EQ(differing, 0);
    EXPECT_GT(held, 1000);
  }
}

TEST(StochasticCapture, TheFirstSamplesAreAMapOfTheirOwn) {
  for (const double alpha : {0.2, 0.3, 0.5}) {
    const Frame frame = captured_fence(16, alpha);
    const Layered layered(frame.views[0]);
    for (const int first : {1, 2, 4, 8, 16}) {
      expect_layer_counts(layered, first, alpha, fmt::format("first {} of 16, alpha {}", first, alpha));
      // Stratified: the number of samples that hold the nearest surface is alpha times all, rounded up or down.
      std::map<int, int> counts;
      for_pixels([&](int x, int y) {
        if (layered.has(x, y, 1)) ++counts[std::popcount(layered.holders(x, y, 0, first))];
      });
      for (const auto& [count, pixels] : counts) {
        EXPECT_GE(count, std::floor(alpha * first - 1e-6));
        EXPECT_LE(count, std::ceil(alpha * first + 1e-6)) << pixels << " pixels";
      }
      // The same bits as in a map of that many, and as in one of more.
      for (const int samples : {first, std::min(first + 1, 16), std::min(2 * first - 1, 16)}) {
        const Frame other = captured_fence(samples, alpha);
        for (int j = 0; j < first; ++j) {
          int differing = 0;
          for_pixels([&](int x, int y) {
            differing +=
                value(other, layer_name("stochastic", j), x, y) != value(frame, layer_name("stochastic", j), x, y);
          });
          EXPECT_EQ(differing, 0) << "sample " << j << " of " << samples;
        }
      }
    }
  }
}

/// Chi-square of a table of counts against the product of its margins.
double chi_square(const std::vector<std::vector<double>>& table) {
  const size_t n = table.size();
  std::vector<double> rows(n, 0), columns(n, 0);
  double all = 0, sum = 0;
  for (size_t i = 0; i < n; ++i) {
    for (size_t j = 0; j < n; ++j) rows[i] += table[i][j], columns[j] += table[i][j], all += table[i][j];
  }
  for (size_t i = 0; i < n; ++i) {
    for (size_t j = 0; j < n; ++j) {
      const double expected = rows[i] * columns[j] / all;
      sum += (table[i][j] - expected) * (table[i][j] - expected) / expected;
    }
  }
  return sum;
}

TEST(StochasticCapture, TwoSeedsHaveNothingToDoWithEachOther) {
  // Which of four samples holds the nearest surface with one seed and with another; none: the fifth.
  const auto table_of = [](const Frame& a, const Frame& b) {
    const Layered left(a.views[0]), right(b.views[0]);
    std::vector<std::vector<double>> table(5, std::vector<double>(5, 0));
    const auto holder = [](uint32_t held) { return held == 0 ? size_t(4) : size_t(std::countr_zero(held)); };
    for_pixels([&](int x, int y) {
      if (left.has(x, y, 1)) ++table[holder(left.holders(x, y, 0))][holder(right.holders(x, y, 0))];
    });
    return table;
  };
  const double most = 39.25;  // of 1000 independent pairs 999 stay below it, with 16 degrees of freedom
  const Frame first = captured_fence(4, 0.2, 0);
  for (const int seed : {1, 2, 77, 2147483647}) {
    const double chi = chi_square(table_of(first, captured_fence(4, 0.2, seed)));
    EXPECT_LT(chi, most) << "seed " << seed;
    std::printf("seeds 0 and %d: chi-square %.1f, 16 degrees of freedom\n", seed, chi);
  }
  EXPECT_GT(chi_square(table_of(first, captured_fence(4, 0.2, 0))), 100 * most) << "one seed is the same twice";
}

TEST(StochasticCapture, TheNearestSurfaceIsInEachSampleEquallyOften) {
  const Frame frame = captured_fence(16, 0.2);
  const Layered layered(frame.views[0]);
  double held[16] = {}, pixels = 0;
  for_pixels([&](int x, int y) {
    if (!layered.has(x, y, 1)) return;
    ++pixels;
    for (int j = 0; j < 16; ++j) held[j] += layered.holders(x, y, 0) >> j & 1;
  });
  for (int j = 0; j < 16; ++j)
    EXPECT_LT(std::abs(held[j] - 0.2 * pixels), 4 * std::sqrt(0.2 * 0.8 * pixels)) << "sample " << j;
}

/// The technique's result for a frame's peeled layers.
Frame derived(Frame& frame, const StochasticOptions& map) {
  RunOptions options;
  options.seed = map.seed;
  return test::outputs_of(find_technique("stochastic-depth"), frame,
                          {{"radius", fmt::format("{}", map.radius.value_or(0.5))},
                           {"max_reach", fmt::format("{}", map.max_reach)},
                           {"samples", std::to_string(map.samples)},
                           {"alpha", fmt::format("{}", map.alpha)},
                           {"surfaces", stochastic_surfaces()[size_t(map.surfaces)]},
                           {"subset", stochastic_subsets()[size_t(map.subset)]}},
                          options);
}

/// Moves the stochastic planes out of a frame.
std::map<std::string, Plane> without_map(View& view) {
  std::map<std::string, Plane> planes;
  for (auto& [name, plane] : view.planes) {
    if (stack_layer(name) && stack_layer(name)->stack == "stochastic") planes.emplace(name, std::move(plane));
  }
  for (const auto& [name, plane] : planes) view.planes.erase(name);
  return planes;
}

void expect_same_map(Frame& frame, const StochasticOptions& options) {
  std::vector<std::map<std::string, Plane>> captured;
  for (View& view : frame.views) {
    captured.push_back(without_map(view));
    EXPECT_EQ(captured.back().size(), size_t(options.samples));
    float most = 0;
    for (int y = 0; y < frame.height(); ++y) {
      for (int x = 0; x < frame.width(); ++x) most = std::max(most, view.planes.at("peel_count").channels[0].at(x, y));
    }
    EXPECT_GT(most, 3) << "there is something to choose from";
    EXPECT_LE(most, 64) << "all surfaces are stored";
  }
  normalise(frame);
  const Frame made = derived(frame, options);
  for (size_t v = 0; v < frame.views.size(); ++v) {
    for (const auto& [name, plane] : captured[v]) {
      const Plane* other = made.views[v].find(name);
      ASSERT_TRUE(other) << name;
      int differing = 0, held = 0;
      for (int y = 0; y < frame.height(); ++y) {
        for (int x = 0; x < frame.width(); ++x) {
          const float a = plane.channels[0].at(x, y), b = other->channels[0].at(x, y);
          differing += std::bit_cast<uint32_t>(a) != std::bit_cast<uint32_t>(b);
          held += std::isfinite(a);
        }
      }
      EXPECT_EQ(differing, 0) << name << " of view '" << frame.views[v].name << "'";
      if (!is_of_relevant(options)) {
        EXPECT_GT(held, 0) << name;
      }
    }
  }
}

TEST(StochasticCapture, TheSameBitsAsTheTechniqueMakes) {
  for (const bool orthographic : {false, true}) {
    for (const auto& [samples, alpha, seed] :
         {std::tuple(1, 0.2, 0), std::tuple(4, 0.2, 7), std::tuple(16, 0.37, 2147483647), std::tuple(5, 1.0, 3),
          std::tuple(3, 0.4, 1), std::tuple(5, 0.2, 2), std::tuple(7, 0.3, 4), std::tuple(12, 0.15, 5)}) {
      for (const auto surfaces : {StochasticSurfaces::all, StochasticSurfaces::hidden}) {
        for (const auto subset : {StochasticSubset::stratified, StochasticSubset::nearest}) {
          const StochasticOptions options = {samples, alpha, seed, surfaces, subset};
          SCOPED_TRACE(fmt::format("{} samples, alpha {}, seed {}, surfaces {}, subset {}, orthographic {}", samples,
                                   alpha, seed, int(surfaces), int(subset), orthographic));
          Frame frame = captured_fence(options, orthographic);
          expect_same_map(frame, options);
        }
      }
    }
  }
}

/// Samples of a map that hold a surface.
int held_in(const Frame& frame) {
  int held = 0;
  for (const Channel* sample : Layered(frame.views[0]).samples)
    for_pixels([&](int x, int y) { held += std::isfinite(sample->at(x, y)); });
  return held;
}

TEST(StochasticCapture, RelevantSurfacesAreThoseOfTheTechnique) {
  for (const bool orthographic : {false, true}) {
    StochasticOptions options = {.samples = 4};
    const int hidden = held_in(captured_fence(options, orthographic));
    int fewest = hidden;
    options.surfaces = StochasticSurfaces::relevant;
    for (const auto& [radius, max_reach, subset] :
         {std::tuple(0.02, 0.25, StochasticSubset::nearest), std::tuple(0.08, 0.25, StochasticSubset::nearest),
          std::tuple(0.2, 0.25, StochasticSubset::nearest), std::tuple(0.2, 0.01, StochasticSubset::nearest),
          std::tuple(0.08, 0.25, StochasticSubset::stratified)}) {
      SCOPED_TRACE(fmt::format("radius {}, max_reach {}, subset {}, orthographic {}", radius, max_reach, int(subset),
                               orthographic));
      options.radius = radius, options.max_reach = max_reach, options.subset = subset;
      Frame frame = captured_fence(options, orthographic);
      const int held = held_in(frame);
      EXPECT_GT(held, 0);
      fewest = std::min(fewest, held);
      expect_same_map(frame, options);
    }
    EXPECT_LT(fewest, hidden) << "some are left out";
  }
}

/// How far counts are from those expected, in all: the sum of squares over the expected ones.
double chi_square(const std::vector<double>& found, const std::vector<double>& expected) {
  double sum = 0;
  for (size_t i = 0; i < found.size(); ++i) {
    if (expected[i] > 0) sum += (found[i] - expected[i]) * (found[i] - expected[i]) / expected[i];
  }
  return sum;
}

/// Equation 1 for every number of samples: floor(alpha S + xi) of them hold the nearest surface, xi even between 0 and 1. Of 1000
/// such figures 999 stay below 10.8 (one degree of freedom), of 64 together below 106.
TEST(StochasticDepthOfLayers, EquationOneHoldsForEveryNumberOfSamples) {
  constexpr int width = 160, height = 120;
  constexpr double pixels = double(width) * height;
  Frame frame = test::shoot(test::perspective(width, height), test::tilted_plane(4, 0, 0));
  for (int i = 0; i < 2; ++i) {
    Channel& channel = test::plane_of(frame, layer_name("peel", i)).channels[0];
    for (int y = 0; y < height; ++y) std::fill_n(channel.row(y), width, 4 + float(i));
  }
  double all = 0;
  for (int samples = 1; samples <= 16; ++samples) {
    for (const double alpha : {0.2, 0.3, 0.37, 0.5}) {
      const Frame map = derived(frame, of_the_paper(samples, alpha, 1));
      std::vector<double> counts(size_t(samples) + 1, 0), in_sample(size_t(samples), 0);
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          size_t count = 0;
          for (int j = 0; j < samples; ++j) {
            const bool holds = value(map, layer_name("stochastic", j), x, y) == 4;
            count += holds;
            in_sample[size_t(j)] += holds;
          }
          ++counts[count];
        }
      }
      const double mean = alpha * samples, least = std::floor(mean + 1e-6), share = std::max(mean - least, 0.0);
      std::vector<double> expected(counts.size(), 0);
      expected[size_t(least)] = (1 - share) * pixels;
      if (share > 0) expected[size_t(least) + 1] = share * pixels;
      const std::string what = fmt::format("{} samples, alpha {}", samples, alpha);
      for (size_t i = 0; i < counts.size(); ++i) {
        if (expected[i] == 0) {
          EXPECT_EQ(counts[i], 0) << what << ": pixels whose nearest surface is held " << i << " times";
        }
      }
      const double chi = chi_square(counts, expected);
      EXPECT_LT(chi, 14) << what;
      all += chi;
      for (const double held : in_sample)
        EXPECT_LT(std::abs(held - alpha * pixels), 4.5 * std::sqrt(alpha * (1 - alpha) * pixels)) << what;
    }
  }
  std::printf("chi-square of all %.1f, 64 figures at most\n", all);
  EXPECT_LT(all, 106);
}

/// Every one of 64 layers is held as often as alpha predicts, down to less than once per image.
TEST(StochasticDepthOfLayers, SixteenSamplesOfSixtyFour) {
  constexpr int width = 160, height = 120, layers = 64, samples = 16;
  constexpr double alpha = 0.05;
  Frame frame = test::shoot(test::perspective(width, height), test::tilted_plane(4, 0, 0));
  const auto depth_of = [](int layer) { return 4 + 0.25f * float(layer); };
  for (int i = 0; i < layers; ++i) {
    Channel& channel = test::plane_of(frame, layer_name("peel", i)).channels[0];
    for (int y = 0; y < height; ++y) std::fill_n(channel.row(y), width, depth_of(i));
  }
  const Frame map = derived(frame, of_the_paper(samples, alpha));
  std::vector<double> held(layers, 0);
  double empty = 0;
  for (int j = 0; j < samples; ++j) {
    const Channel& sample = map.views[0].find(layer_name("stochastic", j))->channels[0];
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const double layer = (double(sample.at(x, y)) - 4) * 4;
        if (std::isinf(layer))
          ++empty;
        else
          ++held.at(size_t(layer));
      }
    }
  }
  const double all = double(width) * height * samples;
  for (int i = 0; i < layers; ++i) {
    const double share = alpha * std::pow(1 - alpha, i);
    EXPECT_LT(std::abs(held[size_t(i)] - share * all), 4.5 * std::sqrt(share * all)) << "layer " << i;
  }
  EXPECT_NEAR(empty / all, std::pow(1 - alpha, layers), 0.002);
}

TEST(StochasticCapture, IsOfAllSurfacesWhateverIsStored) {
  CaptureOptions options;
  options.width = fence_width, options.height = fence_height;
  options.stochastic = of_the_paper(16, 0.2, 5);
  options.views = {{"", camera_for(fence().cameras[0], fence_width, fence_height), {}}};
  const Frame all = captured_fence(16, 0.2, 5);
  for (const int peel : {0, 1}) {
    options.peel = peel;
    const Frame few = capture(fence_tracer(), options).frame;
    int differing = 0;
    for_pixels([&](int x, int y) {
      for (int j = 0; j < 16; ++j)
        differing += value(few, layer_name("stochastic", j), x, y) != value(all, layer_name("stochastic", j), x, y);
    });
    EXPECT_EQ(differing, 0) << peel << " layers stored";
  }
}

TEST(StochasticCapture, TheUnitOfTheSceneChangesNothing) {
  Scene large = boxes();
  for (Mesh& mesh : large.meshes) {
    for (vec3& position : mesh.positions) position *= 1024.0f;
  }
  large.cameras[0].pose.position *= 1024.0;
  const auto map_of = [](const Scene& scene) {
    const Tracer tracer(scene);
    CaptureOptions options;
    options.width = 65, options.height = 33;
    options.stochastic = of_the_paper(8, 0.3, 1);
    options.views = {{"", camera_for(scene.cameras[0], 65, 33), {}}};
    return capture(tracer, options).frame;
  };
  const Frame a = map_of(boxes()), b = map_of(large);
  int held = 0;
  for (int y = 0; y < 33; ++y) {
    for (int x = 0; x < 65; ++x) {
      for (int j = 0; j < 8; ++j) {
        const float small = value(a, layer_name("stochastic", j), x, y);
        EXPECT_EQ(1024 * small, value(b, layer_name("stochastic", j), x, y));
        held += std::isfinite(small);
      }
    }
  }
  EXPECT_GT(held, 1000);
}

// --- The second view

CaptureOptions turned(const Scene& scene, double degrees, bool orthographic) {
  SceneCamera camera = scene.cameras[0];
  camera.orthographic = orthographic;
  camera.width = 6;
  CaptureOptions options;
  options.width = 96, options.height = 54;
  options.planes = {"normal", "position", "instance"};
  options.peel = 64;
  options.stochastic = of_the_paper(4, 0.2, 3);
  options.views = {{"", camera_for(camera, options.width, options.height), {}}};
  options.second_view = degrees;
  return options;
}

TEST(SecondView, HasAllPlanesOfTheFirst) {
  const Scene scene = boxes();
  const Tracer tracer(scene);
  for (const bool orthographic : {false, true}) {
    CaptureOptions options = turned(scene, 35, orthographic);
    int most = 0;
    options.progress = [&](int done, int of) {
      EXPECT_EQ(of, 108) << "rows of both";
      most = std::max(most, done);
    };
    CaptureResult result = capture(tracer, options);
    EXPECT_EQ(most, 108);
    Frame& frame = result.frame;
    ASSERT_EQ(frame.views.size(), 2u);
    EXPECT_EQ(frame.views[0].name, "main");
    EXPECT_EQ(frame.views[1].name, "view2");
    EXPECT_EQ(frame.views[1].camera->orthographic, orthographic);
    EXPECT_EQ(frame.numbers.at("gloamSecondView"), 35);
    std::set<std::string> planes[2];
    for (int v : {0, 1}) {
      for (const auto& [name, plane] : frame.views[size_t(v)].planes) planes[v].insert(name);
    }
    EXPECT_EQ(planes[0], planes[1]);
    EXPECT_TRUE(planes[0].contains("stochastic.03") && planes[0].contains("peel.63") && planes[0].contains("normal"));
    expect_same_map(frame, of_the_paper(4, 0.2, 3));
  }
}

TEST(SecondView, TheFirstIsWhatItIsAlone) {
  const Scene scene = boxes();
  const Tracer tracer(scene);
  CaptureOptions options = turned(scene, -60, false);
  const CaptureResult both = capture(tracer, options);
  options.second_view.reset();
  const CaptureResult alone = capture(tracer, options);
  EXPECT_EQ(both.rays, 2 * alone.rays);
  EXPECT_FALSE(alone.visible);
  for (const auto& [name, plane] : alone.frame.views[0].planes) {
    const Plane& same = both.frame.views[0].planes.at(name);
    EXPECT_EQ(test::difference(same, plane).max, 0) << name;
  }
}

// The sides of the boxes, which the first camera sees edge-on or not at all, have the same world positions in both views.
TEST(SecondView, SeesTheSidesWhereTheyAre) {
  const Scene scene = boxes();
  const Tracer tracer(scene);
  for (const bool orthographic : {false, true}) {
    const Frame frame = capture(tracer, turned(scene, 40, orthographic)).frame;
    int sides[2] = {}, sheet[2] = {};
    for (size_t v : {0, 1}) {
      const View& view = frame.views[v];
      const auto place = [&](int x, int y) {
        dvec3 at = view.origin;
        for (int i = 0; i < 3; ++i) at[i] += view.planes.at("position").channels[size_t(i)].at(x, y);
        return at;
      };
      for (int y = 0; y < 54; ++y) {
        for (int x = 0; x < 96; ++x) {
          const float instance = view.planes.at("instance").channels[0].at(x, y);
          if (instance == 0) continue;
          const dvec3 at = place(x, y);
          if (instance == 4) {
            EXPECT_NEAR(at.z, -5, 1e-5) << "the sheet";
            ++sheet[v];
          } else {
            EXPECT_LT(std::max(std::abs(at.x) - 0.5, std::abs(at.y - 0.5) - 0.5), 1e-5) << "a box";
            sides[v] += std::abs(at.x - 0.5) < 1e-5;
          }
        }
      }
    }
    EXPECT_GT(std::min(sheet[0], sheet[1]), 500);
    EXPECT_LE(sides[0], 5);
    EXPECT_GT(sides[1], 50) << "the camera stands to the right of them";
  }
}

TEST(SecondView, RefusesWhatItCannotDo) {
  const Scene scene = boxes();
  const Tracer tracer(scene);
  const auto with = [&](const std::function<void(CaptureOptions&)>& change) {
    CaptureOptions options = turned(scene, 30, false);
    change(options);
    return options;
  };
  for (const double degrees : {0.0, 90.5, -91.0, double(NAN)})
    EXPECT_THROW(capture(tracer, with([&](CaptureOptions& o) { o.second_view = degrees; })), UsageError) << degrees;
  EXPECT_THROW(capture(tracer, with([](CaptureOptions& o) { o.views.push_back(o.views[0]); })), UsageError);
  EXPECT_THROW(capture(tracer, with([](CaptureOptions& o) { o.views[0].name = "view2"; })), UsageError);
  EXPECT_THROW(capture(tracer, with([](CaptureOptions& o) { o.planes = {"motion"}; })), UsageError);
  EXPECT_THROW(capture(tracer, with([](CaptureOptions& o) { o.views[0].camera.pose->position.y = 1e6; })), Error)
      << "nothing is seen";
  EXPECT_NO_THROW(capture(tracer, with([](CaptureOptions&) {})));
}

TEST(PairOfEyes, RefusesWhatItCannotDo) {
  const Scene scene = boxes();
  const Tracer tracer(scene);
  CaptureOptions options;
  options.width = options.height = 8;
  options.views = {{"", camera_for(scene.cameras[0], 8, 8), {}}};
  options.stereo = StereoRig{0.1, 2, false};
  const CaptureResult pair = capture(tracer, options);
  ASSERT_EQ(pair.frame.views.size(), 2u);
  EXPECT_EQ(pair.frame.views[1].name, "right");
  const auto refused = [&](const std::function<void(CaptureOptions&)>& change) {
    CaptureOptions changed = options;
    change(changed);
    EXPECT_THROW(capture(tracer, changed), UsageError);
  };
  refused([](CaptureOptions& o) { o.second_view = 30; });
  refused([](CaptureOptions& o) { o.views.push_back(o.views[0]); });
  refused([](CaptureOptions& o) { o.views[0].camera.orthographic = true; });
  for (const StereoRig& rig : std::initializer_list<StereoRig>{{-0.1, 2, false},
                                                               {NAN, 2, false},
                                                               {INFINITY, 2, false},
                                                               {0.1, 0, false},
                                                               {0.1, NAN, true},
                                                               {0.1, {}, true},
                                                               {0.1, 1e-12, false}})
    refused([&](CaptureOptions& o) { o.stereo = rig; });
}

TEST(Capture, RefusesWhatItCannotDo) {
  const Scene scene = boxes();
  const Tracer tracer(scene);
  CaptureOptions options;
  options.views = {{"", camera_for(scene.cameras[0], 8, 8), {}}};
  options.width = options.height = 8;
  options.planes = {"normals"};
  EXPECT_THROW(capture(tracer, options), UsageError);
  options.planes = {};
  options.peel = 65;
  EXPECT_THROW(capture(tracer, options), UsageError);
  options.peel = 0;
  for (const StochasticOptions& wrong : std::initializer_list<StochasticOptions>{
           {17, 0.2, 0}, {-1, 0.2, 0}, {4, -0.1, 0}, {4, 1.1, 0}, {4, NAN, 0}, {4, 0.2, -1}}) {
    options.stochastic = wrong;
    EXPECT_THROW(capture(tracer, options), UsageError) << wrong.samples << " " << wrong.alpha << " " << wrong.seed;
  }
  options.stochastic = {};
  options.views[0].camera.pose.reset();
  EXPECT_THROW(capture(tracer, options), Error);
  Scene empty = boxes();
  empty.meshes.clear();
  EXPECT_THROW(Tracer{empty}, Error);
  Scene broken = boxes();
  broken.meshes[0].triangles[0].x = 1000000;
  EXPECT_THROW(Tracer{broken}, Error);
}

}  // namespace
}  // namespace gloam::capture_test
