#include "fit/fit.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "gloam/technique.h"
#include "unit/message_of.h"

namespace gloam::bench::fit_test {
namespace {

/// To one sampling.
Fit fitted_alone(const std::vector<FitGroup>& groups) {
  return fitted(std::vector<std::vector<FitGroup>>{groups}).front();
}

/// So many pixels of one truth, of which only the first term says anything.
std::vector<FitSample> alike(size_t count, float truth) {
  FitSample sample;
  sample.terms.fill(0);
  sample.terms[0] = 0.5f;
  sample.truth = truth;
  return std::vector<FitSample>(count, sample);
}

TEST(Fit, FindsTheCoefficientsThatMadeTheTruth) {
  Random random(7);
  Fit wanted;
  for (double& c : wanted.closed) c = random.uniform(-1, 1) / closed_terms;
  wanted.closed[0] += 0.5;  // AO stays within 0 to 1, where it is not clamped
  std::vector<FitSample> samples(5000);
  for (FitSample& s : samples) {
    for (float& term : s.terms) term = float(random.uniform(0, 1));
    s.truth = float(wanted.ao(s));
  }
  const Fit found = fitted_alone({{&samples, 1}});
  for (size_t i = 0; i < wanted.closed.size(); ++i) EXPECT_NEAR(found.closed[i], wanted.closed[i], 2e-3) << i;
}

/// The error is that of the fit to the same pixels: here of a truth that is off by half of one term, to either side.
TEST(Fit, ExpectsTheErrorThatIsLeft) {
  Random random(8);
  std::vector<FitSample> samples(40000);
  for (FitSample& s : samples) {
    s.terms.fill(0);
    s.terms[0] = float(random.uniform(0.3, 0.6));  // no pixel is open, which would weigh more
    s.terms[1] = float(random.uniform(0, 0.4));
    s.truth = 1 - s.terms[0] + (random.one_in(2) ? 0.5f : -0.5f) * s.terms[1];
  }
  const Fit found = fitted_alone({{&samples, 1}});
  EXPECT_NEAR(found.closed[0], 1, 0.02);
  EXPECT_NEAR(found.closed[1], 0, 0.02);
  EXPECT_NEAR(found.error[0], 0, 0.02);
  EXPECT_NEAR(found.error[1], 0.5, 0.02);
}

TEST(Fit, ExpectsTheErrorOfPixelsThatShowNothing) {
  std::vector<FitSample> samples(1000);
  for (FitSample& s : samples) {
    s.terms.fill(0);
    s.truth = 0.75f;
  }
  EXPECT_NEAR(fitted_alone({{&samples, 1}}).expected_error(samples.front()), 0.25, 1e-3);
}

/// Two samplings whose truths differ by what a and u count: a keeps its own coefficients, u gets the mean.
TEST(Fit, WhatIsUnknownCountsAlikeForAllSamplings) {
  Random random(9);
  std::vector<FitSample> few(4000), many(4000);
  for (std::vector<FitSample>* list : {&few, &many}) {
    for (FitSample& s : *list) {
      s.terms.fill(0);
      s.terms[0] = float(random.uniform(0, 0.5));
      s.terms[2] = float(random.uniform(0, 0.5));
      s.truth = 1 - (list == &few ? 0.5f : 0.9f) * s.terms[0] - (list == &few ? 0.6f : 0.2f) * s.terms[2];
    }
  }
  const std::vector<Fit> fits = fitted({{{&few, 1}}, {{&many, 1}}});
  EXPECT_EQ(fits[0].closed[2], fits[1].closed[2]);
  EXPECT_NEAR(fits[0].closed[2], 0.4, 0.02);
  EXPECT_GT(fits[1].closed[0], fits[0].closed[0]);
}

TEST(Fit, PixelsCountByTheirWeight) {
  const std::vector<FitSample> dark = alike(500, 0.5f), bright = alike(500, 0.9f);
  const Fit fit = fitted_alone({{&dark, 0.25}, {&bright, 0.75}});
  EXPECT_NEAR(fit.ao(dark.front()), 0.8, 1e-3);
}

TEST(Fit, OpenPixelsCountMore) {
  const std::vector<FitSample> open = alike(500, 1.0f), closed = alike(500, 0.5f);
  const Fit fit = fitted_alone({{&open, 1}, {&closed, 1}});
  EXPECT_NEAR(fit.ao(open.front()), (weight_of_open * 1 + 0.5) / (weight_of_open + 1), 1e-3);
}

TEST(Fit, TooDarkIsAShareOfTheOpenPixels) {
  Fit fit;
  fit.closed[0] = 1;
  std::vector<FitSample> samples(4);
  for (FitSample& s : samples) s.terms.fill(0);
  EXPECT_EQ(share_too_dark(samples, fit), 0);
  samples[0].terms[0] = 0.02f;
  samples[1].terms[0] = 0.04f;
  samples[2].terms[0] = 0.5f;
  samples[2].truth = 0.9f;  // is not open
  EXPECT_NEAR(share_too_dark(samples, fit), 1 / 3.0, 1e-9);
  EXPECT_EQ(share_too_dark({samples[2]}, fit), 0);
}

TEST(Fit, ErrorIsThatOfClampedAmbientOcclusion) {
  FitSample open, closed;
  open.terms.fill(-1);  // would be brighter than open
  open.truth = 1;
  closed.terms.fill(1);
  closed.truth = 0.6f;
  closed.gtao = 0.2f;
  Fit fit;
  fit.closed.fill(1);
  EXPECT_NEAR(rmse({open, closed}, fit), 0.6 / std::sqrt(2.0), 1e-6);
  EXPECT_NEAR(rmse({closed}, &FitSample::gtao), 0.4, 1e-6);
}

TEST(Fit, DecilesAreByExpectedError) {
  std::vector<std::pair<double, double>> pixels;
  for (int i = 99; i >= 0; --i) pixels.emplace_back(i, 2 * i);
  const std::vector<Decile> found = deciles(pixels);
  ASSERT_EQ(found.size(), 10u);
  EXPECT_DOUBLE_EQ(found[0].expected, 4.5);
  EXPECT_DOUBLE_EQ(found[0].actual, 9);
  EXPECT_DOUBLE_EQ(found[9].expected, 94.5);
}

TEST(EvidenceSets, TellWhatAFileLacks) {
  const auto message = [](const std::string& text) {
    return test::message_of([&] { evidence_sets(text, "my.json"); });
  };
  EXPECT_EQ(message("no JSON"), "my.json: holds no coefficients; bench_fit writes such files");
  EXPECT_EQ(message("{\"sets\": []}"), "my.json: holds no coefficients; bench_fit writes such files");
  EXPECT_EQ(message("{\"sets\": [1]}"), "my.json: 'sets' has to be a list of sets; bench_fit writes such files");
  EXPECT_EQ(message("{\"sets\": [{\"occluders\": 3}]}"),
            "my.json: 'occluders' of a set has to be depth, back_depth, peel or stochastic");
  EXPECT_EQ(message("{\"sets\": [{\"occluders\": \"depth\", \"directions\": 0}]}"),
            "my.json: 'directions' of a set has to be a whole number from 1 to 1024");
  EXPECT_EQ(message("{\"sets\": [{\"occluders\": \"depth\", \"directions\": 1, \"steps\": 9, \"closed\": [1]}]}"),
            "my.json: 'closed' of a set has to be a list of 26 numbers; bench_fit writes such files");
}

TEST(EvidenceSets, TheBuiltInOnesAreForEveryPresetAndKindOfOccluders) {
  const Technique& technique = find_technique("evidence");
  for (const char* occluders : {"depth", "back_depth", "peel", "stochastic"}) {
    for (const Preset& preset : technique.presets) {
      ParameterValues values(technique.parameters);
      for (const auto& [name, value] : preset.settings) values.set(name, value, technique.name);
      const int directions = int(values.number("directions")), steps = int(values.number("steps"));
      const EvidenceSet* set = nearest_set(fitted_evidence_sets(), occluders, directions, steps);
      ASSERT_NE(set, nullptr) << occluders;
      EXPECT_EQ(set->directions, directions) << occluders << ", " << preset.name;
      EXPECT_EQ(set->steps, steps) << occluders << ", " << preset.name;
    }
  }
}

TEST(EvidenceSets, OtherSettingsTakeTheMostSimilarSet) {
  const std::vector<EvidenceSet>& sets = fitted_evidence_sets();
  EXPECT_EQ(nearest_set(sets, "depth", 32, 64)->directions, 4);
  EXPECT_EQ(nearest_set(sets, "depth", 1, 8)->steps, 9);
  EXPECT_EQ(nearest_set(sets, "colour", 1, 8), nullptr);
}

}  // namespace
}  // namespace gloam::bench::fit_test
