// Cameras fitted to positions, against cameras that are known.
#include "camera/camera_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "base/random.h"
#include "camera/depth_relation.h"
#include "support/seen_frame.h"

namespace gloam::camera_fit_test {
namespace {

using glm::dvec2;
using glm::dvec3;
using test::known_camera;
using test::world_at;

const auto wavy = test::wavy_depth;

const Window display{0, 0, 320, 180};

template <typename Depth>
std::vector<PositionedPixel> seen_by(const Camera& camera, const Depth& depth, int step = 4) {
  std::vector<PositionedPixel> pixels;
  for (int y = display.y0; y < display.y1; y += step)
    for (int x = display.x0; x < display.x1; x += step) {
      const dvec2 centre(x + 0.5, y + 0.5);
      const dvec3 world = world_at(camera, centre, depth(centre));
      pixels.push_back({centre, dvec3(glm::vec3(world)), 1e-8 * glm::length(world)});
    }
  return pixels;
}

void expect_camera(const CameraFit& fit, const Camera& truth, double pixels, double units) {
  EXPECT_EQ(fit.why_refused, "");
  EXPECT_EQ(fit.camera.orthographic, truth.orthographic);
  EXPECT_NEAR(fit.camera.fx / truth.fx, 1, pixels / truth.fx);
  EXPECT_NEAR(fit.camera.fy / truth.fy, 1, pixels / truth.fy);
  EXPECT_NEAR(fit.camera.cx, truth.cx, pixels);
  EXPECT_NEAR(fit.camera.cy, truth.cy, pixels);
  ASSERT_TRUE(fit.camera.pose);
  for (int c = 0; c < 3; ++c)
    EXPECT_LT(glm::distance(fit.camera.pose->world_to_view[c], truth.pose->world_to_view[c]), pixels / truth.fx) << c;
  EXPECT_LT(glm::distance(fit.camera.pose->position, truth.pose->position), units);
}

TEST(CameraFit, FindsThePerspectiveCamera) {
  const Camera truth = known_camera();
  const CameraFit fit = fit_camera(seen_by(truth, wavy), {display});
  expect_camera(fit, truth, 1e-2, 1e-3);
  EXPECT_LT(fit.median, 1e-3);
  EXPECT_EQ(fit.assumption, FitAssumption::none);
}

TEST(CameraFit, FindsALensShiftAndAPixelAspect) {
  Camera truth = known_camera();
  truth.fy = 500;
  truth.cx = 203;
  truth.cy = 61;
  expect_camera(fit_camera(seen_by(truth, wavy), {display}), truth, 2e-2, 1e-3);
}

TEST(CameraFit, FindsACameraFarFromTheOrigin) {
  Camera truth = known_camera();
  truth.pose->position += dvec3(1e6, 2e4, -3e5);
  std::vector<PositionedPixel> pixels = seen_by(truth, wavy);
  for (PositionedPixel& pixel : pixels) pixel.rounding = 0.0625 / std::sqrt(12.0) * 0.6;  // a float at 1e6
  const CameraFit fit = fit_camera(pixels, {display});
  EXPECT_GT(fit.rounding, 0.3);
  expect_camera(fit, truth, 1.5, 0.05);
}

TEST(CameraFit, FindsTheCameraOfHalfFloats) {
  const Camera truth = known_camera();
  std::vector<PositionedPixel> pixels = seen_by(truth, wavy);
  for (PositionedPixel& pixel : pixels) {
    double square = 0;
    for (int c = 0; c < 3; ++c) {
      const double step = std::exp2(std::floor(std::log2(std::abs(pixel.world[c]) + 1e-6)) - 10);
      pixel.world[c] = std::round(pixel.world[c] / step) * step;
      square += step * step / 36;
    }
    pixel.rounding = std::sqrt(square);
  }
  const CameraFit fit = fit_camera(pixels, {display});
  expect_camera(fit, truth, 0.5, 0.02);
  EXPECT_LT(fit.median, 2 * fit.rounding);
}

TEST(CameraFit, OutvotesWildPositions) {
  const Camera truth = known_camera();
  std::vector<PositionedPixel> pixels = seen_by(truth, wavy);
  Random random(5);
  for (PositionedPixel& pixel : pixels)
    if (random.below(10) < 3) pixel.world *= random.uniform(0.1, 0.9);  // mixed with a background of zero
  expect_camera(fit_camera(pixels, {display}), truth, 0.05, 5e-3);
}

TEST(CameraFit, FindsTheCameraOfNoisyPositions) {
  const Camera truth = known_camera();
  std::vector<PositionedPixel> pixels = seen_by(truth, wavy, 3);
  Random random(7);
  for (PositionedPixel& pixel : pixels)
    pixel.world += dvec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)) * 0.008;
  expect_camera(fit_camera(pixels, {display}), truth, 0.5, 0.02);
}

