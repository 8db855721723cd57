// Lower resolution: turns a plan for the whole image into one for every n-th pixel each way.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gloam/plan.h"

namespace gloam {

/// The technique of the passes that the plan itself adds: "resample/subsample", "resample/upsample". It is not in the registry; its
/// parameters are set as resample.NAME, and `reads` are the full-resolution planes that upsampling needs.
const Technique& resampling();

/// Runs the passes of the techniques at `plan.resolution`. Their inputs are subsampled before; their outputs that the plan
/// returns are upsampled after. Reduced planes are named after the whole ones: "depth@2". Every computed pixel is exactly one of
/// the image, and the camera is adapted, so that positions are as exact as at full resolution. `values`: of `resampling`. If
/// outputs are not to be upsampled, the plan returns the reduced ones.
void reduce(Plan& plan, const std::vector<const Technique*>& techniques, const ParameterValues& values,
            bool is_upsampled = true);

/// What is left of a plan at a lower resolution if its outputs are given there: their upsampling, from the planes `given` ("ao@4") beside those
/// of the frame. None for a plan with outputs that are not upsampled.
struct Upsampling {
  Plan plan;
  std::vector<std::string> given;
};
std::optional<Upsampling> upsampling_of(const Plan& plan);

}  // namespace gloam
