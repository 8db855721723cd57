#include "viewer/files.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "base/files.h"
#include "base/lists.h"
#include "base/memory.h"
#include "compare/plane_pairs.h"
#include "exr/camera_facts.h"
#include "exr/holdings.h"
#include "exr/options_beside.h"
#include "exr/plane_facts.h"
#include "gloam/error.h"
#include "gloam/frame_pattern.h"
#include "gloam/option.h"
#include "gloam/planes.h"
#include "sequence/sequence_files.h"
#include "shot/memory.h"
#include "viewer/page.h"

namespace gloam::viewer {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

ReadOptions read_options(const ViewChoice& choice) {
  ReadOptions options = choice.reading;
  options.only_looks = true;
  options.as_stored = !choice.as_read;
  options.unconverted = choice.as_stored;
  return options;
}

/// Options for the file at `place`: flags that name channels and views are about the first.
ReadOptions options_of(const ReadOptions& options, size_t place, const std::string& path) {
  return place == 0 ? options : options_beside(options, path);
}

ViewedFile file_of(const ViewChoice& choice, size_t place, std::vector<std::string>& notes) {
  const std::string& path = choice.files[place];
  const ReadOptions options = read_options(choice);
  if (!FramePattern::is_pattern(path)) return {path, false, {{path, {}, options_of(options, place, path), {}, {}, 0}}};
  const SequenceFiles shot({FramePattern(path, "FILE")}, choice.reading, choice.frames, notes);
  ViewedFile file{path, true, {}};
  for (const SequenceFrame& frame : shot.frames()) {
    const std::string of_frame = shot.paths_of(frame).front();
    ReadOptions own = options;
    const ReadOptions cameras = shot.options_for(frame);
    own.camera_file = cameras.camera_file;
    own.camera_text = cameras.camera_text;
    own.plane_files = cameras.plane_files;
    file.frames.push_back({of_frame, frame.number, options_of(own, place, of_frame), {}, {}, 0});
  }
  return file;
}

/// Planes of any view, results first. A depth that would be made of positions is not in the file as stored.
Names planes_in(const FrameFile& file, bool as_stored) {
  Names all, sorted;
  for (const PlaneSource& source : file.planes())
    if (!as_stored || source.said != DeclaredConvention::made_of_positions) add_new(all, source.plane);
  add_new(sorted, results_among(all));
  add_new(sorted, inputs_among(all));
  return sorted;
}

/// Whether a plane was asked for: by its name, or as a layer of a stack.
bool is_asked(const std::string& plane, const Names& asked) {
  const std::optional<StackLayer> layer = stack_layer(plane);
  return asked.empty() || contains(asked, plane) || (layer && contains(asked, layer->stack));
}

Names asked_of(const Names& planes, const Names& asked) {
  Names some;
  std::copy_if(planes.begin(), planes.end(), std::back_inserter(some),
               [&](const std::string& plane) { return is_asked(plane, asked); });
  return some;
}

Names with_depth(Names planes, const ReadOptions& options, const FrameFile& file) {
  for (const PlaneSource& source : file.planes())
    if (source.plane == "depth" && !options.unconverted) add_new(planes, "depth");
  return planes;
}

/// A plane's bytes, what they are packed into, and that as text, of four channels at once.
unsigned long long bytes_at_peak(const FrameFile& file, const Names& planes) {
  const unsigned long long channel =
      4ull * (unsigned long long)file.window().width() * (unsigned long long)file.window().height();
  return file.bytes_to_read(planes) + 4 * 3 * channel;
}

/// Fills in what the headers of a frame's file say.
void look_at(ViewedFrame& frame, const ViewChoice& choice) {
  const FrameFile file(frame.path, frame.options);
  frame.planes = planes_in(file, choice.as_stored);
  frame.bytes = bytes_at_peak(file, with_depth(asked_of(frame.planes, choice.planes), frame.options, file));
  if (frame.planes.empty()) frame.holdings = gloam::holdings(file);
}

/// Throws UsageError for a plane that no file has.
void check_asked(const ViewChoice& choice, const Names& all) {
  for (const std::string& asked : choice.planes) {
    const bool is_there =
        std::any_of(all.begin(), all.end(), [&](const std::string& plane) { return is_asked(plane, {asked}); });
    if (!is_there)
      throw UsageError("{}: no file has such a plane{}; there are {}", option("planes", asked), suggestion(asked, all),
                       all.empty() ? "none" : first_names(all));
  }
}

/// Keeps the planes asked for.
void choose_planes(ViewedFile& file, const Names& asked) {
  for (ViewedFrame& frame : file.frames) {
    const Names there = std::exchange(frame.planes, asked_of(frame.planes, asked));
    if (!frame.planes.empty()) continue;
    throw Error("{}: {}", frame.path,
                there.empty()
                    ? fmt::format("has no plane that gloam knows; {}; {} shows one as a plane", frame.holdings,
                                  channels_option("mask", "CHANNEL"))
                    : fmt::format("has none of {}; it has {}",
                                  option("planes", fmt::format("{}", fmt::join(asked, ","))), first_names(there)));
  }
}

/// Files of one name are told apart by their folders.
void name_files(std::vector<ViewedFile>& files) {
  std::map<std::string, int> count;
  for (const ViewedFile& file : files) ++count[fs::path(file.name).filename().string()];
  for (ViewedFile& file : files) {
    const fs::path path = fs::path(file.name).lexically_normal();
    const bool is_alone = count[path.filename().string()] == 1;
    file.name = is_alone ? path.filename().string() : (path.parent_path().filename() / path.filename()).string();
  }
}

/// Planes that most files have come first: those are compared.
void sort_planes(std::vector<ViewedFile>& files) {
  std::map<std::string, int> count;
  for (const ViewedFile& file : files)
    for (const std::string& plane : file.planes()) ++count[plane];
  for (ViewedFile& file : files)
    for (ViewedFrame& frame : file.frames)
      std::stable_sort(frame.planes.begin(), frame.planes.end(),
                       [&](const std::string& a, const std::string& b) { return count[a] > count[b]; });
}

/// The same for the page, which opens on the first: depth, which most files have, is what nobody comes for.
Names results_first(Names planes) {
  std::stable_partition(planes.begin(), planes.end(),
                        [](const std::string& plane) { return !results_among({plane}).empty(); });
  return planes;
}

std::vector<std::pair<std::string, std::string>> facts_of(const FrameFile& file, const ViewChoice& choice) {
  std::vector<std::pair<std::string, std::string>> facts;
  const auto add = [&](const char* name, const std::string& text) {
    if (!text.empty()) facts.emplace_back(name, text);
  };
  add("not shown", fmt::format("{}", fmt::join(unread_channels(file), ", ")));
  if (choice.as_stored) return facts;
  add("depth in the file", file.depth_convention());
  add("normals in the file", file.normal_space().empty() ? "" : file.normal_space() + " space");
  return facts;
}

FrameTexts texts_of(const FrameFile& file, const ViewedFrame& frame, const ViewChoice& choice) {
  FrameTexts texts;
  texts.name = file.path().filename().string();
  texts.number = frame.number;
  nlohmann::ordered_json cameras;
  add_cameras(file, frame.options, cameras);
  for (const auto& [view, camera] : cameras["cameras"].items()) texts.cameras.emplace_back(view, camera_line(camera));
  for (const PlaneSource& source : file.planes())
    texts.windows[{source.view, source.plane}] = file.data_window(source.plane, source.view);
  texts.facts = facts_of(file, choice);
  texts.attributes = file.attributes();
  return texts;
}

std::string values_in_words(const ViewChoice& choice) {
  if (choice.as_stored) return "Every value is as the file has it: nothing is converted.";
  const std::string converted =
      "Depth is the distance along the view axis, and normals are in view space, whatever the file has";
  if (!choice.as_read) return converted + "; all other values are as the file has them.";
  return converted + "; normals are unit, shares are from 0 to 1, and NaN is replaced: what techniques read.";
}

void add_frames_of(const std::vector<ViewedFile>& files, const ViewChoice& choice, const ViewProgress& progress,
                   PageWriter& page) {
  const int all = frames_in(files);
  int done = 0;
  for (const ViewedFile& viewed : files) {
    page.begin_file(viewed.name, viewed.is_shot);
    for (const ViewedFrame& frame : viewed.frames) {
      FrameFile file(frame.path, frame.options);
      const Frame read = file.read(with_depth(frame.planes, frame.options, file));
      page.add(read, results_first(frame.planes), texts_of(file, frame, choice));
      if (progress) progress(++done, all);
    }
  }
}

std::string title_of(const std::vector<ViewedFile>& files) {
  std::vector<std::string> names;
  for (const ViewedFile& file : files) names.push_back(file.name);
  return first_names(names);
}

}  // namespace