TEST(CameraFit, MirrorsTheViewOfALeftHandedWorld) {
  Camera truth = known_camera();
  truth.pose->world_to_view[2] *= -1.0;
  truth.pose->position.z *= -1;
  const CameraFit fit = fit_camera(seen_by(truth, wavy), {display});
  expect_camera(fit, truth, 1e-2, 1e-3);
  EXPECT_LT(glm::determinant(fit.camera.pose->world_to_view), 0);
}

TEST(CameraFit, FindsTheOrthographicCamera) {
  Camera truth = known_camera();
  truth.orthographic = true;
  truth.fx = truth.fy = 40;
  const std::vector<PositionedPixel> pixels = seen_by(truth, wavy);
  const CameraFit fit = fit_camera(pixels, {display});
  EXPECT_EQ(fit.why_refused, "");
  EXPECT_TRUE(fit.camera.orthographic);
  EXPECT_NEAR(fit.camera.fx, 40, 1e-3);
  EXPECT_NEAR(fit.camera.fy, 40, 1e-3);
  for (int c = 0; c < 3; ++c)
    EXPECT_LT(glm::distance(fit.camera.pose->world_to_view[c], truth.pose->world_to_view[c]), 1e-4) << c;
  EXPECT_LT(fit.median, 1e-3);
  for (const PositionedPixel& pixel : pixels)
    ASSERT_LT((fit.camera.pose->world_to_view * (pixel.world - fit.camera.pose->position)).z, 0) << "before the camera";
}

TEST(CameraFit, FindsTheCameraOfATiltedPlaneByAnAssumption) {
  Camera truth = known_camera();
  const auto plane = [](const dvec2& pixel) { return 1 / (0.05 + 0.0006 * pixel.y + 0.0002 * pixel.x); };
  const CameraFit fit = fit_camera(seen_by(truth, plane), {display});
  EXPECT_EQ(fit.assumption, FitAssumption::centred_lens);
  expect_camera(fit, truth, 0.1, 0.01);
}

TEST(CameraFit, RefusesAPlaneThatFacesTheCamera) {
  const CameraFit fit = fit_camera(seen_by(known_camera(), [](const dvec2&) { return 5.0; }), {display});
  EXPECT_NE(fit.why_refused.find("one plane that nearly faces"), std::string::npos) << fit.why_refused;
}

TEST(CameraFit, RefusesFewPixelsOnePointAndOneLine) {
  std::vector<PositionedPixel> pixels = seen_by(known_camera(), wavy);
  const std::vector<PositionedPixel> few(pixels.begin(), pixels.begin() + 20);
  EXPECT_NE(fit_camera(few, {display}).why_refused.find("20 of the pixels"), std::string::npos);
  for (PositionedPixel& pixel : pixels) pixel.world = {1, 2, 3};
  EXPECT_NE(fit_camera(pixels, {display}).why_refused.find("one point"), std::string::npos);
  for (PositionedPixel& pixel : pixels) pixel.world = pixel.pixel.x * dvec3(1, 2, 3);
  EXPECT_NE(fit_camera(pixels, {display}).why_refused.find("one line"), std::string::npos);
}

TEST(CameraFit, RefusesAnotherProjectionAndNoise) {
  std::vector<PositionedPixel> pixels = seen_by(known_camera(), wavy);
  for (PositionedPixel& pixel : pixels) {  // a panorama
    const double longitude = pixel.pixel.x / 320 * 6.28, latitude = (0.5 - pixel.pixel.y / 180) * 3.14;
    const dvec3 ray(std::sin(longitude) * std::cos(latitude), std::sin(latitude),
                    std::cos(longitude) * std::cos(latitude));
    pixel.world = ray * wavy(pixel.pixel);
  }
  EXPECT_NE(fit_camera(pixels, {display}).why_refused, "");
  Random random(3);
  for (PositionedPixel& pixel : pixels)
    pixel.world = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  EXPECT_NE(fit_camera(pixels, {display}).why_refused, "");
}

