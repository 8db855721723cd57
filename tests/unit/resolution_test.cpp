// Estimating at a lower resolution: its plan, the pixels that are computed, and the upsampling.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "gloam/compute.h"
#include "gloam/error.h"
#include "gloam/normalise.h"
#include "gloam/plan.h"
#include "gloam/planes.h"
#include "gloam/run.h"
#include "plan/resample.h"
#include "support/long.h"
#include "support/stress.h"
#include "support/techniques.h"
#include "technique/kernel_sources.h"
#include "unit/message_of.h"

namespace gloam::test::resolution_test {
namespace {

using Names = std::vector<std::string>;

// --- The plan

Plan plan_of(const PlanRequest& request, const Names& available = {"depth", "normal"}) {
  return make_plan(request, available, "frame.exr has only R, G, B");
}

Names labels_of(const Plan& plan) {
  Names labels;
  for (const PlannedPass& pass : plan.passes) labels.push_back(pass.label());
  return labels;
}

TEST(Resolution, APlanEstimatesAndFiltersBetweenTwoResamplings) {
  for (const int resolution : {2, 4}) {
    const Plan plan = plan_of({.outputs = {"hbao+"}, .resolution = resolution});
    EXPECT_EQ(labels_of(plan), (Names{"resample/subsample depth", "resample/subsample normal", "hbao+/estimate",
                                      "bilateral/separable", "resample/upsample ao", "resample/upsample ao_raw"}));
    std::vector<int> scales;
    for (const PlannedPass& pass : plan.passes) scales.push_back(pass.pass.scale);
    EXPECT_EQ(scales, (std::vector{resolution, resolution, resolution, resolution, 1, 1}));
    const std::map<std::string, int> planes = plane_scales(plan);
    for (const char* plane : {"depth", "normal", "ao", "ao_raw"}) {
      EXPECT_EQ(planes.at(plane), 1) << plane;
      EXPECT_EQ(planes.at(fmt::format("{}@{}", plane, resolution)), resolution) << plane;
    }
  }
}

TEST(Resolution, WhatIsGivenIsNotComputedAgain) {
  const Plan plan = plan_of({.outputs = {"hbao+"}, .only_filtered = true, .resolution = 4});
  const std::optional<Upsampling> left = upsampling_of(plan);
  ASSERT_TRUE(left);
  EXPECT_EQ(left->given, (Names{"ao@4"}));
  EXPECT_EQ(labels_of(left->plan),
            (Names{"resample/subsample depth", "resample/subsample normal", "resample/upsample ao"}));
  EXPECT_EQ(left->plan.inputs, (Names{"depth", "normal", "ao@4"}));
  EXPECT_EQ(plane_scales(left->plan).at("ao@4"), 4);
  EXPECT_FALSE(upsampling_of(plan_of({.outputs = {"hbao+"}})));
}

TEST(Resolution, WhatIsGivenHasTheSizeOfItsResolution) {
  constexpr int width = 37, height = 21;
  Frame frame = frame_from({.width = width,
                            .height = height,
                            .camera = camera_with_fov(width, height, 60),
                            .planes = {{"depth", std::vector<float>(width * height, 4.0f)}}});
  const Plan plan = make_plan({.outputs = {"hbao+"}, .only_filtered = true, .resolution = 4}, {"depth"}, "");
  const Upsampling left = *upsampling_of(plan);
  Device device;
  for (const int smaller : {0, 1}) {
    Plane given{"ao@4", {}};
    given.channels.emplace_back(Layout(10 - smaller, 6), 0.25f);
    frame.views[0].planes["ao@4"] = std::move(given);
    if (smaller) {
      EXPECT_NE(message_of([&] { run(left.plan, frame, device); }).find("'ao@4' is not the size"), std::string::npos);
      continue;
    }
    const RunResult result = run(left.plan, frame, device);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        ASSERT_FLOAT_EQ(result.frame.views[0].find("ao")->channels[0].at(x, y), 0.25f) << x << " " << y;
  }
}

/// Planes of every kind: of one component, directions, colours.
TEST(Resolution, WhatComesBackHasAKernel) {
  const std::string source = flatten(resampling().source);
  const Names available = all_plane_names(4);
  std::set<std::string> kernels;
  for (const Technique& technique : registry()) {
    for (const int resolution : {2, 4}) {
      Plan plan;
      try {
        plan = plan_of({.outputs = {technique.name}, .with = technique.extras, .resolution = resolution}, available);
      } catch (const UsageError&) {
        continue;  // states why it works only at full resolution
      }
      for (const PlannedPass& planned : plan.passes) {
        if (planned.technique == &resampling()) kernels.insert(planned.pass.kernel);
      }
    }
  }
  EXPECT_TRUE(kernels.count("joint_upsample_color")) << "dielectric's";
  for (const std::string& kernel : kernels)
    EXPECT_NE(source.find("kernel void " + kernel + "("), std::string::npos) << kernel;
}

TEST(Resolution, OnlyWhatIsReadIsSubsampledAndOnlyWhatIsPutOutComesBack) {
  const Plan plan = plan_of({.outputs = {"hbao+"}, .only_outputs = {"ao_raw"}, .resolution = 2},
                            {"depth", "normal", "color", "peel.00", "ao_noise"});
  EXPECT_EQ(labels_of(plan), (Names{"resample/subsample depth", "resample/subsample normal", "hbao+/estimate",
                                    "resample/upsample ao_raw"}));
  EXPECT_EQ(plan.inputs, (Names{"depth", "normal"}));
}

TEST(Resolution, NormalsAreMadeOfAllPixelsBeforeTheyAreSubsampled) {
  const Plan plan = plan_of({.outputs = {"hbao+"}, .filter = "none", .resolution = 2}, {"depth"});
  EXPECT_EQ(labels_of(plan), (Names{"normals/differences", "resample/subsample depth", "resample/subsample normal",
                                    "hbao+/estimate", "resample/upsample ao_raw"}));
  EXPECT_EQ(plan.passes[0].pass.scale, 1);
}

TEST(Resolution, EveryLayerOfAStackIsSubsampled) {
  const Plan plan = plan_of({.outputs = {"dp-hbao+"}, .filter = "none", .resolution = 4},
                            {"depth", "normal", "peel.00", "peel.01", "peel.02"});
  const auto pass = std::find_if(plan.passes.begin(), plan.passes.end(),
                                 [](const PlannedPass& p) { return p.pass.name == "subsample peel"; });
  ASSERT_NE(pass, plan.passes.end());
  EXPECT_EQ(pass->pass.writes[0].plane, "peel@4");
  EXPECT_EQ(pass->pass.writes[0].layers, 3);
}

TEST(Resolution, ExtrasComeBackAsWell) {
  const Names labels = labels_of(
      plan_of({.outputs = {"gtao"}, .only_outputs = {"bent_normal"}, .with = {"bent_normal"}, .resolution = 2}));
  EXPECT_EQ(labels, (Names{"resample/subsample depth", "resample/subsample normal", "gtao/estimate",
                           "resample/upsample bent_normal"}));
}

TEST(Resolution, AFollowerOnItsOwnIsReducedAlone) {
  const Plan plan = plan_of({.outputs = {"bilateral"}, .resolution = 2}, {"depth", "normal", "ao_raw"});
  EXPECT_EQ(labels_of(plan), (Names{"resample/subsample ao_raw", "resample/subsample depth",
                                    "resample/subsample normal", "bilateral/separable", "resample/upsample ao"}));
}

/// The pass that upsamples a plane.
const Pass& upsampling_of(const Plan& plan, const std::string& plane) {
  const auto found = std::find_if(plan.passes.begin(), plan.passes.end(),
                                  [&](const PlannedPass& p) { return p.pass.name == "upsample " + plane; });
  if (found == plan.passes.end()) throw Error("nothing upsamples {}", plane);
  return found->pass;
}

bool looks_at_other_view(const Pass& pass) {
  return std::any_of(pass.reads.begin(), pass.reads.end(),
                     [](const Binding& read) { return read.from == From::other_view; });
}

/// Only results that the filter of both eyes has made alike; not raw ones, and none if each eye has a filter of its own.
TEST(Resolution, WhatTwoViewsAgreeOnIsUpsampledFromBoth) {
  const Names available = {"depth", "normal", "stochastic.00", "stochastic.01", "stochastic.02", "stochastic.03"};
  for (const char* technique : {"stereo-ao", "stereo-gtao", "stereo-bitmask", "stereo-sd-hbao+"}) {
    for (const char* filter : {"mono", "stereo", "stereo2d"}) {
      const Plan plan = plan_of({.outputs = {technique}, .settings = {{"filter", filter}}, .resolution = 2}, available);
      const std::string what = fmt::format("{}, {}", technique, filter);
      EXPECT_EQ(looks_at_other_view(upsampling_of(plan, "ao")), filter != std::string("mono")) << what;
      EXPECT_FALSE(looks_at_other_view(upsampling_of(plan, "ao_raw"))) << what;
    }
  }
  const Plan light = plan_of({.outputs = {"stereo-indirect"}, .resolution = 2}, {"depth", "normal", "color"});
  EXPECT_TRUE(looks_at_other_view(upsampling_of(light, "indirect")));
  EXPECT_FALSE(looks_at_other_view(upsampling_of(light, "indirect_raw")));
  const PlanRequest filtered{.outputs = {"gtao"}, .filter = "stereo-bilateral", .resolution = 4};
  EXPECT_TRUE(looks_at_other_view(upsampling_of(plan_of(filtered), "ao"))) << "as --filter";
  const Pass pass = upsampling_of(plan_of(filtered), "ao");
  Names others;
  for (const Binding& read : pass.reads) {
    if (read.from == From::other_view) others.push_back(read.argument + " " + read.plane);
  }
  EXPECT_EQ(others, (Names{"other_source ao@4", "other_depth depth@4", "other_normal normal@4"}));
  EXPECT_FALSE(pass.can_skip) << "masks restrict techniques that read one view";
  EXPECT_FALSE(looks_at_other_view(upsampling_of(plan_of({.outputs = {"gtao"}, .resolution = 4}), "ao")));
}

TEST(Resolution, UpsamplingInheritsTheRadius) {
  const Plan plan = plan_of(
      {.outputs = {"hbao+"}, .settings = {{"radius", "3"}, {"resample.depth_tolerance", "0.25"}}, .resolution = 2});
  EXPECT_EQ(plan.passes.back().values.number("radius"), 3);
  EXPECT_EQ(plan.passes.back().values.number("depth_tolerance"), 0.25);
  EXPECT_NE(plan.passes[3].values.number("depth_tolerance"), 0.25) << "that of the filter";
}

TEST(Resolution, WhatGuidesUpsamplingIsNotReduced) {
  EXPECT_EQ(message_of([] { plan_of({.outputs = {"normals"}, .resolution = 2}); }),
            "normals: 'normal' guides upsampling, so it needs every pixel; use --resolution full");
}

TEST(Resolution, WhatIsMissingForUpsamplingIsNamed) {
  EXPECT_EQ(message_of([] { plan_of({.outputs = {"hbao+"}, .resolution = 2}, {"normal"}); }),
            "hbao+: needs 'depth', and frame.exr has only R, G, B (see docs/gbuffer.md)");
}

TEST(Extras, UnknownOnesAreRefusedWithWhatThereIs) {
  EXPECT_EQ(message_of([] { plan_of({.outputs = {"gtao"}, .with = {"bent"}}); }),
            "--with bent: gtao does not make it (did you mean 'bent_normal'?); it has bent_normal, cone, "
            "specular_occlusion_raw and lobe_weight");
  EXPECT_EQ(message_of([] { plan_of({.outputs = {"hbao+"}, .with = {"cone"}}); }),
            "--with cone: hbao+ does not make it; it has no extras");
}

// --- Which pixels are computed

/// Sizes that no lane width and no resolution divides.
const std::pair<int, int> sizes[] = {{1, 1}, {1, 33}, {33, 1}, {2, 2}, {3, 5}, {17, 13}, {64, 48}, {101, 67}};

int reduced_size(int size, int resolution) { return (size + resolution - 1) / resolution; }

Frame shoot_room(int width, int height) { return shoot(perspective(width, height), room()); }

/// The frame that a renderer would make of every n-th pixel.
Frame every_nth(const Frame& frame, int n) {
  Frame small;
  small.display = small.window = {0, 0, reduced_size(frame.width(), n), reduced_size(frame.height(), n)};
  small.views.resize(1);
  Camera camera = *frame.views[0].camera;
  camera.fx /= n;
  camera.fy /= n;
  camera.cx = (camera.cx - 0.5) / n + 0.5;
  camera.cy = (camera.cy - 0.5) / n + 0.5;
  small.views[0].camera = camera;
  for (const auto& [name, plane] : frame.views[0].planes) {
    Plane& to = plane_of(small, name);
    for (size_t i = 0; i < plane.channels.size(); ++i) {
      for (int y = 0; y < small.height(); ++y) {
        for (int x = 0; x < small.width(); ++x) to.channels[i].at(x, y) = plane.channels[i].at(n * x, n * y);
      }
    }
  }
  normalise(small);
  return small;
}

/// Pixels whose bits differ.
int differing(const Plane& a, const Plane& b) {
  int count = 0;
  for (size_t i = 0; i < a.channels.size(); ++i) {
    const Layout& layout = a.channels[i].layout();
    EXPECT_EQ(layout, b.channels[i].layout());
    for (int y = 0; y < layout.height; ++y) {
      for (int x = 0; x < layout.width; ++x)
        count += std::bit_cast<uint32_t>(a.channels[i].at(x, y)) != std::bit_cast<uint32_t>(b.channels[i].at(x, y));
    }
  }
  return count;
}

/// Plans for all planes of the frame; missing planes are invented.
Plan plan_at(int resolution, const std::string& technique, Frame& frame, const Settings& settings = {}) {
  plan_for(find_technique(technique), frame);  // adds invented planes
  return make_plan({.outputs = {technique}, .settings = settings, .resolution = resolution}, plane_names(frame), "");
}

TEST(Resolution, SubsampledPlanesHoldEveryNthPixel) {
  for (const auto& [width, height] : sizes) {
    for (const int n : {2, 4}) {
      Frame frame = shoot_room(width, height);
      const Names planes = {"depth", "normal"};
      Plan plan = plan_at(n, "hbao+", frame);  // begins by subsampling them
      plan.passes.erase(plan.passes.begin() + long(planes.size()), plan.passes.end());
      plan.outputs.clear();
      for (const std::string& plane : planes) plan.outputs.push_back(fmt::format("{}@{}", plane, n));
      const Frame expected = every_nth(frame, n);
      for (const int lanes : usual_lanes(device())) {
        const Frame out = run(plan, frame, device(), {.lanes = lanes}).frame;
        for (const std::string& plane : planes) {
          EXPECT_EQ(differing(*out.views[0].find(fmt::format("{}@{}", plane, n)), *expected.views[0].find(plane)), 0)
              << plane << ", " << width << "x" << height << ", 1/" << n << ", lanes " << lanes;
        }
      }
    }
  }
}

/// The techniques of the registry with the output `ao`.
Names makers_of_ao() {
  Names names;
  for (const Technique& t : registry()) {
    const Names& outputs = t.outputs.empty() ? t.writes : t.outputs;
    if (std::find(outputs.begin(), outputs.end(), "ao") != outputs.end()) names.push_back(t.name);
  }
  return names;
}

class ResolutionOf : public testing::TestWithParam<std::string> {};

/// A frame with all inputs of the technique, also raw AO, which another technique would make from all pixels.
Frame frame_for(const std::string& technique, const Shot& shot) {
  Frame frame = shoot(shot, room());
  const Names& reads = find_technique(technique).reads;
  if (std::find(reads.begin(), reads.end(), "ao_raw") != reads.end()) invent_plane(frame, "ao_raw");
  return frame;
}

/// Positions, stacks, filters, everything that a pass reads at a lower resolution: the same bits as from a small frame.
TEST_P(ResolutionOf, AFrameOfEveryNthPixelGivesTheSameBits) {
  for (const auto& [width, height] : {std::pair(1, 1), {17, 13}, {101, 67}}) {
    Shot off_axis = perspective(width, height);
    off_axis.camera.cx += 0.3 * width;
    off_axis.camera.cy -= 0.2 * height;
    for (const Shot& shot : {off_axis, orthographic(width, height, 4)}) {
      for (const int n : {2, 4}) {
        Frame frame = frame_for(GetParam(), shot);
        Plan plan = plan_at(n, GetParam(), frame);
        plan.outputs = {fmt::format("ao@{}", n)};
        Frame small = every_nth(frame, n);
        const RunOptions options{.math = Math::precise};
        const Frame reduced = run(plan, frame, device(), options).frame;
        const Frame whole = run(plan_at(1, GetParam(), small), small, device(), options).frame;
        EXPECT_EQ(differing(*reduced.views[0].find(plan.outputs[0]), *whole.views[0].find("ao")), 0)
            << width << "x" << height << ", 1/" << n << (shot.camera.orthographic ? ", orthographic" : ", perspective");
      }
    }
  }
}

// --- All techniques

/// Largest mean difference of any technique, on the frame below, to its result at full resolution; measured, plus a margin.
/// Occluders as thin as a pixel are lost at a lower resolution.
double mean_allowed(int resolution) { return resolution == 2 ? 0.02 : 0.035; }

TEST_P(ResolutionOf, StaysNearFullResolutionAtEveryLaneWidth) {
  if (is_only_variant(find_technique(GetParam()))) GTEST_SKIP() << "the kernels at a lower resolution are another's";
  Frame frame = shoot(perspective(320, 240), room());
  const Frame whole = run(plan_at(1, GetParam(), frame), frame, device(), {.math = Math::precise}).frame;
  for (const int n : {2, 4}) {
    if (n > 2 && !is_long_run()) continue;
    const Plan plan = plan_at(n, GetParam(), frame);
    const Frame one = run(plan, frame, device(), {.math = Math::precise, .lanes = 1}).frame;
    const Frame many = run(plan, frame, device(), {.math = Math::precise, .lanes = 16}).frame;
    const Frame fast = run(plan, frame, device(), {.math = Math::fast}).frame;
    EXPECT_TRUE(same_bits(one, many)) << "1/" << n;
    for (const Frame* out : {&one, &fast}) EXPECT_EQ(violation(*out), "") << "1/" << n;
    const Difference d = difference(*one.views[0].find("ao"), *whole.views[0].find("ao"));
    std::printf("%s at 1/%d: mean difference to full resolution %.4f of %.4f allowed\n", GetParam().c_str(), n, d.mean,
                mean_allowed(n));
    EXPECT_LE(d.mean, mean_allowed(n));
    EXPECT_GT(d.mean, 0) << "nothing was left out";
  }
}

std::string name_of(const testing::TestParamInfo<std::string>& info) { return identifier(info.param); }

INSTANTIATE_TEST_SUITE_P(All, ResolutionOf, testing::ValuesIn(makers_of_ao()), name_of);

// --- Positions

double worst_distance_from_open(const Frame& out) {
  double worst = 0;
  for (const auto& [name, plane] : out.views[0].planes) {
    for (int y = 0; y < out.height(); ++y) {
      for (int x = 0; x < out.width(); ++x) worst = std::max(worst, std::abs(double(plane.channels[0].at(x, y)) - 1));
    }
  }
  return worst;
}

/// Over cameras, tilts and resolutions.
double worst_on_tilted_planes(const Settings& settings) {
  const double degree = std::numbers::pi / 180;
  Shot off_axis = perspective(112, 80);
  off_axis.camera.cx = 9.25;
  off_axis.camera.cy = 61.5;
  double worst = 0;
  for (const Shot& shot : {perspective(112, 80), off_axis, orthographic(112, 80, 1)}) {
    for (const double tilt : {0.0, 35.0, 60.0, 80.0}) {
      if (shot.camera.orthographic && tilt > 60) continue;  // part of it lies behind the eye
      Frame frame = shoot(shot, tilted_plane(1, tilt * degree, 40 * degree));
      for (const int n : {2, 4}) {
        const Plan plan = plan_at(n, "gtao", frame, settings);
        for (const Math math : {Math::precise, Math::fast})
          worst = std::max(worst, worst_distance_from_open(run(plan, frame, device(), {.math = math}).frame));
      }
    }
  }
  return worst;
}

// Without the bias, which would hide positions that are slightly wrong.
TEST(Resolution, ATiltedPlaneStaysOpen) {
  const double worst = worst_on_tilted_planes({{"radius", "0.1"}, {"bias", "0"}});
  std::printf("tilted planes at half and quarter resolution: within %.2g of open\n", worst);
  EXPECT_LE(worst, 1e-6);
}

// --- Upsampling

/// Raw AO, subsampled, not filtered, and upsampled.
Channel resampled(Frame& frame, int n, const std::function<float(int, int)>& raw, const Settings& settings = {},
                  int lanes = 0) {
  Channel& values = plane_of(frame, "ao_raw").channels[0];
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) values.at(x, y) = raw(x, y);
  }
  normalise(frame);
  Settings all = {{"bilateral.half_width", "0"}};
  all.insert(all.end(), settings.begin(), settings.end());
  const Plan plan = plan_at(n, "bilateral", frame, all);
  return run(plan, frame, device(), {.math = Math::precise, .lanes = lanes})
      .frame.views[0]
      .find("ao")
      ->channels[0]
      .clone();
}

