// The viewer: planes of frames in one self-contained HTML page, with every value as the file has it.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/files.h"
#include "gloam/frame.h"

namespace gloam::viewer {

struct PageOptions {
  std::string title;   ///< the files' names
  std::string values;  ///< a sentence: what is converted of the files' values
  int step = 1;        ///< keeps every `step`-th pixel of every `step`-th row
  bool half = false;   ///< rounds values to half, except identities and channels with values beyond its range
};

/// What a page says of a frame besides its values.
struct FrameTexts {
  std::string name;                                             ///< of the file
  std::optional<int> number;                                    ///< of a shot's frame
  std::vector<std::pair<std::string, std::string>> cameras;     ///< view, camera in words
  std::vector<std::pair<std::string, std::string>> facts;       ///< "depth": "ray", ...
  std::vector<std::pair<std::string, std::string>> attributes;  ///< of the header
  /// By view and plane: the part of the frame's window that the file has; the page has no values elsewhere.
  std::map<std::pair<std::string, std::string>, Window> windows;
};

/// Pages beyond this are refused: browsers fail on them.
inline constexpr unsigned long long most_page_bytes = 1ull << 30;
/// The longest text that they hold, with some room.
inline constexpr unsigned long long most_element_bytes = 500ull << 20;
/// From here on opening the page takes seconds.
inline constexpr unsigned long long large_page_bytes = 150ull << 20;

/// What makes a page smaller, in words.
std::string ways_to_smaller_pages();

/// Writes a page frame by frame, so that one frame is in memory at a time.
class PageWriter {
 public:
  /// Writes the head of the page. `out` must outlive the writer.
  PageWriter(NewFile& out, PageOptions options);

  /// Begins a file of one frame, or of a shot. `name`: as shown.
  void begin_file(const std::string& name, bool is_shot);
  /// Adds a frame to the last file. `planes`: those to show, in this order; the depth, if the frame has it, also tells the
  /// background. Throws Error if the page becomes larger than browsers open.
  void add(const Frame& frame, const std::vector<std::string>& planes, const FrameTexts& texts);
  /// Writes the end of the page.
  void finish();

  unsigned long long bytes() const { return bytes_; }
  /// Sentences: what could not be rounded to half.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  void append(const std::string& text);
  /// Writes data into an element of its own and returns its number.
  int put(const std::string& text);
  nlohmann::ordered_json put_plane(const Frame& frame, const View& view, const Plane& plane, const FrameTexts& texts);
  nlohmann::ordered_json put_view(const Frame& frame, const View& view, const std::vector<std::string>& planes,
                                  const FrameTexts& texts);

  NewFile& out_;
  PageOptions options_;
  nlohmann::ordered_json files_;
  std::vector<std::string> notes_;
  unsigned long long bytes_ = 0;
  int elements_ = 0;
};

}  // namespace gloam::viewer
