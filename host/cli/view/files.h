// The files that `gloam view` shows: frames, results and truths, alone or as shots.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/flags/options.h"
#include "sequence/frame_list.h"

namespace gloam::cli {

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
  FrameFlags frame_flags;
  FrameChoice frames;
  bool as_stored = false, as_read = false;
};

/// Opens every file once and reads its headers. The first planes of a file are results that the other files have too, then others of them.
/// Throws UsageError for a plane that no file has, and for --frames without a shot; Error for files that are missing or cannot be
/// read, and for one without any plane to show.
std::vector<ViewedFile> viewed_files(const ViewChoice& choice);

/// Peak memory, bytes, of reading the frame that takes most.
unsigned long long bytes_to_view(const std::vector<ViewedFile>& files);

/// The planes to read of a frame: those to show, and the depth, which tells the background.
std::vector<std::string> planes_to_read(const ViewedFrame& frame, const FrameFile& file);

}  // namespace gloam::cli
