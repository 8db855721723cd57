#include "bench/fit/fit.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "base/random.h"
#include "bench/plans.h"
#include "gloam/error.h"
#include "gloam/run.h"

namespace gloam::bench {
namespace {

Frame filtered(const TrainingFrame& training, const std::string& technique, Sampling sampling, int term,
               Device& device) {
  Variation variation;
  variation.technique = &find_technique(technique);
  variation.radius = training.radius;
  variation.settings = {{"directions", std::to_string(sampling.directions)}, {"steps", std::to_string(sampling.steps)}};
  if (term != 0) variation.settings.emplace_back("term", std::to_string(term));
  const Plan plan = whole_plan(variation, {"depth", "normal"}, "a frame for fitting");
  return run(plan, training.frame, device, variation.run_options()).frame;
}

const Channel& ao_of(const Frame& frame) { return frame.views[0].planes.at("ao").channels[0]; }

std::vector<glm::ivec2> pixels_of_surfaces(const Channel& depth, int count) {
  std::vector<glm::ivec2> pixels;
  Random random(1);
  constexpr int most_trials = 1000;  // for each pixel
  for (int trial = 0; int(pixels.size()) < count; ++trial) {
    if (trial == most_trials * count) throw Error("a frame for fitting shows next to no surface");
    const glm::ivec2 pixel(int(random.below(size_t(depth.layout().width))),
                           int(random.below(size_t(depth.layout().height))));
    if (!is_background(depth.at(pixel.x, pixel.y))) pixels.push_back(pixel);
  }
  return pixels;
}

}  // namespace

std::vector<FitSample> fit_samples(const TrainingFrame& training, Sampling sampling, Device& device, int pixels) {
  const auto& planes = training.frame.views[0].planes;
  const std::vector<glm::ivec2> places = pixels_of_surfaces(planes.at("depth").channels[0], pixels);
  std::vector<FitSample> samples(places.size());
  const auto take = [&](const Channel& channel, const auto& field) {
    for (size_t i = 0; i < places.size(); ++i) field(samples[i]) = channel.at(places[i].x, places[i].y);
  };
  take(planes.at("ao").channels[0], [](FitSample& s) -> float& { return s.truth; });
  take(ao_of(filtered(training, "gtao", sampling, 0, device)), [](FitSample& s) -> float& { return s.gtao; });
  take(ao_of(filtered(training, "bitmask", sampling, 0, device)), [](FitSample& s) -> float& { return s.bitmask; });
  for (int k = 0; k < evidence_terms; ++k) {
    const auto term = [k](FitSample& s) -> float& { return s.terms[size_t(k)]; };
    take(ao_of(filtered(training, "evidence", sampling, k + 1, device)), term);
    for (FitSample& s : samples) term(s) = 1 - term(s);
  }
  return samples;
}

Coefficients fitted(const std::vector<const std::vector<FitSample>*>& samples) {
  // Small beside the sums over thousands of pixels: it only keeps terms that are nearly alike from growing against each other.
  constexpr double ridge = 0.2;
  cv::Mat square = ridge * cv::Mat::eye(evidence_terms, evidence_terms, CV_64F);
  cv::Mat right = cv::Mat::zeros(evidence_terms, 1, CV_64F);
  size_t count = 0;
  for (const std::vector<FitSample>* list : samples) {
    for (const FitSample& s : *list) {
      for (int i = 0; i < evidence_terms; ++i) {
        right.at<double>(i) += double(s.terms[size_t(i)]) * (1 - double(s.truth));
        for (int j = 0; j < evidence_terms; ++j)
          square.at<double>(i, j) += double(s.terms[size_t(i)]) * double(s.terms[size_t(j)]);
      }
    }
    count += list->size();
  }
  if (count < size_t(evidence_terms)) throw Error("{} pixels are too few to fit {} terms", count, evidence_terms);
  cv::Mat solution;
  cv::solve(square, right, solution, cv::DECOMP_CHOLESKY);
  Coefficients coefficients;
  for (int i = 0; i < evidence_terms; ++i) coefficients[size_t(i)] = solution.at<double>(i);
  return coefficients;
}

double rmse(const std::vector<FitSample>& samples, const Coefficients& coefficients) {
  double sum = 0;
  for (const FitSample& s : samples) {
    double closed = 0;
    for (size_t i = 0; i < coefficients.size(); ++i) closed += coefficients[i] * double(s.terms[i]);
    sum += std::pow(std::clamp(1 - closed, 0.0, 1.0) - double(s.truth), 2);
  }
  return std::sqrt(sum / double(samples.size()));
}

double rmse(const std::vector<FitSample>& samples, float FitSample::*ao) {
  double sum = 0;
  for (const FitSample& s : samples) sum += std::pow(double(s.*ao) - double(s.truth), 2);
  return std::sqrt(sum / double(samples.size()));
}

}  // namespace gloam::bench
