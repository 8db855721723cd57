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

/// The technique that makes AO from occluders of this kind, and the planes that it reads.
std::pair<std::string, std::vector<std::string>> technique_for(const std::string& occluders, const Frame& frame) {
  std::vector<std::string> planes = {"depth", "normal"};
  if (occluders == "depth") return {"evidence", planes};
  for (const auto& [name, unused] : frame.views[0].planes) {
    if (name == occluders || name.starts_with(occluders + ".")) planes.push_back(name);
  }
  if (occluders == "back_depth") return {"evidence", planes};
  return {(occluders == "peel" ? "dp-" : "sd-") + std::string("evidence"), planes};
}

Variation variation_of(const std::string& technique, const TrainingFrame& training, const Sampling& sampling) {
  Variation variation;
  variation.technique = &find_technique(technique);
  variation.radius = training.radius;
  variation.settings = {{"directions", std::to_string(sampling.directions)}, {"steps", std::to_string(sampling.steps)}};
  return variation;
}

Frame filtered(const TrainingFrame& training, const std::string& technique, const Sampling& sampling, Device& device) {
  const Variation variation = variation_of(technique, training, sampling);
  return run(whole_plan(variation, {"depth", "normal"}, "a frame for fitting"), training.frame, device,
             variation.run_options())
      .frame;
}

std::string term_name(int k) { return "term_" + std::to_string(k); }

/// A pass of the filter for one term instead of AO.
PlannedPass for_term(PlannedPass planned, int k) {
  for (std::vector<Binding>* list : {&planned.pass.reads, &planned.pass.writes}) {
    for (Binding& binding : *list) {
      if (binding.plane == "ao_raw")
        binding.plane = term_name(k);
      else if (binding.plane.starts_with("ao"))
        binding.plane += "." + term_name(k);
    }
  }
  return planned;
}

/// The technique's plan, making all terms instead of AO. The outputs are the filtered terms.
Plan plan_of_terms(const Variation& variation, const std::vector<std::string>& planes) {
  Plan plan = whole_plan(variation, planes, "a frame for fitting");
  std::vector<PlannedPass> passes, filter;
  for (PlannedPass& planned : plan.passes) {
    if (planned.technique != variation.technique) {
      filter.push_back(planned);
      continue;
    }
    if (planned.pass.name == "estimate") {
      planned.pass.defines.emplace_back("TERMS_ONLY", 1);
      for (int k = 0; k < fitted_terms; ++k) planned.pass.writes.push_back({term_name(k), term_name(k)});
    }
    passes.push_back(planned);
  }
  plan.outputs.clear();
  for (int k = 0; k < fitted_terms; ++k) {
    for (const PlannedPass& planned : filter) passes.push_back(for_term(planned, k));
    plan.outputs.push_back("ao." + term_name(k));
  }
  plan.passes = std::move(passes);
  return plan;
}

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

/// Which of a sample's terms the error is fitted to.
float error_term(const FitSample& s, int i) { return s.terms[size_t(i < evidence_terms ? i : evidence_terms + i)]; }

/// Least squares of `wanted(sample)` over `count` terms, `term(sample, i)`.
template <typename Term, typename Value>
cv::Mat regression(const std::vector<FitGroup>& groups, int count, const Term& term, const Value& wanted) {
  // Small beside the sums over thousands of pixels: it only keeps terms that are nearly alike from growing against each other.
  constexpr double ridge = 0.2;
  cv::Mat square = ridge * cv::Mat::eye(count, count, CV_64F), right = cv::Mat::zeros(count, 1, CV_64F);
  size_t pixels = 0;
  std::vector<double> terms{};
  terms.resize(size_t(count));
  for (const FitGroup& group : groups) {
    for (const FitSample& s : *group.samples) {
      for (int i = 0; i < count; ++i) terms[size_t(i)] = double(term(s, i));
      const double value = wanted(s);
      for (int i = 0; i < count; ++i) {
        const double weighted = group.weight * terms[size_t(i)];
        right.at<double>(i) += weighted * value;
        for (int j = 0; j < count; ++j) square.at<double>(i, j) += weighted * terms[size_t(j)];
      }
    }
    pixels += group.samples->size();
  }
  if (pixels < size_t(count)) throw Error("{} pixels are too few to fit {} terms", pixels, count);
  cv::Mat solution;
  cv::solve(square, right, solution, cv::DECOMP_CHOLESKY);
  return solution;
}

}  // namespace

