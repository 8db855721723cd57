// Cameras fitted to positions, against cameras that are known.
#include "camera/camera_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "base/random.h"
#include "gloam/projection.h"

namespace gloam {
namespace {

using glm::dvec2;
using glm::dvec3;

const Window display{0, 0, 320, 180};

/// Turned about y by `yaw`, then about its own x by `pitch`: radians, positive to the left and upwards.
glm::dmat3 world_to_view(double yaw, double pitch) {
  const double c = std::cos(yaw), s = std::sin(yaw), cp = std::cos(pitch), sp = std::sin(pitch);
  const dvec3 right(c, 0, -s), ahead(-s * cp, sp, -c * cp), up = glm::cross(right, ahead);
  return glm::transpose(glm::dmat3(right, up, -ahead));
}

Camera known_camera() {
  Camera camera;
  camera.fx = camera.fy = 250;
  camera.cx = 160;
  camera.cy = 90;
  camera.pose = Pose{world_to_view(0.4, -0.2), {3, 1.5, 7}};
  return camera;
}

/// Depths of a scene that is no plane: waves, and a box in front of them.
double wavy(const dvec2& pixel) {
  const double waves = 8 + std::sin(pixel.x * 0.05) + 0.8 * std::cos(pixel.y * 0.08);
  return pixel.x > 100 && pixel.x < 180 && pixel.y > 60 && pixel.y < 140 ? 3.5 : waves;
}

dvec3 world_of(const Camera& camera, const dvec2& pixel, double depth) {
  return glm::transpose(camera.pose->world_to_view) * view_ray(camera, pixel)->at(depth) + camera.pose->position;
}

template <typename Depth>
std::vector<PositionedPixel> seen_by(const Camera& camera, const Depth& depth, int step = 4) {
  std::vector<PositionedPixel> pixels;
  for (int y = display.y0; y < display.y1; y += step)
    for (int x = display.x0; x < display.x1; x += step) {
      const dvec2 centre(x + 0.5, y + 0.5);
      const dvec3 world = world_of(camera, centre, depth(centre));
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
    if (random.one_in(4)) pixel.world *= random.uniform(0.1, 0.9);  // mixed with a background of zero
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

/// Depth of a floor 2 below the camera, that is level.
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

TEST(CameraFit, KeepsAShiftOfHalfAPixel) {
  Camera truth = known_camera();
  truth.cx += 0.5;
  truth.cy += 0.5;
  expect_camera(fit_camera(seen_by(truth, wavy), {display}), truth, 1e-2, 1e-3);
}

}  // namespace
}  // namespace gloam
