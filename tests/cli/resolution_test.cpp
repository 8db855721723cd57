// --resolution and --with at the command line: plans, files and refusals.
#include "cli/gloam_process.h"
#include "gloam/error.h"
#include "support/long.h"
#include "support/stress.h"

namespace gloam::test::resolution_test {
namespace {

using Json = nlohmann::json;

class CliResolution : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    Frame frame = shoot(perspective(49, 33), room());
    Channel& depth = plane_of(frame, "depth").channels[0];
    for (int y = 0; y < 9; ++y) std::fill_n(depth.row(y), 12, INFINITY);
    write_frame(path("frame.exr"), frame);
  }
  Result run(const Arguments& more) const {
    Arguments arguments = {"run", "gtao", path("frame.exr"), "-o", path("ao.exr"), "--json", "-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return gloam(arguments);
  }
};

TEST_F(CliResolution, ThePlanIsToldAsJson) {
  const Result result =
      gloam({"plan", "gtao", path("frame.exr"), "--resolution", "quarter", "--with", "bent_normal", "--json", "-"},
            {{"OCL_ICD_VENDORS", "/nonexistent"}});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json plan = result.json();
  std::vector<std::string> names;
  for (const Json& pass : plan["passes"]) names.push_back(pass["name"]);
  EXPECT_EQ(names,
            (std::vector<std::string>{"resample/subsample depth", "resample/subsample normal", "gtao/estimate",
                                      "bilateral/separable", "resample/upsample ao", "resample/upsample bent_normal"}));
  EXPECT_EQ(plan["outputs"], Json({"ao", "bent_normal"}));
  EXPECT_EQ(plan["passes"][2]["writes"], Json({"ao_raw@4", "bent_normal@4"}));
}

TEST_F(CliResolution, WhatComesBackHasTheSizeOfTheFrame) {
  for (const char* resolution : {"full", "half", "quarter"}) {
    const Result result =
        run({"--resolution", resolution, "--with", "bent_normal,cone", "--outputs", "ao,ao_raw", "--keep-depth"});
    ASSERT_EQ(result.status, 0) << result.err;
    FrameFile file(path("ao.exr"), {});
    const Frame out = file.read({"ao", "ao_raw", "bent_normal", "cone"});
    EXPECT_EQ(out.width(), 49);
    EXPECT_EQ(out.height(), 33);
    const bool is_reduced = std::string(resolution) != "full";
    EXPECT_EQ(result.json()["passes"][0]["name"], is_reduced ? "resample/subsample depth" : "gtao/estimate");
  }
}

TEST_F(CliResolution, BackgroundReadsTheSameAtEveryResolution) {
  for (const char* resolution : {"full", "half", "quarter"}) {
    ASSERT_EQ(run({"--resolution", resolution, "--with", "bent_normal,cone", "--outputs", "ao,ao_raw", "--keep-depth"})
                  .status,
              0);
    FrameFile file(path("ao.exr"), {});
    const Frame out = file.read({"depth", "ao", "ao_raw", "bent_normal", "cone"});
    const auto value = [&](const char* plane, int x, int y) {
      return out.views[0].planes.at(plane).channels[0].at(x, y);
    };
    int pixels = 0;
    for (int y = 0; y < out.height(); ++y) {
      for (int x = 0; x < out.width(); ++x) {
        if (!std::isinf(value("depth", x, y))) continue;
        ++pixels;
        ASSERT_EQ(value("ao", x, y), 1) << resolution;
        ASSERT_EQ(value("ao_raw", x, y), 1) << resolution;
        ASSERT_EQ(value("bent_normal", x, y), 0) << resolution;
        ASSERT_EQ(value("cone", x, y), 0) << resolution;
      }
    }
    EXPECT_GT(pixels, 0);
  }
}

/// A plane that cannot be computed at a lower resolution is a usage error of one line; no kernel is missing.
TEST_F(CliResolution, EveryTechniqueRunsAtEveryResolutionOrSaysWhyNot) {
  ONLY_IN_LONG_RUN();  // Resolution.WhatComesBackHasAKernel tests only the plans
  const std::map<std::string, std::string> refused = {{"normals", "'normal' guides upsampling"},
                                                      {"stochastic-depth", "'stochastic' holds layers"},
                                                      {"temporal-sssr", "motion is in its pixels"}};
  ASSERT_EQ(gloam({"capture", "gallery", "--size", "48x27", "--planes",
                   "depth,normal,albedo,color,roughness,reflectance,position,back_depth,instance", "--stereo", "0.065",
                   "--peel", "2", "--stochastic", "4", "--outlines", "0.5", "-o", path("all.exr")})
                .status,
            0);
  const Json techniques = gloam({"list", "techniques", "--json", "-"}).json();
  ASSERT_GT(techniques.size(), 40u);
  for (const Json& technique : techniques) {
    const std::string name = technique.at("name");
    const auto why = refused.find(name);
    for (const char* resolution : {"half", "quarter"}) {
      const Result result = gloam({"run", name, path("all.exr"), "-o", path("out.exr"), "--resolution", resolution});
      EXPECT_EQ(result.status, why == refused.end() ? 0 : 2) << name << " " << resolution << ": " << result.err;
      if (why == refused.end()) continue;
      EXPECT_NE(result.err.find(why->second), std::string::npos) << result.err;
    }
  }
}

TEST_F(CliResolution, ColoursComeBackAsTheyWere) {
  ASSERT_EQ(gloam({"run", "dielectric", path("frame.exr"), "-o", path("full.exr")}).status, 0);
  const Frame full = FrameFile(path("full.exr"), {}).read({"reflectance"});
  for (const char* resolution : {"half", "quarter"}) {
    const Result result =
        gloam({"run", "dielectric", path("frame.exr"), "-o", path("low.exr"), "--resolution", resolution});
    ASSERT_EQ(result.status, 0) << result.err;
    const Frame low = FrameFile(path("low.exr"), {}).read({"reflectance"});
    for (size_t c = 0; c < 3; ++c) {
      for (int y = 0; y < 33; ++y) {
        for (int x = 0; x < 49; ++x)
          EXPECT_NEAR(low.views[0].find("reflectance")->channels[c].at(x, y),
                      full.views[0].find("reflectance")->channels[c].at(x, y), 1e-6)
              << resolution << " " << x << " " << y;
      }
    }
  }
}

TEST_F(CliResolution, OtherNamesAreWrongUsage) {
  for (const char* resolution : {"third", "2", "1/2"}) {
    const Result result = run({"--resolution", resolution});
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(result.err,
              fmt::format("gloam: --resolution {} is not allowed; full, half and quarter are\n", resolution));
  }
  EXPECT_EQ(files(), std::vector<std::string>{"frame.exr"});
}

TEST_F(CliResolution, WhatGuidesUpsamplingIsNotReduced) {
  const Result result = gloam({"run", "normals", path("frame.exr"), "-o", path("normals.exr"), "--resolution", "half"});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.lines_of_error(), 1) << result.err;
  EXPECT_NE(result.err.find("'normal' guides upsampling"), std::string::npos) << result.err;
}

