// Normalisation: depth, background, normals and planes brought to one convention.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <limits>

#include "camera/camera_json.h"
#include "camera/camera_search.h"
#include "frame/field_of_view.h"
#include "gloam/error.h"
#include "gloam/exr.h"
#include "gloam/normalise.h"
#include "normalise/depth.h"
#include "normalise/normal_samples.h"
#include "normalise/normals.h"
#include "unit/read_channel.h"

namespace gloam::conventions_test {
namespace {

using namespace gloam;
using glm::dvec3;
using gloam::test::read_channel;
using gloam::test::read_vector;

constexpr float inf = std::numeric_limits<float>::infinity();
const float nan = std::numeric_limits<float>::quiet_NaN();

Channel row_of(const std::vector<float>& values) {
  Channel channel(Layout(int(values.size()), 1), -7.0f);
  std::copy(values.begin(), values.end(), channel.row(0));
  return channel;
}

std::vector<float> values_in(const Channel& channel) {
  return {channel.row(0), channel.row(0) + channel.layout().width};
}

/// Image-sized window at the origin.
Window window_of(const Channel& channel) { return {0, 0, channel.layout().width, channel.layout().height}; }

Camera plain_camera() {
  Camera camera;
  camera.fx = camera.fy = 100;
  return camera;
}

struct Converted {
  std::vector<float> depth;
  std::string convention;
  std::vector<std::string> assumed;
};

Converted convert(const std::vector<float>& values, const StatedDepth& options = {}, Camera camera = plain_camera(),
                  const std::vector<float>* alpha = nullptr) {
  Channel depth = row_of(values);
  const Channel cover = row_of(alpha ? *alpha : values);
  Converted result;
  result.convention = to_view_depth(depth, alpha ? &cover : nullptr, window_of(depth), camera, options, result.assumed);
  result.depth = values_in(depth);
  return result;
}

StatedDepth with(DepthConvention depth, std::optional<double> near = {}, std::optional<double> far = {}) {
  StatedDepth options;
  options.convention = depth;
  options.near = near;
  options.far = far;
  return options;
}

/// An image computed by a function of the pixel.
Channel image(int width, int height, const std::function<float(int, int)>& value) {
  Channel channel(Layout(width, height), 0.0f);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) channel.at(x, y) = value(x, y);
  return channel;
}

// --- Background

TEST(Depth, BackgroundIsRecognisedAndNothingElse) {
  const Converted c =
      convert({1, inf, -inf, nan, 0, -0.0f, 1e10f, 1e11f, 1e-31f, -3, 9.9e9f, 65504, 1e-6f, 60, 1e-29f});
  EXPECT_EQ(c.depth,
            (std::vector<float>{1, inf, inf, inf, inf, inf, inf, inf, inf, inf, 9.9e9f, 65504, 1e-6f, 60, 1e-29f}));
  EXPECT_EQ(c.convention, "z");
  ASSERT_EQ(c.assumed.size(), 2u);
  EXPECT_EQ(c.assumed[0], "depth: 1 negative value among positive ones taken as background");
  EXPECT_NE(c.assumed[1].find("--depth"), std::string::npos);
}

TEST(Depth, FarPlaneWhereKnown) {
  const float beside = std::nextafter(60.1f, 0.0f);
  const std::vector<float> values = {60.1f, beside, 60.099f, 60.2f, 65504};
  Camera camera = plain_camera();
  EXPECT_EQ(convert(values).depth, values);
  camera.far = 60.1;
  EXPECT_EQ(convert(values, {}, camera).depth, (std::vector<float>{inf, inf, 60.099f, 60.2f, 65504}));
  const StatedDepth options = with(DepthConvention::z, {}, 65504);  // the option wins over the camera
  EXPECT_EQ(convert(values, options, camera).depth, (std::vector<float>{60.1f, beside, 60.099f, 60.2f, inf}));
  camera.far = std::numeric_limits<double>::infinity();
  EXPECT_EQ(convert(values, {}, camera).depth, values);
}

TEST(Depth, BackgroundOption) {
  StatedDepth options;
  options.background = 65504.0f;
  const Converted c = convert({65504, 65503, std::nextafter(65504.0f, 0.0f), 1, 0, 1e10f}, options);
  EXPECT_EQ(c.depth, (std::vector<float>{inf, 65503, std::nextafter(65504.0f, 0.0f), 1, inf, 1e10f}));
  options.convention = DepthConvention::ray;  // compared before conversion
  Camera camera = plain_camera();
  camera.cx = 0.5;
  camera.cy = 0.5;
  camera.fx = 1;
  EXPECT_EQ(convert({65504, 65504, 2}, options, camera).depth,
            (std::vector<float>{inf, inf, float(2 / std::sqrt(5.0))}));
  options = with(DepthConvention::reversed, 1);
  options.background = 0.25f;
  EXPECT_EQ(convert({0.25f, 0.5f}, options).depth, (std::vector<float>{inf, 2}));
}

TEST(Depth, NegativeDepthIsFlippedOnlyWhenAllIs) {
  const Converted flipped = convert({-1, -2.5f, 0, 1e10f, -1e10f, -inf, nan});
  EXPECT_EQ(flipped.convention, "negative z");
  EXPECT_EQ(flipped.depth, (std::vector<float>{1, 2.5f, inf, inf, inf, inf, inf}));
  ASSERT_EQ(flipped.assumed.size(), 1u);
  EXPECT_NE(flipped.assumed[0].find("negative"), std::string::npos);
  const Converted mixed = convert({-1, 2});
  EXPECT_EQ(mixed.convention, "z");
  EXPECT_EQ(mixed.depth, (std::vector<float>{inf, 2}));
  StatedDepth options;
  options.background = -50.0f;
  EXPECT_EQ(convert({-1, -50}, options).depth, (std::vector<float>{1, inf}));
  EXPECT_EQ(convert({0, nan, inf}).convention, "z");  // nothing but background
}

TEST(Depth, AllInUnitRangeIsMentioned) {
  EXPECT_NE(convert({0.5f, 0.9f}).assumed.at(0).find("0..1"), std::string::npos);
  EXPECT_EQ(convert({0.5f, 1.9f}).assumed.at(0).find("0..1"), std::string::npos);
  EXPECT_TRUE(convert({0.5f}, with(DepthConvention::z)).assumed.empty());
}

TEST(Depth, PaddingIsLeftAlone) {
  Channel depth = row_of({1, 0});
  std::vector<std::string> assumed;
  to_view_depth(depth, nullptr, window_of(depth), plain_camera(), {}, assumed);
  EXPECT_EQ(depth.row(0)[2], -7);
  EXPECT_EQ(depth.row(0)[-1], -7);
}

// --- Conversions

TEST(Depth, RayLength) {
  // 3-4-5: at pixel centre (300.5, 0.5), with the axis at (0.5, 0.5) and fx = 400, the ray is 5/4 of z.
  Camera camera = plain_camera();
  camera.fx = 400;
  camera.cx = camera.cy = 0.5;
  Channel depth = image(301, 2, [](int, int) { return 10.0f; });
  std::vector<std::string> assumed;
  EXPECT_EQ(to_view_depth(depth, nullptr, window_of(depth), camera, with(DepthConvention::ray), assumed), "ray");
  EXPECT_EQ(depth.at(0, 0), 10);
  EXPECT_FLOAT_EQ(depth.at(300, 0), 8);
  EXPECT_FLOAT_EQ(depth.at(0, 1), float(10 / std::sqrt(1 + 1e-4)));
  EXPECT_TRUE(assumed.empty());

  // The same pixels, where the window does not begin at 0.
  Channel moved = image(301, 2, [](int, int) { return 10.0f; });
  camera.cx += 1000;
  camera.cy -= 70;
  to_view_depth(moved, nullptr, {1000, -70, 1301, -68}, camera, with(DepthConvention::ray), assumed);
  EXPECT_FLOAT_EQ(moved.at(300, 0), 8);

  camera.orthographic = true;
  EXPECT_EQ(convert({10, 0, 3}, with(DepthConvention::ray), camera).depth, (std::vector<float>{10, inf, 3}));
}

TEST(Depth, RayLengthsThatLeaveNoDepthAreBackground) {
  Camera camera = plain_camera();
  camera.fx = 1e-6;  // the pixel's ray lies nearly in the plane of the image
  camera.cx = -1e6;
  EXPECT_EQ(convert({1e-25f, 1e-29f, 1e10f}, with(DepthConvention::ray), camera).depth,
            (std::vector<float>{inf, inf, inf}));
}

TEST(Depth, RayLengthOfAWallOverAllFieldsOfView) {
  double worst = 0;
  for (double degrees : {1.0, 60.0, 120.0, 179.0}) {
    const Window window{0, 0, 640, 360};
    Camera camera = camera_from_fov(degrees, window, 1, "test");
    camera.cx += 100;  // off-axis
    Channel depth = image(640, 360, [&](int x, int y) {
      const dvec3 direction((x + 0.5 - camera.cx) / camera.fx, (y + 0.5 - camera.cy) / camera.fy, 1);
      return float(7 * glm::length(direction));
    });
    std::vector<std::string> assumed;
    to_view_depth(depth, nullptr, window, camera, with(DepthConvention::ray), assumed);
    for (int y = 0; y < 360; ++y)
      for (int x = 0; x < 640; ++x) worst = std::fmax(worst, std::abs(depth.at(x, y) / 7.0 - 1));
  }
  std::printf("ray to z, worst relative error: %.2e\n", worst);
  EXPECT_LT(worst, 2e-7);
}

TEST(Depth, NdcByHand) {
  // near 1, far 3: z = 3 / (3 - 2 d)
  const Converted c = convert({0, 0.75f, 0.5f, 1, 1.5f, -0.25f, nan}, with(DepthConvention::ndc, 1, 3));
  EXPECT_EQ(c.convention, "ndc");
  EXPECT_EQ(c.depth, (std::vector<float>{1, 2, 1.5f, inf, inf, inf, inf}));
  EXPECT_TRUE(c.assumed.empty());
}

TEST(Depth, ReversedByHand) {
  // near 1, far 3: z = 3 / (1 + 2 d)
  const Converted c = convert({1, 0.25f, 0.5f, 0, 1.5f, -0.25f, nan}, with(DepthConvention::reversed, 1, 3));
  EXPECT_EQ(c.convention, "reversed");
  EXPECT_EQ(c.depth, (std::vector<float>{1, 2, 1.5f, inf, inf, inf, inf}));
  const double infinite = std::numeric_limits<double>::infinity();
  const std::vector<float> expected = {0.5f, 1, 2, inf};
  EXPECT_EQ(convert({1, 0.5f, 0.25f, 0}, with(DepthConvention::reversed, 0.5, infinite)).depth, expected);
  const Converted assumed = convert({1, 0.5f, 0.25f, 0}, with(DepthConvention::reversed, 0.5));
  EXPECT_EQ(assumed.depth, expected);
  EXPECT_EQ(assumed.assumed.size(), 1u);
  EXPECT_EQ(convert({1e-20f}, with(DepthConvention::reversed, 0.5)).depth,
            std::vector<float>{inf});  // 5e19 is no depth
}

TEST(Depth, OrthographicWindowDepthIsLinear) {
  Camera camera = plain_camera();
  camera.orthographic = true;
  camera.near = 2;
  camera.far = 10;
  EXPECT_EQ(convert({0, 0.25f, 1}, with(DepthConvention::ndc), camera).depth, (std::vector<float>{2, 4, inf}));
  EXPECT_EQ(convert({1, 0.25f, 0}, with(DepthConvention::reversed), camera).depth, (std::vector<float>{2, 8, inf}));
}

TEST(Depth, AlphaTellsTheNearPlaneFromNothing) {
  const std::vector<float> alpha = {0, 1, 0, 0.5f};
  EXPECT_EQ(convert({0, 0, 0.5f, 0}, with(DepthConvention::ndc, 1, 3), plain_camera(), &alpha).depth,
            (std::vector<float>{inf, 1, 1.5f, 1}));
  EXPECT_EQ(convert({0, 0, 4, 0}, {}, plain_camera(), &alpha).depth, (std::vector<float>{inf, inf, 4, inf}));
}

TEST(Depth, MissingOrImpossibleClippingPlanes) {
  const auto message = [](const StatedDepth& options, const Camera& camera = plain_camera()) -> std::string {
    try {
      convert({0.5f}, options, camera);
    } catch (const Error& e) {
      return e.what();
    }
    return "";
  };
  using enum DepthConvention;
  EXPECT_NE(message(with(ndc)).find("--near"), std::string::npos);
  EXPECT_NE(message(with(reversed)).find("--near"), std::string::npos);
  EXPECT_NE(message(with(ndc, 1)).find("--far"), std::string::npos);
  EXPECT_NE(message(with(ndc, 0, 3)).find("near is 0"), std::string::npos);
  EXPECT_NE(message(with(ndc, 3, 1)).find("far is 1"), std::string::npos);
  EXPECT_NE(message(with(ndc, 1, std::nan(""))).find("far is nan"), std::string::npos);
  Camera camera = plain_camera();
  camera.orthographic = true;
  EXPECT_NE(message(with(reversed, 1), camera).find("--far"), std::string::npos);
  camera.orthographic = false;
  camera.near = 1;
  camera.far = 3;
  EXPECT_EQ(message(with(ndc), camera), "");
}

TEST(Depth, ErrorOfEachEncodingIsStated) {
  const double near = 0.05, far = 60;
  std::vector<double> truth;
  for (double z = 0.06; z < 59; z *= 1.01) truth.push_back(z);
  const auto worst = [&](const StatedDepth& options, const std::function<float(double)>& encode) {
    std::vector<float> encoded;
    for (double z : truth) encoded.push_back(encode(z));
    const std::vector<float> back = convert(encoded, options).depth;
    double largest = 0;
    for (size_t i = 0; i < truth.size(); ++i) largest = std::fmax(largest, std::abs(back[i] / truth[i] - 1));
    return largest;
  };
  const auto ndc = [&](double z) { return far * (z - near) / (z * (far - near)); };
  const auto steps = [](double value, double count) { return float(std::round(value * count) / count); };
  const StatedDepth as_ndc = with(DepthConvention::ndc, near, far), as_reversed = with(DepthConvention::reversed, near);
  const double z_float = worst(with(DepthConvention::z), [](double z) { return float(z); });
  const double ndc_float = worst(as_ndc, [&](double z) { return float(ndc(z)); });
  const double ndc_24 = worst(as_ndc, [&](double z) { return steps(ndc(z), 16777215.0); });
  const double ndc_16 = worst(as_ndc, [&](double z) { return steps(ndc(z), 65535.0); });
  const double reversed_float = worst(as_reversed, [&](double z) { return float(near / z); });
  std::printf(
      "worst relative error, z 0.06..59, near 0.05, far 60: z %.1e, ndc float %.1e, 24 bit %.1e, 16 bit %.1e, "
      "reversed float %.1e\n",
      z_float, ndc_float, ndc_24, ndc_16, reversed_float);
  EXPECT_LT(z_float, 6e-8);
  EXPECT_LT(reversed_float, 1.3e-7);
  // Half a step of d, 2^-25 or 2^-24 or 2^-17, grows by z (f - n) / (n f): 1180 at most.
  EXPECT_LT(ndc_float, 1180 * 0x1p-25 * 1.01);
  EXPECT_LT(ndc_24, 1180 * 0x1p-24 * 1.01);
  EXPECT_LT(ndc_16, 1180 * 0x1p-17 * 1.02);
}

// --- Normal space

/// Finds the space of normals; decodes encoded ones in place.
NormalSpace detect_normal_space(Plane& normal, const Channel& depth, const Window& window, const Camera& camera,
                                std::vector<std::string>& assumed) {
  NormalSamples samples(normal.channels.front().layout());
  samples.take(normal, 0);
  const NormalForm form = find_form(samples.pairs(depth, window, camera), camera.pose, {}, assumed);
  bring_to_view_space(normal, {.range = form.range}, camera);
  return form.space;
}

/// A sphere of radius 3 at depth 10 before a wall that leans away, seen by a turned camera; one corner is background.
struct Scene {
  Window window{0, 0, 320, 200};
  Camera camera = camera_from_fov(60, window, 1, "test");
  Channel depth{Layout(320, 200), inf};
  Plane normal{"normal", {}};