/// Units from micrometres to light minutes, lenses from wide to long, turned and shifted anyhow.
TEST(CameraFit, FindsCamerasOfAnyUnitAndDirection) {
  Random random(11);
  for (int i = 0; i < 60; ++i) {
    const double unit = random.of_any_size(1e-6, 1e8);
    Camera truth = known_camera();
    truth.fx = random.of_any_size(80, 3000);
    truth.fy = truth.fx * (random.one_in(3) ? random.uniform(0.5, 2) : 1);
    if (random.one_in(2)) truth.cx += random.uniform(-100, 100), truth.cy += random.uniform(-60, 60);
    truth.pose->world_to_view = test::turned_view(random.uniform(-3, 3), random.uniform(-1.5, 1.5));
    truth.pose->position = unit * dvec3(random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-9, 9));
    truth.orthographic = random.one_in(5);
    if (truth.orthographic) truth.fx /= 8 * unit, truth.fy /= 8 * unit;
    const CameraFit fit = fit_camera(seen_by(truth, [&](const dvec2& p) { return unit * wavy(p); }), {display});
    ASSERT_EQ(fit.why_refused, "") << i;
    ASSERT_EQ(fit.camera.orthographic, truth.orthographic) << i << " fx " << truth.fx;
    EXPECT_LT(fit.median, 0.01) << i;
    EXPECT_NEAR(fit.camera.fx / truth.fx, 1, 2e-3) << i << " fx " << truth.fx;
    EXPECT_NEAR(fit.camera.fy / truth.fy, 1, 2e-3) << i;
    EXPECT_LT(glm::distance(fit.camera.pose->world_to_view[2], truth.pose->world_to_view[2]), 1e-3) << i;
  }
}

TEST(CameraFit, KeepsAShiftOfHalfAPixel) {
  Camera truth = known_camera();
  truth.cx += 0.5;
  truth.cy += 0.5;
  expect_camera(fit_camera(seen_by(truth, wavy), {display}), truth, 1e-2, 1e-3);
}

/// The pixels with depths as a file may have them: by planar depth and length of the ray.
template <typename Stored>
std::vector<PositionedPixel> with_depths(const Camera& camera, const Stored& stored) {
  std::vector<PositionedPixel> pixels = seen_by(camera, wavy);
  for (PositionedPixel& pixel : pixels)
    pixel.depth = stored(wavy(pixel.pixel), glm::distance(pixel.world, camera.pose->position));
  return pixels;
}

TEST(DepthRelation, TellsPlanarDepthFromTheLengthOfTheRayAndItsScale) {
  const Camera camera = known_camera();
  const auto relation = [&](const auto& stored) { return relate_depth(camera, with_depths(camera, stored)); };
  EXPECT_EQ(relation([](double z, double) { return z; }).kind, DepthRelation::planar);
  EXPECT_NEAR(relation([](double z, double) { return z; }).scale, 1, 1e-6);
  EXPECT_EQ(relation([](double, double ray) { return 100 * ray; }).kind, DepthRelation::along_ray);
  EXPECT_NEAR(relation([](double, double ray) { return 100 * ray; }).scale, 100, 1e-4);
  EXPECT_EQ(relation([](double z, double) { return 1 / z; }).kind, DepthRelation::neither);
  EXPECT_EQ(relate_depth(camera, seen_by(camera, wavy)).kind, DepthRelation::unknown) << "no depths";
}

TEST(DepthRelation, SaysNothingOfANarrowView) {
  Camera camera = known_camera();
  camera.fx = camera.fy = 1e5;
  EXPECT_EQ(relate_depth(camera, with_depths(camera, [](double z, double) { return z; })).kind, DepthRelation::unknown);
}

TEST(DepthRelation, PlacesAnOrthographicCamera) {
  for (const bool is_mirrored : {false, true}) {
    Camera truth = known_camera();
    truth.orthographic = true;
    truth.fx = truth.fy = 40;
    if (is_mirrored)
      for (int c = 0; c < 3; ++c) truth.pose->world_to_view[c].z *= -1;
    const auto pixels = with_depths(truth, [](double z, double) { return 10 * z; });
    Camera camera = fit_camera(pixels, {display}).camera;
    const DepthRelation relation = place_by_depth(camera, pixels);
    EXPECT_EQ(relation.kind, DepthRelation::planar);
    EXPECT_NEAR(relation.scale, 10, 1e-3);
    EXPECT_LT(glm::distance(camera.pose->position, truth.pose->position), 1e-3) << is_mirrored;
    EXPECT_LT(glm::distance(camera.pose->world_to_view[2], truth.pose->world_to_view[2]), 1e-4) << is_mirrored;
  }
}

}  // namespace
}  // namespace gloam::camera_fit_test
