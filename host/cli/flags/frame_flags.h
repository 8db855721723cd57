// Flags and arguments for the frame to read, and for how to read it.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gloam/exr.h"
#include "gloam/frame_files.h"
#include "sequence/frame_list.h"

namespace gloam::cli {

/// A path with its name on the command line: {"-o", "out.exr"}.
using NamedPath = std::pair<std::string, std::string>;

/// How to read a frame.
struct FrameFlags {
  std::string camera, view, views, limit_memory;
  std::vector<std::string> planes;
  std::optional<double> fov, near, far, background;
  DepthConvention depth = DepthConvention::automatic;
  std::optional<double> depth_scale, depth_offset;
  DepthBytes depth_bytes = DepthBytes::automatic;
  std::optional<DepthEncoding> depth_encoding;
  NormalConvention normals;
  std::string depth_file, normal_file, color_file;
  std::vector<std::string> plane_files;
  void add_to(CLI::App& app);
  /// Throws UsageError for malformed planes and views.
  ReadOptions read_options() const;
  /// Whether they say what the depth is, or where it ends.
  bool changes_depth() const;
};

/// The flags given to a command that say how a frame is read.
std::vector<const CLI::Option*> reading_flags(const CLI::App& app);
/// The same as text, with a space before each, for a command line that is told.
std::string reading_text(const CLI::App& app);
/// Throws UsageError for such a flag but for those of `allowed`: frames of a set say themselves how they are read.
void check_no_reading_flags(const CLI::App& app, const std::vector<std::string>& allowed = {});
/// Throws UsageError for --frames, which is for a shot, with one frame.
void check_no_frames(const FrameChoice& choice, const std::string& frame);

/// The arguments of a command that takes a frame in one file, or its two eyes in two.
struct FrameArguments {
  std::string frame, other_eye, history;
  void add_to(CLI::App& app);
  /// The one or two files of the frame.
  std::vector<std::string> files() const;
  /// Whether one of them names the frames of a shot.
  bool has_pattern() const;
  /// Opens the named files, history included.
  FrameFiles open(const ReadOptions& options) const;
  /// For `check_paths`.
  std::vector<NamedPath> inputs() const {
    return {{"the frame", frame}, {"the frame", other_eye}, {"--history", history}};
  }
};

}  // namespace gloam::cli