bool is_background_at(const Frame& frame, int x, int y) {
  return is_background(frame.views[0].find("depth")->channels[0].at(x, y));
}

TEST(Upsampling, AConstantStaysConstantAndBackgroundOpen) {
  for (const auto& [width, height] : sizes) {
    for (const int n : {2, 4}) {
      for (const float constant : {0.37f, 1.0f}) {
        Frame frame = shoot_room(width, height);
        const auto raw = [&](int x, int y) { return is_background_at(frame, x, y) ? 1 : constant; };
        const Channel out = resampled(frame, n, raw);
        for (int y = 0; y < height; ++y) {
          for (int x = 0; x < width; ++x) {
            // A surface with background at all four pixels around it gets the background's value.
            const float value = out.at(x, y), distance = std::min(std::abs(value - constant), std::abs(value - 1));
            ASSERT_LE(is_background_at(frame, x, y) ? std::abs(value - 1) : distance, constant == 1 ? 0 : 1e-6)
                << x << ", " << y << " of " << width << "x" << height << ", 1/" << n;
            if (x % n != 0 || y % n != 0 || is_background_at(frame, x, y)) continue;
            ASSERT_NEAR(value, constant, 1e-6) << x << ", " << y << " of " << width << "x" << height << ", 1/" << n;
          }
        }
      }
    }
  }
}

