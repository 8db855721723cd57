// The files of host/report/ and Vega, embedded at build time.
#pragma once

#include <map>
#include <string>

namespace gloam::report {

/// File name -> text.
const std::map<std::string, std::string>& embedded_files();

}  // namespace gloam::report
