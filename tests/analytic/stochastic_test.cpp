// Techniques over stochastic depth lie between the same over one depth and over all layers, on built-in scenes.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <tuple>

#include "gloam/planes.h"
#include "gloam/scene/capture.h"
#include "support/estimate.h"
#include "support/long.h"

namespace gloam::test::stochastic_test {
namespace {

/// From the first camera, with the first `layers` layers.
Frame captured(const std::string& name, const Settings& settings = {}, int layers = 32) {
  const gloam::Scene scene = load_scene(name, settings);
  CaptureOptions options{.width = 480, .height = 270, .planes = {"depth", "normal"}, .peel = layers};
  options.views = {{"", camera_for(scene.cameras.front(), options.width, options.height), {}}};
  return capture(Tracer(scene), options).frame;
}

Channel unfiltered(const Frame& frame, const std::string& technique, const Settings& settings, double radius) {
  const Frame result =
      raw_of(technique, frame, joined(settings, {{"radius", std::to_string(radius)}}), {.math = Math::precise});
  return result.views[0].planes.at("ao_raw").channels[0].clone();
}

double rmse(const Frame& frame, const Channel& a, const Channel& b) {
  const Channel& depth = frame.views[0].planes.at("depth").channels[0];
  double sum = 0, count = 0;
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      if (is_background(depth.at(x, y))) continue;
      const double off = double(a.at(x, y)) - b.at(x, y);
      sum += off * off;
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

const Settings directions_of_the_paper = {{"directions", "8"}, {"steps", "4"}};

class StochasticDepthOn : public testing::TestWithParam<std::string> {};

TEST_P(StochasticDepthOn, ClosesTheGapToAllLayers) {
  ONLY_IN_LONG_RUN();
  const double radius = load_scene(GetParam(), {}).ao_radius;
  const Frame frame = captured(GetParam());
  const auto image = [&](const std::string& technique, const Settings& settings) {
    return unfiltered(frame, technique, joined(directions_of_the_paper, settings), radius);
  };
  const Channel all_layers = image("dp-hbao", {});
  const double gap = rmse(frame, image("hbao", {}), all_layers);
  const auto closed_by = [&](const Settings& map, int samples, const char* compensation = "1") {
    const Settings settings = joined(map, {{"samples", std::to_string(samples)}, {"compensation", compensation}});
    return 1 - rmse(frame, image("sd-hbao", settings), all_layers) / gap;
  };
  const Settings paper = {{"surfaces", "all"}, {"subset", "stratified"}, {"alpha", "0.2"}},
                 hidden = {{"surfaces", "hidden"}, {"subset", "stratified"}, {"alpha", "0.25"}}, usual = {};
  std::map<int, double> by_paper, by_hidden, by_usual;
  for (const auto& [name, map, closed] :
       {std::tuple("the paper's map", &paper, &by_paper), std::tuple("hidden surfaces at random", &hidden, &by_hidden),
        std::tuple("the usual map", &usual, &by_usual)}) {
    std::printf("%s, %s: hbao to dp-hbao %.4f; closed", GetParam().c_str(), name, gap);
    double before = 0;
    for (const int samples : {1, 2, 4, 8, 16}) {
      const double share = (*closed)[samples] = closed_by(*map, samples);
      EXPECT_GT(share, before) << name << ", " << samples << " samples";
      before = share;
      std::printf(" %.0f %% (%d)", 100 * share, samples);
    }
    std::printf("\n");
  }
  const double compensated = closed_by(paper, 4, "1.3");
  std::printf("the paper's with compensation 1.3: %.0f %% (4)\n", 100 * compensated);
  EXPECT_GE(by_paper[4], 0.5);
  EXPECT_GE(by_paper[8], 0.65);
  EXPECT_GT(compensated, by_paper[4]);
  for (const int samples : {1, 2, 4, 8, 16}) EXPECT_GT(by_hidden[samples], by_paper[samples]) << samples;
  EXPECT_GE(by_hidden[4], 0.65);
  for (const int samples : {2, 4, 8, 16}) EXPECT_GT(by_usual[samples], by_hidden[samples]) << samples;
  EXPECT_GE(by_usual[4], 0.75);
  EXPECT_GE(by_usual[8], 0.85);
}

/// The effect of the paper's early-out, and of the default one: next to nothing.
TEST_P(StochasticDepthOn, EarlyOutCostsLittle) {
  ONLY_IN_LONG_RUN();
  const double radius = load_scene(GetParam(), {}).ao_radius;
  const Frame frame = captured(GetParam());
  for (const char* technique : {"ssao", "hbao", "hbao+", "gtao", "bitmask"}) {
    const std::string sd = std::string("sd-") + technique;
    const auto image = [&](const std::string& name, const Settings& settings) {
      return unfiltered(frame, name, settings, radius);
    };
    const Channel all_layers = image(std::string("dp-") + technique, {});
    const double gap = rmse(frame, image(technique, {}), all_layers);
    std::map<std::string, double> left;
    for (const char* early_out : {"off", "below", "on"})
      left[early_out] = rmse(frame, image(sd, {{"samples", "8"}, {"early_out", early_out}}), all_layers);
    std::printf("%s, %s: gap %.4f; left with early-out off %.4f, below %.4f, on %.4f\n", GetParam().c_str(), sd.c_str(),
                gap, left["off"], left["below"], left["on"]);
    EXPECT_LT(left["below"], gap) << sd;
    EXPECT_LT(left["on"], gap) << sd;
    EXPECT_LE(left["below"], left["off"] + 0.05 * gap) << sd;
  }
}

/// The mean of what sd-hbao takes, over that of all layers, on a pillar with sheets between it and the rib that it hides. The nearest
/// hidden surfaces are the sheets; of relevant ones the rib is among the first, however many sheets there are.
TEST(StochasticDepth, RelevantSurfacesAreFoundBehindAnyNumberOfSheets) {
  for (const int sheets : {0, 10}) {
    const Frame frame = captured("pillar", {{"sheets", std::to_string(sheets)}});
    const auto taken = [&](const std::string& technique, const Settings& settings) {
      const Channel ao = unfiltered(frame, technique, joined(directions_of_the_paper, settings), 0.5);
      const Channel& depth = frame.views[0].planes.at("depth").channels[0];
      double sum = 0;
      for (int y = 0; y < frame.height(); ++y) {
        for (int x = 0; x < frame.width(); ++x) sum += is_background(depth.at(x, y)) ? 0 : 1 - double(ao.at(x, y));
      }
      return sum;
    };
    const double all = taken("dp-hbao", {}), hidden = taken("sd-hbao", {{"surfaces", "hidden"}}) / all,
                 relevant = taken("sd-hbao", {{"surfaces", "relevant"}}) / all,
                 at_random = taken("sd-hbao", {{"surfaces", "relevant"}, {"subset", "stratified"}}) / all;
    std::printf("%d sheets: of all layers hidden %.3f, relevant %.3f, relevant at random %.3f\n", sheets, hidden,
                relevant, at_random);
    EXPECT_GT(relevant, 0.99) << sheets;
    EXPECT_GT(at_random, 0.7) << sheets;
    if (sheets == 0) {
      EXPECT_GT(hidden, 0.99);
    } else {
      EXPECT_LT(hidden, 0.05);
    }
  }
}

/// What is left out of a map of relevant surfaces cannot count: with room for all others not a bit changes. Without ssao, whose `range`
/// reaches behind the ball of its points.
TEST(StochasticDepth, SurfacesThatAreNotRelevantCannotCount) {
  const Frame frame = captured("corridor", {}, 16);
  const auto held = [&](const char* surfaces) {
    Frame copy = clone(frame);
    const Frame map = outputs_of(find_technique("stochastic-depth"), copy,
                                 {{"samples", "16"}, {"surfaces", surfaces}, {"radius", "0.5"}}, {});
    long long count = 0;
    for (const auto& [name, plane] : map.views[0].planes) {
      for (int y = 0; y < map.height(); ++y) {
        for (int x = 0; x < map.width(); ++x) count += !is_background(plane.channels[0].at(x, y));
      }
    }
    return count;
  };
  EXPECT_LT(held("relevant"), 0.97 * double(held("hidden"))) << "some are left out";
  for (const char* technique : {"hbao", "hbao+", "gtao", "bitmask", "alchemy", "sao", "evidence"}) {
    const auto image = [&](const char* surfaces) {
      return unfiltered(frame, std::string("sd-") + technique,
                        {{"samples", "16"}, {"early_out", "off"}, {"surfaces", surfaces}}, 0.5);
    };
    EXPECT_EQ(rmse(frame, image("relevant"), image("hidden")), 0) << technique;
  }
}

/// Only background in the map: the same bits as without a map.
TEST(StochasticDepth, EmptySamplesChangeNothing) {
  Frame frame = shoot(perspective(96, 64), room());
  for (const char* technique : {"ssao", "hbao", "hbao+", "gtao", "bitmask"}) {
    Frame with_map = clone(frame);
    for (int i = 0; i < 4; ++i) plane_of(with_map, layer_name("stochastic", i));
    const Channel without = unfiltered(frame, technique, {}, 0.5),
                  with = unfiltered(with_map, std::string("sd-") + technique, {}, 0.5);
    EXPECT_EQ(rmse(frame, without, with), 0) << technique;
  }
}

// --- What is read behind the depth, and how it counts

/// A technique with an estimate over stochastic depth, and settings with which a depth behind an occluder within reach counts.
struct Estimator {
  std::string name;
  Settings settings;
  /// Heights above the wall, scene units, of an occluder within reach, and of one out of reach.
  double near, far;
};

/// The radius is .5. The cap on the reach leaves an occluder at the height `near` within the radius of every point that samples it. The
/// balls of ssao weigh by depth alone: in full up to `range`, .1, not at all from .2 on.
const std::vector<Estimator> estimators = {{"ssao", {{"range", "0.2"}}, 0.17, 0.45},
                                           {"hbao", {{"max_reach", "0.02"}}, 0.45, 0.9},
                                           {"hbao+", {{"max_reach", "0.02"}}, 0.45, 0.9},
                                           {"gtao", {{"max_reach", "0.02"}, {"fade", "1"}}, 0.45, 0.9},
                                           {"alchemy", {{"max_reach", "0.02"}}, 0.45, 0.9},
                                           {"sao", {{"max_reach", "0.02"}}, 0.45, 0.9},
                                           {"bitmask", {{"max_reach", "0.02"}, {"thickness", "0.1"}}, 0.45, 0.9}};

/// The settings without what caps the reach.
Settings range_of(const Estimator& e) { return e.name == "ssao" ? e.settings : Settings{}; }

constexpr double wall = 4, hidden_height = 0.15;

/// A wall that faces the eye, with blocks before it at a height, and in a stochastic depth map a surface behind each block. Seen without
/// perspective, which would move the blocks sideways, out of reach.
Frame blocks_before_a_wall(double height) {
  Frame frame = shoot(orthographic(96, 64, 4.6), tilted_plane(wall, 0, 0));
  Channel& depth = frame.views[0].planes.at("depth").channels[0];
  Channel& hidden = plane_of(frame, layer_name("stochastic", 0)).channels[0];
  for (int i = 1; i < 4; ++i) plane_of(frame, layer_name("stochastic", i));
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      const bool is_block = x % 8 < 2 && y % 8 < 2;
      depth.at(x, y) = float(is_block ? wall - height : wall);
      hidden.at(x, y) = is_block ? float(wall - hidden_height) : INFINITY;
    }
  }
  return frame;
}

double largest_difference(const Channel& a, const Channel& b) {
  double most = 0;
  for (int y = 0; y < a.layout().height; ++y) {
    for (int x = 0; x < a.layout().width; ++x) most = std::max(most, std::abs(double(a.at(x, y)) - b.at(x, y)));
  }
  return most;
}

double mean_taken(const Channel& ao) {
  double sum = 0;
  for (int y = 0; y < ao.layout().height; ++y) {
    for (int x = 0; x < ao.layout().width; ++x) sum += 1 - double(ao.at(x, y));
  }
  return sum / (double(ao.layout().width) * ao.layout().height);
}

/// `early_out=on` is the paper's section 3.3: what is within the radius is not looked behind, what rises before it is. `below` looks
/// behind both.
TEST(StochasticDepth, EarlyOutOnLooksBehindOnlyWhatIsOutOfReach) {
  for (const Estimator& e : estimators) {
    SCOPED_TRACE(e.name);
    const auto image = [&](const Frame& frame, const char* early_out) {
      return unfiltered(frame, "sd-" + e.name, joined(e.settings, {{"early_out", early_out}}), 0.5);
    };
    const Frame within = blocks_before_a_wall(e.near);
    const Channel one_layer = unfiltered(within, e.name, e.settings, 0.5), on = image(within, "on"),
                  below = image(within, "below"), off = image(within, "off");
    EXPECT_EQ(largest_difference(on, one_layer), 0) << "what is behind an occluder within the radius is not read";
    EXPECT_EQ(largest_difference(below, off), 0);
    EXPECT_GT(mean_taken(below), mean_taken(one_layer) + 1e-3) << "what is behind it would count";
    const Frame beyond = blocks_before_a_wall(e.far);
    EXPECT_EQ(largest_difference(image(beyond, "on"), image(beyond, "off")), 0);
    EXPECT_GT(mean_taken(image(beyond, "on")), mean_taken(unfiltered(beyond, e.name, e.settings, 0.5)) + 1e-3)
        << "what is behind one out of reach is read";
  }
}

/// Depths that have nothing to do with one another, seen or hidden, around points of a surface whose normal has an angle with this
/// cosine to the line to the eye.
Frame strewn(double cosine) {
  Frame frame = shoot(perspective(96, 64), tilted_plane(wall, 0, 0));
  const Shot shot = perspective(96, 64);
  View& view = frame.views[0];
  for (int i = 0; i < 4; ++i) plane_of(frame, layer_name("stochastic", i));
  uint32_t state = 1;
  const auto random = [&] { return (state = state * 1664525u + 1013904223u) / 4294967296.0; };
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      const double first = wall - 0.4 + 0.8 * random();
      view.planes.at("depth").channels[0].at(x, y) = float(first);
      for (int i = 0; i < 4; ++i)
        plane_of(frame, layer_name("stochastic", i)).channels[0].at(x, y) = float(first + 0.4 * random());
      const glm::dvec3 to_eye = -glm::normalize(point_at(ray_through(shot, x + 0.5, y + 0.5), 1) - glm::dvec3(0));
      const double turn = 6.283 * random();
      const glm::dvec3 across = glm::normalize(glm::cross(to_eye, glm::dvec3(std::cos(turn), std::sin(turn), 0.1)));
      const glm::dvec3 normal = cosine * to_eye + std::sqrt(1 - cosine * cosine) * across;
      for (int c = 0; c < 3; ++c) view.planes.at("normal").channels[size_t(c)].at(x, y) = float(normal[c]);
    }
  }
  return frame;
}

