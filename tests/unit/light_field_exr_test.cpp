// Images of a light-field display's modules, written and read again.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>

#include "gloam/display_json.h"
#include "gloam/exr.h"
#include "gloam/projection.h"
#include "support/light_field.h"
#include "unit/message_of.h"

namespace gloam::test::light_field_exr_test {
namespace {

namespace fs = std::filesystem;
using glm::dvec2;
using glm::dvec3;

LightFieldDisplay four_modules() {
  LightFieldDisplay display = flat_display();
  display.screen_radius = 5;
  display.modules = {{{-0.6, 0, -5}, 3, 0}, {{-0.2, 0.1, -6}}, {{0.2, 0, -6}, 0, 2}, {{0.6, 0, -5}, -3, 0}};
  display.world = WorldToPhysical{{1.1, -0.1, 0.2, 0.2, 0.9, 0.1, 0.3, 0.25, 1.3}, {1e7 / 3, -2e6, 5.1}};
  return display;
}

class DisplayFile : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "gloam-display-XXXXXX").string();
    folder = mkdtemp(pattern.data());
  }
  void TearDown() override { fs::remove_all(folder); }

  /// A wall seen through all modules, or some of them.
  static Frame frame_of(const LightFieldDisplay& display, const std::vector<size_t>& modules = {0, 1, 2, 3}) {
    Frame frame;
    for (const size_t i : modules) {
      Frame one = shoot(shot_of_module(display, 24, 18, i), tilted_plane(3, 0.2, 0));
      frame.display = one.display;
      frame.window = one.window;
      one.views[0].name = module_names(display)[i];
      frame.views.push_back(std::move(one.views[0]));
    }
    return frame;
  }

  fs::path write(const Frame& frame) const {
    write_frame(folder / "frame.exr", frame);
    return folder / "frame.exr";
  }

  fs::path write_text(const std::string& name, const std::string& text) const {
    std::ofstream(folder / name) << text;
    return folder / name;
  }

  fs::path folder;
};

void expect_same(const Camera& a, const Camera& b) {
  ASSERT_TRUE(a.slits && b.slits && a.pose && b.pose);
  EXPECT_NEAR(a.fx, b.fx, 1e-9);
  EXPECT_NEAR(a.cy, b.cy, 1e-9);
  EXPECT_EQ(a.slits->module, b.slits->module);
  EXPECT_LT(glm::length(a.pose->position - b.pose->position), 1e-8);
  for (const dvec2 pixel : {dvec2(0.5, 0.5), dvec2(12.5, 9.5), dvec2(23.5, 2.5)}) {
    const auto from = view_ray(a, pixel), to = view_ray(b, pixel);
    ASSERT_EQ(from.has_value(), to.has_value());
    if (!from) continue;
    EXPECT_LT(glm::length(from->at(3) - to->at(3)), 1e-9);
  }
}

TEST_F(DisplayFile, EveryModuleKeepsItsCamera) {
  const Frame before = frame_of(four_modules());
  FrameFile file(write(before), {});
  ASSERT_EQ(file.views(), (std::vector<std::string>{"module00", "module01", "module02", "module03"}));
  const Frame after = file.read({"depth", "normal"});
  EXPECT_TRUE(after.assumed.empty()) << after.assumed.front();
  for (size_t i = 0; i < 4; ++i) {
    SCOPED_TRACE(after.views[i].name);
    expect_same(*before.views[i].camera, *after.views[i].camera);
    EXPECT_EQ(after.views[i].camera->source, "header");
    EXPECT_EQ(after.views[i].planes.at("depth").channels[0].at(12, 9),
              before.views[i].planes.at("depth").channels[0].at(12, 9));
  }
}

TEST_F(DisplayFile, WrittenAgainItIsTheSame) {
  write_frame(folder / "again.exr", FrameFile(write(frame_of(four_modules())), {}).read({"depth"}));
  const FrameFile again(folder / "again.exr", {});
  expect_same(*again.camera("module02"), *frame_of(four_modules()).views[2].camera);
}

TEST_F(DisplayFile, SomeModulesAreNotTheFirstOnes) {
  const LightFieldDisplay display = four_modules();
  for (const std::vector<size_t>& some : {std::vector<size_t>{1, 3}, {3}, {2, 0}}) {
    const Frame before = frame_of(display, some);
    FrameFile file(write(before), {});
    ASSERT_EQ(file.views().size(), some.size());
    for (size_t i = 0; i < some.size(); ++i) {
      EXPECT_EQ(file.views()[i], module_names(display)[some[i]]);
      expect_same(*before.views[i].camera, *file.camera(file.views()[i]));
    }
  }
}

