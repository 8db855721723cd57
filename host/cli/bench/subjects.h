// Frames to measure on, for the commands that measure.
#pragma once

#include <string>
#include <vector>

#include "cli/flags/radius.h"
#include "measure/own_subject.h"

namespace gloam::cli {

/// Shows the current work on a terminal, in a line that the next one overwrites.
void show_status(const std::string& what, double share);
void erase_status();

/// Throws Error if the folder of -o cannot be made.
void make_output_folder(const std::filesystem::path& folder);

/// Throws UsageError for a list of effects with another name; "all" stands for all. In the order of `measured_effects`.
std::vector<std::string> parse_effects(const std::string& list);

/// The radius that techniques are measured with on a frame.
RadiusReport report_of(const bench::Subject& subject, const std::vector<const Technique*>& techniques);

/// A frame in a file for `own_subject`: read by the flags, and refused where it takes more memory than they allow.
bench::OwnFrame own_frame(const std::string& frame, const FrameFlags& flags, const std::vector<std::string>& truths);

}  // namespace gloam::cli