TEST(Upsampling, PixelsThatWereTakenKeepTheirValue) {
  for (const int n : {2, 4}) {
    Frame frame = shoot_room(101, 67);
    std::mt19937 random(7);
    const Channel out = resampled(frame, n, [&](int, int) { return float(random() >> 8) * 0x1p-24f; });
    const Channel& raw = frame.views[0].find("ao_raw")->channels[0];
    int looked_at = 0;
    for (int y = 0; y < frame.height(); y += n) {
      for (int x = 0; x < frame.width(); x += n) {
        if (is_background_at(frame, x, y)) continue;
        ASSERT_NEAR(out.at(x, y), raw.at(x, y), 1e-6) << x << ", " << y << ", 1/" << n;
        ++looked_at;
      }
    }
    EXPECT_GT(looked_at, 100);
  }
}

/// On one plane only the bilinear weights matter, and they reproduce a linear image.
TEST(Upsampling, IsBilinearOnAPlane) {
  for (const int n : {2, 4}) {
    for (const Shot& shot : {perspective(101, 67), orthographic(101, 67, 1)}) {
      for (const double tilt : {0.0, 0.9}) {
        Frame frame = shoot(shot, tilted_plane(1, tilt, 0.6));
        const auto linear = [](int x, int y) { return float(0.1 + 0.004 * x + 0.005 * y); };
        for (const int lanes : {1, 16}) {
          const Channel out = resampled(frame, n, linear, {{"radius", "0.5"}}, lanes);
          double worst = 0;
          for (int y = 0; y <= (shot.height - 1) / n * n; ++y) {
            for (int x = 0; x <= (shot.width - 1) / n * n; ++x)
              worst = std::max(worst, std::abs(double(out.at(x, y)) - double(linear(x, y))));
          }
          EXPECT_LE(worst, 5e-6) << "1/" << n << ", tilt " << tilt << ", lanes " << lanes;
        }
      }
    }
  }
}

