// gloam bench, pick and report on effects of light other than ambient occlusion: the plane that is measured, its truth, and what there
// is without a technique.
#include <map>
#include <set>

#include "cli/gloam_process.h"

namespace gloam::test::bench_effects_test {
namespace {

using Json = nlohmann::json;

const std::vector<std::string> effects = {"bounces", "specular_occlusion", "indirect", "contact"};

/// Small measurements without what is not looked at.
Arguments with(Arguments arguments, const Arguments& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  for (const char* word : {"--rounds", "1", "--variants", "none", "--no-growth", "--presets", "low", "--json", "-"})
    arguments.push_back(word);
  return arguments;
}

const Json& of_effect(const Json& list, const std::string& effect) {
  static const Json none;
  for (const Json& each : list) {
    if (each["effect"] == effect) return each;
  }
  ADD_FAILURE() << "nothing of " << effect;
  return none;
}

class BenchEffects : public Cli {
 protected:
  /// What gloam run and gloam compare say about the same image.
  double rmse_of(const std::string& technique, const std::string& effect, const fs::path& frame, const fs::path& truth,
                 const Arguments& settings) const {
    Arguments run = {"run", technique, frame, "-o", path("out.exr"), "--float"};
    run.insert(run.end(), settings.begin(), settings.end());
    const Result made = gloam(run);
    EXPECT_EQ(made.status, 0) << made.err;
    const Result compared = gloam({"compare", path("out.exr"), truth, "--plane", effect, "--json", "-"});
    EXPECT_EQ(compared.status, 0) << compared.err;
    return compared.json()["rmse"];
  }
};

TEST_F(BenchEffects, AreMeasuredByTheirOwnTruths) {
  const Result result =
      gloam(with({"bench", "--all", "-o", path("out"), "--scenes", "gallery", "--size", "96x54", "--rays", "32"},
                 {"--effects", "contact,indirect,bounces,specular_occlusion"}));
  ASSERT_EQ(result.status, 0) << result.err;
  const Json document = result.json();
  ASSERT_EQ(document["scenes"].size(), effects.size());
  const fs::path frame = path("out/scenes/gallery.exr");
  for (size_t i = 0; i < effects.size(); ++i) {
    const Json& scene = document["scenes"][i];
    const std::string& effect = effects[i];
    SCOPED_TRACE(effect);
    EXPECT_EQ(scene["effect"], effect);
    EXPECT_EQ(scene["name"], "gallery");
    EXPECT_EQ(scene["base"]["name"], effect == "indirect" ? "black" : "white");
    const double base = scene["base"]["rmse_to_truth"];
    EXPECT_EQ(scene["base"]["bias"] < 0, effect == "indirect");  // white is too bright
    if (effect == "indirect")
      EXPECT_LT(scene["white"], 0.9);  // light near by is dim
    else
      EXPECT_EQ(scene["white"], 1);
    const Json &row = of_effect(document["results"], effect), &converged = of_effect(document["converged"], effect);
    EXPECT_LT(row["rmse_to_truth"], base);
    EXPECT_LT(converged["rmse_to_truth"], base);
    EXPECT_TRUE(row["samples"].is_number());
    const fs::path truth = path("out/scenes") / ("gallery_" + effect + "_ref.exr");
    const std::string length = effect == "contact" ? "--length" : "--radius";
    const double expected =
        rmse_of(row["technique"], effect, frame, truth, {length, "0.5", "--preset", row["preset"].get<std::string>()});
    EXPECT_NEAR(row["rmse_to_truth"], expected, 1e-6);
    EXPECT_EQ(row["ladder"]["t12"].is_number(), effect != "indirect");  // it alone has a form over peeled layers
    EXPECT_EQ(row["ladder"]["t1"].is_number(), effect == "indirect");
    EXPECT_EQ(row["ladder"]["t2"].is_number(), effect == "indirect");
    EXPECT_TRUE(row["ladder"]["t3"].is_number());
    EXPECT_TRUE(row["ladder"]["t0w"].is_null());  // a contribution is to ambient occlusion
  }
  // No technique finds light within a radius of 0: the base line by another way.
  EXPECT_NEAR(of_effect(document["scenes"], "indirect")["base"]["rmse_to_truth"],
              rmse_of("indirect", "indirect", frame, path("out/scenes/gallery_indirect_ref.exr"), {"--radius", "0"}),
              1e-6);
  std::set<std::string> measured;
  for (const Json& row : document["results"]) measured.insert(row["technique"].get<std::string>());
  for (const char* name : {"multi-bounce", "specular-occlusion", "indirect", "contact-shadow"})
    EXPECT_TRUE(measured.count(name)) << name;
  EXPECT_FALSE(measured.count("gtao"));
  EXPECT_TRUE(document["scales"].empty());  // checks are of ambient occlusion

  const Result page = gloam({"report", path("out"), "--markdown", path("page.md")});
  ASSERT_EQ(page.status, 0) << page.err;
  const std::string text = slurp(path("page.md"));
  for (const char* words : {"### gallery (indirect)\n", "### architecture (contact)\n", "| black, no technique | ",
                            "### specular\\_occlusion\n", "screen and hidden"})
    EXPECT_NE(text.find(words), std::string::npos) << words;
}

TEST_F(BenchEffects, AreThoseThatTruthsHold) {
  const std::string frame = path("frame.exr"), bounces = path("bounces.exr"), contact = path("contact.exr");
  ASSERT_EQ(gloam({"capture", "gallery", "-o", frame, "--size", "96x54"}).status, 0);
  ASSERT_EQ(gloam({"reference", "bounces", frame, "-o", bounces, "--samples", "32"}).status, 0);
  ASSERT_EQ(gloam({"reference", "contact", frame, "-o", contact, "--length", "0.5"}).status, 0);
  const Result result =
      gloam(with({"bench", "--all", "-o", path("out"), "--frame", frame}, {"--truth", bounces, "--truth", contact}));
  ASSERT_EQ(result.status, 0) << result.err;
  const Json document = result.json();
  ASSERT_EQ(document["scenes"].size(), 2u);
  EXPECT_EQ(document["scenes"][0]["effect"], "bounces");
  EXPECT_EQ(document["scenes"][1]["effect"], "contact");
  EXPECT_EQ(document["scenes"][1]["radius_from"], "truth");
  EXPECT_EQ(of_effect(document["results"], "bounces")["technique"], "multi-bounce");
  EXPECT_EQ(of_effect(document["results"], "contact")["technique"], "contact-shadow");

  const Result other = gloam(with({"bench", "--all", "-o", path("out"), "--frame", frame},
                                  {"--truth", bounces, "--effects", "specular_occlusion"}));
  EXPECT_EQ(other.status, 1);
  EXPECT_NE(other.err.find("no plane 'specular_occlusion' to measure against"), std::string::npos) << other.err;

  // Within .35 are all presets at full resolution, of which medium takes twice as long as low; at half, two differ by a few hundredths.
  const Result picked = gloam({"pick", frame, "--truth", contact, "--error", "0.35", "--json", "-"});
  ASSERT_EQ(picked.status, 0) << picked.err;
  EXPECT_EQ(picked.json()["technique"], "contact-shadow");
  EXPECT_NE(picked.json()["command"].get<std::string>().find("-o contact.exr --preset low --length 0.5"),
            std::string::npos)
      << picked.json()["command"];
  const Result several = gloam({"pick", frame, "--truth", contact, "--truth", bounces, "--error", "0.9"});
  EXPECT_EQ(several.status, 2);
  EXPECT_NE(several.err.find("bounces and contact are several effects"), std::string::npos) << several.err;
}

}  // namespace
}  // namespace gloam::test::bench_effects_test
