// Displays as JSON, the rays of their modules, and which of many views are key views.
#include "gloam/light_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/matrix.hpp>
#include <nlohmann/json.hpp>

#include "gloam/display_json.h"
#include "gloam/projection.h"
#include "plan/key_views.h"
#include "unit/message_of.h"

namespace gloam::test::light_field_test {
namespace {

using glm::dmat3;
using glm::dvec2;
using glm::dvec3;
using nlohmann::json;

constexpr double degree = glm::pi<double>() / 180;

json flat_display() {
  return json::parse(R"({
    "name": "wall", "unit": "metres",
    "observer": {"distance": 3, "height": 0.1},
    "screen": {"width": 1.6, "height": 1.2},
    "modules": {"resolution": [160, 120], "count": 5, "line": {"from": [-0.4, 0.2, -2], "to": [0.4, 0.2, -1.5]}},
    "world_to_physical": {"linear": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}})");
}

LightFieldDisplay read(const json& document) { return display_from_text(document.dump(), "d.json"); }

std::string fault_of(const json& document) {
  return message_of([&] { read(document); });
}

/// One line that begins with the file and holds every one of `parts`.
void expect_fault(const std::string& message, const std::vector<std::string>& parts) {
  EXPECT_EQ(message.rfind("d.json: ", 0), 0u) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  for (const std::string& part : parts)
    EXPECT_NE(message.find(part), std::string::npos) << "'" << part << "' is not in: " << message;
}

void expect_near(const dvec3& a, const dvec3& b, double tolerance) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "component " << i;
}

// --- Reading

TEST(DisplayJson, EveryField) {
  json document = flat_display();
  document["screen"]["radius"] = 2.5;
  document["modules"] = json::parse(R"({"resolution": [320, 200], "list": [
    {"position": [0.1, 0.2, -1]}, {"position": [-0.3, 0, -1.25], "yaw": 7, "pitch": -4}]})");
  document["world_to_physical"] = json::parse(R"({"linear": [[1, 2, 3], [0, 4, 5], [0, 0, 6]], "origin": [7, 8, 9]})");
  const LightFieldDisplay d = read(document);
  EXPECT_EQ(d.name, "wall");
  EXPECT_EQ(d.observer_distance, 3);
  EXPECT_EQ(d.observer_height, 0.1);
  EXPECT_EQ(d.screen_width, 1.6);
  EXPECT_EQ(d.screen_height, 1.2);
  EXPECT_EQ(d.screen_radius, 2.5);
  EXPECT_EQ(d.width, 320);
  EXPECT_EQ(d.height, 200);
  ASSERT_EQ(d.modules.size(), 2u);
  EXPECT_EQ(d.modules[0].position, dvec3(0.1, 0.2, -1));
  EXPECT_EQ(d.modules[0].yaw, 0);
  EXPECT_EQ(d.modules[0].pitch, 0);
  EXPECT_EQ(d.modules[1].position, dvec3(-0.3, 0, -1.25));
  EXPECT_EQ(d.modules[1].yaw, 7);
  EXPECT_EQ(d.modules[1].pitch, -4);
  ASSERT_TRUE(d.world);
  // By rows, as it is written.
  EXPECT_EQ(d.world->linear * dvec3(1, 10, 100), dvec3(321, 540, 600));
  EXPECT_EQ(d.world->origin, dvec3(7, 8, 9));
}

