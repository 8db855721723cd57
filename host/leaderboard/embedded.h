// The files of host/leaderboard/, embedded at build time.
#pragma once

#include <map>
#include <string>

namespace gloam::leaderboard {

/// File name -> text.
const std::map<std::string, std::string>& embedded_files();

}  // namespace gloam::leaderboard
