// DIR/bench.json as commands that measure write it.
#pragma once

#include <filesystem>
#include <optional>

#include "cli/flags/options.h"
#include "measure/measurement.h"
#include "score/result_file.h"

namespace gloam::cli {

/// The results of a folder while gloam's own techniques are measured into it: these replace what was measured before, with a note, and what
/// `gloam score` has added stays.
class BenchFile {
 public:
  /// `set`: empty for scenes and frames of the user's own. Throws Error for a file that is no result or of another set, and while
  /// another process measures into the folder.
  explicit BenchFile(const std::filesystem::path& folder, const report::SetFacts& set = {});

  std::filesystem::path path() const { return file_.path(); }

  /// Before a subject is measured. Throws Error if the folder has submitted rows on a scene of this name that is another.
  void check(const bench::Subject& subject) const;

  /// Writes what was measured, with the notes so far.
  void write(const Json& measured) const;

 private:
  const score::MeasuringAlone alone_;
  const score::ResultFile file_;
};

}  // namespace gloam::cli