TEST_F(CliResolution, LayersAreNotUpsampled) {
  ASSERT_EQ(gloam({"capture", "fence", "-o", path("layers.exr"), "--size", "49x33", "--peel", "3"}).status, 0);
  const Result result =
      gloam({"run", "stochastic-depth", path("layers.exr"), "-o", path("map.exr"), "--resolution", "half"});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.err,
            "gloam: stochastic-depth: 'stochastic' holds layers, which cannot be upsampled; use --resolution full\n");
  EXPECT_EQ(files(), (std::vector<std::string>{"frame.exr", "layers.exr"}));
}

TEST_F(CliResolution, ExtrasThatThereAreNot) {
  const std::pair<const char*, const char*> refused[] = {
      {"bent",
       "gloam: --with bent: gtao does not make it (did you mean 'bent_normal'?); it has bent_normal, cone, "
       "specular_occlusion_raw and lobe_weight\n"},
      {"cone,ao_noise",
       "gloam: --with ao_noise: gtao does not make it; it has bent_normal, cone, specular_occlusion_raw and "
       "lobe_weight\n"}};
  for (const auto& [extras, message] : refused) {
    const Result result = run({"--with", extras});
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(result.err, message);
  }
  const Result none = gloam({"run", "hbao+", path("frame.exr"), "-o", path("ao.exr"), "--with", "cone"});
  EXPECT_EQ(none.status, 2);
  EXPECT_EQ(none.err, "gloam: --with cone: hbao+ does not make it; it has no extras\n");
  EXPECT_EQ(files(), std::vector<std::string>{"frame.exr"});
}

}  // namespace
}  // namespace gloam::test::resolution_test
