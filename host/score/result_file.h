// The results that measurements and submissions join: DIR/bench.json.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/file_lock.h"
#include "results/measurements.h"
#include "score/entry.h"
#include "score/scoring.h"

namespace gloam::score {

/// "gloam-1 (public, hash 0123abcd)"
std::string in_words(const report::SetFacts& set);

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

/// What a result file holds: rows of gloam's own, those that were submitted, and the scenes of both.
class Results {
 public:
  /// `name`: of the file, for messages. Throws Error for a text that `gloam report` would not read either.
  Results(const std::string& text, std::string name);
  /// Without a row. `set`: empty for frames of the user's own.
  Results(const report::SetFacts& set, std::string name);

  /// Number of rows of an entry.
  size_t rows_of(const std::string& entry) const;
  /// Number of rows that gloam measured; those of a shot, or of a paper's tables, count too.
  size_t measured_rows() const;
  /// Throws Error if another method has rows whose files would be called as those of this one.
  void check_files_of(const std::string& entry) const;

  /// Adds a row and its scene, in place of the same entry's row on the same scene. Throws Error for a scene of the same name that is another.
  void put(Json row, Json scene);
  /// Gives a row its fit.
  void set_fit(const Json& row, const Json& fit);
  /// Removes an entry's rows that are not among `kept`, as pairs of scene and effect.
  void remove_others(const std::string& entry, const std::vector<std::pair<std::string, std::string>>& kept);
  /// Replaces all but the submitted rows and their scenes by what gloam measured. Throws Error as `check_scene`.
  void put_measured(Json measured);
  /// Throws Error if submitted rows are on a scene of this name that is another.
  void check_scene(const Json& scene) const;

  const Json& document() const { return document_; }

 private:
  friend class ResultFile;
  Json document_;
  std::string name_;
  report::SetFacts set_;  ///< that the rows are of; empty: none
};

/// DIR/bench.json, which several commands and processes add to.
class ResultFile {
 public:
  /// Reads what is there. Throws Error for a file that is no result of gloam, or of another set.
  ResultFile(const std::filesystem::path& folder, const report::SetFacts& set);

  std::filesystem::path path() const { return path_; }
  bool is_new() const { return is_new_; }
  /// What was there when this object was made.
  const Results& found() const { return found_; }

  /// Changes the file as it is now, and replaces it whole. Other processes wait meanwhile, so that none loses what another has added.
  /// Throws Error as the constructor does, and if another process does not come to an end.
  void update(const std::function<void(Results&)>& change) const;

 private:
  Results read() const;

  std::filesystem::path path_;
  report::SetFacts set_;
  bool is_new_ = true;
  Results found_;
};

/// While gloam's own techniques are measured into a folder. Results that were submitted may join meanwhile; a second measurement, which would
/// replace the first and disturb its times, is refused. Throws Error.
class MeasuringAlone {
 public:
  explicit MeasuringAlone(const std::filesystem::path& folder);

 private:
  FileLock lock_;
};

}  // namespace gloam::score
