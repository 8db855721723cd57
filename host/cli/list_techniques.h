// What gloam tells of techniques: all of them one a line, one of them in full.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "cli/options.h"

namespace gloam::cli {

/// As the contract has it: range, default, choices.
Json parameter_document(const Parameter& parameter);
/// The default of a parameter for people.
std::string default_in_words(const Parameter& parameter);

/// A plane stands for the technique that makes it by default: "ao".
std::string technique_for(const std::string& name);

/// All that there is to know of them, for programs.
Json techniques_document(const std::vector<const Technique*>& techniques);
/// Names and summaries, those together that make the same.
void print_techniques();
/// Parameters, defaults, presets, what it reads and writes. `settable`: parameters that the command has as flags; the others
/// take --set.
void print_technique(const Technique& technique, const std::set<std::string>& settable);
/// docs/techniques.md: one section per technique.
void print_techniques_markdown();

}  // namespace gloam::cli