/// `early_out=below` leaves out only what cannot count, however steep the surface is seen.
TEST(StochasticDepth, EarlyOutBelowLosesNothing) {
  for (const double cosine : {1.0, 0.5, 0.1, 0.01, -0.2}) {
    const Frame frame = strewn(cosine);
    for (const Estimator& e : estimators) {
      const Settings range = range_of(e);
      const auto image = [&](const char* early_out) {
        return unfiltered(frame, "sd-" + e.name, joined(range, {{"early_out", early_out}}), 0.5);
      };
      const Channel off = image("off");
      EXPECT_EQ(largest_difference(image("below"), off), 0) << e.name << ", cosine " << cosine;
      // Where the normal is turned away, all is closed.
      if (cosine > 0) {
        EXPECT_GT(mean_taken(off), mean_taken(unfiltered(frame, e.name, range, 0.5)) + 1e-3)
            << e.name << ", " << cosine;
      }
    }
  }
}

/// Of sd-evidence too, whose coefficients are others than those of evidence, so that it stands beside no plain technique.
TEST(StochasticDepth, EarlyOutBelowLosesNothingOfEvidence) {
  for (const double cosine : {1.0, 0.1, 0.01, -0.2}) {
    const Frame frame = strewn(cosine);
    const auto image = [&](const char* early_out) {
      return unfiltered(frame, "sd-evidence", {{"early_out", early_out}}, 0.5);
    };
    const Channel off = image("off");
    EXPECT_EQ(largest_difference(image("below"), off), 0) << cosine;
    if (cosine > 0) {
      EXPECT_GT(largest_difference(image("on"), off), 1e-3) << cosine;
    }
  }
}

