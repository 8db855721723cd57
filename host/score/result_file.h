// The results that a submission joins: DIR/bench.json.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "score/entry.h"
#include "score/scoring.h"

namespace gloam::score {

/// Which set results are of.
struct SetId {
  std::string name, part, hash;
  std::optional<long long> seed;
};
Json document_of(const SetId& set);
/// "gloam-1 (public, hash 0123abcd)"
std::string in_words(const SetId& set);

/// How a method's command fared beside gloam's own, as whole processes.
struct WholeTimes {
  std::string command, gloam_command;
  std::vector<double> ms, gloam_ms;  ///< a round each
};
Json document_of(const WholeTimes& whole);

/// What a row says besides its figures.
struct RowDetails {
  std::optional<WholeTimes> whole;
  std::vector<std::string> scored_by;  ///< the command line
};

/// The row of a scored target.
Json row_of(const Scored& scored, const Entry& entry, const RowDetails& details);
/// The fit of a row: its values, and the figures of its images so.
Json document_of(const BestFit& fit, const Figures& figures, const std::string& effect);
Json scene_of(const Scored& scored);

/// Median, least and greatest, and every round.
Json milliseconds_of(const std::vector<double>& rounds);

class ResultFile {
 public:
  /// Reads what is there. `set`: none for frames of the user's own. Throws Error for a file that is no result of gloam, or of another
  /// set.
  ResultFile(const std::filesystem::path& folder, const std::optional<SetId>& set);

  std::filesystem::path path() const { return path_; }
  bool is_new() const { return is_new_; }
  /// Number of rows of an entry.
  size_t rows_of(const std::string& name) const;

  /// Adds a row and its scene, in place of the same entry's row on the same scene. Throws Error for a scene of the same name that is another.
  void put(Json row, Json scene);
  /// Gives a row its fit.
  void set_fit(const Json& row, Json fit);
  /// Removes an entry's rows that are not among `kept`, as pairs of scene and effect.
  void remove_others(const std::string& name, const std::vector<std::pair<std::string, std::string>>& kept);
  void write() const;
  const Json& document() const { return document_; }

 private:
  std::filesystem::path path_;
  Json document_;
  bool is_new_ = true;
};

}  // namespace gloam::score
