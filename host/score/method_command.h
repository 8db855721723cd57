// A method's own program makes the images, and is timed whole beside gloam.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "score/result_file.h"
#include "score/scoring.h"

namespace gloam::score {

/// What makes the images.
struct MethodOptions {
  std::string command;  ///< "engine --in {frame} --out {image}"
  std::string device;   ///< for gloam's own runs
  std::string image_type = "exr";
  double timeout = 600;
  int rounds = 3;
};

/// Runs the command for frames when their images are asked for, once each; the images stay in a folder. They are made in another one
/// beside it, so that an earlier image stays until there is a new one.
class MethodCommand {
 public:
  /// `folder`: of the images, made when the first one is. Throws UsageError for a command that cannot be run so.
  MethodCommand(const MethodOptions& flags, const std::filesystem::path& folder);

  /// Of the images of a target and, where the command asks for them, its cameras: none of them may be a file that is read.
  void tell_ledger(const Target& target) const;

  /// The images of a frame. Throws Error where the command fails, hangs, or leaves no image.
  std::vector<SubmittedFile> files_of(const Target& target, const TargetFrame& at);

  /// The command in turn with gloam's own technique on the same frame, each as a whole process, in rounds; frame by frame for a
  /// sequence. None, with a note, where one of them fails.
  std::optional<WholeTimes> time(const Target& target, std::vector<std::string>& notes);

 private:
  struct Made {
    std::vector<SubmittedFile> files;
    std::string failure;  ///< empty: made
  };
  /// What a command makes in one run.
  struct Job {
    std::vector<std::string> words;
    std::string image;  ///< its name
    std::string view;
  };
  bool has(const char* placeholder) const;
  /// Whether one run makes the images of all frames.
  bool is_whole(const Target& target) const;
  /// `folder`: that the images are made in.
  std::vector<Job> jobs_for(const Target& target, const TargetFrame& at, const std::filesystem::path& folder) const;
  /// The names of the images that a job makes.
  std::vector<std::string> names_of(const Target& target, const Job& job) const;
  std::map<std::string, std::string> values_for(const Target& target, const TargetFrame& at, const std::string& view,
                                                const std::filesystem::path& image,
                                                const std::filesystem::path& images) const;
  std::string image_of(const Target& target, const std::string& frame, const std::string& view) const;
  std::filesystem::path camera_of(const Target& target, const TargetFrame& at) const;
  Made make(const Target& target, const TargetFrame& at);
  double milliseconds_of(const Target& target, const TargetFrame& at) const;
  std::vector<std::string> own_words(const Target& target, const TargetFrame& at,
                                     const std::filesystem::path& folder) const;

  const MethodOptions flags_;
  const std::vector<std::string> words_;
  const std::filesystem::path folder_;
  std::map<std::string, Made> made_;
};

}  // namespace gloam::score