// --- Compensation

TEST(StochasticDepth, CompensationOfZeroIsThePlainTechnique) {
  const Frame frame = strewn(0.7);
  for (const Estimator& e : estimators) {
    for (const char* early_out : {"off", "below", "on"}) {
      const Channel none = unfiltered(frame, "sd-" + e.name,
                                      joined(range_of(e), {{"compensation", "0"}, {"early_out", early_out}}), 0.5);
      EXPECT_EQ(largest_difference(none, unfiltered(frame, e.name, range_of(e), 0.5)), 0)
          << e.name << ", " << early_out;
    }
  }
}

/// The factor is on what the hidden depths add, pixel by pixel where nothing is cut off at 0. Where hbao takes a part of a rise, the
/// horizon is lower for the samples that follow, so that below 1 there is no proportion.
TEST(StochasticDepth, CompensationMultipliesWhatHiddenDepthsAdd) {
  for (const Estimator& e : estimators) {
    SCOPED_TRACE(e.name);
    const Frame frame = blocks_before_a_wall(e.far);
    std::map<std::string, Channel> ao;
    for (const char* factor : {"0", "0.5", "1", "2", "3"})
      ao.emplace(factor, unfiltered(frame, "sd-" + e.name, joined(e.settings, {{"compensation", factor}}), 0.5));
    double off_below_1 = 0, off_above_1 = 0;
    int pixels = 0;
    for (int y = 0; y < frame.height(); ++y) {
      for (int x = 0; x < frame.width(); ++x) {
        const auto at = [&](const char* factor) { return double(ao.at(factor).at(x, y)); };
        if (at("3") < 0.01 || at("0") - at("1") < 0.01) continue;
        ++pixels;
        off_below_1 = std::max(off_below_1, std::abs(at("0") + at("1") - 2 * at("0.5")));
        off_above_1 = std::max(off_above_1, std::abs(at("1") + at("3") - 2 * at("2")));
        EXPECT_GT(at("1") - at("2"), 0.005) << x << ", " << y;
      }
    }
    EXPECT_GT(pixels, 100);
    EXPECT_LT(off_above_1, 1e-5);
    if (e.name != "hbao") {
      EXPECT_LT(off_below_1, 1e-5);
    }
  }
}

/// The hidden depths stand before the highest visible ones along each direction: a horizon that they raised by more than they take
/// would leave nothing for what is seen behind them.
TEST(StochasticDepth, LessCompensationIsNeverBrighterThanNone) {
  const Frame frame = strewn(0.7);
  for (const Estimator& e : estimators) {
    double before = mean_taken(unfiltered(frame, e.name, range_of(e), 0.5));
    for (const char* factor : {"0.1", "0.25", "0.5", "0.75", "1", "1.5"}) {
      const double taken =
          mean_taken(unfiltered(frame, "sd-" + e.name, joined(range_of(e), {{"compensation", factor}}), 0.5));
      EXPECT_GT(taken, before) << e.name << ", " << factor;
      before = taken;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, StochasticDepthOn, testing::Values("colonnade", "corridor"));

}  // namespace
}  // namespace gloam::test::stochastic_test
