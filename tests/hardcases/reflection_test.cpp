// Hard case 19: reflections where directions degenerate and probabilities come near nothing or are huge.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "gloam/planes.h"
#include "hard_case.h"

namespace gloam::test {
namespace {

constexpr double brightest = 1e4;

bool makes_reflections(const Technique& technique) {
  return std::find(technique.outputs.begin(), technique.outputs.end(), "reflection") != technique.outputs.end();
}

/// Normals towards the eye, across the view (n.v = 0), away from it, along the rows and columns of the image, and halfway
/// between: rays go back to the eye, along the screen and out of the image from its border.
glm::dvec3 normal_of(int kind, const glm::dvec3& to_eye) {
  const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), to_eye)), up = glm::cross(to_eye, right);
  const glm::dvec3 normals[] = {to_eye,
                                right,
                                up,
                                -right,
                                glm::normalize(to_eye + right),
                                glm::normalize(to_eye - up),
                                glm::normalize(1e-4 * to_eye + up),
                                glm::normalize(right - 0.5 * to_eye),
                                glm::dvec3(0, 0, 1)};
  return normals[kind % 9];
}

Frame frame_of(const Technique& technique, const Shot& shot) {
  Frame frame = shoot(shot, room());
  for (const char* plane : {"color", "roughness", "reflectance"}) plane_of(frame, plane);
  plan_for(technique, frame);  // invents what is lacking, and the second view
  const float roughnesses[] = {0, 1e-3f, 0.0299f, 0.03f, 0.031f, 0.1f, 0.5f, 1};
  for (View& view : frame.views) {
    for (int y = 0; y < shot.height; ++y) {
      for (int x = 0; x < shot.width; ++x) {
        if (is_background(view.planes.at("depth").channels[0].at(x, y))) continue;
        const glm::dvec3 normal =
            normal_of(x / 3 + y / 5, -glm::normalize(ray_through(shot, x + 0.5, y + 0.5).direction));
        for (size_t i = 0; i < 3; ++i) {
          view.planes.at("normal").channels[i].at(x, y) = float(normal[int(i)]);
          view.planes.at("reflectance").channels[i].at(x, y) = (x + y) % 7 == 0 ? 1 : 0.04f;
          // One pixel in a few hundred is a lamp: what is improbable and bright makes fireflies.
          view.planes.at("color").channels[i].at(x, y) = (x * 7 + y * 13) % 311 == 0 ? float(brightest) : 0.1f;
        }
        view.planes.at("roughness").channels[0].at(x, y) = roughnesses[(x / 2 + y) % 8];
      }
    }
  }
  return frame;
}

TEST_P(HardCase, Row19Reflections) {
  SKIP_WHERE_OPTED_OUT(19);
  if (!makes_reflections(technique())) GTEST_SKIP() << "makes no reflection";
  double worst = 0;
  for (const Shot& shot : usual_shots()) {
    Frame frame = frame_of(technique(), shot);
    for (const Settings& setting : {Settings{}, Settings{{"max_roughness", "1"}}, Settings{{"environment_r", "100"}},
                                    Settings{{"max_distance", "0"}}, Settings{{"bias", "0"}, {"thickness", "inf"}}}) {
      for (const RunOptions& way : two_ways()) {
        const Frame out = outputs_of(technique(), frame, setting, way);
        EXPECT_EQ(violation(out), "") << text_of(setting);
        for (const View& view : out.views) {
          const std::vector<Channel>& c = view.planes.at("reflection").channels;
          for (int y = 0; y < shot.height; ++y) {
            for (int x = 0; x < shot.width; ++x) {
              for (size_t i = 0; i < 3; ++i)
                worst = std::max({worst, c[i].at(x, y) / brightest - 1, double(-c[i].at(x, y))});
              worst = std::max({worst, c[3].at(x, y) - 1.0, double(-c[3].at(x, y))});
            }
          }
        }
      }
    }
  }
  report(19, "brighter than the brightest that could be reflected, or darker than nothing", worst, 1e-5);
}

}  // namespace
}  // namespace gloam::test