TEST(DisplayJson, WhatMayBeLeftOut) {
  json document = flat_display();
  for (const char* field : {"name", "unit", "world_to_physical"}) document.erase(field);
  document["observer"].erase("height");
  const LightFieldDisplay d = read(document);
  EXPECT_EQ(d.name, "unnamed");
  EXPECT_EQ(d.observer_height, 0);
  EXPECT_FALSE(d.screen_radius);
  EXPECT_FALSE(d.world);
  EXPECT_EQ(message_of([&] {
              module_cameras(d, {0, 0, 8, 8});
            }),
            "display 'unnamed': does not say which part of the world it shows; give region_of_interest.world");
  document["world_to_physical"] = {{"linear", {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};
  EXPECT_EQ(read(document).world->origin, dvec3(0));
}

TEST(DisplayJson, AFileGivesItsNameToADisplayWithoutOne) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "gloam_hologram.json";
  json document = flat_display();
  std::ofstream(file) << document.dump();
  EXPECT_EQ(read_display(file).name, "wall");
  document.erase("name");
  std::ofstream(file) << document.dump();
  EXPECT_EQ(read_display(file).name, "gloam_hologram");
  std::filesystem::remove(file);
}

TEST(DisplayJson, ModulesOnALine) {
  json document = flat_display();
  const LightFieldDisplay d = read(document);
  ASSERT_EQ(d.modules.size(), 5u);
  expect_near(d.modules[0].position, {-0.4, 0.2, -2}, 1e-15);
  expect_near(d.modules[1].position, {-0.2, 0.2, -1.875}, 1e-15);
  expect_near(d.modules[4].position, {0.4, 0.2, -1.5}, 1e-15);
  for (const OpticalModule& module : d.modules) EXPECT_TRUE(module.yaw == 0 && module.pitch == 0);
  document["modules"]["count"] = 1;
  expect_near(read(document).modules.at(0).position, {0, 0.2, -1.75}, 1e-15);
}

TEST(DisplayJson, ModulesOnAnArc) {
  json document = flat_display();
  document["modules"].erase("line");
  document["modules"]["arc"] = {{"centre", {0.5, -0.2, 1}}, {"radius", 4}, {"angle", 60}};
  const LightFieldDisplay d = read(document);
  ASSERT_EQ(d.modules.size(), 5u);
  expect_near(d.modules[0].position, {0.5 - 4 * std::sin(30 * degree), -0.2, 1 - 4 * std::cos(30 * degree)}, 1e-14);
  expect_near(d.modules[2].position, {0.5, -0.2, -3}, 1e-14);
  expect_near(d.modules[3].position, {0.5 + 4 * std::sin(15 * degree), -0.2, 1 - 4 * std::cos(15 * degree)}, 1e-14);
  document["modules"]["count"] = 1;
  expect_near(read(document).modules.at(0).position, {0.5, -0.2, -3}, 1e-14);
}

/// The axis of a module that faces the middle of the screen passes through it.
TEST(DisplayJson, Facing) {
  json document = flat_display();
  document["modules"]["facing"] = "ahead";
  for (const OpticalModule& module : read(document).modules) EXPECT_TRUE(module.yaw == 0 && module.pitch == 0);
  document["modules"]["facing"] = "middle";
  const LightFieldDisplay d = read(document);
  EXPECT_NEAR(d.modules[0].yaw, std::atan2(0.4, 2) / degree, 1e-12) << "from the left towards the right";
  EXPECT_LT(d.modules[0].pitch, 0) << "from above downwards";
  for (const auto& [name, camera] : module_cameras(d, {0, 0, 160, 120})) {
    const TwoSlits& s = *camera.slits;
    const dvec3 middle = glm::transpose(s.turn) * (dvec3(0) - s.module);
    expect_near(middle / glm::length(middle), {0, 0, 1}, 1e-14);
    expect_near(s.turn[0], glm::cross(s.turn[1], s.turn[2]), 1e-14);
    EXPECT_NEAR(s.turn[0].y, 0, 1e-14) << "turned, but not tilted";
  }
}

/// The same part of the world, said by two boxes and by a matrix.
TEST(DisplayJson, BoxesAndMatrixGiveOneMap) {
  json boxes = flat_display(), matrix = boxes;
  boxes.erase("world_to_physical");
  boxes["region_of_interest"] = json::parse(R"({
    "physical": {"centre": [0.1, 0.2, -0.5], "size": [1.6, 1.2, 2]},
    "world": {"centre": [1e7, 5, -3], "size": [16, 6, 4], "right": [0, 0, 2], "up": [0, 3, 0]}})");
  // Right is z, up is y: towards the observers is -x.
  matrix["world_to_physical"]["linear"] = {{0, 0, 0.1}, {0, 0.2, 0}, {-0.5, 0, 0}};
  matrix["world_to_physical"]["origin"] = {1e7 - 1, 4, -4};
  const WorldToPhysical a = *read(boxes).world, b = *read(matrix).world;
  for (int i = 0; i < 3; ++i) expect_near(a.linear[i], b.linear[i], 1e-15);
  expect_near(a.origin, b.origin, 1e-8);
  expect_near(a.linear * (dvec3(1e7, 5, -3) - a.origin), {0.1, 0.2, -0.5}, 1e-8);
  // A corner of one box becomes that of the other.
  expect_near(a.linear * (dvec3(1e7 - 2, 5 + 3, -3 + 8) - a.origin), {0.1 + 0.8, 0.2 + 0.6, -0.5 + 1}, 1e-8);
}

TEST(DisplayJson, RoundTripKeepsEveryCamera) {
  json convex = flat_display();
  convex["screen"]["radius"] = 2.2;
  convex["modules"].erase("line");
  convex["modules"]["arc"] = {{"centre", {0, -0.2, 0.3}}, {"radius", 3}, {"angle", 40}};
  convex["modules"]["facing"] = "middle";
  convex["world_to_physical"] = {{"linear", {{1.1, 0.2, 0.3}, {-0.1, 0.9, 0.05}, {0.2, 0.1, 1.3}}},
                                 {"origin", {12345678.9, -0.1, 1e7 / 3}}};
  for (const json& document : {flat_display(), convex}) {
    const LightFieldDisplay d = read(document);
    const auto before = module_cameras(d, {3, -2, 163, 118});
    const auto after = module_cameras(display_from_text(text_of(d), "again"), {3, -2, 163, 118});
    ASSERT_EQ(after.size(), before.size());
    for (size_t i = 0; i < before.size(); ++i) {
      const Camera &a = before[i].second, &b = after[i].second;
      EXPECT_EQ(before[i].first, after[i].first);
      for (const auto& [from, to] : {std::pair{a.fx, b.fx}, {a.fy, b.fy}, {a.cx, b.cx}, {a.cy, b.cy}, {*a.far, *b.far}})
        EXPECT_NEAR(from, to, 1e-12 * std::abs(from));
      expect_near(a.pose->position, b.pose->position, 1e-12);
      expect_near(a.slits->module, b.slits->module, 1e-12);
      EXPECT_EQ(a.slits->screen_radius, b.slits->screen_radius);
      for (int k = 0; k < 3; ++k) {
        expect_near(a.pose->world_to_view[k], b.pose->world_to_view[k], 1e-12);
        expect_near(a.slits->to_physical[k], b.slits->to_physical[k], 1e-12);
        expect_near(a.slits->turn[k], b.slits->turn[k], 1e-12);
      }
    }
  }
}

