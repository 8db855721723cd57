// An open EXR file and what its headers tell of views, planes and windows.
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
  Headers headers;
  NamedPlanes names;
  Window display, window;  ///< `window`: that frames cover
  double pixel_aspect = 1;
  std::vector<std::string> notes;  ///< what was assumed of views and pixels, a sentence each

  /// What serves as a plane of a view; nullptr where nothing does.
  const PlaneSource* source(const std::string& plane, const std::string& view) const;
  bool has(const std::string& plane, const std::string& view) const;
};

/// Reads the headers. Throws Error (one line, naming the file) for a file that is none, damaged, deep or too large, and for
/// views and channels of the options that the file does not have.
ExrFile open_exr(const std::filesystem::path& path, const ReadOptions& options);

/// Takes the planes of this view, as --view would.
void choose_view(ExrFile& file, const std::string& view);

/// Frames of the file will cover `window`. Throws Error where that is too large.
void set_window(ExrFile& file, const Box& window);

}  // namespace gloam
