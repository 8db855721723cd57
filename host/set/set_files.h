// Files of data/sets/ and data/displays/, embedded, so that the command needs no files at run time.
#pragma once

#include <map>
#include <string>

namespace gloam::sets {

/// Text by path: "sets/gloam-1.json", "displays/small.json".
const std::map<std::string, std::string>& set_files();

/// The JSON of a display by its name ("small"); empty if there is none.
std::string display_text(const std::string& name);

}  // namespace gloam::sets