TEST(DisplayJson, NamesOfModules) {
  LightFieldDisplay d;
  d.modules.resize(3);
  EXPECT_EQ(module_names(d), (std::vector<std::string>{"module00", "module01", "module02"}));
  d.modules.resize(100);
  EXPECT_EQ(module_names(d).back(), "module99");
  d.modules.resize(101);
  EXPECT_EQ(module_names(d).front(), "module000");
  EXPECT_EQ(module_names(d).back(), "module100");
}

TEST(DisplayJson, IsToldFromACamera) {
  EXPECT_TRUE(is_display_text(flat_display().dump()));
  EXPECT_FALSE(is_display_text(R"({"fx": 3, "camera_to_world": []})"));
  EXPECT_FALSE(is_display_text("[1]"));
  EXPECT_FALSE(is_display_text("{"));
  // A faulty display is still a display: its fault must be reported.
  EXPECT_TRUE(is_display_text(R"({"observer": {"distance": NaN}, "modules": {}})"));
}

// --- Faults

TEST(DisplayFault, NoModules) {
  json document = flat_display();
  document["modules"]["count"] = 0;
  expect_fault(fault_of(document), {"modules.count is 0", "without modules"});
  document["modules"].erase("count");
  expect_fault(fault_of(document), {"modules.count is missing"});
  document["modules"].erase("line");
  document["modules"]["list"] = json::array();
  expect_fault(fault_of(document), {"modules.list is empty", "without modules"});
  document.erase("modules");
  expect_fault(fault_of(document), {"has no modules", "modules.count", "modules.list"});
}

TEST(DisplayFault, AScreenBehindItsObservers) {
  for (const double distance : {0.0, -3.0}) {
    json document = flat_display();
    document["observer"]["distance"] = distance;
    expect_fault(fault_of(document), {"observer.distance", "behind its observers"});
  }
}

TEST(DisplayFault, AModuleBeforeTheScreen) {
  json document = flat_display();
  document["modules"]["line"]["to"] = {0.4, 0, 0};
  expect_fault(fault_of(document), {"module 4", "z = 0", "not behind the screen"});
  document["modules"]["line"]["to"] = {0.4, 0, -0.1};
  EXPECT_EQ(fault_of(document), "no error");
  // The sides of a convex screen lie 0.4 behind its middle.
  document["screen"]["radius"] = 1;
  expect_fault(fault_of(document), {"module 4", "z = -0.1", "not behind the screen", "-0.4"});
  document["modules"]["line"]["to"] = {0.4, 0, -0.41};
  EXPECT_EQ(fault_of(document), "no error");
  document["screen"]["radius"] = 0.8;
  expect_fault(fault_of(document), {"screen.radius", "0.8"});
}

