// Where the error of a technique comes from, step by step (docs/benchmarking.md).
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "gloam/device.h"
#include "measures.h"
#include "plans.h"
#include "subject.h"

namespace gloam::bench {

/// RMSE of each image to the one a step above; none where one of both is not at hand.
struct Ladder {
  std::optional<double> t0w;       ///< truth with the technique's own contribution, to the truth
  std::optional<double> t1;        ///< over all peeled layers and converged, to that
  std::optional<double> t2;        ///< over the layers it is given, converged, to that
  std::optional<double> t3;        ///< with its samples, in double, to that
  std::optional<double> t4_bias;   ///< what the filter does to the converged image
  std::optional<double> t4_noise;  ///< filtered, to the filtered converged image
  std::optional<double> t5;        ///< float and fast, to that in double
  std::optional<double> truth;     ///< what is shipped, to the truth: the total
};

/// Images of techniques on one frame, each computed once.
class Steps {
 public:
  /// Either truth may be missing: `truth` null, `truths` null where no scene is at hand. All must outlive it.
  /// `holds`: as for `make_plan`.
  Steps(const Frame& frame, const std::string& holds, Device& device, const Truth* truth, Truths* truths);

  /// Throws what `gloam::run` throws.
  Ladder climb(const Variation& variation);

 private:
  const Image& image(const Plan& plan, bool shipped);
  const Image* own_truth(const Technique& technique, const ParameterValues& values);
  Image filtered(const Plan& filter, const std::string& plane, const Image& raw);

  const Frame& frame_;
  const std::string holds_;
  Device& device_;
  const Truth* truth_;
  Truths* truths_;
  std::vector<Mask> foreground_;
  std::vector<std::string> available_;
  std::map<std::string, Image> images_;
};

}  // namespace gloam::bench
