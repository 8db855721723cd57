// Techniques by the plane that is wanted.
#pragma once

#include <string>

namespace gloam {

/// The technique that a user means: "ao" stands for the one that is the default for it. Any other name is returned as it is.
std::string technique_for(const std::string& name);

}  // namespace gloam