TEST(DisplayFault, SingularAndMirrored) {
  json boxes = flat_display(), matrix = boxes;
  boxes.erase("world_to_physical");
  boxes["region_of_interest"] = json::parse(R"({"physical": {"size": [1, 1, 1]}, "world": {"size": [1, 1, 1]}})");
  EXPECT_EQ(fault_of(boxes), "no error");
  const auto with_boxes = [&](auto change) {
    json document = boxes;
    change(document["region_of_interest"]);
    return fault_of(document);
  };
  expect_fault(with_boxes([](json& r) { r["world"]["size"][1] = 0; }),
               {"region_of_interest.world.size[1] is 0", "singular"});
  expect_fault(with_boxes([](json& r) { r["physical"]["size"][2] = 0; }),
               {"region_of_interest.physical.size[2] is 0", "singular"});
  expect_fault(with_boxes([](json& r) { r["world"]["size"][0] = -2; }),
               {"region_of_interest.world.size[0]", "-2", "> 0"});
  expect_fault(with_boxes([](json& r) { r["world"]["size"][0] = 1e-320; }), {"region_of_interest", "singular"});
  expect_fault(with_boxes([](json& r) {
                 r["world"]["up"] = {2, 0, 0};
               }),
               {"region_of_interest.world", "on one line", "singular"});
  expect_fault(with_boxes([](json& r) {
                 r["world"]["right"] = {0, 0, 0};
               }),
               {"region_of_interest.world", "on one line", "singular"});
  expect_fault(with_boxes([](json& r) {
                 r["world"]["up"] = {1, 1, 0};
               }),
               {"region_of_interest.world.up", "right angle"});
  expect_fault(with_boxes([](json& r) { r.erase("physical"); }), {"region_of_interest.physical", "missing"});
  expect_fault(with_boxes([](json& r) { r.erase("world"); }), {"region_of_interest.world", "missing"});
  matrix["world_to_physical"]["linear"] = {{1, 2, 3}, {2, 4, 6}, {0, 0, 1}};
  expect_fault(fault_of(matrix), {"world_to_physical.linear", "singular"});
  matrix["world_to_physical"]["linear"] = {{1, 0, 0}, {0, 0, 0}, {0, 0, 1}};
  expect_fault(fault_of(matrix), {"world_to_physical.linear", "singular"});
  matrix["world_to_physical"]["linear"] = {{1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
  expect_fault(fault_of(matrix), {"world_to_physical.linear", "mirrors", "-1"});
  json both = matrix;
  both["region_of_interest"] = boxes["region_of_interest"];
  expect_fault(fault_of(both), {"world_to_physical", "beside region_of_interest"});
}

/// As Python writes them.
TEST(DisplayFault, NumbersThatAreNotFinite) {
  const auto fault = [](const char* pointer, const std::string& literal) {
    json document = flat_display();
    document[json::json_pointer(pointer)] = "HERE";
    std::string text = document.dump();
    text.replace(text.find("\"HERE\""), 6, literal);
    return message_of([&] { display_from_text(text, "d.json"); });
  };
  for (const char* literal : {"NaN", "Infinity", "-Infinity"}) {
    expect_fault(fault("/observer/distance", literal), {"observer.distance is not finite"});
    expect_fault(fault("/screen/width", literal), {"screen.width is not finite"});
    expect_fault(fault("/modules/count", literal), {"modules.count is not finite"});
    expect_fault(fault("/modules/resolution/1", literal), {"modules.resolution[1] is not finite"});
    expect_fault(fault("/modules/line/to/2", literal), {"modules.line.to[2] is not finite"});
    expect_fault(fault("/world_to_physical/linear/1/2", literal), {"world_to_physical.linear[1][2] is not finite"});
  }
  expect_fault(fault("/screen/width", "1e13"), {"screen.width", "1e+13", "1e12"});
  expect_fault(fault("/screen/width", "1e999"), {"JSON"});
}

TEST(DisplayFault, BoxesThatDifferTooMuch) {
  json display = flat_display();
  display.erase("world_to_physical");
  display["region_of_interest"] = {{"physical", {{"size", {1, 1, 1}}}}, {"world", {{"size", {1, 1, 1e-11}}}}};
  EXPECT_EQ(fault_of(display), "no error");
  display["region_of_interest"]["world"]["size"][2] = 1e-13;
  expect_fault(fault_of(display), {"region_of_interest", "differ too much", "1e12"});
}

TEST(DisplayFault, TextsNestedSoDeepThatReadersWouldEnd) {
  const std::string deep = std::string(1000000, '[') + std::string(1000000, ']');
  std::string text = flat_display().dump();
  text.replace(text.find("\"line\""), 0, "\"facing\": " + deep + ", ");
  expect_fault(message_of([&] { display_from_text(text, "d.json"); }), {"200 levels"});
}

TEST(DisplayFault, ModulesPlacedBeyondTheRangeOfNumbers) {
  json display = flat_display();
  display["modules"]["line"]["to"][2] = -1e12;
  EXPECT_EQ(fault_of(display), "no error");
  display["modules"].erase("line");
  display["modules"]["arc"] = {{"centre", {0, 0, -1e12}}, {"radius", 1e12}, {"angle", 1}};
  expect_fault(fault_of(display), {"module 0", "1e12"});
}

TEST(DisplayFault, ScreensTooNarrowForNumbers) {
  json display = flat_display();
  display["screen"]["width"] = 1e-300;
  const LightFieldDisplay narrow = read(display);
  const std::string message = message_of([&] { module_cameras(narrow, {0, 0, 16, 12}); });
  EXPECT_NE(message.find("'wall': module00, the screen and the world"), std::string::npos) << message;
}

TEST(DisplayFault, MisspeltFields) {
  const auto fault = [](const char* pointer) {
    json document = flat_display();
    document[json::json_pointer(pointer)] = 1;
    return fault_of(document);
  };
  expect_fault(fault("/observers"), {"observers is no field", "did you mean 'observer'"});
  expect_fault(fault("/observer/distanse"), {"observer.distanse is no field", "did you mean 'distance'"});
  expect_fault(fault("/screen/widht"), {"screen.widht is no field", "did you mean 'width'"});
  expect_fault(fault("/modules/cuont"), {"modules.cuont is no field", "did you mean 'count'"});
  expect_fault(fault("/modules/line/form"), {"modules.line.form is no field", "did you mean 'from'"});
  expect_fault(fault("/world_to_physical/orgin"), {"world_to_physical.orgin is no field", "did you mean 'origin'"});
  json listed = flat_display();
  listed["modules"] = {{"resolution", {8, 8}}, {"list", {{{"position", {0, 0, -1}}, {"jaw", 3}}}}};
  expect_fault(fault_of(listed), {"modules.list[0].jaw is no field", "did you mean 'yaw'"});
}

TEST(DisplayFault, WrongTypes) {
  const auto fault = [](const char* pointer, const json& value) {
    json document = flat_display();
    document[json::json_pointer(pointer)] = value;
    return fault_of(document);
  };
  expect_fault(fault("/name", 3), {"name is of type number", "text"});
  expect_fault(fault("/name", nullptr), {"name is of type null", "text"});
  expect_fault(fault("/observer", {1, 2}), {"observer is of type array", "object"});
  expect_fault(fault("/observer/distance", "far"), {"observer.distance is of type string", "number"});
  expect_fault(fault("/observer/distance", nullptr), {"observer.distance is missing"});
  expect_fault(fault("/observer/height", true), {"observer.height is of type boolean", "number"});
  expect_fault(fault("/screen", nullptr), {"screen is missing"});
  expect_fault(fault("/screen/height", -1), {"screen.height", "-1", "> 0"});
  expect_fault(fault("/screen/radius", 0), {"screen.radius", "0", "> 0"});
  expect_fault(fault("/modules", json::array()), {"modules is of type array", "object"});
  expect_fault(fault("/modules/count", 2.5), {"modules.count", "2.5", "whole number"});
  expect_fault(fault("/modules/count", -1), {"modules.count", "-1", "whole number"});
  expect_fault(fault("/modules/count", 5000), {"modules.count", "5000", "4096"});
  expect_fault(fault("/modules/line", nullptr), {"modules.line is missing"});
  expect_fault(fault("/modules/line/to", {1, 2}), {"modules.line.to is no list of 3"});
  expect_fault(fault("/modules/line/to/1", "up"), {"modules.line.to[1] is of type string"});
  expect_fault(fault("/modules/facing", "inward"), {"modules.facing is \"inward\"", "ahead", "middle"});
  expect_fault(fault("/modules/facing", 3), {"modules.facing is 3"});
  expect_fault(fault("/world_to_physical/linear", {{1, 0}, {0, 1}}), {"world_to_physical.linear is not 3 rows of 3"});
  expect_fault(fault("/world_to_physical/linear/0/1", "x"), {"world_to_physical.linear[0][1] is of type string"});
  expect_fault(fault("/world_to_physical/origin", 0), {"world_to_physical.origin is no list of 3"});
  expect_fault(message_of([] { display_from_text("[1]", "d.json"); }), {"array", "observer, screen and modules"});
  expect_fault(message_of([] { display_from_text("{", "d.json"); }), {"JSON"});
}

TEST(DisplayFault, Resolution) {
  const auto fault = [](const json& value) {
    json document = flat_display();
    document["modules"]["resolution"] = value;
    return fault_of(document);
  };
  expect_fault(fault(nullptr), {"modules.resolution is missing", "[width, height]"});
  expect_fault(fault(160), {"modules.resolution is no list of 2"});
  expect_fault(fault({160}), {"modules.resolution is no list of 2"});
  expect_fault(fault({160, 0}), {"modules.resolution[1]", "0", "1 to 16384"});
  expect_fault(fault({160.5, 8}), {"modules.resolution[0]", "160.5", "whole number"});
  expect_fault(fault({20000, 8}), {"modules.resolution[0]", "20000"});
}

/// Fields that exclude each other are refused, since one of them would be ignored.
TEST(DisplayFault, WhatExcludesEachOther) {
  json document = flat_display();
  document["modules"]["arc"] = {{"centre", {0, 0, 0}}, {"radius", 2}, {"angle", 30}};
  expect_fault(fault_of(document), {"modules.arc is given beside line"});
  document = flat_display();
  document["modules"]["list"] = {{{"position", {0, 0, -1}}}};
  expect_fault(fault_of(document), {"modules.count is given beside list"});
  for (const char* field : {"line", "arc", "facing"}) {
    json listed = flat_display();
    listed["modules"] = {{"resolution", {8, 8}}, {"list", {{{"position", {0, 0, -1}}}}}, {field, 1}};
    expect_fault(fault_of(listed), {fmt::format("modules.{} is given beside list", field)});
  }
}

TEST(DisplayFault, ModulesThatDoNotLightTheScreen) {
  json document = flat_display();
  document["modules"] = {{"resolution", {8, 8}}, {"list", {{{"position", {0, 0, -1}}, {"yaw", 95}}}}};
  expect_fault(fault_of(document), {"module 0", "95", "away from the screen"});
  document["modules"]["list"][0]["yaw"] = 60;
  const LightFieldDisplay d = read(document);
  const std::string message = message_of([&] { module_cameras(d, {0, 0, 8, 8}); });
  EXPECT_NE(message.find("display 'wall': module00 cannot light the whole screen"), std::string::npos) << message;
}

// --- Rays

struct Case {
  const char* name;
  json document;
};

dvec3 observer_of(const TwoSlits& s) { return {0, s.observer_height, s.observer_distance}; }

std::vector<Case> cases() {
  const json flat = flat_display();
  json convex = flat, far_behind = flat, turned = flat, sheared = flat, distant = flat, nearly_flat = flat;
  convex["screen"]["radius"] = 2;
  convex["modules"]["facing"] = "middle";
  // Outside the screen's cylinder.
  far_behind["screen"]["radius"] = 0.9;
  far_behind["modules"]["line"] = {{"from", {-0.4, 0.1, -6}}, {"to", {0.4, 0.1, -6}}};
  turned["modules"] = json::parse(R"({"resolution": [160, 120], "list": [
    {"position": [-0.7, 0.3, -2], "yaw": 20, "pitch": -9}, {"position": [0, 0, -1], "yaw": -15, "pitch": 12}]})");
  sheared["world_to_physical"]["linear"] = {{1.1, 0.2, 0.3}, {-0.1, 0.9, 0.25}, {0.2, 0.1, 1.3}};
  distant["world_to_physical"]["linear"] = {{0.5, 0.1, -0.2}, {0, 0.7, 0}, {0.1, 0, 0.4}};
  distant["world_to_physical"]["origin"] = {1e7, -2e7, 3e7 + 0.1};
  nearly_flat["screen"]["radius"] = 1e5;
  return {{"flat", flat},
          {"convex", convex},
          {"far behind a convex screen", far_behind},
          {"turned", turned},
          {"sheared", sheared},
          {"distant", distant},
          {"nearly flat", nearly_flat}};
}

