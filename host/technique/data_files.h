// Files of data/ that the library needs, embedded in it.
#pragma once

#include <map>
#include <string>

namespace gloam {

/// Text by name: "devices.json", "self_test.json".
const std::map<std::string, std::string>& data_files();

}  // namespace gloam
