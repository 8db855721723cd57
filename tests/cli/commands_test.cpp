// Correct use of every command: its output, its JSON, its files.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>

#include <cmath>
#include <regex>
#include <set>

#include "cli/gloam_process.h"
#include "support/stress.h"

namespace gloam::test::commands_test {
namespace {

using Json = nlohmann::json;

bool has(const Json& list, const std::string& item) { return std::find(list.begin(), list.end(), item) != list.end(); }

std::vector<std::string> passes_of(const Json& plan) {
  std::vector<std::string> names;
  for (const Json& pass : plan["passes"]) names.push_back(pass["name"]);
  return names;
}

TEST_F(Cli, HelpAndVersion) {
  const Result help = gloam({"--help"});
  EXPECT_EQ(help.status, 0);
  EXPECT_NE(help.out.find("Examples:\n  gloam ao frame.exr\n"), std::string::npos) << help.out;
  const Result version = gloam({"--version"});
  EXPECT_EQ(version.status, 0);
  EXPECT_EQ(gloam({"-V"}).out, version.out);
  for (const char* command : {"info", "run", "compare", "plan", "list"}) {
    const Result result = gloam({command, "--help"});
    EXPECT_EQ(result.status, 0);
    EXPECT_NE(result.out.find("Examples:"), std::string::npos) << command;
  }
}

TEST_F(Cli, AloneTheCommandShowsItsHelp) {
  const Result alone = gloam({});
  EXPECT_EQ(alone.status, 2);
  EXPECT_EQ(alone.out, gloam({"--help"}).out);
  EXPECT_TRUE(alone.err.empty()) << alone.err;
}

TEST_F(Cli, ListTechniquesHasOneLineForEachMethod) {
  const Json techniques = gloam({"list", "techniques", "--json", "-"}).json();
  const std::string list = gloam({"list", "techniques"}).out;
  for (const Json& technique : techniques) {
    const std::string name = technique["name"], begin = "\n  " + name + " ";
    const size_t at = list.find(begin);
    if (!technique["variant"].is_null()) {
      EXPECT_EQ(at, std::string::npos) << begin << " is in a column of its method's line";
      continue;
    }
    ASSERT_NE(at, std::string::npos) << begin;
    EXPECT_EQ(list.find(begin, at + 1), std::string::npos) << begin;
    const std::string line = list.substr(at + 1, list.find('\n', at + 1) - at - 1);
    EXPECT_NE(line.find(technique["summary"].get<std::string>()), std::string::npos) << line;
  }
  EXPECT_LT(std::count(list.begin(), list.end(), '\n'), long(techniques.size()) + 24);
}

TEST_F(Cli, OneTechniqueIsShownInFull) {
  const Json all = gloam({"list", "techniques", "--json", "-"}).json();
  for (const Json& technique : all) {
    const std::string name = technique["name"], shown = gloam({"list", "techniques", name}).out,
                      help = gloam({"run", name, "--help"}).out;
    for (const std::string& text : {shown, help}) {
      const std::string page = text.substr(text.find(name + ": " + technique["summary"].get<std::string>()));
      EXPECT_NE(page.find("  reads   "), std::string::npos) << name;
      EXPECT_NE(page.find("  writes  "), std::string::npos) << name;
      for (const Json& p : technique["parameters"])
        EXPECT_NE(page.find(p["name"].get<std::string>() + " "), std::string::npos) << name << ": " << p["name"];
      for (const auto& [preset, settings] : technique["presets"].items())
        EXPECT_NE(page.find("  --preset " + preset + " "), std::string::npos) << name << ": " << preset;
      EXPECT_NE(page.find(technique["caution"].get<std::string>()), std::string::npos) << name;
    }
  }
  EXPECT_EQ(gloam({"list", "techniques", "gtao", "--json", "-"}).json().size(), 1u);
  EXPECT_EQ(gloam({"list", "scenes", "gtao"}).status, 2);
  EXPECT_EQ(gloam({"list", "techniques", "gtoa"}).status, 2);
}

TEST_F(Cli, ListsTheTextThatTheCompilerOfKernelsGets) {
  const Result shown = gloam({"list", "--kernel", "gtao/estimate"});
  ASSERT_EQ(shown.status, 0);
  for (const char* part :
       {"// gtao/estimate: gtao_estimate, compiled with -D ", " -D DIRECTIONS=1 ",
        "typedef struct {\n  float radius;\n",
        "#define ARGUMENTS Frame frame, Params params, PLANE depth, PLANE normal_x, PLANE normal_y, PLANE normal_z, "
        "PLANE_OUT ao_raw\n",
        "#line 1 \"gtao/gtao.cl\"\n", "\n// out: ao_raw; ", "\nkernel void gtao_estimate(ARGUMENTS) {\n"})
    EXPECT_NE(shown.out.find(part), std::string::npos) << part;
  EXPECT_EQ(gloam({"list", "--kernel", "dp-indirect/estimate"}).status, 0) << "reads stacks";
  EXPECT_EQ(gloam({"list", "--kernel", "stereo-ssr/see"}).status, 0) << "reads the other eye";
  for (const char* of_plans : {"resample/upsample ao", "resample/upsample reflectance", "mask/bits", "adaptive/tiles",
                               "temporal/accumulate", "gtao/estimate of the rest"})
    EXPECT_EQ(gloam({"list", "--kernel", of_plans}).status, 0) << of_plans;
  const Result names = gloam({"list", "--kernel", "evidence"});
  EXPECT_EQ(names.status, 0) << names.err;
  EXPECT_EQ(names.out.find("evidence/estimate\nevidence/isolated\n"), 0u) << names.out;
  EXPECT_EQ(gloam({"list", "--kernel", "evidense"}).status, 2);
}

TEST_F(Cli, QuietTellsErrorsButNoNotes) {
  write_frame(path("f.exr"), small_frame(32, 24, {"depth"}));
  const Arguments away = {"capture", "plane", "-o",    path("p.exr"), "--size",
                          "8x8",     "--eye", "0,5,0", "--target",    "0,9,1"};
  EXPECT_NE(gloam(away).err.find("note: "), std::string::npos);
  for (const char* flag : {"-q", "--quiet"}) {
    Arguments quiet = away;
    quiet.push_back(flag);
    const Result result = gloam(quiet);
    EXPECT_EQ(result.status, 0);
    EXPECT_TRUE(result.err.empty()) << result.err;
    EXPECT_EQ(gloam({"info", path("none.exr"), flag}).lines_of_error(), 1);
  }
}

TEST_F(Cli, ListTechniquesTellsAllThatAProgramNeeds) {
  const Result result = gloam({"list", "techniques", "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  bool found = false;
  for (const Json& technique : result.json()) {
    for (const char* key : {"name", "summary", "paper", "reads", "optional", "writes", "parameters"})
      EXPECT_TRUE(technique.contains(key)) << key;
    if (technique["name"] == "evidence") {
      EXPECT_EQ(technique["optional"], Json::array({"back_depth"}));
    }
    if (technique["name"] != "hbao+") continue;
    found = true;
    EXPECT_EQ(technique["reads"], Json({"depth", "normal"}));
    for (const Json& p : technique["parameters"]) {
      for (const char* key : {"name", "type", "default", "min", "max", "choices", "unit", "help"})
        EXPECT_TRUE(p.contains(key)) << key;
      if (p["name"] == "directions") {
        EXPECT_EQ(p["default"], 8);
      }
      if (p["name"] == "radius") {
        EXPECT_EQ(p["unit"], "scene units");
      }
      if (p["name"] == "falloff") {
        EXPECT_EQ(p["choices"], Json({"quadratic", "none"}));
      }
    }
  }
  EXPECT_TRUE(found);
}

TEST_F(Cli, WhatTechniquesMakeWhenAskedIsTold) {
  const Json techniques = gloam({"list", "techniques", "--json", "-"}).json();
  const std::string one = gloam({"list", "techniques", "gtao"}).out,
                    page = gloam({"list", "techniques", "--markdown"}).out, help = gloam({"run", "--help-all"}).out;
  int makers = 0;
  for (const Json& technique : techniques) {
    if (technique["extras"] != Json({"bent_normal", "cone"})) continue;
    ++makers;
    const std::string name = technique["name"], section = page.substr(page.find("\n## `" + name + "`\n"));
    EXPECT_NE(section.substr(0, section.find("\n## ", 1)).find("`cone` (cosine of"), std::string::npos) << name;
    const bool is_method = technique["variant"].is_null();
    EXPECT_TRUE(!is_method || help.substr(help.find("--with")).find(name) != std::string::npos) << name;
  }
  EXPECT_GE(makers, 4);
  EXPECT_NE(one.find("  --with  cone: cosine of the half angle"), std::string::npos);
  EXPECT_NE(help.find("cosine of the half angle"), std::string::npos) << help;
}

/// Anchors as Markdown viewers make them: only letters, digits and hyphens stay, and repeated anchors are numbered.
TEST_F(Cli, LinksOnThePageOfTechniquesLeadToTheirSections) {
  std::istringstream page(gloam({"list", "techniques", "--markdown"}).out);
  std::map<std::string, std::string> links, sections;  // by technique
  std::map<std::string, int> taken;
  for (std::string line; std::getline(page, line);) {
    if (line.rfind("| [`", 0) == 0) {
      const std::regex link("\\[`([^`]+)`\\]\\(#([^)]+)\\)");  // variants are linked in their method's line
      for (std::sregex_iterator at(line.begin(), line.end(), link), end; at != end; ++at)
        links[at->str(1)] = at->str(2);
    } else if (line.rfind("## `", 0) == 0) {
      const std::string name = line.substr(4, line.size() - 5);
      std::string anchor = name;
      std::erase(anchor, '+');
      const int before = taken[anchor]++;
      sections[name] = before == 0 ? anchor : anchor + "-" + std::to_string(before);
    }
  }
  EXPECT_EQ(links, sections);
  EXPECT_NE(links.at("hbao+"), links.at("hbao"));
}

TEST_F(Cli, ListDevicesAndMetrics) {
  const Json devices = gloam({"list", "devices", "--json", "-"}).json();
  ASSERT_FALSE(devices.empty());
  for (const char* key : {"platform", "device", "type", "lanes", "double", "memory"})
    EXPECT_TRUE(devices[0].contains(key)) << key;
  const Json metrics = gloam({"list", "metrics", "--json", "-"}).json();
  EXPECT_TRUE(std::any_of(metrics.begin(), metrics.end(), [](const Json& m) { return m["name"] == "rmse"; }));
}

TEST_F(Cli, InfoOfTheBundledFrame) {
  const Result result = gloam({"info", loggia, "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json info = result.json();
  EXPECT_EQ(info["size"], Json({480, 270}));
  EXPECT_EQ(info["depth_convention"], "z");
  EXPECT_NEAR(info["background_share"], 0.0913, 0.001);
  EXPECT_NEAR(info["camera"]["hfov_deg"], 65, 0.01);
  EXPECT_TRUE(has(info["runs"], "hbao+"));
  for (const Json& plane : info["planes"]) {
    if (plane["name"] != "depth") continue;
    EXPECT_EQ(plane["channels"], Json({"Z"}));
    EXPECT_GT(plane["min"], 2.0);
    EXPECT_LT(plane["max"], 20.0);
    EXPECT_GT(plane["nonfinite"], 0);  // the background
  }
  EXPECT_NE(gloam({"info", loggia}).out.find("runs"), std::string::npos);
}

TEST_F(Cli, InfoSaysWhatIsLacking) {
  write_frame(path("beauty.exr"), small_frame(32, 24, {"color"}));
  const Json info = gloam({"info", path("beauty.exr"), "--json", "-"}).json();
  EXPECT_TRUE(info["runs"].empty());
  EXPECT_EQ(info["lacks"]["hbao+"], Json({"depth"}));
  EXPECT_TRUE(info["background_share"].is_null());
}

TEST_F(Cli, WhatIsLackingTakesThreeLinesUnlessEachTechniqueIsAskedFor) {
  const auto lines = [](const std::string& text) {
    std::vector<std::string> found;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
      if (line.find("lacks") != std::string::npos) found.push_back(line);
    return found;
  };
  const Json info = gloam({"info", loggia, "--json", "-"}).json();
  const std::vector<std::string> few = lines(gloam({"info", loggia}).out),
                                 all = lines(gloam({"info", loggia, "--lacks"}).out);
  ASSERT_EQ(few.size(), 3u);
  EXPECT_NE(few[0].find("lacks  planes: peel ("), std::string::npos) << few[0];
  EXPECT_NE(few[0].find("roughness ("), std::string::npos) << few[0];
  EXPECT_NE(few[1].find("lacks  views: a second view ("), std::string::npos) << few[1];
  EXPECT_NE(few[2].find("--lacks"), std::string::npos) << few[2];
  EXPECT_EQ(all.size(), info["lacks"].size());
}

TEST_F(Cli, PlanNeedsNoDeviceAndReadsNoColour) {
  write_frame(path("frame.exr"), small_frame());
  const Result result = gloam({"plan", "ao", path("frame.exr"), "--json", "-"}, {{"OCL_ICD_VENDORS", "/nonexistent"}});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json plan = result.json();
  EXPECT_EQ(plan["outputs"], Json({"ao"}));
  EXPECT_EQ(plan["decoded"], Json({"Z"}));
  EXPECT_EQ(passes_of(plan), (std::vector<std::string>{"normals/differences", "evidence/estimate", "evidence/isolated",
                                                       "bilateral/separable"}));
  const bool color_skipped =
      std::any_of(plan["skipped"].begin(), plan["skipped"].end(), [](const Json& s) { return s["what"] == "color"; });
  EXPECT_TRUE(color_skipped);
}

// A plane made by a filter can be planned by the technique before the filter, too.
TEST_F(Cli, APlaneCanBePlannedAsTheTechniqueThatMakesIt) {
  const auto plan = [&](const Arguments& more) {
    Arguments arguments = {"plan", "ao", loggia, "--json", "-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return gloam(arguments);
  };
  const Result cone = plan({"--with", "cone"});
  ASSERT_EQ(cone.status, 0) << cone.err;
  EXPECT_EQ(cone.json()["outputs"], Json({"ao", "cone"}));
  EXPECT_EQ(passes_of(cone.json())[0], "evidence/estimate");
  EXPECT_EQ(cone.json()["passes"][0]["writes"], Json({"ao_raw", "isolated", "cone"}));
  EXPECT_EQ(cone.json()["passes"][1]["writes"], Json({"ao_raw", "cone"}));
  EXPECT_EQ(plan({"--with", "hit"}).err,
            "gloam: --with hit: evidence does not make it; it has bent_normal, cone, "
            "specular_occlusion_raw, lobe_weight and ao_error\n");
  EXPECT_EQ(passes_of(plan({"--filter", "gaussian"}).json())[2].rfind("gaussian/", 0), 0u);
  const Json half = plan({"--resolution", "half"}).json();
  EXPECT_EQ(half["passes"][2]["writes"], Json({"ao_raw@2", "isolated@2"})) << "the estimate runs reduced as well";
  EXPECT_EQ(passes_of(gloam({"plan", "ao,hbao+", loggia, "--json", "-"}).json())[0], "hbao+/estimate");
}

TEST_F(Cli, APlanForTwoViewsIsRefusedAsTheRunIs) {
  const Result planned = gloam({"plan", "stereo-gtao", loggia}),
               ran = gloam({"run", "stereo-gtao", loggia, "-o", path("ao.exr")});
  EXPECT_EQ(planned.status, 1);
  EXPECT_EQ(planned.err, ran.err);
  EXPECT_NE(planned.err.find("needs a frame of two views, and this one has 1"), std::string::npos) << planned.err;
}

TEST_F(Cli, ADepthOnlyFrameWorks) {
  write_frame(path("frame.exr"), small_frame(32, 24, {"depth"}));
  const Result result = gloam({"run", "hbao+", path("frame.exr"), "-o", path("ao.exr"), "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.json()["plan"]["decoded"], Json({"Z"}));
  FrameFile written(path("ao.exr"), {});
  EXPECT_EQ(written.all_channels(), (std::vector<std::string>{"AO", "Y"}));
}

TEST_F(Cli, RunWritesFilteredAndRawAo) {
  const Result result = gloam({"run", "hbao+", loggia, "-o", path("ao.exr"), "--radius", "0.5", "--repeat", "3",
                               "--json", path("run.json"), "--outputs", "ao,ao_raw", "--keep-depth", "--float"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("hbao+/estimate"), std::string::npos);
  const Json run = Json::parse(slurp(path("run.json")));
  EXPECT_EQ(run["technique"], "hbao+");
  EXPECT_EQ(run["passes"].size(), 2u);
  for (const char* key : {"device", "lanes", "math", "total_ms", "plan", "skipped_share"})
    EXPECT_TRUE(run.contains(key)) << key;
  for (const Json& pass : run["passes"]) {
    EXPECT_GT(pass["ms"]["median"], 0);
    EXPECT_LE(pass["ms"]["min"], pass["ms"]["median"]);
    EXPECT_LE(pass["ms"]["median"], pass["ms"]["max"]);
  }
  FrameFile written(path("ao.exr"), {});
  EXPECT_EQ(written.common_planes(), (std::vector<std::string>{"depth", "ao", "ao_raw"}));
  EXPECT_EQ(written.text_attribute("gloamTechnique"), "hbao+");
  EXPECT_NE(written.text_attribute("gloamParameters").find("hbao+: radius=0.5 max_reach=0.25"), std::string::npos);
  const Frame frame = written.read({"ao", "ao_raw", "depth"});
  const View& view = frame.views[0];
  ASSERT_TRUE(view.camera.has_value());
  EXPECT_TRUE(view.camera->pose.has_value());
  double filtered = 0, raw = 0;
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x + 1 < frame.width(); ++x) {
      filtered += std::abs(view.find("ao")->channels[0].at(x, y) - view.find("ao")->channels[0].at(x + 1, y));
      raw += std::abs(view.find("ao_raw")->channels[0].at(x, y) - view.find("ao_raw")->channels[0].at(x + 1, y));
      if (is_background(view.find("depth")->channels[0].at(x, y))) {
        EXPECT_EQ(view.find("ao")->channels[0].at(x, y), 1);
      }
    }
  }
  EXPECT_LT(filtered, 0.8 * raw);  // the filter removed noise
}

TEST_F(Cli, ParametersAreFlags) {
  const auto ao = [&](const Arguments& extra) {
    Arguments arguments = {"run", "hbao+", loggia, "-o", path("ao.exr").string(), "--bare", "--math", "precise"};
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    EXPECT_EQ(gloam(arguments).status, 0);
    FrameFile file(path("ao.exr"), {});
    const Frame frame = file.read({"ao"});
    std::vector<float> values;
    for (int y = 0; y < frame.height(); ++y)
      values.insert(values.end(), frame.views[0].find("ao")->channels[0].row(y),
                    frame.views[0].find("ao")->channels[0].row(y) + frame.width());
    return values;
  };
  const std::vector<float> by_set = ao({"--set", "radius=0.25", "--set", "normal_tolerance=0.3"});
  EXPECT_EQ(by_set, ao({"--radius", "0.25", "--normal-tolerance=0.3"}));
  EXPECT_NE(by_set, ao({"--radius", "0.5"}));
  EXPECT_NE(by_set, ao({"--radius", "0.25", "--normal-tolerance=0.3", "--seed", "1"}));
  EXPECT_NE(by_set, ao({"--radius", "0.25", "--preset", "low"}));
  // A follower inherits the radius of its technique, unless a setting names the follower.
  EXPECT_EQ(ao({"--set", "hbao+.radius=0.25"}), ao({"--radius", "0.25"}));
  EXPECT_NE(ao({"--set", "hbao+.radius=0.25", "--set", "bilateral.radius=0.01"}), ao({"--radius", "0.25"}));
}

TEST_F(Cli, OnlyTheOutputsAskedForAreComputed) {
  const Result result =
      gloam({"run", "hbao+", loggia, "-o", path("ao.exr"), "--outputs", "ao_raw", "--bare", "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.json()["passes"].size(), 1u);
  EXPECT_EQ(FrameFile(path("ao.exr"), {}).all_channels(), (Arguments{"AO_raw", "Y"}));
  const Result unfiltered =
      gloam({"run", "hbao+", loggia, "-o", path("raw.exr"), "--filter", "none", "--bare", "--json", "-"});
  EXPECT_EQ(unfiltered.json()["passes"].size(), 1u);
}

TEST_F(Cli, AnOutputNamedTwiceIsWrittenOnce) {
  const Result result = gloam({"run", "hbao+", loggia, "-o", path("ao.exr"), "--outputs", "ao,ao", "--bare"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(FrameFile(path("ao.exr"), {}).all_channels(), (Arguments{"AO", "Y"}));
}

TEST_F(Cli, DoubleAndFloatAgree) {
  for (const char* real : {"float", "double"}) {
    ASSERT_EQ(
        gloam({"run", "hbao+", loggia, "-o", path(std::string(real) + ".exr"), "--real", real, "--math", "precise"})
            .status,
        0);
  }
  const Json difference = gloam({"compare", path("float.exr"), path("double.exr"), "--json", "-"}).json();
  EXPECT_LT(difference["mae"], 1e-4);
  EXPECT_GT(difference["max"], 0);
}

TEST_F(Cli, CompareWithTheTruth) {
  ASSERT_EQ(gloam({"run", "hbao+", loggia, "-o", path("ao.exr"), "--radius", "0.5"}).status, 0);
  const Result result = gloam({"compare", path("ao.exr"), loggia_truth, "-o", path("difference.png"), "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json figures = result.json();
  for (const char* key : {"pixels", "mae", "rmse", "bias", "psnr", "max", "over_1_255", "over_0_05", "ssim", "gmsd"})
    EXPECT_TRUE(figures.contains(key)) << key;
  EXPECT_NEAR(double(figures["pixels"]), 480 * 270 * (1 - 0.0913), 100);
  EXPECT_LT(figures["rmse"], 0.2);  // a white image has 0.26
  EXPECT_EQ(slurp(path("difference.png")).substr(1, 3), "PNG");
}

// Both AO files also hold the depth that the AO was made from.
TEST_F(Cli, UnfilteredAoIsComparedWithTheTruthsAo) {
  const std::string raw = path("raw.exr"), both = path("both.exr");
  ASSERT_EQ(gloam({"run", "hbao+", loggia, "-o", raw, "--filter", "none"}).status, 0);
  ASSERT_EQ(gloam({"run", "hbao+", loggia, "-o", both, "--outputs", "ao,ao_raw"}).status, 0);
  const auto planes = [&](const Arguments& arguments) {
    Arguments all = {"compare", "--json", "-"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Result result = gloam(all);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_GT(result.json()["rmse"], 0);
    return result.json()["plane"].get<std::string>() + " " + result.json()["truth_plane"].get<std::string>();
  };
  EXPECT_EQ(planes({raw, loggia_truth}), "ao_raw ao");
  EXPECT_EQ(planes({raw, loggia_truth, "--what", "ao_raw"}), "ao_raw ao");
  EXPECT_EQ(planes({both, loggia_truth}), "ao ao");
  EXPECT_EQ(planes({both, loggia_truth, "--what", "ao_raw"}), "ao_raw ao") << "as the help has it";
  EXPECT_EQ(planes({loggia_truth, raw}), "ao ao_raw");
  EXPECT_EQ(gloam({"compare", raw, both, "--json", "-"}).json()["truth_plane"], "ao_raw");
  const std::string heading = "ao_raw of " + raw + " against ao of " + loggia_truth;
  EXPECT_EQ(gloam({"compare", raw, loggia_truth}).out.rfind(heading, 0), 0u);
  const Result none = gloam({"compare", raw, loggia_truth, "--what", "ao"});
  EXPECT_EQ(none.status, 1);
  EXPECT_NE(none.err.find("did you mean 'ao_raw'"), std::string::npos) << none.err;
}

TEST_F(Cli, ResultsOfOtherKindsAreNotReadAsTheDepthBesideThem) {
  ASSERT_EQ(gloam({"run", "gtao", loggia, "-o", path("bent.exr"), "--with", "bent_normal", "--outputs", "bent_normal",
                   "--keep-depth"})
                .status,
            0);
  const Result result = gloam({"compare", path("bent.exr"), loggia_truth});
  EXPECT_EQ(result.status, 1) << result.out;
  EXPECT_EQ(result.lines_of_error(), 1) << result.err;
  EXPECT_NE(result.err.find("has bent_normal and"), std::string::npos) << result.err;
  EXPECT_EQ(gloam({"compare", path("bent.exr"), loggia_truth, "--what", "depth", "--json", "-"}).json()["rmse"], 0);
}

TEST_F(Cli, TheBundledTruthSaysHowItWasMade) {
  const FrameFile truth(loggia_truth, {});
  EXPECT_EQ(truth.number_attribute("aoRadius"), 0.5);
  EXPECT_EQ(truth.number_attribute("aoSamples"), 16384);
  EXPECT_NEAR(truth.number_attribute("aoNoise").value(), 0.0003, 0.00005);
  EXPECT_EQ(truth.text_attribute("aoFalloff"), "none");
  ASSERT_EQ(gloam({"run", "hbao+", loggia, "-o", path("ao.exr"), "--radius", "0.3"}).status, 0);
  EXPECT_EQ(gloam({"compare", path("ao.exr"), loggia_truth}).err,
            "note: the radius of the test is 0.3, and that of the truth 0.5\n");
  const Result pick = gloam({"pick", loggia, "--truth", loggia_truth, "--budget", "1s", "--radius", "0.3"});
  EXPECT_EQ(pick.status, 2);
  EXPECT_NE(pick.err.find("--radius 0.3: the truth was made with 0.5"), std::string::npos) << pick.err;
}

TEST_F(Cli, AnImageIsIdenticalToItself) {
  const Json same = gloam({"compare", loggia_truth, loggia_truth, "--json", "-"}).json();
  EXPECT_TRUE(same["psnr"].is_null());
  EXPECT_EQ(same["rmse"], 0);
  EXPECT_EQ(same["ssim"], 1);
}

/// A frame whose one plane holds a value everywhere, and another at one pixel.
Frame flat(const std::string& plane, float value, float odd) {
  Frame frame = small_frame(32, 24, {plane});
  Channel& channel = frame.views[0].planes[plane].channels[0];
  for (int y = 0; y < 24; ++y) std::fill(channel.row(y), channel.row(y) + 32, value);
  channel.at(3, 5) = odd;
  return frame;
}

TEST_F(Cli, WhatIsMeasuredIsWhatTheFileHolds) {
  write_frame(path("good.exr"), flat("ao", 0.5f, 0.5f));
  write_frame(path("over.exr"), flat("ao", 1.5f, 1.5f));
  write_frame(path("nan.exr"), flat("ao", 0.5f, NAN));
  EXPECT_NEAR(double(gloam({"compare", path("over.exr"), path("good.exr"), "--json", "-"}).json()["rmse"]), 1, 1e-6);
  const Result nan = gloam({"compare", path("nan.exr"), path("good.exr")});
  EXPECT_EQ(nan.status, 1);
  EXPECT_NE(nan.err.find("(3, 5)"), std::string::npos) << nan.err;
  const Json info = gloam({"info", path("over.exr"), "--json", "-"}).json();
  EXPECT_EQ(info["planes"][0]["max"], 1.5);
}

/// AO that lists two views and does not state which one it is, as in references rendered eye by eye.
void write_unnamed_eye(const fs::path& path, float value) {
  Imf::Header header(32, 24);
  header.channels().insert("AO", Imf::Channel(Imf::FLOAT));
  Imf::addMultiView(header, {"left", "right"});
  std::vector<float> pixels(32 * 24, value);
  Imf::FrameBuffer buffer;
  buffer.insert("AO", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(pixels.data()), 4, 4 * 32));
  Imf::OutputFile file(path.c_str(), header);
  file.setFrameBuffer(buffer);
  file.writePixels(24);
}

Frame two_eyes(float left, float right) {
  Frame frame = small_frame(32, 24, {"depth", "ao"});
  frame.views[0].name = "left";
  frame.views.push_back(std::move(small_frame(32, 24, {"depth", "ao"}).views[0]));
  frame.views[1].name = "right";
  const float values[] = {left, right};
  for (size_t i = 0; i < 2; ++i) frame.views[i].planes["ao"].channels[0] = Channel(Layout(32, 24), values[i]);
  return frame;
}

TEST_F(Cli, AnEyeThatDoesNotSayWhichItIsGoesWithTheViewAskedFor) {
  write_frame(path("both.exr"), two_eyes(0.25f, 0.75f));
  write_unnamed_eye(path("truth_right.exr"), 0.75f);
  const Result told = gloam({"compare", path("both.exr"), path("truth_right.exr"), "--view", "right", "--json", "-"});
  ASSERT_EQ(told.status, 0) << told.err;
  EXPECT_EQ(told.json()["rmse"], 0);
  EXPECT_EQ(told.err, "");
  Frame named = two_eyes(0.25f, 0.75f);
  named.views.pop_back();
  write_frame(path("left.exr"), named);
  const Result other = gloam({"compare", path("both.exr"), path("left.exr"), "--view", "right"});
  EXPECT_NE(other.err.find("view 'right' is compared with view 'left'"), std::string::npos) << "both files say so";
}

TEST_F(Cli, TheTestsRadiusIsHeldAgainstTheTruthsWhereBothAreKnown) {
  const auto said = [&](const std::string& used, double truth) {
    Frame frame = small_frame(32, 24, {"depth", "ao"});
    frame.attributes["gloamParameters"] = "hbao+: radius=" + used + " bias=0.1";
    write_frame(path("ao.exr"), frame);
    frame.numbers["aoRadius"] = truth;
    write_frame(path("truth.exr"), frame);
    return gloam({"compare", path("ao.exr"), path("truth.exr")}).err;
  };
  EXPECT_EQ(said("0.3", 0.3), "");
  EXPECT_EQ(said("inf", INFINITY), "");
  EXPECT_EQ(said("0.5", 0.3), "note: the radius of the test is 0.5, and that of the truth 0.3\n");
  EXPECT_EQ(said("0.5", INFINITY), "note: the radius of the test is 0.5, and that of the truth inf\n");
  EXPECT_EQ(said("inf", 0.3), "note: the radius of the test is inf, and that of the truth 0.3\n");
}

TEST_F(Cli, ChannelsThatTheUserNamesAreTheTests) {
  write_frame(path("ao.exr"), small_frame(32, 24, {"Lamp.R"}));
  write_frame(path("frame.exr"), small_frame(32, 24, {"depth"}));
  write_frame(path("truth.exr"), flat("ao", 0.5f, 0.25f));
  const Result result = gloam({"compare", path("ao.exr"), path("truth.exr"), "--plane", "ao=Lamp.R", "--frame",
                               path("frame.exr"), "--json", "-"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.json()["plane"], "ao");
  EXPECT_EQ(result.json()["max"], 0.25);
}

TEST_F(Cli, TheFrameThatTellsTheBackgroundHasToFit) {
  write_frame(path("ao.exr"), flat("ao", 0.5f, 0.5f));
  write_frame(path("frame.exr"), small_frame(32, 24, {"depth"}));
  write_frame(path("tiny.exr"), small_frame(1, 1, {"depth"}));
  EXPECT_EQ(
      gloam({"compare", path("ao.exr"), path("ao.exr"), "--frame", path("frame.exr"), "--json", "-"}).json()["pixels"],
      32 * 24);
  const Result result = gloam({"compare", path("ao.exr"), path("ao.exr"), "--frame", path("tiny.exr")});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("1x1"), std::string::npos) << result.err;
  write_frame(path("large.exr"), small_frame(64, 48, {"depth"}));
  const Result large = gloam({"compare", path("ao.exr"), path("ao.exr"), "--frame", path("large.exr")});
  EXPECT_EQ(large.status, 1) << large.out;
  EXPECT_EQ(large.lines_of_error(), 1) << large.err;
  EXPECT_NE(large.err.find("is 64x48, and the images are 32x24"), std::string::npos) << large.err;
}

TEST_F(Cli, TheFrameThatTellsTheBackgroundMayStartElsewhereOrReachFarther) {
  write_frame(path("ao.exr"), flat("ao", 0.5f, 0.5f));
  Frame moved = small_frame(32, 24, {"depth"});
  moved.display = moved.window = {100, 50, 132, 74};
  moved.views[0].planes["depth"].channels[0].at(3, 5) = 0;
  write_frame(path("moved.exr"), moved);
  Frame wide = small_frame(48, 40, {"depth"});
  wide.display = {0, 0, 32, 24};
  wide.window = {-8, -8, 40, 32};
  wide.views[0].planes["depth"].channels[0].at(0, 0) = 0;
  wide.views[0].planes["depth"].channels[0].at(8, 8) = 0;
  write_frame(path("wide.exr"), wide);
  for (const char* frame : {"moved.exr", "wide.exr"}) {
    const Result result =
        gloam({"compare", path("ao.exr"), path("ao.exr"), "--frame", path(frame).string(), "--json", "-"});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.json()["pixels"], 32 * 24 - 1) << frame;
  }
}

/// A parameter of a flag's name is set by --set, and its help says so.
TEST_F(Cli, NoParameterHidesAFlag) {
  const std::string help = gloam({"run", "--help-all"}).out;
  std::set<std::string> hidden;
  for (const Json& technique : gloam({"list", "techniques", "--json", "-"}).json()) {
    const std::string own = gloam({"run", technique["name"].get<std::string>(), "--help"}).out;
    for (const Json& p : technique["parameters"]) {
      const std::string name = p["name"];
      // --radius stands among the flags that most need, and is the parameter itself.
      if (name == "radius" || help.find("\n  --" + name + " ") == std::string::npos) continue;
      hidden.insert(name);
      EXPECT_NE(own.find("\n  --set " + name + " "), std::string::npos) << technique["name"] << ": " << name;
    }
  }
  EXPECT_EQ(hidden, std::set<std::string>{"filter"});
  const Json plan = gloam({"plan", "hbao+", loggia, "--filter", "none", "--json", "-"}).json();
  EXPECT_EQ(plan["passes"].size(), 1) << plan;
}

TEST_F(Cli, HelpOfARunShowsTheTechniquesParameters) {
  const std::string help = gloam({"run", "hbao+", "--help"}).out;
  EXPECT_NE(help.find("Usage: gloam run"), std::string::npos) << help;
  EXPECT_NE(help.find("--radius"), std::string::npos) << help;
}

TEST_F(Cli, WindowsOfOneSizeMayStartElsewhere) {
  Frame moved = small_frame(32, 24, {"depth", "ao"});
  write_frame(path("a.exr"), moved);
  moved.display = moved.window = {100, 50, 132, 74};
  write_frame(path("b.exr"), moved);
  EXPECT_EQ(gloam({"compare", path("a.exr"), path("b.exr"), "--json", "-"}).json()["rmse"], 0);
}

// As written by `gloam run`, each file also holds the depth that the AO was made from.
TEST_F(Cli, CompareTakesAResultBeforeTheDepthBesideIt) {
  for (const char* result : {"ao", "ao_raw", "reflection", "bent_normal", "cone", "hit", "mask", "outline_count"}) {
    Frame frame = shoot(perspective(48, 32), room(), false);
    invent_plane(frame, result);
    write_frame(path("a.exr"), frame);
    const Result compared = gloam({"compare", path("a.exr"), path("a.exr"), "--json", "-"});
    ASSERT_EQ(compared.status, 0) << compared.err;
    EXPECT_EQ(compared.json()["plane"], result);
  }
}

}  // namespace
}  // namespace gloam::test::commands_test