using CameraCheck = std::function<void(const Camera&)>;

void for_each_module(const CameraCheck& check) {
  for (const Case& test : cases()) {
    for (const auto& [name, camera] : module_cameras(read(test.document), {0, 0, 160, 120})) {
      SCOPED_TRACE(fmt::format("{}, {}", test.name, name));
      check(camera);
    }
  }
}

TEST(TwoSlitRays, PlaceIsTheInverseOfRay) {
  for_each_module([](const Camera& camera) {
    double worst = 0;
    int shown = 0;
    for (int y = 0; y < 120; ++y) {
      for (int x = 0; x < 160; ++x) {
        const dvec2 pixel(x + 0.5, y + 0.5);
        const auto ray = view_ray(camera, pixel);
        if (!ray) continue;
        ++shown;
        for (const double share : {0.01, 0.3, 0.7, 0.99}) {
          const double depth = share * depth_of_slit(camera);
          const dvec3 point = ray->at(depth);
          EXPECT_NEAR(point.z, -depth, 1e-12 * depth);
          const auto back = pixel_of(camera, point);
          worst = std::max(worst, back ? glm::length(*back - pixel) : 1e9);
        }
      }
    }
    EXPECT_LT(worst, 1e-6);
    // The whole image, except the part that turned modules throw past the screen.
    EXPECT_GT(shown, 160 * 120 / 2);
  });
}

