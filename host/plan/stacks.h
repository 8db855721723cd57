// Planes in layers: which of a frame's layers a plan takes, and what kernels are told of them.
#pragma once

#include <string>
#include <vector>

#include "gloam/plan.h"

namespace gloam {

/// Planes, and the stacks whose first layer is among them.
std::vector<std::string> with_stacks(std::vector<std::string> planes);

/// Planes to take from the frame: a stack is taken layer by layer. What is not there joins `missing`.
void take_inputs(Plan& plan, const std::vector<std::string>& inputs, const std::vector<std::string>& available,
                 std::vector<std::string>& missing);

/// What the pass's kernel has to know of the stacks that it reads: PEEL_LAYERS. Throws MissingPlanes or UsageError where the
/// pass reads more layers than there are.
void define_layers(Pass& pass, const Plan& plan, const Technique& technique);

/// Leaves out the layers at the end of a stack that no pass reads.
void trim_stacks(Plan& plan);

/// "PEEL" for "peel": how defines are named after arguments.
std::string upper_case(std::string name);

}  // namespace gloam
