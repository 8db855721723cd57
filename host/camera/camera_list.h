// One camera JSON for each frame of a sequence, in one file.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace gloam {

/// The JSON {"frames": {"1001": CAMERA, ...}}, or {"frames": [CAMERA, ...]} in the order of the frames. CAMERA is a camera
/// JSON; a field that it lacks is that of the top.
class CameraList {
 public:
  /// The list of a file; none if the file is a JSON without "frames". Throws Error naming the file if it cannot be read, for
  /// "frames" of another form, for a list in order that has another number of cameras than there are `frames`, and for frames
  /// without a camera.
  static std::optional<CameraList> of_file(const std::filesystem::path& file, const std::vector<int>& frames);

  /// The text of a frame's camera JSON.
  const std::string& text_of(int frame) const { return texts_.at(frame); }

  /// Whether it is in the order of the frames, without their numbers.
  bool is_in_order() const { return is_in_order_; }

 private:
  bool is_in_order_ = false;
  std::map<int, std::string> texts_;
};

/// The text of the camera of one frame, from a JSON with a camera for each frame by number; none if the file is another JSON. Throws
/// Error naming the file if it cannot be read, or has no camera for the frame.
std::optional<std::string> camera_text_of_frame(const std::filesystem::path& file, int frame);

}  // namespace gloam
