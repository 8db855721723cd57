#include "sequence/pattern_reads.h"

#include <vector>

#include "base/file_identity.h"
#include "base/file_ledger.h"
#include "camera/camera_search.h"
#include "gloam/error.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;

/// Whether a file lies in the folder of a pattern, whatever either is called.
bool is_beside(const fs::path& file, const FramePattern& pattern) {
  const fs::path folder = file.parent_path().empty() ? fs::path(".") : file.parent_path();
  return are_same_file(folder, pattern.folder());
}

/// None where the folder cannot be read: then there is nothing to lose.
std::vector<int> frames_there(const FramePattern& pattern) {
  try {
    return pattern.frames_there();
  } catch (const Error&) {
    return {};
  }
}

/// Empty if the file is the camera of no frame.
std::string as_camera_of(const FramePattern& pattern, const fs::path& file) {
  if (!is_beside(file, pattern) || !may_be_camera_file(file)) return "";
  for (const int frame : frames_there(pattern)) {
    try {
      const auto found = find_camera_file(pattern.path_of(frame));
      if (found && are_same_file(*found, file)) return fmt::format("the camera file of frame {}", frame);
    } catch (const Error&) {  // two files could be its camera; told when the frame is read
    }
  }
  return "";
}

}  // namespace

void reads_pattern(const FramePattern& pattern) {
  if (!has_file_ledger()) return;
  const auto in_words = [text = pattern.text()](int frame) { return fmt::format("frame {} of {}", frame, text); };
  for (const int frame : frames_there(pattern)) reads_file(pattern.path_of(frame), in_words(frame));
  reads_names([pattern, in_words](const fs::path& output) {
    const std::optional<int> frame = pattern.frame_of(output.filename().string());
    return frame && is_beside(output, pattern) ? in_words(*frame) : "";
  });
}

void reads_cameras_beside(const FramePattern& pattern) {
  reads_names([pattern](const fs::path& output) { return as_camera_of(pattern, output); });
}

}  // namespace gloam
