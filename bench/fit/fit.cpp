#include "fit/fit.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "gloam/error.h"
#include "gloam/run.h"
#include "gloam/variants.h"
#include "measure/plans.h"

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
  return {variant_name("evidence", {occluders == "peel" ? Layers::peeled : Layers::stochastic}), planes};
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
    if (planned.pass.writes.front().plane == "ao_raw") {
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

/// The terms that the error is fitted to.
float error_term(const FitSample& s, int i) {
  if (i < evidence_terms) return s.terms[size_t(i)];
  return i < error_terms - 1 ? s.terms[size_t(evidence_terms + i)] : 1.0f;
}

/// Whether one of AO's terms has `u` or `n`: of t, and of r t.
bool has_unknown(int term) {
  const int i = term % evidence_terms;
  return i == 2 || i == 6 || i == 7 || i == 8;
}

/// Least squares with a little ridge, small beside the sums over thousands of pixels: it only keeps terms that are nearly alike from
/// growing against each other.
class Regression {
 public:
  explicit Regression(int columns)
      : square_(0.2 * cv::Mat::eye(columns, columns, CV_64F)), right_(cv::Mat::zeros(columns, 1, CV_64F)) {}

  /// A row: `terms[i]` stands in column `columns[i]`.
  void add(const std::vector<int>& columns, const std::vector<double>& terms, double value, double weight) {
    for (size_t i = 0; i < terms.size(); ++i) {
      double* row = square_.ptr<double>(columns[i]);
      const double weighted = weight * terms[i];
      *right_.ptr<double>(columns[i]) += weighted * value;
      for (size_t j = 0; j < terms.size(); ++j) row[columns[j]] += weighted * terms[j];
    }
    ++rows_;
  }

  cv::Mat solution() const {
    if (rows_ < square_.rows) throw Error("{} pixels are too few to fit {} terms", rows_, square_.rows);
    cv::Mat solution;
    cv::solve(square_, right_, solution, cv::DECOMP_CHOLESKY);
    return solution;
  }

 private:
  cv::Mat square_, right_;
  long long rows_ = 0;
};

/// Columns of AO's terms for one of several samplings: the common ones first.
std::vector<int> columns_of(size_t sampling) {
  int common = 0, own = 0, all_common = 0;
  for (int i = 0; i < closed_terms; ++i) all_common += has_unknown(i);
  std::vector<int> columns;
  for (int i = 0; i < closed_terms; ++i)
    columns.push_back(has_unknown(i) ? common++ : all_common + int(sampling) * (closed_terms - all_common) + own++);
  return columns;
}

/// The fit to AO of each sampling.
void fit_closed(const std::vector<std::vector<FitGroup>>& samplings, std::vector<Fit>& fits) {
  const std::vector<int> last = columns_of(samplings.size() - 1);
  Regression regression(*std::max_element(last.begin(), last.end()) + 1);
  for (size_t k = 0; k < samplings.size(); ++k) {
    const std::vector<int> columns = columns_of(k);
    for (const FitGroup& group : samplings[k]) {
      for (const FitSample& s : *group.samples)
        regression.add(columns, {s.terms.begin(), s.terms.begin() + closed_terms}, 1 - double(s.truth),
                       group.weight * (s.truth >= least_open ? weight_of_open : 1));
    }
  }
  const cv::Mat solution = regression.solution();
  for (size_t k = 0; k < samplings.size(); ++k) {
    const std::vector<int> columns = columns_of(k);
    for (size_t i = 0; i < closed_terms; ++i) fits[k].closed[i] = solution.at<double>(columns[i]);
  }
}

/// The square of the share of samples outside of the image.
double outside_term(const FitSample& s) { return double(s.terms.back()); }

}  // namespace

/// Twice: the second time pixels count by the inverse of what the first expects, so that small
/// errors are met as well as large ones.
void fit_error(const std::vector<FitGroup>& groups, Fit& fit) {
  constexpr double least = 0.01;
  std::vector<int> columns;
  for (int i = 0; i < error_terms + 1; ++i) columns.push_back(i);
  for (int round = 0; round < 2; ++round) {
    Regression regression(error_terms + 1);
    for (const FitGroup& group : groups) {
      for (const FitSample& s : *group.samples) {
        std::vector<double> terms;
        for (int i = 0; i < error_terms; ++i) terms.push_back(double(error_term(s, i)));
        terms.push_back(outside_term(s));
        const double weight = round == 0 ? group.weight : group.weight / (fit.expected_error(s) + least);
        regression.add(columns, terms, std::abs(fit.ao(s) - double(s.truth)), weight);
      }
    }
    const cv::Mat solution = regression.solution();
    for (int i = 0; i < error_terms; ++i) fit.error[size_t(i)] = solution.at<double>(i);
    fit.outside = solution.at<double>(error_terms);
  }
}

std::vector<FitSample> fit_samples(const TrainingFrame& training, const Sampling& sampling, Device& device) {
  const std::vector<glm::ivec2>& places = training.pixels;
  std::vector<FitSample> samples(places.size());
  const auto take = [&](const Frame& frame, const std::string& plane, const auto& field) {
    const Channel& channel = frame.views[0].planes.at(plane).channels[0];
    for (size_t i = 0; i < places.size(); ++i) field(samples[i]) = channel.at(places[i].x, places[i].y);
  };
  const int width = training.frame.width(), height = training.frame.height();
  for (size_t i = 0; i < places.size(); ++i) {
    const auto [x, y] = std::pair(places[i].x, places[i].y);
    samples[i].to_border = (float(std::min({x, y, width - 1 - x, height - 1 - y})) + 0.5f) / float(width);
  }
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
  sum += outside * outside_term(sample);
  return std::clamp(sum, 0.0, 1.0);
}

std::vector<Fit> fitted(const std::vector<std::vector<FitGroup>>& samplings) {
  std::vector<Fit> fits{samplings.size()};
  fit_closed(samplings, fits);
  for (size_t k = 0; k < samplings.size(); ++k) fit_error(samplings[k], fits[k]);
  return fits;
}

namespace {

/// `ao(sample)`: what is compared with the truth.
template <typename Estimate>
double rmse_of(const std::vector<FitSample>& samples, const Estimate& ao) {
  double sum = 0;
  for (const FitSample& s : samples) sum += std::pow(double(ao(s)) - double(s.truth), 2);
  return std::sqrt(sum / double(samples.size()));
}

}  // namespace

double rmse(const std::vector<FitSample>& samples, const Fit& fit) {
  return rmse_of(samples, [&](const FitSample& s) { return fit.ao(s); });
}

double rmse(const std::vector<FitSample>& samples, float FitSample::*ao) {
  return rmse_of(samples, [&](const FitSample& s) { return s.*ao; });
}

double share_too_dark(const std::vector<FitSample>& samples, const Fit& fit) {
  constexpr double tolerance = 0.03;
  long long open = 0, dark = 0;
  for (const FitSample& s : samples) {
    if (s.truth < least_open) continue;
    ++open;
    dark += fit.ao(s) < double(s.truth) - tolerance;
  }
  return open == 0 ? 0 : double(dark) / double(open);
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