/// World positions: far from the origin, the error is the rounding of doubles there.
TEST(TwoSlitRays, PosesAreThoseOfTheDisplay) {
  for (const Case& test : cases()) {
    SCOPED_TRACE(test.name);
    const LightFieldDisplay d = read(test.document);
    const Camera camera = module_cameras(d, {0, 0, 160, 120})[1].second;
    const glm::dmat3 rotation = camera.pose->world_to_view;
    for (int i = 0; i < 3; ++i) expect_near((rotation * glm::transpose(rotation))[i], dmat3(1.0)[i], 1e-14);
    EXPECT_NEAR(glm::determinant(rotation), 1, 1e-14);
    const TwoSlits& s = *camera.slits;
    EXPECT_TRUE(s.to_physical[0][2] == 0 && s.to_physical[1][2] == 0 && s.to_physical[2][2] > 0);
    for (const dvec3& off : {dvec3(0), dvec3(0.3, -0.2, 0.5), dvec3(-1, 2, -0.7)}) {
      const dvec3 world = d.world->origin + off, view = rotation * (world - camera.pose->position);
      expect_near(s.to_physical * view + observer_of(s), d.world->linear * off, 2e-8);
    }
  }
}

/// Physical: the least distance between a ray and a line, each by a point and a direction.
double distance_between(const dvec3& a, const dvec3& along_a, const dvec3& b, const dvec3& along_b) {
  const dvec3 across = glm::cross(along_a, along_b);
  return std::abs(glm::dot(b - a, across)) / glm::length(across);
}

TEST(TwoSlitRays, PosesOfAShearedWorldTurnAndDoNothingElse) {
  json document = flat_display();
  document["world_to_physical"]["linear"] = {{2, 0, 0.1}, {0, 2, 0}, {0, -1e7, 1}};
  const dmat3 turn = module_cameras(read(document), {0, 0, 160, 120}).front().second.pose->world_to_view;
  const dmat3 product = glm::transpose(turn) * turn;
  for (int i = 0; i < 3; ++i) expect_near(product[i], dmat3(1.0)[i], 1e-14);
}

TEST(TwoSlitRays, MeetBothSlits) {
  for_each_module([](const Camera& camera) {
    const TwoSlits& s = *camera.slits;
    for (int y = 3; y < 120; y += 19) {
      for (int x = 3; x < 160; x += 19) {
        const auto ray = view_ray(camera, {x + 0.5, y + 0.5});
        if (!ray) continue;
        const dvec3 start = s.to_physical * ray->start + observer_of(s), along = s.to_physical * ray->per_depth;
        EXPECT_NEAR(distance_between(start, along, s.module, {0, 1, 0}), 0, 1e-12);
        EXPECT_NEAR(distance_between(start, along, observer_of(s), {1, 0, 0}), 0, 1e-12);
        EXPECT_LT(along.z, 0) << "away from the observers";
      }
    }
  });
}

