// Planes in layers: which layers of a frame a plan reads, and the defines that describe them to kernels.
#pragma once

#include <string>
#include <vector>

#include "gloam/plan.h"

namespace gloam {

/// The planes, and the stacks whose first layer is among them.
std::vector<std::string> with_stacks(std::vector<std::string> planes);

/// The planes to read from the frame; a stack is read layer by layer. Planes that are not available join `missing`.
void take_inputs(Plan& plan, const std::vector<std::string>& inputs, const std::vector<std::string>& available,
                 std::vector<std::string>& missing);

/// Adds the defines for the stacks that the pass's kernel reads: PEEL_LAYERS. Throws MissingPlanes or UsageError if the pass
/// reads more layers than there are.
void define_layers(Pass& pass, const Plan& plan, const Technique& technique);

/// Drops the layers at the end of a stack that no pass reads.
void trim_stacks(Plan& plan);

/// "PEEL" for "peel": defines are named after arguments in upper case.
std::string upper_case(std::string name);

}  // namespace gloam
