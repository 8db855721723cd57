// Where the error of a technique comes from, step by step (docs/benchmarking.md).
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/measures.h"
#include "bench/plans.h"
#include "bench/subject.h"
#include "gloam/device.h"

namespace gloam::bench {

/// Of what is shipped, to the truth: the total. None without a truth.
struct Errors {
  std::optional<double> rmse;
  std::optional<double> bias;  ///< above 0: too bright
};

/// RMSE of each image to the one a step above; none where one of both is not at hand.
struct Ladder {
  std::optional<double> t0w;       ///< truth with the technique's own contribution, to the truth
  std::optional<double> t1;        ///< over all peeled layers and converged, to that
  std::optional<double> t2;        ///< over the layers it is given, converged, to that
  std::optional<double> t3;        ///< with its samples, in double, to that
  std::optional<double> t4_bias;   ///< what the filter does to the converged image
  std::optional<double> t4_noise;  ///< filtered, to the filtered converged image
  std::optional<double> t5;        ///< what is shipped, to that in double
};

/// Images of techniques on one frame. Those that many presets share are computed once.
class Steps {
 public:
  /// Either truth may be missing: `truth` null, `truths` null where no scene is at hand. All must outlive it.
  /// `holds`: as for `make_plan`. `foreground`: what errors are over.
  Steps(const Frame& frame, const std::string& holds, Device& device, const Truth* truth, Truths* truths,
        Foreground foreground);

  /// What is handed over in the end, with its filter. Throws what `gloam::run` throws.
  Image shipped(const Variation& variation);

  Errors errors(const Image& shipped) const;

  /// Of the technique's own plane, converged and unfiltered, on the layers it is given; none without a truth, or where
  /// there is no such thing.
  Errors converged_errors(const Variation& variation);

  /// `shipped`: of the same variation. At a lower resolution there is no `t4_bias` and no `t4_noise`: the filter does not
  /// see the converged image then.
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