/// A ray meets the screen where the module's own light does: light is spread upwards and downwards there, not sideways.
TEST(TwoSlitRays, LeaveTheScreenWhereTheModuleLightsIt) {
  for_each_module([](const Camera& camera) {
    const TwoSlits& s = *camera.slits;
    for (const dvec2 pixel : {dvec2(40, 30), dvec2(80, 60), dvec2(130, 101)}) {
      const auto ray = view_ray(camera, pixel);
      ASSERT_TRUE(ray);
      const dvec3 light = s.turn * dvec3((pixel.x - camera.cx) / camera.fx, (camera.cy - pixel.y) / camera.fy, 1);
      const dvec3 start = s.to_physical * ray->start + observer_of(s), along = s.to_physical * ray->per_depth;
      const dvec3 side = glm::cross(light, dvec3(0, 1, 0));
      EXPECT_NEAR(glm::dot(side, along), 0, 1e-12 * glm::length(side)) << "not turned sideways";
      // Both pass through one point, and it is on the screen.
      const double t =
          (start.y - s.module.y - (start.z - s.module.z) * light.y / light.z) / (along.z * light.y / light.z - along.y);
      const dvec3 spot = start + t * along;
      const double r = s.screen_radius.value_or(0);
      if (std::abs(along.z * light.y / light.z - along.y) < 0.01) continue;  // one goes as the other
      const double behind = s.screen_radius ? std::hypot(spot.x, spot.z + r) - r : spot.z;
      EXPECT_NEAR(behind, 0, 1e-9);
    }
  });
}

TEST(TwoSlitRays, ImagesHoldTheScreen) {
  const Camera camera = module_cameras(read(flat_display()), {0, 0, 160, 120})[1].second;
  const TwoSlits& s = *camera.slits;
  // The corners of the screen are those of the image.
  const auto pixel_of = [&](double x, double y) {
    const dvec3 seen = glm::transpose(s.turn) * (dvec3(x, y, 0) - s.module);
    return dvec2(camera.cx + camera.fx * seen.x / seen.z, camera.cy - camera.fy * seen.y / seen.z);
  };
  EXPECT_LT(glm::length(pixel_of(-0.8, 0.6) - dvec2(0, 0)), 1e-9);
  EXPECT_LT(glm::length(pixel_of(0.8, -0.6) - dvec2(160, 120)), 1e-9);
  EXPECT_TRUE(view_ray(camera, {0.001, 0.001}));
  EXPECT_TRUE(view_ray(camera, {159.999, 119.999}));
  for (const dvec2 outside : {dvec2(-0.001, 60), dvec2(160.001, 60), dvec2(80, -0.001), dvec2(80, 120.001)})
    EXPECT_FALSE(view_ray(camera, outside)) << outside.x << ", " << outside.y;
}

TEST(TwoSlitRays, LightThatMissesTheScreenShowsNothing) {
  json document = flat_display();
  document["modules"] = json::parse(R"({"resolution": [160, 120], "list": [
    {"position": [-0.7, 0, -2], "yaw": 25, "pitch": 10}]})");
  const Camera camera = module_cameras(read(document), {0, 0, 160, 120})[0].second;
  int missing = 0;
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x) {
      const TwoSlits& s = *camera.slits;
      const dvec3 light = s.turn * dvec3((x + 0.5 - camera.cx) / camera.fx, (camera.cy - y - 0.5) / camera.fy, 1);
      const dvec3 spot = s.module + light * (2 / light.z);
      const bool hits = std::abs(spot.x) <= 0.8 && std::abs(spot.y) <= 0.6;
      EXPECT_EQ(view_ray(camera, {x + 0.5, y + 0.5}).has_value(), hits) << x << ", " << y;
      missing += !hits;
    }
  }
  EXPECT_GT(missing, 1000) << "a turned module's image of the screen has corners to spare";
}

TEST(TwoSlitRays, PointsThatHaveNoPlace) {
  const Camera camera = module_cameras(read(flat_display()), {0, 0, 160, 120})[2].second;
  const double slit = depth_of_slit(camera);
  EXPECT_NEAR(slit, 3 + 1.75, 1e-12);
  const auto ray = view_ray(camera, {30.5, 40.5});
  EXPECT_TRUE(pixel_of(camera, ray->at(1e-9)));
  EXPECT_FALSE(pixel_of(camera, ray->at(0))) << "on the observers' line";
  EXPECT_FALSE(pixel_of(camera, ray->at(-1))) << "before the observers";
  EXPECT_TRUE(pixel_of(camera, ray->at(slit - 1e-9)));
  EXPECT_FALSE(pixel_of(camera, ray->at(slit))) << "at the module";
  EXPECT_FALSE(pixel_of(camera, ray->at(slit + 1))) << "behind the module";
  // Nor have points seen past the side of a screen that is half a cylinder.
  json document = flat_display();
  document["screen"] = {{"width", 1.6}, {"height", 1.2}, {"radius", 0.81}};
  document["modules"]["line"] = {{"from", {0, 0, -2}}, {"to", {0, 0, -2}}};
  const Camera convex = module_cameras(read(document), {0, 0, 160, 120})[0].second;
  EXPECT_TRUE(pixel_of(convex, {0, 0, -3}));
  EXPECT_FALSE(pixel_of(convex, {4, 0, -3}));
}