TEST_F(DisplayFile, ViewsAreChosenByName) {
  const Frame before = frame_of(four_modules());
  const fs::path path = write(before);
  const FrameFile file(path, {.views = {"module03", "module01"}});
  ASSERT_EQ(file.views(), (std::vector<std::string>{"module03", "module01"}));
  expect_same(*before.views[3].camera, *file.camera("module03"));
  expect_same(*before.views[1].camera, *file.camera("module01"));
}

/// Positions are relative to the observers' position, which the header holds in double.
TEST_F(DisplayFile, PositionsStayWhereTheyWere) {
  LightFieldDisplay display = flat_display();
  display.modules.push_back({{-0.5, 0, -6}});
  const Frame before = captured(display, 40, 32);
  const Frame after = FrameFile(write(before), {}).read({"depth", "position"});
  for (size_t i = 0; i < 2; ++i) {
    const auto world = [i](const Frame& frame) {
      const std::vector<Channel>& p = frame.views[i].planes.at("position").channels;
      return frame.views[i].origin + dvec3(p[0].at(20, 16), p[1].at(20, 16), p[2].at(20, 16));
    };
    EXPECT_LT(glm::length(world(before) - world(after)), 1e-6);
  }
}

TEST_F(DisplayFile, ADamagedAttributeIsNamed) {
  const auto message = [&](const std::string& text) {
    Frame frame = frame_of(four_modules(), {1, 2});
    for (View& view : frame.views) {
      TwoSlits slits = *view.camera->slits;
      slits.display = std::make_shared<const std::string>(text);
      view.camera->slits = std::make_shared<const TwoSlits>(slits);
    }
    const fs::path path = write(frame);
    const std::string said = message_of([&] { FrameFile(path, {}); });
    EXPECT_EQ(said.rfind(path.string() + ": ", 0), 0u) << said;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    return said;
  };
  EXPECT_NE(message("{\"observer\": ").find("attribute gloamDisplay: not readable as JSON"), std::string::npos);
  EXPECT_NE(message("{\"observer\": 3}").find("attribute gloamDisplay: observer is of type number"), std::string::npos);
  LightFieldDisplay display = four_modules();
  display.world.reset();
  EXPECT_NE(message(text_of(display)).find("does not say which part of the world"), std::string::npos);
  display = four_modules();
  display.modules[1].yaw = 80;
  EXPECT_NE(message(text_of(display)).find("module01 cannot light the whole screen"), std::string::npos);
}

// --- A display as a camera file

TEST_F(DisplayFile, ACameraFileMayBeADisplay) {
  const LightFieldDisplay display = four_modules();
  const Frame before = frame_of(display);
  Frame without = frame_of(display, {0, 2});
  for (View& view : without.views) view.camera.reset();
  const fs::path path = write(without), json = write_text("display.json", text_of(display));
  const FrameFile file(path, {.camera_file = json});
  expect_same(*before.views[0].camera, *file.camera("module00"));
  expect_same(*before.views[2].camera, *file.camera("module02"));
  EXPECT_FALSE(FrameFile(path, {}).camera("module00"));
}

TEST_F(DisplayFile, ADisplayThatDoesNotFitIsToldFromADisplayWithAFault) {
  const LightFieldDisplay display = four_modules();
  Frame without = frame_of(display);
  for (View& view : without.views) view.camera.reset();
  const fs::path path = write(without);
  const auto message = [&](const std::string& text) {
    const fs::path json = write_text("display.json", text);
    const std::string said = message_of([&] { FrameFile(path, {.camera_file = json}); });
    EXPECT_NE(said.find("display.json"), std::string::npos) << said;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    return said;
  };
  LightFieldDisplay other = display;
  other.modules.resize(3);
  const std::string misfit = message(text_of(other));
  EXPECT_NE(misfit.find("module03"), std::string::npos) << misfit;
  other = display;
  other.world.reset();
  const std::string nowhere = message(text_of(other));
  EXPECT_NE(nowhere.find("does not say which part of the world"), std::string::npos) << nowhere;
  std::string text = text_of(display);
  text.replace(text.find("\"distance\":4.0"), 14, "\"distance\":NaN");
  const std::string nan = message(text);
  EXPECT_NE(nan.find("observer.distance is not finite"), std::string::npos) << nan;
}

}  // namespace
}  // namespace gloam::test::light_field_exr_test
