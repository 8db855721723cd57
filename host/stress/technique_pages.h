// The pages of all techniques, embedded: generated.
#pragma once

#include <map>
#include <string>

namespace gloam::stress {

/// Path below kernels/ ("gtao/README.md") -> text, for each technique's folder.
const std::map<std::string, std::string>& technique_pages();

}  // namespace gloam::stress
