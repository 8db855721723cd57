// Flags and arguments that say which frame is read, and how.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

#include "gloam/exr.h"
#include "gloam/frame_files.h"

namespace gloam::cli {

/// A path with what it is on the command line: {"-o", "out.exr"}.
using NamedPath = std::pair<std::string, std::string>;

/// How to read a frame.
struct FrameFlags {
  std::string camera, depth = "auto", normal_space = "auto", view, views;
  std::vector<std::string> planes;
  std::string fov, near, far, background, limit_memory;
  void add_to(CLI::App& app);
  /// Throws UsageError for values out of range.
  ReadOptions read_options() const;
};

/// The arguments of a command that takes a frame in one file, or its two eyes in two.
struct FrameArguments {
  std::string frame, other_eye, history;
  void add_to(CLI::App& app);
  /// What they name, history included.
  FrameFiles open(const ReadOptions& options) const;
  /// For `check_paths`.
  std::vector<NamedPath> inputs() const {
    return {{"the frame", frame}, {"the frame", other_eye}, {"--history", history}};
  }
};

}  // namespace gloam::cli
