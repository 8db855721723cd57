// Specular occlusion against closed forms: the published formula, caps of the sphere, a lobe against a wall, and an open plane.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include "support/integral.h"

namespace gloam::test::specular_occlusion_test {
namespace {

using glm::dvec3;

void fill(Frame& frame, const std::string& plane, double value) {
  Channel& channel = plane_of(frame, plane).channels[0];
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) channel.at(x, y) = float(value);
  }
}

Frame run_method(const std::string& method, const Frame& frame) {
  const Settings settings = {{"method", method}, {"half_width", "0"}};
  return run(plan_of("specular-occlusion", frame, settings, {"specular_occlusion"}), frame, device(),
             {.math = Math::precise})
      .frame;
}

TEST(SpecularOcclusion, FromAoIsTheFormulaOfThePaper) {
  constexpr int size = 33;
  for (const double tilt : {0.0, 0.8, 1.4}) {
    Frame frame = shoot(orthographic(size, size, 1), tilted_plane(3, tilt, 0.4));
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        plane_of(frame, "ao").channels[0].at(x, y) = float(x) / (size - 1);
        plane_of(frame, "roughness").channels[0].at(x, y) = float(y) / (size - 1);
      }
    }
    const Frame out = run_method("lagarde", frame);
    double worst = 0;
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        if (is_background(value_at(frame, "depth", x, y))) continue;
        const double ao = double(x) / (size - 1), roughness = double(y) / (size - 1);
        const double power = std::pow(std::cos(tilt) + ao, std::exp2(-16 * roughness * roughness - 1));
        const double expected = std::clamp(power - 1 + ao, 0.0, 1.0);
        worst = std::max(worst, std::abs(value_at(out, "specular_occlusion", x, y) - expected));
      }
    }
    std::printf("tilt %.1f: within %.2g of the formula\n", tilt, worst);
    EXPECT_LE(worst, 1e-6);
  }
}

/// Of the part of a cap about `lobe` above the surface z = 0, the share within a cap about `open`; by counting directions.
double counted_share(const dvec3& lobe, double lobe_cosine, const dvec3& open, double open_cosine) {
  const dvec3 side = glm::normalize(glm::cross(lobe, dvec3(0.3, 0.9, 0.2))), other = glm::cross(lobe, side);
  int all = 0, both = 0;
  for (int i = 0; i < 400; ++i) {
    const double z = 1 - (1 - lobe_cosine) * (i + 0.5) / 400, r = std::sqrt(1 - z * z);
    for (int k = 0; k < 400; ++k) {
      const double turn = 2 * std::numbers::pi * (k + 0.5) / 400;
      const dvec3 d = z * lobe + r * std::cos(turn) * side + r * std::sin(turn) * other;
      if (d.z <= 0) continue;
      ++all;
      both += glm::dot(d, open) >= open_cosine;
    }
  }
  return double(both) / all;
}

TEST(SpecularOcclusion, FromConesIsWhatCapsHaveInCommon) {
  double worst = 0;
  for (const double tilt : {0.0, 0.7, 1.3}) {
    for (const double roughness : {0.3, 0.6, 1.0}) {
      for (const double lean : {0.0, 0.5}) {
        for (const double cone : {0.0, 0.5, 0.9}) {
          Frame frame = shoot(orthographic(16, 2, 1), tilted_plane(3, tilt, 0));
          fill(frame, "roughness", roughness);
          fill(frame, "cone", cone);
          // The plane is tilted towards +x by `tilt`, so that is the normal's angle from the eye in the plane of x and z.
          const dvec3 bent(std::sin(tilt - lean), 0, std::cos(tilt - lean));
          for (size_t i = 0; i < 3; ++i) {
            Channel& channel = plane_of(frame, "bent_normal").channels[i];
            for (int y = 0; y < 2; ++y) {
              for (int x = 0; x < 16; ++x) channel.at(x, y) = float(bent[int(i)]);
            }
          }
          const double alpha = roughness * roughness, lobe = (1 - alpha * alpha) / (1 + alpha * alpha);
          // In the surface's frame: the mirror direction leans by `tilt` from the normal, the bent normal by `lean` the other way.
          const double expected =
              counted_share({std::sin(tilt), 0, std::cos(tilt)}, lobe, {-std::sin(lean), 0, std::cos(lean)}, cone);
          const double found = value_at(run_method("cone", frame), "specular_occlusion", 8, 1);
          worst = std::max(worst, std::abs(found - expected));
        }
      }
    }
  }
  std::printf("caps: within %.2g of counted directions\n", worst);
  EXPECT_LE(worst, 5e-3);
}

