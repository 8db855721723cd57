#include "gloam/frame_files.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <regex>

#include "base/lists.h"
#include "exr/view_planes.h"
#include "gloam/error.h"
#include "gloam/option.h"
#include "gloam/planes.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;
using Names = std::array<std::string, 2>;

std::string file_name(const FrameFile& file) { return file.path().filename().string(); }

/// The view that the file itself names; empty if it names none or the view is only assumed.
std::string own_name(const FrameFile& file) { return file.view_is_assumed() ? "" : file.views().front(); }

/// "left" or "right" by the end of the file's name, before a frame number: "pair_L.exr", "pair-right.0012.exr"; else empty.
std::string eye_in_name(const fs::path& path) {
  static const std::regex ending("(?:.*[._-])?(?:(l|left)|(r|right))(?:[._-][0-9]+)?", std::regex::icase);
  std::smatch match;
  const std::string stem = path.stem().string();
  if (!std::regex_match(stem, match, ending)) return "";
  return match[1].matched ? "left" : "right";
}

std::string other_eye(const std::string& eye) { return eye == "left" ? "right" : eye == "right" ? "left" : ""; }

bool tell_apart(const Names& names) { return !names[0].empty() && !names[1].empty() && names[0] != names[1]; }

/// Names of the two eyes. `how` stays empty if the files themselves name them.
Names eye_names(const FrameFile& first, const FrameFile& second, std::string& how) {
  const Names own = {own_name(first), own_name(second)};
  if (tell_apart(own)) return own;
  Names clues = {eye_in_name(first.path()), eye_in_name(second.path())};
  for (size_t i : {0, 1})
    if (clues[i].empty()) clues[i] = own[i];
  for (size_t i : {0, 1})
    if (clues[i].empty()) clues[i] = other_eye(clues[1 - i]);
  how = tell_apart(clues) ? "by their names" : "in the order given";
  return tell_apart(clues) ? clues : Names{"left", "right"};
}

void check_one_view(const FrameFile& file) {
  if (file.views().size() == 1) return;
  std::vector<std::string> quoted;
  for (const std::string& view : file.views()) quoted.push_back("'" + view + "'");
  throw UsageError(
      "{}: has the views {}, but each of two files must hold one eye; give this file alone, or files of one view",
      file.path().string(), enumerate(quoted));
}

void check_same_size(const FrameFile& first, const FrameFile& second) {
  if (first.display() == second.display()) return;
  throw Error("{}: shows {}, and {} {}; the eyes of a frame are of one size, render both alike", second.path().string(),
              in_words(second.display()), first.path().string(), in_words(first.display()));
}

Window united(const Window& a, const Window& b) {
  return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

/// Notes of both eyes: a common note once, others with the name of their eye.
std::vector<std::string> merged_notes(const std::vector<std::string>& first, const std::vector<std::string>& second,
                                      const std::string& first_name, const std::string& second_name) {
  std::vector<std::string> notes;
  for (const std::string& note : first)
    notes.push_back(contains(second, note) ? note : fmt::format("{}: {}", first_name, note));
  for (const std::string& note : second)
    if (!contains(first, note)) notes.push_back(fmt::format("{}: {}", second_name, note));
  return notes;
}

}  // namespace

std::optional<std::string> view_in_name(const std::filesystem::path& file, const std::vector<std::string>& views) {
  const std::string stem = file.stem().string();
  for (const std::string& view : views) {
    if (view.empty() || stem.size() <= view.size() || !stem.ends_with(view)) continue;
    if (!std::isalnum((unsigned char)stem[stem.size() - view.size() - 1])) return view;
  }
  return {};
}

