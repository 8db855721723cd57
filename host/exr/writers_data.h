// data/writers.json, embedded.
#pragma once

#include <map>
#include <string>

namespace gloam {

/// Text by name: "writers.json".
const std::map<std::string, std::string>& writers_data();

}  // namespace gloam