TEST(TwoSlitRays, PixelsPerUnit) {
  const Camera camera = module_cameras(read(flat_display()), {0, 0, 160, 120})[1].second;
  for (const double depth : {1.0, 3.0, 4.5}) {
    const dvec3 point = view_ray(camera, {70.5, 50.5})->at(depth);
    const double moved = pixel_of(camera, point + dvec3(0.01, 0, 0))->x - pixel_of(camera, point)->x;
    EXPECT_NEAR(pixels_per_unit(camera, depth), moved / 0.01, 1e-6);
  }
}

// --- Fitted to a camera

TEST(FittedDisplay, ShowsWhatTheCameraFrames) {
  for (const double height_of_observers : {0.0, 0.25}) {
    for (const bool is_off_axis : {false, true}) {
      json document = flat_display();
      document.erase("world_to_physical");
      document["observer"]["height"] = height_of_observers;
      Camera camera;
      camera.fx = camera.fy = 500;
      camera.cx = is_off_axis ? 260 : 320, camera.cy = is_off_axis ? 300 : 240;
      Pose pose;
      pose.world_to_view = glm::transpose(dmat3(dvec3(0, 0, -1), dvec3(0, 1, 0), dvec3(1, 0, 0)));
      pose.position = {1e6, 2, 3};
      camera.pose = pose;
      const double depth = 7;
      const LightFieldDisplay d = fitted_to(read(document), camera, {0, 0, 640, 480}, depth);
      const auto physical = [&](const dvec3& view) {
        const dvec3 world = pose.position + glm::transpose(pose.world_to_view) * view;
        return d.world->linear * (world - d.world->origin);
      };
      expect_near(physical({0, 0, 0}), {0, height_of_observers, 3}, 1e-8);
      // The borders of the image at the depth are those of the screen.
      const auto at = [&](double x, double y) { return physical(depth * view_ray(camera, {x, y})->per_depth); };
      expect_near(at(320, 0), {0, 0.6, 0}, 1e-8);
      expect_near(at(320, 480), {0, -0.6, 0}, 1e-8);
      expect_near(at(0, 240), {-0.8, 0, 0}, 1e-8);
      expect_near(at(640, 240), {0.8, 0, 0}, 1e-8);
    }
  }
}

TEST(FittedDisplay, OfAnOrthographicCamera) {
  json document = flat_display();
  document.erase("world_to_physical");
  Camera camera;
  camera.orthographic = true;
  camera.fx = camera.fy = 100, camera.cx = 320, camera.cy = 240;
  camera.pose = Pose{};
  const LightFieldDisplay d = fitted_to(read(document), camera, {0, 0, 640, 480}, 5);
  expect_near(d.world->linear * (dvec3(0, 2.4, -5) - d.world->origin), {0, 0.6, 0}, 1e-12);
  expect_near(d.world->linear * (dvec3(0) - d.world->origin), {0, 0.1, 3}, 1e-12);
}

// --- Key views

TEST(KeyViews, EveryViewHasOneNear) {
  for (int count = 1; count <= 40; ++count) {
    for (int spacing = 2; spacing <= 45; ++spacing) {
      SCOPED_TRACE(fmt::format("{} views, spacing {}", count, spacing));
      const std::vector<KeyViewRole> roles = key_view_roles(count, spacing);
      ASSERT_EQ(roles.size(), size_t(count));
      std::vector<int> keys;
      for (int i = 0; i < count; ++i) {
        if (roles[size_t(i)].is_key) keys.push_back(i);
      }
      ASSERT_FALSE(keys.empty());
      EXPECT_LE(int(keys.size()), (count + spacing - 1) / spacing + 1) << "no more than are needed";
      for (int i = 0; i < count; ++i) {
        const KeyViewRole& role = roles[size_t(i)];
        if (role.is_key) continue;
        int least = count;
        for (const int key : keys) least = std::min(least, std::abs(key - i));
        EXPECT_LE(least, spacing / 2) << i;
        ASSERT_TRUE(roles.at(size_t(role.nearest)).is_key && roles.at(size_t(role.far)).is_key) << i;
        EXPECT_EQ(std::abs(role.nearest - i), least) << i;
        const bool is_between = keys.front() < i && i < keys.back();
        if (!is_between) {
          EXPECT_EQ(role.far, role.nearest) << i;
          continue;
        }
        EXPECT_NE(role.far < i, role.nearest < i) << i << " has one on each side";
        for (const int key : keys)
          EXPECT_FALSE((key < i) == (role.far < i) && std::abs(key - i) < std::abs(role.far - i)) << i;
      }
    }
  }
}

}  // namespace
}  // namespace gloam::test::light_field_test