FrameFiles::FrameFiles(const std::vector<std::string>& paths, const ReadOptions& options) {
  if (paths.size() == 1) {
    files_.emplace_back(paths[0], options);
    views_ = files_[0].views();
    return;
  }
  if (paths.size() != 2) throw UsageError("a frame is one file, or two with one eye each; {} were given", paths.size());
  if (!options.views.empty())
    throw UsageError("{}: each of two files is one view already; leave it out, or give one file",
                     option("view", fmt::format("{}", fmt::join(options.views, ","))));
  if (!options.plane_files.empty())
    throw UsageError("{}: a file of one plane is for one eye, and two are given; leave it out, or give one file",
                     option("plane-file", options.plane_files.begin()->first));
  std::error_code unknown;
  if (fs::equivalent(paths[0], paths[1], unknown))
    throw UsageError("{}: is given twice ({}), and two files are two eyes; give the file of each", paths[0], paths[1]);
  for (const std::string& path : paths) files_.push_back(FrameFile::without_cameras(path, options));
  for (const FrameFile& file : files_) check_one_view(file);
  check_same_size(files_[0], files_[1]);
  std::string how;
  const Names names = eye_names(files_[0], files_[1], how);
  if (!how.empty())
    assumed_ = fmt::format("views: {} is taken as '{}' and {} as '{}', {}", file_name(files_[0]), names[0],
                           file_name(files_[1]), names[1], how);
  const Window window = united(files_[0].window(), files_[1].window());
  for (size_t i : {0, 1}) files_[i].become({names[i], names[1 - i], paths[1 - i], window});
  views_.assign(names.begin(), names.end());
}

std::string FrameFiles::name() const {
  std::vector<std::string> names;
  for (const FrameFile& file : files_) names.push_back(file_name(file));
  return enumerate(names);
}

/// Sources under the views' names in this frame.
std::vector<PlaneSource> FrameFiles::sources() const {
  std::vector<PlaneSource> sources;
  for (size_t i = 0; i < files_.size(); ++i) {
    for (PlaneSource source : files_[i].planes()) {
      if (files_.size() > 1) source.view = views_[i];
      sources.push_back(source);
    }
  }
  return sources;
}

std::vector<std::string> FrameFiles::common_planes() const {
  std::vector<std::string> planes = gloam::common_planes(sources(), views_);
  if (history_) add_new(planes, history_->planes());
  if (expects_history_) add_new(planes, history_planes());
  return planes;
}

std::string FrameFiles::why_missing(const std::string& plane) const {
  return gloam::why_missing(sources(), views_, plane);
}

Frame FrameFiles::read(const std::vector<std::string>& planes) {
  std::vector<std::string> own = planes;
  std::erase_if(own, is_of_history);
  Frame frame = read_files(own);
  if (history_ && has_history(planes)) history_->add_to(frame, planes);
  return frame;
}

Frame FrameFiles::read_files(const std::vector<std::string>& planes) {
  Frame frame = files_[0].read(planes);
  if (files_.size() == 1) return frame;
  Frame second = files_[1].read(planes);
  frame.views.push_back(std::move(second.views[0]));
  const std::vector<PlaneSource> all = sources();
  for (size_t i : {0, 1}) {
    View& view = frame.views[i];
    view.name = views_[i];
    // Layers that only the other file's stack has.
    for (const std::string& plane : planes) {
      if (find_source(all, plane, view.name) || !has_plane(all, plane, view.name)) continue;
      Plane& empty = view.planes[plane];
      empty.name = plane;
      empty.channels.emplace_back(Layout(frame.width(), frame.height()), plane_kind(plane).outside);
    }
  }
  frame.assumed = merged_notes(frame.assumed, second.assumed, file_name(files_[0]), file_name(files_[1]));
  const std::vector<std::string> unused = unused_planes(all, views_, planes, "one of the files alone has it");
  frame.assumed.insert(frame.assumed.end(), unused.begin(), unused.end());
  if (!assumed_.empty()) frame.assumed.insert(frame.assumed.begin(), assumed_);
  for (std::string& sentence : frame.assumed) sentence = printable(sentence);
  return frame;
}

}  // namespace gloam
