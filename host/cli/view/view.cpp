// gloam view FILE...: frames, results and truths as one page for a browser
#include <algorithm>
#include <fstream>
#include <memory>

#include "cli/flags/memory.h"
#include "cli/flags/shot_flags.h"
#include "cli/process/browser.h"
#include "gloam/error.h"
#include "gloam/frame_pattern.h"
#include "viewer/files.h"

namespace gloam::cli {
namespace {

namespace fs = std::filesystem;
using viewer::ViewedFile;
using viewer::ViewedFrame;

struct ViewCommand {
  viewer::ViewChoice choice;
  FrameFlags frame_flags;
  std::string output;
  bool no_open = false;
  JsonFlag json;
};

// --- Where the page goes

/// frame.view.html for frame.exr, shot.view.html for shot.####.exr, beside the first file.
fs::path default_page(const std::string& first) {
  fs::path path = first;
  std::string stem = path.stem().string();
  if (FramePattern::is_pattern(first)) {
    stem = stem.substr(0, stem.find_first_of("#%"));
    while (!stem.empty() && std::string("._- ").find(stem.back()) != std::string::npos) stem.pop_back();
  }
  return path.replace_filename((stem.empty() ? "frames" : stem) + ".view.html");
}

/// A page of that name that gloam did not write is not lost by accident.
void check_is_ours(const fs::path& page) {
  std::ifstream file(page);
  std::string begin(2000, '\0');
  file.read(begin.data(), long(begin.size()));
  if (file.gcount() == 0 || begin.find("Made by gloam view") != std::string::npos) return;
  throw Error("{}: is there, and gloam view has not made it; -o names another page", page.string());
}

fs::path page_of(const ViewCommand& flags, const std::vector<ViewedFile>& files) {
  const fs::path page = flags.output.empty() ? default_page(flags.choice.files.front()) : fs::path(flags.output);
  std::vector<NamedPath> inputs;
  for (const ViewedFile& file : files)
    for (const ViewedFrame& frame : file.frames) inputs.push_back({"a file to show", frame.path});
  inputs.push_back({"--camera", flags.frame_flags.camera});
  check_paths(inputs, {{"-o", page.string()}, {"--json", flags.json.file()}});
  if (flags.output.empty()) check_is_ours(page);
  return page;
}

// --- What is said of the page

Json document_of(const std::vector<ViewedFile>& files, const fs::path& page, unsigned long long bytes, bool opened) {
  Json list = Json::array();
  for (const ViewedFile& file : files) {
    Json numbers = Json::array();
    for (const ViewedFrame& frame : file.frames)
      if (frame.number) numbers.push_back(*frame.number);
    list.push_back({{"name", file.name}, {"frames", numbers}, {"planes", file.planes()}});
  }
  return {{"page", page.string()}, {"bytes", bytes}, {"files", list}, {"opened", opened}};
}

/// Files that share no plane can be looked at, but not compared.
void note_nothing_in_common(const std::vector<ViewedFile>& files) {
  for (size_t i = 1; i < files.size(); ++i) {
    const std::vector<std::string> first = files[0].planes(), other = files[i].planes();
    if (std::none_of(other.begin(), other.end(), [&](const std::string& plane) { return contains(first, plane); }))
      note({fmt::format("{} and {} have no plane in common: {} beside {}", files[0].name, files[i].name,
                        first_names(first), first_names(other))});
  }
}

void view_command(const ViewCommand& flags) {
  viewer::ViewChoice choice = flags.choice;
  choice.reading = flags.frame_flags.read_options();
  std::vector<std::string> notes;
  const std::vector<ViewedFile> files = viewed_files(choice, notes);
  const fs::path page = page_of(flags, files);
  planned_memory(flags.frame_flags, files.front().name, bytes_to_view(files),
                 "--planes takes fewer planes, or shrink the frames");
  note(notes);
  note_nothing_in_common(files);
  const unsigned long long bytes = write_page(page, files, choice, progress_bar(), notes);
  note(notes);
  const bool opens = !flags.no_open && !flags.json.only_json() && has_browser();
  flags.json.write(document_of(files, page, bytes, opens), {page.string()});
  if (opens) open_in_browser(page);
  if (flags.json.only_json()) return;
  fmt::print("wrote {}: {}, {}, {:.1f} MB{}\n", printable(page.string()), counted(files.size(), "file"),
             counted(size_t(frames_in(files)), "frame"), double(bytes) / 1e6,
             opens ? "; xdg-open opens it" : "; open it in a browser");
}

}  // namespace

void add_view(CLI::App& app) {
  auto flags = std::make_shared<ViewCommand>();
  CLI::App* command = app.add_subcommand("view", "frames, results and truths as one page to look at and compare");
  add_text(*command, "files", flags->choice.files, "FILE.exr",
           "EXR files, or those of shots: 'shot.####.exr'; of several, any two are compared")
      ->required();
  add_text(*command, "-o,--output", flags->output, "PAGE.html",
           "the page; default: FILE.view.html beside the first file")
      ->group("Writing");
  add_parsed(
      *command, "--planes", flags->choice.planes,
      [](const std::string& text, const std::string& flag) { return split_list(text, flag); },
      "only these planes; peel and stochastic mean all their layers; default: all", "A,B");
  command->add_flag("--half", flags->choice.half,
                    "round values to half: a smaller page; default: every bit of the file's floats");
  add_number(*command, "--scale", flags->choice.step, {1, 64},
             "keep every N-th pixel of every N-th row, from 1 to 64: a smaller page; default: 1", "N");
  command->add_flag("--no-open", flags->no_open, "do not open the page in a browser")->group("Writing");
  CLI::Option* stored = command->add_flag("--as-stored", flags->choice.as_stored,
                                          "convert nothing: depth and normals too are shown as the file has them");
  command
      ->add_flag("--as-read", flags->choice.as_read,
                 "show what techniques read: unit normals, shares from 0 to 1, NaN replaced")
      ->excludes(stored);
  add_frames(*command, flags->choice.frames);
  add_missing_without_hold(*command, flags->choice.frames);
  flags->frame_flags.add_to(*command);
  flags->json.add_to(*command);
  command->footer(
      "Writes one file that needs no other and no network, and opens it where there is a display. Examples:\n"
      "  gloam view frame.exr\n"
      "  gloam view frame.exr ao.exr truth.exr -o look.html\n"
      "  gloam view ao.exr truth.exr --planes ao\n"
      "  gloam view 'shot.####.exr' 'ao.####.exr' --frames 1-24 --half --scale 2\n"
      "  gloam view display.exr --planes ao --views module00,module01");
  command->callback([flags] { view_command(*flags); });
}

}  // namespace gloam::cli
