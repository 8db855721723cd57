// Where the error of a technique comes from, step by step (docs/benchmarking.md).
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "gloam/device.h"
#include "measure/effects.h"
#include "measure/measures.h"
#include "measure/plans.h"
#include "measure/similarity.h"
#include "measure/subject.h"
#include "results/measurements.h"

namespace gloam::bench {

using report::Ladder;

/// Errors of the shipped result to the truth: the total. None without a truth.
struct Errors {
  std::optional<double> rmse;
  std::optional<double> bias;  ///< above 0: too bright
};

/// Images of techniques on one frame. Images that many presets share are computed once.
class Steps {
 public:
  /// Either truth may be missing: `truth` null, `truths` null without a scene. All arguments must outlive it. `holds`: as for
  /// `make_plan`. `foreground`: the pixels that errors are over.
  Steps(const Frame& frame, const std::string& holds, Device& device, const Truth* truth, Truths* truths,
        Foreground foreground);

  /// The final result, with its filter. Throws as `gloam::run` does.
  Image shipped(const Variation& variation);

  Errors errors(const Image& shipped) const;

  /// How alike the shipped image and the truth look; empty without a truth.
  Similarity similarity(const Image& shipped) const;

  /// Errors of what there is without a technique; none without a truth.
  Errors base_errors(const MeasuredEffect& effect) const;

  /// Errors of the technique's own plane, converged and unfiltered, on the given layers; none without a truth or without
  /// converged settings.
  Errors converged_errors(const Variation& variation);

  /// `shipped`: of the same variation. At a lower resolution `t4_bias` and `t4_noise` are missing: the filter does not get the
  /// converged image.
  Ladder climb(const Variation& variation, const Image& shipped);

 private:
  Image computed(const Plan& plan, const RunOptions& options);
  const Image& shared(const Plan& plan, const RunOptions& options);
  Image kept_in_half(const Variation& variation, const Plan& whole);
  const Image* own_truth(const Technique& technique, const ParameterValues& values);
  const Image* converged(const Technique& technique, const Variation& variation);
  Image filtered(const Frame& frame, const Plan& filter, const std::string& plane, const Image& raw,
                 const RunOptions& options);

  const Frame& frame_;
  const std::string holds_;
  Device& device_;
  const Truth* truth_;
  Truths* truths_;
  Foreground foreground_;
  std::vector<std::string> available_;
  std::map<std::string, Image> images_;
  std::optional<Frame> frame_in_half_;
};

}  // namespace gloam::bench
