// Flags for frames in many files, whose names are patterns: shot.####.exr.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "sequence/frame_list.h"

namespace gloam::cli {

struct ShotFlags {
  FrameChoice choice;
  std::string memory;
  bool resume = false, keep_depth = false, keep_margin = false, as_float = false, print = false;
  int chunks = 0;   ///< 0: the shot is not divided
  int warm_up = 0;  ///< frames that are not written
  /// `divides`: with --chunks, --print and --warm-up.
  void add_to(CLI::App& app, bool divides = true);
  /// The first flag given that only a shot has; empty if there is none.
  std::string any() const;
};

/// Adds --frames.
void add_frames(CLI::App& app, FrameChoice& choice);
/// Adds --missing.
void add_missing(CLI::App& app, FrameChoice& choice);
/// The same for commands that measure: a frame held in place of another would be measured as if it were that one.
void add_missing_without_hold(CLI::App& app, FrameChoice& choice);
/// Adds --keep-margin.
void add_keep_margin(CLI::App& app, bool& keep_margin);
/// Adds --resume.
void add_resume(CLI::App& app, bool& resume);

}  // namespace gloam::cli
