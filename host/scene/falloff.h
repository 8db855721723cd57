// What a traced truth of ambient occlusion counts: its falloff and its radius.
#pragma once

#include <optional>
#include <string>

#include "gloam/radius.h"
#include "gloam/scene/reference.h"

namespace gloam {

/// `name`: "none", or a technique whose contribution is traced; `settings`: its own, such as {"hbao+.bias", "0.2"}. Throws UsageError.
void set_falloff(AoReferenceOptions& options, const std::string& name, const Settings& settings);

/// The radius that is given, else that of the frame's header, else of the scene, else one made from the frame.
Radius radius_of_truth(std::optional<double> given, std::optional<double> stated, const Scene& scene,
                       const Frame& frame);

}  // namespace gloam
