// gloam info --sheet and --scan-line: one plane of all views as a picture.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/flags/options.h"

namespace gloam::cli {

struct ViewPictureFlags {
  std::string sheet, scan_line, what;
  std::optional<int> row;

  void add_to(CLI::App& app);
  bool any() const { return !sheet.empty() || !scan_line.empty(); }
  /// Throws UsageError for names without .png and for flags without the picture that they are for.
  void check() const;
  /// For `check_paths`.
  std::vector<NamedPath> outputs() const { return {{"--sheet", sheet}, {"--scan-line", scan_line}}; }
};

/// Writes the pictures asked for, and returns their files. Decodes only the plane, and the depth, which tells the background.
std::vector<std::string> write_view_pictures(const std::string& path, const ViewPictureFlags& flags,
                                             const FrameFlags& frame_flags);

}  // namespace gloam::cli