  Scene() {
    const dvec3 z = glm::normalize(dvec3(1, -2, 0.5)), x = glm::normalize(glm::cross(dvec3(0, 0, 1), z));
    camera.pose = Pose{glm::transpose(glm::dmat3(x, glm::cross(z, x), z)), {100, 200, 300}};
    for (int i = 0; i < 3; ++i) normal.channels.emplace_back(depth.layout(), 0.0f);
    for (int py = 0; py < 200; ++py)
      for (int px = 0; px < 320; ++px) shade(px, py);
  }

  void shade(int px, int py) {
    if (px < 40 && py < 40) return;
    const dvec3 ray((px + 0.5 - camera.cx) / camera.fx, (camera.cy - py - 0.5) / camera.fy, -1);
    const dvec3 centre(0, 0, -10), wall = glm::normalize(dvec3(0.3, 0.6, 1));
    const double b = glm::dot(ray, centre), a = glm::dot(ray, ray), c = glm::dot(centre, centre) - 9;
    const double discriminant = b * b - a * c;
    const bool sphere = discriminant > 0;
    const double t = sphere ? (b - std::sqrt(discriminant)) / a : -14 / glm::dot(ray, wall);
    if (t <= 0) return;
    depth.at(px, py) = float(t);
    set(px, py, sphere ? (ray * t - centre) / 3.0 : wall);
  }
  void set(int x, int y, const dvec3& n) {
    for (int i = 0; i < 3; ++i) normal.channels[size_t(i)].at(x, y) = float(n[i]);
  }
  dvec3 get(int x, int y) const {
    return {normal.channels[0].at(x, y), normal.channels[1].at(x, y), normal.channels[2].at(x, y)};
  }
  void change(const std::function<dvec3(const dvec3&)>& f) {
    for (int y = 0; y < 200; ++y)
      for (int x = 0; x < 320; ++x) set(x, y, f(get(x, y)));
  }
  void to_world() {
    const glm::dmat3 view_to_world = glm::transpose(camera.pose->world_to_view);
    change([&](const dvec3& n) { return view_to_world * n; });
  }
  NormalSpace detect(std::string& sentence) {
    std::vector<std::string> assumed;
    const NormalSpace space = detect_normal_space(normal, depth, window, camera, assumed);
    EXPECT_EQ(assumed.size(), 1u);
    sentence = assumed.at(0);
    return space;
  }
};

double agreement_in(const std::string& sentence) {
  return std::stod(sentence.substr(sentence.find("agree with depth to ") + 20));
}

TEST(Normals, ViewSpaceIsRecognised) {
  Scene scene;
  std::string sentence;
  EXPECT_EQ(scene.detect(sentence), NormalSpace::view);
  EXPECT_GT(agreement_in(sentence), 0.98) << sentence;
  EXPECT_NE(sentence.find("taken as view space"), std::string::npos) << sentence;
}

TEST(Normals, WorldSpaceIsRecognisedAndRotatedBack) {
  Scene scene, original;
  scene.to_world();
  std::string sentence;
  EXPECT_EQ(scene.detect(sentence), NormalSpace::world);
  EXPECT_GT(agreement_in(sentence), 0.98) << sentence;
  EXPECT_NE(sentence.find("--normal-space"), std::string::npos) << sentence;
  bring_to_view_space(scene.normal, {NormalSpace::world}, scene.camera);
  for (int y = 0; y < 200; y += 7)
    for (int x = 0; x < 320; x += 7)
      EXPECT_LT(glm::length(scene.get(x, y) - original.get(x, y)), 1e-6) << x << ", " << y;
}

TEST(Normals, OrthographicCamera) {
  Scene scene;
  scene.camera.orthographic = true;
  scene.camera.fx = scene.camera.fy = 20;  // only the wall: z = 10 + 0.3 X + 0.6 Y
  const dvec3 wall = glm::normalize(dvec3(0.3, 0.6, 1));
  scene.depth = image(320, 200, [&](int x, int y) {
    return float(10 + 0.3 * (x + 0.5 - scene.camera.cx) / 20 + 0.6 * (scene.camera.cy - y - 0.5) / 20);
  });
  scene.change([&](const dvec3&) { return wall; });
  scene.to_world();
  std::string sentence;
  EXPECT_EQ(scene.detect(sentence), NormalSpace::world);
  EXPECT_GT(agreement_in(sentence), 0.99) << sentence;
}

TEST(Normals, EncodedNormalsAreDecodedInPlace) {
  for (const bool world : {false, true}) {
    Scene scene, original;
    if (world) scene.to_world(), original.to_world();
    scene.change([](const dvec3& n) { return 0.5 + 0.5 * n; });
    std::string sentence;
    EXPECT_EQ(scene.detect(sentence), world ? NormalSpace::world : NormalSpace::view);
    EXPECT_NE(sentence.find("decoded from 0..1"), std::string::npos) << sentence;
    EXPECT_GT(agreement_in(sentence), 0.98) << sentence;
    EXPECT_LT(glm::length(scene.get(160, 100) - original.get(160, 100)), 1e-6);
    EXPECT_LT(glm::length(scene.get(300, 190) - original.get(300, 190)), 1e-6);
  }
}

TEST(Normals, PositiveNormalsAreNotTakenForEncoded) {
  Scene scene;  // the wall alone: every component of its normal is positive
  scene.depth = image(320, 200, [&](int x, int y) {
    const dvec3 ray((x + 0.5 - scene.camera.cx) / scene.camera.fx, (scene.camera.cy - y - 0.5) / scene.camera.fy, -1);
    return float(-14 / glm::dot(ray, glm::normalize(dvec3(0.3, 0.6, 1))));
  });
  scene.change([](const dvec3&) { return glm::normalize(dvec3(0.3, 0.6, 1)); });
  std::string sentence;
  EXPECT_EQ(scene.detect(sentence), NormalSpace::view);
  EXPECT_EQ(sentence.find("decoded"), std::string::npos) << sentence;
}

TEST(Normals, WithoutAPoseThoseOfTheViewStillAgreeWithDepth) {
  Scene scene;
  scene.camera.pose.reset();
  std::string sentence;
  EXPECT_EQ(scene.detect(sentence), NormalSpace::view);
  EXPECT_NE(sentence.find("view space"), std::string::npos) << sentence;
}

TEST(Normals, WithoutAPoseOthersAreWorldSpace) {
  Scene scene;
  scene.to_world();
  scene.camera.pose.reset();
  std::string sentence;
  EXPECT_EQ(scene.detect(sentence), NormalSpace::world);
  EXPECT_NE(sentence.find("world space"), std::string::npos) << sentence;
}

/// A camera that looks along the world's -z except for 30 degrees: its world-space normals agree with depth to 0.87.
TEST(Normals, WithoutAPoseAWorldTurnedLittleIsNotTheView) {
  Scene scene;
  const double angle = 0.52;
  scene.camera.pose->world_to_view =
      glm::dmat3(1, 0, 0, 0, std::cos(angle), std::sin(angle), 0, -std::sin(angle), std::cos(angle));
  scene.to_world();
  scene.camera.pose.reset();
  std::string sentence;
  EXPECT_EQ(scene.detect(sentence), NormalSpace::world);
  const double agreement = std::stod(sentence.substr(sentence.find("only to ") + 8));
  EXPECT_GT(agreement, 0.8) << sentence;
  EXPECT_LT(agreement, 0.9) << sentence;
}

/// Edges, of which small images have many: a third of the normals lies 60 degrees off, to either side.
TEST(Normals, WithoutAPoseEdgesAreNoTurn) {
  Scene scene;
  int pixel = 0;
  scene.change([&](const dvec3& n) {
    if (++pixel % 3 != 0) return n;
    const double angle = pixel % 2 ? 1.05 : -1.05;
    return dvec3(n.x, std::cos(angle) * n.y - std::sin(angle) * n.z, std::sin(angle) * n.y + std::cos(angle) * n.z);
  });
  scene.camera.pose.reset();
  std::string sentence;
  EXPECT_EQ(scene.detect(sentence), NormalSpace::view) << sentence;
  EXPECT_LT(agreement_in(sentence), 0.9) << sentence;
  EXPECT_EQ(sentence.find("turned by"), std::string::npos) << sentence;
}

/// 11.5 degrees: they agree with depth too well to tell by that alone.
TEST(Normals, WithoutAPoseATurnIsTold) {
  for (const bool is_turned : {false, true}) {
    Scene scene;
    const double angle = is_turned ? 0.2 : 0;
    scene.camera.pose->world_to_view =
        glm::dmat3(1, 0, 0, 0, std::cos(angle), std::sin(angle), 0, -std::sin(angle), std::cos(angle));
    scene.to_world();
    scene.camera.pose.reset();
    std::string sentence;
    EXPECT_EQ(scene.detect(sentence), NormalSpace::view) << sentence;
    EXPECT_EQ(sentence.find("turned by") != std::string::npos, is_turned) << sentence;
    if (!is_turned) continue;
    EXPECT_NEAR(std::stod(sentence.substr(sentence.find("turned by ") + 10)), 11.5, 1.1) << sentence;
    EXPECT_NE(sentence.find("--camera"), std::string::npos) << sentence;
  }
}

TEST(Normals, MissingOnesAreCountedOnTheForeground) {
  Scene scene;
  EXPECT_EQ(count_missing_normals(scene.normal, scene.depth), 0);
  for (int x = 100; x < 103; ++x) scene.set(x, 150, {0, 0, 0});
  scene.set(103, 150, {0, nan, 1});
  scene.set(104, 150, {inf, 0, 1});
  EXPECT_EQ(count_missing_normals(scene.normal, scene.depth), 5);
  scene.depth.at(104, 150) = inf;
  EXPECT_EQ(count_missing_normals(scene.normal, scene.depth), 4);
}

TEST(Normals, ViewWhereNothingCanTell) {
  std::string sentence;
  Scene empty;
  empty.depth = Channel(empty.depth.layout(), inf);
  EXPECT_EQ(empty.detect(sentence), NormalSpace::view);
  Scene broken;
  broken.change([](const dvec3&) { return dvec3(std::nan("")); });
  EXPECT_EQ(broken.detect(sentence), NormalSpace::view);

  Plane one{"normal", {}};
  for (int i = 0; i < 3; ++i) one.channels.emplace_back(Layout(1, 1), 0.5f);
  std::vector<std::string> assumed;
  EXPECT_EQ(detect_normal_space(one, Channel(Layout(1, 1), 1.0f), {0, 0, 1, 1}, Scene().camera, assumed),
            NormalSpace::view);
}

// --- Normalisation

Frame frame_of(const std::map<std::string, std::vector<std::vector<float>>>& planes) {
  Frame frame;
  View view;
  for (const auto& [name, components] : planes) {
    Plane plane{name, {}};
    for (const auto& values : components) plane.channels.push_back(row_of(values));
    frame.window = window_of(plane.channels[0]);
    view.planes[name] = std::move(plane);
  }
  frame.display = frame.window;
  frame.views.push_back(std::move(view));
  return frame;
}

std::vector<float> values_in(const Frame& frame, const std::string& plane, size_t component = 0) {
  return values_in(frame.views[0].planes.at(plane).channels[component]);
}

TEST(Normalise, DepthAndItsLayers) {
  Frame frame = frame_of({{"depth", {{1, 0, -1, nan, inf, -inf, 1e10f, 1e-31f, 5, 60}}},
                          {"back_depth", {{2, 0, -1, nan, inf, -inf, 1e10f, 1e-31f, 5, 60}}},
                          {"peel.00", {{3, 0, -1, nan, inf, -inf, 1e10f, 1e-31f, 5, 60}}}});
  frame.views[0].camera = plain_camera();
  frame.views[0].camera->far = 60;
  normalise(frame, 5.0f);
  EXPECT_EQ(values_in(frame, "depth"), (std::vector<float>{1, inf, inf, inf, inf, inf, 1e10f, inf, inf, inf}));
  EXPECT_EQ(values_in(frame, "back_depth"), (std::vector<float>{2, inf, inf, inf, inf, inf, 1e10f, inf, inf, inf}));
  EXPECT_EQ(values_in(frame, "peel.00"), (std::vector<float>{3, inf, inf, inf, inf, inf, 1e10f, inf, inf, inf}));
}

TEST(Normalise, NormalsAreUnitOrZero) {
  Frame frame = frame_of({{"depth", {{1, 1, 1, 1, 1, 1, 1, 1, 1e10f}}},
                          {"normal",
                           {{3, 0, nan, inf, 1e38f, 1e-40f, 0.1f, 0, 0},
                            {0, 0, 0, 0, 1e38f, 0, 0, 1, 0},
                            {4, 0, 1, 0, 0, 0, 0, nan, 1}}}});
  normalise(frame);
  const float diagonal = float(std::sqrt(0.5));
  EXPECT_EQ(values_in(frame, "normal", 0), (std::vector<float>{0.6f, 0, 0, 0, diagonal, 1, 1, 0, 0}));
  EXPECT_EQ(values_in(frame, "normal", 1), (std::vector<float>{0, 0, 0, 0, diagonal, 0, 0, 0, 0}));
  EXPECT_EQ(values_in(frame, "normal", 2), (std::vector<float>{0.8f, 0, 0, 0, 0, 0, 0, 0, 0}));
}

TEST(Normalise, NormalsWithoutDepthStay) {
  Frame frame = frame_of({{"normal", {{0}, {0}, {2}}}});
  normalise(frame);
  EXPECT_EQ(values_in(frame, "normal", 2), std::vector<float>{1});
}

TEST(Normalise, BoundedPlanesAndColours) {
  Frame frame = frame_of({{"ao", {{0.5f, -0.1f, 1.5f, nan, inf, -inf}}},
                          {"albedo", {{0.5f, -0.1f, 1.5f, nan, inf, -inf}, {0, 0, 0, 0, 0, 0}, {1, 1, 1, 1, 1, 1}}},
                          {"color", {{0.5f, -0.1f, 1500, nan, inf, -inf}, {0, 0, 0, 0, 0, 0}, {1, 1, 1, 1, 1, 1}}}});
  normalise(frame);
  EXPECT_EQ(values_in(frame, "ao"), (std::vector<float>{0.5f, 0, 1, 1, 1, 0}));
  EXPECT_EQ(values_in(frame, "albedo"), (std::vector<float>{0.5f, 0, 1, 0, 1, 0}));
  EXPECT_EQ(values_in(frame, "color"), (std::vector<float>{0.5f, -0.1f, 1500, 0, 0, 0}));
}

TEST(Normalise, PaddingTakesTheOutsideValue) {
  Frame frame = frame_of({{"depth", {{1, 2}}}, {"ao", {{1, 0.5f}}}, {"normal", {{0, 0}, {0, 0}, {1, 1}}}});
  normalise(frame);
  const auto padding = [&](const char* plane) {
    const Channel& channel = frame.views[0].planes.at(plane).channels[0];
    return std::vector<float>{channel.data()[0], channel.row(0)[-1], channel.row(0)[2], channel.row(0)[15],
                              channel.data()[channel.layout().count() - 1]};
  };
  EXPECT_EQ(padding("depth"), std::vector<float>(5, inf));
  EXPECT_EQ(padding("ao"), std::vector<float>(5, 1.0f));
  EXPECT_EQ(padding("normal"), std::vector<float>(5, 0.0f));
}

TEST(Normalise, ASecondPassChangesNoBit) {
  Scene scene;
  scene.change([](const dvec3& n) { return n * 0.3 + dvec3(0.1, 0, 0); });
  Frame frame;
  frame.window = frame.display = scene.window;
  frame.views.emplace_back();
  frame.views[0].planes["normal"] = scene.normal.clone();
  frame.views[0].planes["depth"].channels.push_back(scene.depth.clone());
  normalise(frame);
  const Plane once = frame.views[0].planes["normal"].clone();
  normalise(frame);
  for (size_t c = 0; c < 3; ++c)
    for (int y = 0; y < 200; ++y)
      for (int x = 0; x < 320; ++x)
        ASSERT_EQ(frame.views[0].planes["normal"].channels[c].at(x, y), once.channels[c].at(x, y)) << x << ", " << y;
}

// --- Real frames

class CapturedNormals : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(folder + "/README.md")) GTEST_SKIP() << "no captures at " << folder;
  }
  /// Detects the space twice: with the file's normals (world), and with rotated ones.
  void expect_world(const std::string& frame, const std::string& depth_name, const std::string& normal_name) {
    const std::string path = folder + "/" + frame;
    std::vector<std::string> assumed;
    Channel depth = read_channel(path, depth_name);
    Plane normal = read_vector(path, normal_name, "normal");
    const Window window = window_of(depth);
    const Camera camera = read_camera_file(*find_camera_file(path), window, assumed).at("");
    EXPECT_EQ(to_view_depth(depth, nullptr, window, camera, {}, assumed), "z");
    EXPECT_EQ(detect_normal_space(normal, depth, window, camera, assumed), NormalSpace::world);
    std::printf("%s\n  %s\n", frame.c_str(), assumed.back().c_str());
    EXPECT_GT(agreement_in(assumed.back()), 0.9);
    bring_to_view_space(normal, {NormalSpace::world}, camera);
    EXPECT_EQ(detect_normal_space(normal, depth, window, camera, assumed), NormalSpace::view);
  }
  const std::string folder = GLOAM_CAPTURES;
};

