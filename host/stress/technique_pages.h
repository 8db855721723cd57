// The pages of all techniques, embedded: generated.
#pragma once

#include <map>
#include <string>

namespace gloam::stress {

/// README.md of each folder of kernels/, by "gtao/README.md".
const std::map<std::string, std::string>& technique_pages();

}  // namespace gloam::stress
