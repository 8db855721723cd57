// Lists of techniques: all of them, one a line, or one in full.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "cli/flags/options.h"

namespace gloam::cli {

/// JSON as documented: range, default, choices.
Json parameter_document(const Parameter& parameter);
/// The default of a parameter for people.
std::string default_in_words(const Parameter& parameter);

/// Everything about techniques, for programs.
Json techniques_document(const std::vector<const Technique*>& techniques);
/// What a technique is listed under: "ambient occlusion", "masks, for --only".
const std::string& heading_of(const Technique& technique);
/// All headings, in the order of the list.
std::vector<std::string> technique_headings();
/// Prints names and summaries, grouped by the planes that techniques make.
void print_techniques();
/// Prints parameters, defaults, presets, and the planes that the technique reads and writes. `settable`: parameters that the
/// command has as flags; the others need --set.
void print_technique(const Technique& technique, const std::set<std::string>& settable);
/// Prints docs/techniques.md: one section per technique.
void print_techniques_markdown();

/// Prints the text that the compiler gets for a pass, by its name: of a technique's plan for a frame that has every plane
/// ("gtao/estimate"), or of what plans add ("temporal/accumulate"). Throws UsageError, with the nearest name, for an unknown one.
void print_kernel(const std::string& label);

}  // namespace gloam::cli
