// The best setting for one frame and device, by measurement.
#pragma once

#include <string>
#include <vector>

#include "gloam/variants.h"
#include "measure/contest.h"
#include "measure/own_subject.h"

namespace gloam::bench {

struct Picked {
  std::vector<Choice> finalists;  ///< sorted by time
  size_t tried = 0;               ///< number of settings tried
  size_t best = 0;                ///< index of the best finalist
  std::string why;                ///< why it is the best, in a sentence
  std::string truth;              ///< reference of the errors: "the truth", or its stand-in
  bool has_truth = true;          ///< it is no stand-in
  std::vector<Skipped> skipped;
  std::vector<Skipped> left_out;  ///< as of a contest
};

/// Holds a contest of the presets of the techniques at full and at half resolution. If the
/// subject has no truth, errors are to the converged image of the technique that is nearest to ray-traced truth on the built-in
/// scenes (of effects other than ambient occlusion: of the first technique). If one of the techniques makes an image of only the first of two views, times and errors of all are those of the first
/// view. Throws Error that names the nearest miss if nothing is within the bound.
Picked pick(const Subject& subject, const PickOptions& options, Device& device);

/// The plane that is picked for: that of the truths, else of the techniques that are named. Throws UsageError for several.
std::string effect_to_pick(const std::vector<std::string>& truths, const std::vector<std::string>& techniques);

/// The techniques of these names, or all of this variant that make the effect but for those of `left_out`, which are tried only if they are
/// named. Throws UsageError for one that does not make it.
std::vector<const Technique*> techniques_to_pick(const std::vector<std::string>& names, const std::string& effect,
                                                 std::vector<Skipped>& left_out, const VariantChoice& variant = {});

struct PickedOnFrame {
  Subject subject;
  Picked picked;
};

/// Reads a frame and picks. Tracing a truth does not count as time. `left_out`: as of `techniques_to_pick`.
PickedOnFrame pick_on_frame(const OwnFrame& own, const std::string& effect, PickOptions options,
                            const SceneOptions& scene, const std::vector<Skipped>& left_out, Device& device,
                            const TellNotes& tell);

}  // namespace gloam::bench
