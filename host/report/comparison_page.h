// A comparison as text, as a page of documentation and as JSON.
#pragma once

#include <string>
#include <vector>

#include "report/comparison.h"

namespace gloam::report {

/// What was compared with what, and how, a line each.
std::vector<std::string> heading_of(const Comparison& comparison, const Source& first, const Source& second);

/// Rows of text with a heading: techniques; rows that differ; milliseconds on two devices, none where both ran on one.
std::vector<std::vector<std::string>> table_of_techniques(const Comparison& comparison);
std::vector<std::vector<std::string>> table_of_rows(const Comparison& comparison, bool only_those_that_differ);
std::vector<std::vector<std::string>> table_of_devices(const Comparison& comparison, const Source& first,
                                                       const Source& second);

/// How many rows of each scene have which verdict, a line each; then the rows of one file alone.
std::vector<std::string> counts_of(const Comparison& comparison, const Source& first, const Source& second);

/// Markdown, with all rows. `command`: the one that makes the page again.
std::string page_of(const Comparison& comparison, const Source& first, const Source& second,
                    const std::string& command);

Json document_of(const Comparison& comparison, const Source& first, const Source& second);

}  // namespace gloam::report
