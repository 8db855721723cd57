// Commands that make a row again.
#pragma once

#include <string>

#include "leaderboard/table.h"

namespace gloam::leaderboard {

/// Makes the image of a measured row: "gloam run gtao gloam-1/frames/courtyard.exr -o gtao_courtyard.exr --preset medium --set ...", with
/// all settings, so that it stays the same where presets change. Empty for a submitted row, and for a variant that is no setting of
/// `gloam run`.
std::string run_command(const Row& row, const Item& item, const report::SetFacts& set);

/// What measured or scored a row: the command that the file or, of a submitted row, the row states; empty in older files.
std::string measuring_command(const Row& row, const report::Measurements& file);

}  // namespace gloam::leaderboard