// Bent normals of an open surface differ from its normal in the last bits, which narrow lobes seen edge-on magnify.
TEST(SpecularOcclusion, OfAConeThatIsTheHemisphereIsOpen) {
  for (const double tilt : {0.0, 1.0, 1.5, 1.55, 1.57}) {
    Frame frame = shoot(orthographic(16, 2, 1), tilted_plane(3, tilt, 0));
    fill(frame, "roughness", 0.05);
    fill(frame, "cone", 1.2e-7);
    for (size_t i = 0; i < 3; ++i) {
      Channel &bent = plane_of(frame, "bent_normal").channels[i], &normal = plane_of(frame, "normal").channels[i];
      for (int y = 0; y < 2; ++y) {
        for (int x = 0; x < 16; ++x) bent.at(x, y) = normal.at(x, y) + (i == 0 ? 2.4e-7f : 0);
      }
    }
    const Frame out = run_method("cone", frame);
    for (int x = 0; x < 16; ++x) {
      if (is_background(value_at(frame, "depth", x, 1))) continue;
      EXPECT_EQ(value_at(out, "specular_occlusion", x, 1), 1) << tilt << " " << x;
    }
  }
}

/// The open share of a GGX lobe with height-correlated masking: microfacets are drawn in proportion to D (n.h), each direction
/// weighted by BRDF * cosine over its density.
double open_share(const IntegralCase& test, const Receiver& here, double roughness, double reach) {
  const dvec3 n = here.surface.normal, v = glm::normalize(-here.ray.direction);
  const dvec3 side = glm::normalize(glm::cross(n, std::abs(n.x) < 0.7 ? dvec3(1, 0, 0) : dvec3(0, 1, 0)));
  const dvec3 other = glm::cross(n, side);
  const double alpha = roughness * roughness;
  const auto hidden = [&](double cosine) {
    return 0.5 * (std::sqrt(1 + alpha * alpha * (1 / (cosine * cosine) - 1)) - 1);
  };
  double all = 0, open = 0;
  for (int i = 0; i < 20000; ++i) {
    const dvec3 u = even_point(i);
    const double square = alpha * alpha * u.x / (1 - u.x), z = 1 / std::sqrt(1 + square), r = std::sqrt(1 - z * z);
    const double turn = 2 * std::numbers::pi * u.y;
    const dvec3 h = z * n + r * std::cos(turn) * side + r * std::sin(turn) * other;
    const double to_facet = glm::dot(v, h);
    const dvec3 l = 2 * to_facet * h - v;
    const double light = glm::dot(n, l);
    if (to_facet <= 0 || light <= 0) continue;
    const double weight = to_facet / (z * (1 + hidden(glm::dot(n, v)) + hidden(light)));
    const auto hit = test.scene({here.point + 1e-6 * n, l});
    all += weight;
    if (!hit || hit->depth > reach) open += weight;
  }
  return open / all;
}

struct SlicesCase {
  std::string technique, scene;
  double bound;  ///< on the RMSE to the integral: what was measured, and a quarter more
};

class LobeInSlices : public testing::TestWithParam<SlicesCase> {};

INSTANTIATE_TEST_SUITE_P(All, LobeInSlices,
                         testing::Values(SlicesCase{"gtao", "corner, perspective", 0.034},
                                         SlicesCase{"gtao", "corner, orthographic", 0.0155},
                                         SlicesCase{"bitmask", "corner, perspective", 0.114}),
                         [](const auto& info) { return identifier(info.param.technique + info.param.scene); });

