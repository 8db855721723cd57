// What images are scored against: an item of a frozen set, or the user's own frames, with the truths of one effect.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gloam/exr.h"
#include "measure/measurement.h"

namespace gloam::score {

/// A frame and the files of its truth.
struct TargetFrame {
  int number = 1;
  std::filesystem::path frame;
  std::vector<std::string> truths;
  std::function<void()> check;  ///< throws Error for a file that is not the set's; empty: nothing to check
};

struct Target {
  std::string name;  ///< "courtyard"
  std::string kind;  ///< "frame", "sequence", "eyes", "display", "hard"; empty outside a set
  std::string scene_class = "own";
  std::string effect = "ao";
  std::optional<double> radius;    ///< as the set states it
  std::vector<std::string> views;  ///< names; empty: one without a name, or not known before the frame is opened
  bool is_sequence = false;
  std::string pattern;  ///< of a sequence's frames, "frames/walk.####.exr"; empty: their names have none in common
  std::vector<TargetFrame> frames;

  /// "courtyard", "walk frame 7"; with the effect where it is not ambient occlusion.
  std::string in_words(std::optional<int> frame = {}) const;
};

/// A frame with its truth, decoded.
struct LoadedFrame {
  Frame frame;  ///< depth, and where they are there normals and motion
  bench::Truth truth;
  bench::Foreground foreground;
  double exposure = 0;  ///< of a reflection, by its truth
  std::vector<std::string> views() const;
  /// Of its planes and its truth.
  unsigned long long bytes() const;
};

/// Bytes that `load` takes, by the headers of the files. Throws as that.
unsigned long long bytes_to_load(const TargetFrame& at, const std::string& effect, const ReadOptions& reading);

/// Throws Error: a file is not the set's, cannot be read, or has neither depth nor truth.
LoadedFrame load(const TargetFrame& at, const std::string& effect, const ReadOptions& reading,
                 std::vector<std::string>& notes);

/// What a report says of the scene, with a picture of its truth below `folder` (empty: without).
report::Scene facts_of(const Target& target, const LoadedFrame& first, const std::filesystem::path& folder);

/// Where `write_picture` puts a picture, below the folder: "images/courtyard/truth.png".
std::string picture_file(const Target& target, const std::string& name);
/// The name of the pictures of a method's images.
std::string submitted_picture(const std::string& method);

/// Writes a picture of one view as PNG below `folder`; returns its path there. Throws Error.
std::string write_picture(const std::filesystem::path& folder, const Target& target, const std::string& name,
                          const LoadedFrame& loaded, const bench::Image& image);

}  // namespace gloam::score
