// The files of host/viewer/ that make the page, embedded at build time.
#pragma once

#include <map>
#include <string>

namespace gloam::viewer {

/// File name -> text.
const std::map<std::string, std::string>& embedded_files();

}  // namespace gloam::viewer
