// Cameras from renderers' own attributes, with values worked out by hand.
#include "exr/writer_cameras.h"

#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "gloam/error.h"
#include "gloam/projection.h"
#include "support/seen_frame.h"
#include "unit/message_of.h"

namespace gloam::writer_cameras_test {
namespace {

using glm::dvec2;
using glm::dvec3;
using test::message_of;

const Window display{0, 0, 200, 100};

std::optional<Camera> read(const Imf::Header& header, std::vector<std::string>* said = nullptr) {
  std::vector<std::string> notes;
  const auto camera = writer_camera(header, display, 1, notes);
  if (said) *said = notes;
  return camera;
}

void put(Imf::Header& header, const char* name, const char* text) { header.insert(name, Imf::StringAttribute(text)); }

/// Where the camera shows a point of the world.
void expect_at(const Camera& camera, const dvec3& world, const dvec2& pixel) {
  ASSERT_TRUE(camera.pose);
  const auto found = pixel_of_world(camera, world, 1);
  ASSERT_TRUE(found);
  EXPECT_LT(glm::distance(*found, pixel), 1e-3) << found->x << ' ' << found->y;
}

Imf::Header vray_header(const Imath::M44f& transform) {
  Imf::Header header(200, 100);
  header.insert("cameraFov", Imf::FloatAttribute(90));
  header.insert("cameraTransform", Imf::M44fAttribute(transform));
  header.insert("cameraProjection", Imf::IntAttribute(0));
  return header;
}

/// At (10, 2, 5) in Maya's world, y up, looking along +x: right is +z. Rows: x is right, y is backwards, z is down.
TEST(WriterCameras, VRayForMaya) {
  Imf::Header header = vray_header(Imath::M44f(0, 0, 1, 0, -1, 0, 0, 0, 0, -1, 0, 0, 10, 2, 5, 1));
  put(header, "vrayInfo/vrayversion", "Version of V-Ray for Maya 3.60.04");
  const Camera camera = *read(header);
  EXPECT_NEAR(camera.fx, 100, 1e-4);
  EXPECT_EQ(camera.cx, 100);
  expect_at(camera, {14, 2, 5}, {100, 50});
  expect_at(camera, {14, 2, 7}, {150, 50});
  expect_at(camera, {14, 3, 5}, {100, 25});
}

/// At (10, 2, 5) in the world of 3ds Max, z up, looking along +y: right is +x. Rows: x is right, y is up, z is backwards.
TEST(WriterCameras, VRayWithoutAVersion) {
  const Camera camera = *read(vray_header(Imath::M44f(1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 10, 2, 5, 1)));
  expect_at(camera, {10, 6, 5}, {100, 50});
  expect_at(camera, {12, 6, 5}, {150, 50});
  expect_at(camera, {10, 6, 6}, {100, 25});
}

TEST(WriterCameras, VRayOfUnknownAxesTellsTheLensAlone) {
  Imf::Header header = vray_header(Imath::M44f());
  put(header, "vrayInfo/vrayversion", "V-Ray for SketchUp");
  std::vector<std::string> notes;
  const auto camera = read(header, &notes);
  ASSERT_TRUE(camera);
  EXPECT_FALSE(camera->pose);
  EXPECT_EQ(notes.size(), 2u);
  header.insert("cameraProjection", Imf::IntAttribute(3));
  EXPECT_FALSE(read(header, &notes));
  EXPECT_NE(notes.front().find("cameraProjection is 3"), std::string::npos) << notes.front();
}

Imf::Header unreal_header(const char* pitch, const char* yaw, const char* roll) {
  Imf::Header header(200, 100);
  put(header, "unreal/camera/curPos/x", "10.0");
  put(header, "unreal/camera/curPos/y", "20.0");
  put(header, "unreal/camera/curPos/z", "30.0");
  put(header, "unreal/camera/curRot/pitch", pitch);
  put(header, "unreal/camera/curRot/yaw", yaw);
  put(header, "unreal/camera/curRot/roll", roll);
  put(header, "unreal/camera/FinalImage/fov", "90.0");
  put(header, "unreal/camera/FinalImage/fstop", "2.8");
  return header;
}

/// Unreal's world: x ahead, y to the right, z up, left-handed.
TEST(WriterCameras, UnrealUnturned) {
  const Camera camera = *read(unreal_header("0", "0", "0"));
  EXPECT_NEAR(camera.fx, 100, 1e-9);
  expect_at(camera, {110, 20, 30}, {100, 50});
  expect_at(camera, {110, 70, 30}, {150, 50});
  expect_at(camera, {110, 20, 55}, {100, 25});
  EXPECT_NEAR(glm::determinant(camera.pose->world_to_view), -1, 1e-12) << "a left-handed world";
}

TEST(WriterCameras, UnrealTurned) {
  // Yaw turns from x to y: looks along +y, and right is -x.
  expect_at(*read(unreal_header("0", "90", "0")), {10, 120, 30}, {100, 50});
  expect_at(*read(unreal_header("0", "90", "0")), {-40, 120, 30}, {150, 50});
  // Pitch turns upwards: looks along +z, and up is -x.
  expect_at(*read(unreal_header("90", "0", "0")), {10, 20, 130}, {100, 50});
  expect_at(*read(unreal_header("90", "0", "0")), {-15, 20, 130}, {100, 25});
  // Roll turns clockwise: right is down.
  expect_at(*read(unreal_header("0", "0", "90")), {110, 20, 5}, {125, 50});
  expect_at(*read(unreal_header("0", "0", "90")), {110, 45, 30}, {100, 25});
}

TEST(WriterCameras, UnrealWithoutOneFieldOfView) {
  Imf::Header header = unreal_header("0", "0", "0");
  put(header, "unreal/camera/Other/fov", "50.0");
  std::vector<std::string> notes;
  EXPECT_FALSE(read(header, &notes));
  EXPECT_EQ(notes.size(), 1u);
}

TEST(WriterCameras, RedshiftTellsTheLensAlone) {
  Imf::Header header(200, 100);
  header.insert("rs/camera/fov", Imf::FloatAttribute(90));
  const auto camera = read(header);
  ASSERT_TRUE(camera);
  EXPECT_NEAR(camera->fx, 100, 1e-4);
  EXPECT_FALSE(camera->pose);
}

TEST(WriterCameras, RefusesImpossibleValues) {
  EXPECT_EQ(message_of([] { read(vray_header(Imath::M44f(2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1))); }),
            "cameraTransform: scales by 2, expected a rotation and a translation");
  Imf::Header header(200, 100);
  header.insert("rs/camera/fov", Imf::FloatAttribute(200));
  EXPECT_EQ(message_of([&] { read(header); }), "rs/camera/fov: a field of view of 200 degrees; 1 to 179 make sense");
  EXPECT_FALSE(read(Imf::Header(200, 100)));
}

}  // namespace
}  // namespace gloam::writer_cameras_test
