#include "bench/fit/fit.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace gloam::bench {
namespace {

TEST(Fit, FindsTheCoefficientsThatMadeTheTruth) {
  Random random(7);
  Coefficients wanted;
  for (double& c : wanted) c = random.uniform(-1, 1);
  std::vector<FitSample> samples(5000);
  for (FitSample& s : samples) {
    double closed = 0;
    for (size_t i = 0; i < wanted.size(); ++i) {
      s.terms[i] = float(random.uniform(0, 1));
      closed += wanted[i] * double(s.terms[i]);
    }
    s.truth = float(1 - closed);
  }
  const Coefficients found = fitted({&samples});
  for (size_t i = 0; i < wanted.size(); ++i) EXPECT_NEAR(found[i], wanted[i], 2e-3) << i;
}

TEST(Fit, ErrorIsThatOfClampedAmbientOcclusion) {
  FitSample open, closed;
  open.terms.fill(-1);  // would be brighter than open
  open.truth = 1;
  closed.terms.fill(1);
  closed.truth = 0.6f;
  closed.gtao = 0.2f;
  Coefficients coefficients;
  coefficients.fill(1);
  EXPECT_NEAR(rmse({open, closed}, coefficients), 0.6 / std::sqrt(2.0), 1e-6);
  EXPECT_NEAR(rmse({closed}, &FitSample::gtao), 0.4, 1e-6);
}

}  // namespace
}  // namespace gloam::bench
