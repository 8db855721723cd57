// What gloam score prints.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "cli/flags/options.h"
#include "score/scoring.h"

namespace gloam::cli {

/// A scored target with its figures at the best fit, and its whole times.
struct ScoredRow {
  score::Scored scored;
  std::optional<score::Figures> at_fit;
  Json row;
};

/// One line for each item and frame that was left out, on standard error, though --quiet: they are errors.
void tell_left_out(const std::vector<score::LeftOut>& left_out);

void print_scores(const score::Entry& entry, const std::vector<ScoredRow>& rows,
                  const std::map<std::string, score::BestFit>& fits);

/// For --json -.
Json scores_document(const score::Entry& entry, const std::vector<ScoredRow>& rows,
                     const std::map<std::string, score::BestFit>& fits, const std::vector<score::LeftOut>& left_out);

}  // namespace gloam::cli
