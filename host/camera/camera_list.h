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

/// What tells the number of an image that is no frame of a shot's pattern.
struct ImageNumbers {
  std::string image;           ///< file name, for messages
  std::optional<int> by_name;  ///< the last digits of the file's name
  std::optional<int> by_header;
};

/// The text of the camera of one image, from a JSON with a camera for each frame: that of the frame by the image's name, else by its
/// header; of a list with the same camera for all frames that of any, where nothing tells another frame. None if the file is another
/// JSON. Adds a note where the name did not tell, and where name and header tell different cameras. Throws Error naming the file if it
/// cannot be read, or if none of its cameras is known to be the image's.
std::optional<std::string> camera_text_of_image(const std::filesystem::path& file, const ImageNumbers& numbers,
                                                std::vector<std::string>& notes);

}  // namespace gloam
