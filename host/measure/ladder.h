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

namespace gloam::bench {

/// Errors of the shipped result to the truth: the total. None without a truth.
struct Errors {
  std::optional<double> rmse;
  std::optional<double> bias;  ///< above 0: too bright
};

/// RMSE of each image to the one a step above; none if one of the two is missing.
struct Ladder {
  std::optional<double> t0w;  ///< truth with the technique's own contribution, to the truth
  std::optional<double> t1;   ///< over all peeled layers and converged, to the image above
  std::optional<double> t2;   ///< over the given layers, converged, to the image above
  std::optional<double> t12;  ///< the same to T0w, where the registry has no form over peeled layers: both steps in one
  std::optional<double> t3;   ///< with its own samples, in double, to the image above
  std::optional<double> t4_bias;   ///< filtered converged image, to the converged image
  std::optional<double> t4_noise;  ///< filtered, to the filtered converged image
  std::optional<double> t5;        ///< shipped result, to the same in double
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