TEST_P(LobeInSlices, IsTheIntegralOverTheLobe) {
  constexpr double radius = 0.8;
  const IntegralCase test = integral_case(GetParam().scene, 6);
  for (const double roughness : {0.2, 1.0}) {
    Frame frame = shoot(test.shot, test.scene);
    fill(frame, "roughness", roughness);
    const Settings settings = {{"radius", "0.8"}, {"max_reach", "1"}, {"directions", "32"},
                               {"steps", "64"},   {"jitter", "off"},  {"bias", "0"}};
    const Plan plan = plan_of(GetParam().technique, frame, settings, {"specular_occlusion_raw"});
    const Frame out = run(plan, frame, device()).frame;
    double squares = 0, worst = 0, nearest_to_half = 1;
    for (const glm::ivec2 pixel : test.pixels) {
      const double expected = open_share(test, receiver_at(test, pixel), roughness, radius);
      const double off = value_at(out, "specular_occlusion_raw", pixel.x, pixel.y) - expected;
      squares += off * off;
      worst = std::max(worst, std::abs(off));
      nearest_to_half = std::min(nearest_to_half, std::abs(expected - 0.5));
    }
    const double rmse = std::sqrt(squares / double(test.pixels.size()));
    std::printf("%s, %s, roughness %.1f: RMSE %.4f, worst %.4f\n", GetParam().technique.c_str(), test.name.c_str(),
                roughness, rmse, worst);
    EXPECT_LT(nearest_to_half, 0.45) << "nothing is partly closed";
    EXPECT_LE(rmse, GetParam().bound);
  }
}

/// What a plane reflects of a white environment, as no ray meets anything; with this openness, if any.
Frame reflected(double roughness, std::optional<double> open) {
  Frame frame = shoot(perspective(48, 36), tilted_plane(3, 0.4, 0.6));
  fill(frame, "roughness", roughness);
  for (const char* plane : {"color", "reflectance"}) invent_plane(frame, plane);
  if (open) fill(frame, "specular_occlusion", *open);
  const Settings white = {{"environment_r", "1"}, {"environment_g", "1"}, {"environment_b", "1"}};
  return run(plan_of("sssr", frame, white, {"reflection"}), frame, device()).frame;
}

TEST(SpecularOcclusion, IsAFactorOnTheEnvironmentThatReflectionsDoNotFind) {
  for (const double roughness : {0.0, 0.5, 0.9}) {  // a mirror, rays, and too rough for rays
    const Frame without = reflected(roughness, {}), half = reflected(roughness, 0.5);
    EXPECT_TRUE(same_bits(reflected(roughness, 1), without)) << roughness;
    double brightest = 0;
    for (int y = 0; y < 36; ++y) {
      for (int x = 0; x < 48; ++x) {
        EXPECT_NEAR(value_at(half, "reflection", x, y), 0.5 * value_at(without, "reflection", x, y), 1e-6);
        brightest = std::max(brightest, double(value_at(without, "reflection", x, y)));
      }
    }
    EXPECT_GT(brightest, 0.1) << roughness;
  }
}

TEST(SpecularOcclusion, OfAPlaneIsOpen) {
  for (const std::string method : {"sectors", "cone", "lagarde"}) {
    for (const double tilt : {0.0, 0.7, 1.4}) {
      Frame frame = shoot(perspective(80, 60), tilted_plane(3, tilt, 0.4));
      invent_plane(frame, "roughness");
      const Frame out =
          run(plan_of("specular-occlusion", frame, {{"method", method}}, {"specular_occlusion"}), frame, device())
              .frame;
      double worst = 0;
      for (int y = 0; y < 60; ++y) {
        for (int x = 0; x < 80; ++x) worst = std::max(worst, 1.0 - value_at(out, "specular_occlusion", x, y));
      }
      std::printf("%s, tilt %.1f: %.2g from open\n", method.c_str(), tilt, worst);
      // An edge of the cone at the horizon magnifies the last bits of the bent normal: 2.1e-5, and a quarter more.
      EXPECT_LE(worst, method == "cone" ? 2.7e-5 : 1e-6) << method << ", " << tilt;
    }
  }
}

}  // namespace
}  // namespace gloam::test::specular_occlusion_test
