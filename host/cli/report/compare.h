// Two results of gloam bench, compared: gloam report --compare and gloam bench --baseline.
#pragma once

#include <string>

#include "cli/flags/options.h"
#include "report/comparison.h"

namespace gloam::cli {

/// A result by the file's path as given, or the folder's. Throws Error for a file that is none.
report::Source result_of(const std::string& given);

/// The path as given; of an absolute path only the last folder and the name, since pages are for other machines.
std::string shown_path(const std::filesystem::path& path);

/// Prints what was compared, and what differs.
void print(const report::Comparison& comparison, const report::Source& first, const report::Source& second);

/// gloam report FIRST SECOND --compare
void report_compare(const std::string& first, const std::string& second, const std::string& markdown,
                    const JsonFlag& json);

}  // namespace gloam::cli