TEST_F(CapturedNormals, Kitchen) {
  expect_world("kitchen/kitchen_user.exr", "ViewLayer.Depth.Z", "ViewLayer.Normal");
  expect_world("kitchen/kitchen_exact.exr", "ViewLayer.Depth.Z", "ViewLayer.Normal");
}
TEST_F(CapturedNormals, GardenLensShift) {
  expect_world("variants/garden_lens_shift.exr", "ViewLayer.Depth.Z", "ViewLayer.Normal");
}
TEST_F(CapturedNormals, GardenOrthographic) {
  expect_world("variants/garden_ortho.exr", "ViewLayer.Depth.Z", "ViewLayer.Normal");
}
TEST_F(CapturedNormals, GardenCompositor) {
  expect_world("variants/garden_compositor_file_output.exr", "depth.V", "N");
}

TEST_F(CapturedNormals, KitchenBackgroundShare) {
  Channel depth = read_channel(folder + "/kitchen/kitchen_user.exr", "ViewLayer.Depth.Z");
  std::vector<std::string> assumed;
  to_view_depth(depth, nullptr, window_of(depth), plain_camera(), {}, assumed);
  long background = 0;
  for (int y = 0; y < depth.layout().height; ++y)
    for (int x = 0; x < depth.layout().width; ++x) background += is_background(depth.at(x, y));
  EXPECT_NEAR(double(background) / (960 * 540), 0.034, 0.002);
}

}  // namespace

}  // namespace gloam::conventions_test