/// Whether one of the reduced pixels around a pixel with a bilinear weight has the pixel's depth.
bool has_neighbour(const Channel& depth, int n, int x, int y) {
  for (const int dy : {0, n}) {
    for (const int dx : {0, n}) {
      const int column = x / n * n + dx, row = y / n * n + dy;
      if ((dx > 0 && x % n == 0) || (dy > 0 && y % n == 0)) continue;
      if (column >= depth.layout().width || row >= depth.layout().height) continue;
      if (depth.at(column, row) == depth.at(x, y)) return true;
    }
  }
  return false;
}

TEST(Upsampling, DoesNotBleedOverADepthEdge) {
  for (const int n : {2, 4}) {
    for (const Shot& shot : {perspective(101, 67), orthographic(101, 67, 3)}) {
      const auto is_near = [&](const EyeRay& ray) {
        const double x = ray.origin.x + ray.direction.x, y = ray.origin.y + ray.direction.y;
        // A half plane, and a slanted bar about a pixel wide.
        return x + 0.3 * y < 0.01 || std::abs(x - 0.2 - 0.5 * y) < 0.6 / shot.camera.fx;
      };
      Frame frame = shoot(shot, [&](const EyeRay& ray) -> std::optional<Surface> {
        return Surface{is_near(ray) ? 2.0 : 2.2, {0, 0, 1}};
      });
      const Channel& depth = frame.views[0].find("depth")->channels[0];
      const auto side = [&](int x, int y) { return depth.at(x, y) < 2.1f ? 0.0f : 1.0f; };
      const Channel out = resampled(frame, n, side);
      double worst = 0;
      int alone = 0;
      for (int y = 0; y < shot.height; ++y) {
        for (int x = 0; x < shot.width; ++x) {
          if (has_neighbour(depth, n, x, y))
            worst = std::max(worst, double(std::abs(out.at(x, y) - side(x, y))));
          else
            ++alone;
        }
      }
      std::printf("upsampling by %d over an edge: worst %.2g; %d pixels have no neighbour on their own surface\n", n,
                  worst, alone);
      EXPECT_EQ(worst, 0);
      EXPECT_GT(alone, 0) << "the bar is never missed";
      EXPECT_LT(alone, shot.width * shot.height / 20);
    }
  }
}

}  // namespace
}  // namespace gloam::test::resolution_test
