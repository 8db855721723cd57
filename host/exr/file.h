// An open EXR file, and the views, planes and windows that its headers describe.
#pragma once

#include <OpenEXR/ImfMultiPartInputFile.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "exr/box.h"
#include "exr/channel_names.h"
#include "exr/headers.h"
#include "exr/stream.h"
#include "gloam/exr.h"

namespace gloam {

struct ExrFile {
  std::filesystem::path path;
  ReadOptions options;
  std::unique_ptr<ExrInput> stream;
  std::unique_ptr<Imf::MultiPartInputFile> parts;
  uint64_t end_of_headers = 0;  ///< bytes from the start
  Headers headers;
  NamedPlanes names;
  Window display, window;  ///< `window`: the one that frames cover
  double pixel_aspect = 1;
  std::vector<std::string> notes;  ///< assumptions about views and pixels, a sentence each

  /// The source of a view's plane; nullptr if there is none.
  const PlaneSource* source(const std::string& plane, const std::string& view) const;
  bool has(const std::string& plane, const std::string& view) const;
};

/// Reads the headers. Throws Error (one line, naming the file) for a file that is not an EXR, damaged, deep or too large, and for
/// views and channels of the options that the file lacks.
ExrFile open_exr(const std::filesystem::path& path, const ReadOptions& options);

/// Selects the planes of this view, as --view does.
void choose_view(ExrFile& file, const std::string& view);

/// Sets the window that frames of the file cover. Throws Error if it is too large.
void set_window(ExrFile& file, const Box& window);

}  // namespace gloam
