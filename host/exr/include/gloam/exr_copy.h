// Copies of EXR files with planes of gloam beside all that the files hold.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gloam/exr.h"
#include "gloam/frame.h"

namespace gloam {

/// The content of parts that hold a finished picture: readers do not take it for the frame's own colour.
inline constexpr const char* composite_content = "composite";

/// Planes for a copy of a file: all that the frame's views have.
struct AddedPlanes {
  std::string
      content;  ///< names their parts: "ao" for "gloam.ao", or "gloam.ao.left" and "gloam.ao.right" of two views
  const Frame* frame;
  WriteOptions writing;
};

/// Writes a copy of the EXR file `original` with further parts: one for each view of each of `added`. Every part of the original
/// stays bit for bit: its blocks are copied as they are compressed, with all its attributes. A part of the original that has the
/// name of a new one is left out. Cameras are those of the original: new parts have none. Written like `write_frame`, and throws as
/// that does, and Error naming the original if it cannot be copied. Returns notes, a sentence each.
std::vector<std::string> write_copy(const std::filesystem::path& path, const std::filesystem::path& original,
                                    const std::vector<AddedPlanes>& added);

/// As `write_frame`, with all attributes of a part of `original` that tell of more than how it is stored, and that the frame does not
/// write itself: chromaticities, time code, the renderer's own; but not those of a Cryptomatte, whose channels the frame lacks.
void write_frame_like(const std::filesystem::path& path, const std::filesystem::path& original, int part,
                      const Frame& frame, const WriteOptions& options);

}  // namespace gloam
