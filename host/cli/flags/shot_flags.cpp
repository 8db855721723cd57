#include "cli/flags/shot_flags.h"

#include "cli/flags/memory.h"
#include "cli/process/chunk_commands.h"
#include "flags/typed.h"
#include "gloam/frame_numbers.h"

namespace gloam::cli {
namespace {

constexpr const char* shots_heading = "Shots";

/// Adds --chunks, --print and --warm-up.
void add_chunks(CLI::App& app, ShotFlags& flags) {
  add_chunk_flags(app, flags.chunks, flags.print, "a shot", shots_heading);
  add_number(app, "--warm-up", flags.warm_up, {0, 1000000},
             "with --temporal: this many of the first frames are computed for those that follow, and not written", "N")
      ->group(shots_heading);
}

}  // namespace

void add_frames(CLI::App& app, FrameChoice& choice) {
  add_parsed(app, "--frames", choice.frames, parse_frame_numbers,
             "frames of a shot: 1001-1100, 1-99x2 or 1,5,9-12; default: all", "A-B")
      ->group(shots_heading);
}

void add_missing(CLI::App& app, FrameChoice& choice) {
  add_choice(app, "--missing", choice.missing, missing_words,
             "frames that are not there: refuse (the default), leave out, or take the nearest one before")
      ->group(shots_heading);
}

void add_missing_without_hold(CLI::App& app, FrameChoice& choice) {
  choice.may_hold = false;
  add_choice(app, "--missing", choice.missing, {{"error", MissingFrames::error}, {"skip", MissingFrames::skip}},
             "frames that are not there: refuse (the default) or leave out")
      ->group(shots_heading);
}

void add_resume(CLI::App& app, bool& resume) {
  app.add_flag("--resume", resume, "leave frames alone that are whole and were made in the same way")
      ->group(shots_heading);
}

void ShotFlags::add_to(CLI::App& app, bool divides) {
  const Heading heading(app, shots_heading);
  add_frames(app, choice);
  add_missing(app, choice);
  add_resume(app, resume);
  add_text(app, "--memory", memory, "4G|512M",
           "most memory for a shot: it decides how many frames are worked on at once")
      ->check(accepted_by(parse_memory, "--memory"));
  if (divides) add_chunks(app, *this);
  app.add_flag("--keep-depth", keep_depth, "also write the frame's depth, and of two eyes normals");
  add_keep_margin(app, keep_margin);
  app.add_flag("--float", as_float, "write AO and the like as float instead of half");
}

void add_keep_margin(CLI::App& app, bool& keep_margin) {
  app.add_flag("--keep-margin", keep_margin,
               "of a frame with a margin: write the whole data window, instead of the display window");
}

std::string ShotFlags::any() const {
  if (choice.frames) return "--frames";
  if (choice.missing) return "--missing";
  if (resume) return "--resume";
  if (!memory.empty()) return "--memory";
  if (chunks > 0) return "--chunks";
  return warm_up > 0 ? "--warm-up" : "";
}

}  // namespace gloam::cli
