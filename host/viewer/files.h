// The files that a page shows: frames, results and truths, alone or as shots.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gloam/exr.h"
#include "sequence/frame_list.h"

namespace gloam::viewer {

/// A frame's file, and how it is read.
struct ViewedFrame {
  std::string path;
  std::optional<int> number;  ///< of a shot's frame
  ReadOptions options;
  std::vector<std::string> planes;  ///< those to show, in order
  std::string holdings;             ///< what it has, where none of that can be shown
  unsigned long long bytes = 0;     ///< of memory at the peak of reading and packing it
};

/// One argument of the command.
struct ViewedFile {
  std::string name;  ///< as shown
  bool is_shot = false;
  std::vector<ViewedFrame> frames;
  std::vector<std::string> planes() const;  ///< of any frame
};

/// What is shown of the files.
struct ViewChoice {
  std::vector<std::string> files, planes;  ///< `planes`: empty for all
  ReadOptions reading;
  FrameChoice frames;
  bool as_stored = false, as_read = false;
  int step = 1;       ///< the page keeps every `step`-th pixel of every `step`-th row
  bool half = false;  ///< the page rounds values to half
};

/// Opens every file once and reads its headers. Appends to `notes` what is said of frames of a shot. The first planes of a file are results that the other files have too, then others of them.
/// Throws UsageError for a plane that no file has, and for a choice of frames without a shot; Error for files that are missing or cannot be
/// read, and for one without any plane to show.
std::vector<ViewedFile> viewed_files(const ViewChoice& choice, std::vector<std::string>& notes);

/// Peak memory, bytes, of reading the frame that takes most.
unsigned long long bytes_to_view(const std::vector<ViewedFile>& files);

int frames_in(const std::vector<ViewedFile>& files);

/// Is told how many frames are in the page.
using ViewProgress = std::function<void(int done, int of)>;

/// Writes the page, and returns its bytes. Appends to `notes` what is not as in the files, and for a page that browsers open slowly.
unsigned long long write_page(const std::filesystem::path& path, const std::vector<ViewedFile>& files,
                              const ViewChoice& choice, const ViewProgress& progress, std::vector<std::string>& notes);

}  // namespace gloam::viewer
