// Figures of a submission's images against the truths.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "measure/similarity.h"
#include "score/entry.h"
#include "score/fit.h"
#include "score/submitted_files.h"
#include "score/target.h"

namespace gloam::score {

/// Means over the frames, which count alike.
struct Figures {
  double rmse = 0, bias = 0, ssim = 0;
  std::optional<double> flip, flicker, inconsistency;
  std::map<std::string, Metrics> views;    ///< of the first frame, where it has several views
  std::optional<double> rmse_at_own_size;  ///< of an image of a lower resolution, to the truth's means there
};

/// One target, scored.
struct Scored {
  Target target;
  Figures figures;
  std::vector<int> frames, missing;  ///< numbers of the frames that were scored, and of those left out
  report::Scene scene;
  std::string picture;  ///< below the folder; empty: none
};

/// Why an item or a frame was left out.
struct LeftOut {
  std::string item;  ///< "courtyard", "walk frame 7"
  std::string why;
};

struct ScoringOptions {
  std::filesystem::path folder;  ///< of images/; empty: no pictures
  ReadOptions frames;            ///< how frames are read
  ReadOptions images;            ///< how images are read
  /// Throws Error for a file that takes more memory than it may, given what is held besides. Empty: all may be read.
  std::function<void(const std::string& file, unsigned long long bytes)> afford = {};
};

/// Gives the files of a frame's image. Throws Error where there are none that can be scored.
using FilesOf = std::function<std::vector<SubmittedFile>(const Target&, const TargetFrame&)>;

class Scoring {
 public:
  Scoring(const Entry& entry, ScoringOptions options) : entry_(entry), options_(std::move(options)) {}

  /// The figures of a target; none if nothing of it could be scored. What was left out is listed.
  std::optional<Scored> score(const Target& target, const FilesOf& files_of);

  /// The best fit over all targets of an effect so far; none where nothing can be fitted.
  std::optional<BestFit> best_fit(const std::string& effect) const;

  /// The figures of a target's images as a fit makes them; none if they cannot be read again.
  std::optional<Figures> score_fitted(const Target& target, const FilesOf& files_of, const BestFit& fit);

  /// What the images look like where it is not what the entry states: inverted, encoded for a screen, of another scale. One line each.
  std::vector<std::string> doubts() const;

  const std::vector<LeftOut>& left_out() const { return left_out_; }
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  struct Walked;
  using Transform = std::function<bench::Image(const bench::Image&)>;
  std::optional<Walked> walk(const Target& target, const FilesOf& files_of, const Transform& transform, bool is_first);
  bench::Image plain_image(const Target& target, const LoadedFrame& loaded, const std::vector<SubmittedFile>& files,
                           std::optional<double>& rmse_at_own_size);
  void afford(const std::string& file, unsigned long long bytes) const;
  void note_radius(const Target& target, const LoadedFrame& loaded);
  void add_to_fit(const Target& target, const TargetFrame& at, const LoadedFrame& loaded, const bench::Image& image);

  const Entry& entry_;
  const ScoringOptions options_;
  std::map<std::string, FitSums> fits_;                       ///< by effect
  std::map<std::string, std::vector<std::string>> inverted_;  ///< images that look inverted, by effect
  std::vector<LeftOut> left_out_;
  std::vector<std::string> notes_;
};

}  // namespace gloam::score