std::vector<FitSample> fit_samples(const TrainingFrame& training, const Sampling& sampling, Device& device,
                                   int pixels) {
  const auto& planes = training.frame.views[0].planes;
  const std::vector<glm::ivec2> places = pixels_of_surfaces(planes.at("depth").channels[0], pixels);
  std::vector<FitSample> samples(places.size());
  const auto take = [&](const Frame& frame, const std::string& plane, const auto& field) {
    const Channel& channel = frame.views[0].planes.at(plane).channels[0];
    for (size_t i = 0; i < places.size(); ++i) field(samples[i]) = channel.at(places[i].x, places[i].y);
  };
  take(training.frame, "ao", [](FitSample& s) -> float& { return s.truth; });
  take(filtered(training, "gtao", sampling, device), "ao", [](FitSample& s) -> float& { return s.gtao; });
  take(filtered(training, "bitmask", sampling, device), "ao", [](FitSample& s) -> float& { return s.bitmask; });
  const auto [technique, inputs] = technique_for(sampling.occluders, training.frame);
  const Variation variation = variation_of(technique, training, sampling);
  const Frame terms = run(plan_of_terms(variation, inputs), training.frame, device, variation.run_options()).frame;
  for (int k = 0; k < fitted_terms; ++k)
    take(terms, "ao." + term_name(k), [k](FitSample& s) -> float& { return s.terms[size_t(k)]; });
  return samples;
}

double Fit::ao(const FitSample& sample) const {
  double sum = 0;
  for (int i = 0; i < closed_terms; ++i) sum += closed[size_t(i)] * double(sample.terms[size_t(i)]);
  return std::clamp(1 - sum, 0.0, 1.0);
}

double Fit::expected_error(const FitSample& sample) const {
  double sum = 0;
  for (int i = 0; i < error_terms; ++i) sum += error[size_t(i)] * double(error_term(sample, i));
  return std::clamp(sum, 0.0, 1.0);
}

Fit fitted(const std::vector<FitGroup>& groups) {
  Fit fit;
  const cv::Mat closed = regression(
      groups, closed_terms, [](const FitSample& s, int i) { return s.terms[size_t(i)]; },
      [](const FitSample& s) { return 1 - double(s.truth); });
  for (int i = 0; i < closed_terms; ++i) fit.closed[size_t(i)] = closed.at<double>(i);
  const cv::Mat error = regression(groups, error_terms, error_term,
                                   [&](const FitSample& s) { return std::abs(fit.ao(s) - double(s.truth)); });
  for (int i = 0; i < error_terms; ++i) fit.error[size_t(i)] = error.at<double>(i);
  return fit;
}

double rmse(const std::vector<FitSample>& samples, const Fit& fit) {
  double sum = 0;
  for (const FitSample& s : samples) sum += std::pow(fit.ao(s) - double(s.truth), 2);
  return std::sqrt(sum / double(samples.size()));
}

double rmse(const std::vector<FitSample>& samples, float FitSample::*ao) {
  double sum = 0;
  for (const FitSample& s : samples) sum += std::pow(double(s.*ao) - double(s.truth), 2);
  return std::sqrt(sum / double(samples.size()));
}

std::vector<Decile> deciles(std::vector<std::pair<double, double>> pixels) {
  std::stable_sort(pixels.begin(), pixels.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Decile> result;
  for (size_t tenth = 0; tenth < 10; ++tenth) {
    const size_t begin = pixels.size() * tenth / 10, end = pixels.size() * (tenth + 1) / 10;
    Decile decile{0, 0};
    for (size_t i = begin; i < end; ++i) {
      decile.expected += pixels[i].first / double(end - begin);
      decile.actual += pixels[i].second / double(end - begin);
    }
    result.push_back(decile);
  }
  return result;
}

}  // namespace gloam::bench
