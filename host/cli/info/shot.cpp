#include "cli/info/shot.h"

#include <algorithm>
#include <iterator>
#include <map>

#include "cli/flags/wrap.h"
#include "cli/info/verdict.h"
#include "exr/camera_facts.h"
#include "gloam/error.h"
#include "gloam/frame_numbers.h"
#include "gloam/frame_pattern.h"
#include "sequence/pattern_reads.h"

namespace gloam::cli {
namespace {

/// What a frame's headers say, or why they cannot be read.
struct FrameRow {
  int frame = 0;
  std::filesystem::path file;
  std::string size, error;
  std::vector<std::string> views, planes;
  std::string camera;
  FoundOnShotFrame found;
  std::string unused_camera;  ///< why a camera is not used that was given, or lies beside the frame; empty: none
};

/// "header"; of several views those that differ: "header, cam.json".
std::string camera_sources(const FrameFile& file) {
  std::vector<std::string> sources;
  for (const std::string& view : file.views()) {
    const std::optional<Camera> camera = file.camera(view);
    add_new(sources, camera ? camera->source : "none");
  }
  return fmt::format("{}", fmt::join(sources, ", "));
}

FrameRow row_of(int frame, const std::filesystem::path& path, const ReadOptions& options) {
  FrameRow row{frame, path, {}, {}, {}, {}, {}, {}, {}};
  row.found.frame = frame;
  try {
    FrameFile file(path, options);
    file.fit_cameras();
    row.size = fmt::format("{}x{}", file.display().width(), file.display().height());
    if (file.views() != std::vector<std::string>{""}) row.views = file.views();
    for (const PlaneSource& plane : file.planes()) add_new(row.planes, plane.plane);
    row.camera = camera_sources(file);
    Json cameras;
    add_cameras(file, options, cameras);
    row.found = found_on(frame, file, cameras.contains("camera_from") ? cameras["camera_from"].get<std::string>() : "");
    for (const std::string& sentence : file.camera_notes())
      if (sentence.starts_with("camera: ") && sentence.find("not used") != std::string::npos)
        row.unused_camera = sentence;
  } catch (const UsageError&) {
    throw;
  } catch (const Error& error) {
    row.error = error.what();
  }
  return row;
}

/// A property that some frames have in another form than most.
struct DifferenceInShot {
  std::string what, usual;
  std::map<std::string, std::vector<int>> others;  ///< frames, by their form
};

template <typename Property>
void add_difference(std::vector<DifferenceInShot>& differences, const std::vector<FrameRow>& rows,
                    const std::string& what, const Property& property) {
  std::map<std::string, std::vector<int>> forms;
  for (const FrameRow& row : rows) {
    if (row.error.empty()) forms[property(row)].push_back(row.frame);
  }
  if (forms.size() < 2) return;
  const auto usual = std::max_element(forms.begin(), forms.end(),
                                      [](const auto& a, const auto& b) { return a.second.size() < b.second.size(); });
  DifferenceInShot difference{what, usual->first, forms};
  difference.others.erase(usual->first);
  differences.push_back(difference);
}

std::vector<DifferenceInShot> differences_of(const std::vector<FrameRow>& rows) {
  std::vector<DifferenceInShot> differences;
  add_difference(differences, rows, "size", [](const FrameRow& row) { return row.size; });
  add_difference(differences, rows, "views",
                 [](const FrameRow& row) { return fmt::format("{}", fmt::join(row.views, ", ")); });
  std::vector<std::string> planes;
  for (const FrameRow& row : rows) add_new(planes, row.planes);
  for (const std::string& plane : planes)
    add_difference(differences, rows, "plane '" + plane + "'",
                   [&](const FrameRow& row) { return contains(row.planes, plane) ? "there" : "not there"; });
  return differences;
}

/// Of the frames asked for, else of those between the first and the last.
std::vector<int> missing_frames(const std::vector<FrameRow>& rows, const FrameChoice& choice) {
  std::vector<int> missing, there;
  for (const FrameRow& row : rows) there.push_back(row.frame);
  const auto is_there = [&](int frame) { return std::binary_search(there.begin(), there.end(), frame); };
  if (choice.frames) {
    std::remove_copy_if(choice.frames->begin(), choice.frames->end(), std::back_inserter(missing), is_there);
    return missing;
  }
  for (int frame = there.front(); frame < there.back(); ++frame) {
    if (!is_there(frame)) missing.push_back(frame);
  }
  return missing;
}

Json document_of(const std::string& pattern, const std::vector<FrameRow>& rows,
                 const std::vector<DifferenceInShot>& differences, const std::vector<int>& missing) {
  Json frames = Json::array(), differs = Json::array();
  for (const FrameRow& row : rows) {
    Json frame = {{"frame", row.frame}, {"file", row.file.string()}};
    if (row.error.empty())
      frame.update({{"size", row.size}, {"views", row.views}, {"planes", row.planes}, {"camera", row.camera}});
    else
      frame["error"] = row.error;
    frames.push_back(frame);
  }
  for (const DifferenceInShot& difference : differences)
    differs.push_back({{"what", difference.what}, {"usual", difference.usual}, {"others", difference.others}});
  return {{"pattern", pattern}, {"frames", frames}, {"missing", missing}, {"differs", differs}};
}

/// The command that computes ambient occlusion of the shot, beside it.
std::string command_for(const std::filesystem::path& pattern, const FrameChoice& choice, const std::string& reading) {
  std::filesystem::path out = pattern.parent_path() / ("ao_" + pattern.filename().string());
  std::string frames = choice.frames ? " --frames " + frames_in_words(*choice.frames) : "";
  frames.erase(std::remove(frames.begin() + std::min<size_t>(frames.size(), 10), frames.end(), ' '), frames.end());
  return printable(fmt::format("gloam ao {} -o {}{}{}", quoted_for_shell(pattern.string()),
                               quoted_for_shell(out.replace_extension(".exr").string()), frames, reading));
}

std::string verdict_of(const std::vector<FrameRow>& rows, const std::string& command) {
  std::vector<FoundOnShotFrame> found;
  for (const FrameRow& row : rows) found.push_back(row.found);
  return verdict_on_shot(found, command);
}

void print_shot(const std::string& pattern, const std::vector<FrameRow>& rows,
                const std::vector<DifferenceInShot>& differences, const std::vector<int>& missing) {
  fmt::print("{}: {}, {} to {}\n\n", printable(pattern), counted(rows.size(), "frame"), rows.front().frame,
             rows.back().frame);
  std::vector<std::vector<std::string>> table = {{"frame", "size", "camera", "views", "planes"}};
  for (const FrameRow& row : rows)
    table.push_back({std::to_string(row.frame), row.error.empty() ? row.size : "-", row.camera,
                     fmt::format("{}", fmt::join(row.views, ", ")),
                     row.error.empty() ? fmt::format("{}", fmt::join(row.planes, ", ")) : row.error});
  print_table(table, 5);
  if (!missing.empty() || !differences.empty()) fmt::print("\n");
  if (!missing.empty()) fmt::print("missing  {}\n", frames_in_words(missing));
  for (const DifferenceInShot& difference : differences) {
    for (const auto& [form, frames] : difference.others)
      fmt::print("differs  {}: {} in {}, and mostly {}\n", printable(difference.what), printable(form),
                 frames_in_words(frames), printable(difference.usual));
  }
}

/// The frames whose camera is not used, by the sentence that says why.
std::map<std::string, std::vector<int>> unused_cameras(const std::vector<FrameRow>& rows) {
  std::map<std::string, std::vector<int>> frames;
  for (const FrameRow& row : rows)
    if (!row.unused_camera.empty()) frames[row.unused_camera].push_back(row.frame);
  return frames;
}

}  // namespace

void describe_shot(const std::string& pattern, const FrameChoice& choice, const FrameFlags& flags, const JsonFlag& json,
                   const std::string& reading) {
  ReadOptions options = flags.read_options();
  options.only_looks = true;
  const FramePattern files(pattern, "FRAME.exr");
  reads_pattern(files);
  reads_cameras_beside(files);
  std::vector<std::string> notes;  // the table says the same
  std::vector<FrameRow> rows;
  for (const SequenceFrame& frame : list_frames({files}, {choice.frames, MissingFrames::skip}, notes))
    rows.push_back(row_of(frame.number, files.path_of(frame.number), options));
  const std::vector<int> missing = missing_frames(rows, choice);
  const std::vector<DifferenceInShot> differences = differences_of(rows);
  json.write(document_of(pattern, rows, differences, missing));
  if (!json.only_json()) {
    fmt::print("{}\n\n", wrapped(verdict_of(rows, command_for(pattern, choice, reading)), 0, 0));
    print_shot(pattern, rows, differences, missing);
  }
  const auto unused = unused_cameras(rows);
  for (const auto& [why, numbers] : unused)
    note({fmt::format("{}: {}",
                      numbers.size() == 1 ? fmt::format("frame {}", numbers[0]) : "frames " + frames_in_words(numbers),
                      why)});
  std::vector<int> unread;
  for (const FrameRow& row : rows) {
    if (!row.error.empty()) unread.push_back(row.frame);
  }
  if (!unread.empty())
    throw Error("{} of {} frames cannot be read: {}", unread.size(), rows.size(), frames_in_words(unread));
  if (unused.empty() || flags.camera.empty()) return;
  print_notes();  // an error leaves them out
  throw Error("--camera {}: is not used for every frame; the notes say why, and gloam run refuses it", flags.camera);
}

}  // namespace gloam::cli