Names ViewedFile::planes() const {
  Names all;
  for (const ViewedFrame& frame : frames) add_new(all, frame.planes);
  return all;
}

std::vector<ViewedFile> viewed_files(const ViewChoice& choice, std::vector<std::string>& notes) {
  std::vector<ViewedFile> files;
  Names all;
  for (size_t i = 0; i < choice.files.size(); ++i) {
    ViewedFile file = file_of(choice, i, notes);
    for (ViewedFrame& frame : file.frames) look_at(frame, choice);
    add_new(all, file.planes());
    files.push_back(std::move(file));
  }
  const bool has_shot = std::any_of(files.begin(), files.end(), [](const ViewedFile& file) { return file.is_shot; });
  if (choice.frames.frames && !has_shot)
    throw UsageError("{}: is for a shot, and {} is one frame; write its number as in shot.####.exr", option("frames"),
                     choice.files.front());
  check_asked(choice, all);
  for (ViewedFile& file : files) choose_planes(file, choice.planes);
  name_files(files);
  sort_planes(files);
  return files;
}

unsigned long long bytes_to_view(const std::vector<ViewedFile>& files) {
  unsigned long long most = 0;
  for (const ViewedFile& file : files)
    for (const ViewedFrame& frame : file.frames) most = std::max(most, frame.bytes);
  return process_bytes + most;
}

int frames_in(const std::vector<ViewedFile>& files) {
  int count = 0;
  for (const ViewedFile& file : files) count += int(file.frames.size());
  return count;
}

unsigned long long write_page(const std::filesystem::path& path, const std::vector<ViewedFile>& files,
                              const ViewChoice& choice, const ViewProgress& progress, std::vector<std::string>& notes) {
  unsigned long long bytes = 0;
  write_atomically(path, [&](NewFile& out) {
    PageWriter page(out, {title_of(files), values_in_words(choice), choice.step, choice.half});
    add_frames_of(files, choice, progress, page);
    page.finish();
    add_new(notes, page.notes());
    bytes = page.bytes();
  });
  if (bytes > large_page_bytes)
    notes.push_back(fmt::format("the page has {}: a browser takes seconds to open it, and as much memory; {}",
                                memory_in_words(bytes), ways_to_smaller_pages()));
  return bytes;
}

}  // namespace gloam::viewer
