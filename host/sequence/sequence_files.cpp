#include "sequence/sequence_files.h"

#include <algorithm>
#include <memory>
#include <mutex>
#include <utility>

#include "base/file_ledger.h"
#include "gloam/error.h"
#include "gloam/option.h"
#include "normalise/normal_form.h"
#include "sequence/pattern_reads.h"

namespace gloam {
namespace {

/// The numbers of the frames' files, each once: of one that is held several frames are read.
std::vector<int> sources_of(const std::vector<SequenceFrame>& frames) {
  std::vector<int> sources;
  for (const SequenceFrame& frame : frames) {
    if (sources.empty() || sources.back() != frame.source) sources.push_back(frame.source);
  }
  return sources;
}

/// Frames that are looked at for the convention of all: the first ones may show nothing, or next to nothing.
constexpr size_t most_looked_at = 5;
/// Surface that a frame has to show to decide for all, pixels. By the share, a hundred or so of the places where normals are compared with the
/// depth (normalise/normal_samples.h) lie on it; a convention that is not plain is found by 24 at least.
constexpr double least_share_shown = 0.03;
constexpr long long least_shown = 256;

/// What the files of one eye, or of both in one, tell of their depth and normals.
struct Told {
  FoundDepth depth;
  FoundNormals normals;
  long long shown = 0;  ///< pixels of surface in the frame that tells
  bool is_enough = false;
};

/// The pixels of a view that have a depth and a normal.
long long surface_of(const View& view, const FoundNormals& found) {
  const Plane *depth = view.find("depth"), *normal = view.find("normal");
  // Those of a world are left out of a frame without a pose, and tell of the others all the same.
  const bool is_left_out = found.convention.space == NormalSpace::world && !(view.camera && view.camera->pose);
  if (!depth || (!normal && !is_left_out)) return 0;
  const Channel& z = depth->channels.front();
  long long count = 0;
  for (int y = 0; y < z.layout().height; ++y) {
    for (int x = 0; x < z.layout().width; ++x) {
      const auto is_any = [&](const Channel& component) { return component.at(x, y) != 0; };
      count += !is_background(z.at(x, y)) &&
               (!normal || std::any_of(normal->channels.begin(), normal->channels.end(), is_any));
    }
  }
  return count;
}

/// The surface by which a file's normals were found: in its view, or in the first of its views that shows any.
long long surface_of(const Frame& frame, const FrameFiles& files, size_t file) {
  const FoundNormals& found = files.files()[file].found_normals();
  if (!is_whole(found.convention)) return 0;
  if (files.files().size() > 1) return surface_of(frame.views[file], found);
  for (const View& view : frame.views) {
    if (const long long shown = surface_of(view, found); shown > 0) return shown;
  }
  return 0;
}

void say_where(const SequenceFrame& at, std::vector<std::string>& notes) {
  for (std::string& note : notes) note += fmt::format(" (decided on frame {} for the whole sequence)", at.number);
}

/// The first frame whose surfaces tell decides; where none does, each frame stays planar distance.
void take_depth(const FoundDepth& found, const SequenceFrame& at, FoundDepth& told) {
  if (!found.read || !found.is_told) return;
  told = found;
  say_where(at, told.notes);
}

/// Whether a file has nothing more to tell.
bool has_told_all(const Told& told) { return told.is_enough && (told.depth.is_told || !told.depth.read); }

/// Takes over what a frame tells, if it shows more than the frames before and none of them has shown enough.
void look_at(const SequenceFrame& at, const SequenceFiles& sequence, std::vector<Told>& told) {
  FrameFiles files = sequence.open(at);
  const Frame frame = files.read({"depth", "normal"});
  const double pixels = double(frame.width()) * double(frame.height());
  for (size_t i = 0; i < files.files().size(); ++i) {
    if (!told[i].depth.is_told) take_depth(files.files()[i].found_depth(), at, told[i].depth);
    const long long shown = surface_of(frame, files, i);
    if (told[i].is_enough || shown <= told[i].shown) continue;
    told[i].normals = files.files()[i].found_normals();
    told[i].shown = shown, told[i].is_enough = shown >= least_shown && double(shown) >= least_share_shown * pixels;
    say_where(at, told[i].normals.notes);
  }
}

/// What the depth and the normals of a sequence tell, by its inputs: the first of the frames that can be read and shows enough of a surface stands for all,
/// else the one that shows most. `frames`: those to look at. A frame that cannot be read is told when its turn comes.
std::vector<Told> conventions_of(const SequenceFiles& sequence, const std::vector<SequenceFrame>& frames) {
  std::vector<Told> told(sequence.inputs().size());
  for (size_t i = 0; i < std::min(frames.size(), most_looked_at); ++i) {
    if (std::all_of(told.begin(), told.end(), has_told_all)) break;
    try {
      look_at(frames[i], sequence, told);
    } catch (const Error&) {
    }
  }
  return told;
}

bool is_frame_of(const FramePattern& pattern, const std::filesystem::path& file) {
  const std::optional<int> frame = pattern.frame_of(file.filename().string());
  return frame && pattern.path_of(*frame) == file;
}

/// The frames that are there, whichever are asked for: so a frame has the same bits in every part of its shot. Cameras in the order of the
/// frames asked for belong to these alone.
std::vector<SequenceFrame> frames_to_look_at(const SequenceFiles& sequence) {
  if (sequence.cameras_are_in_order()) return sequence.frames();
  FrameChoice all;
  all.missing = MissingFrames::skip;
  std::vector<std::string> unused;
  return list_frames(sequence.inputs(), all, unused);
}

/// `conventions_of`, worked out once, when the first thread asks; for the input that a file is of.
std::function<Told(const std::filesystem::path&)> told_when_asked(std::shared_ptr<const SequenceFiles> sequence) {
  struct Kept {
    std::once_flag once;
    std::vector<Told> told;
  };
  return [kept = std::make_shared<Kept>(), sequence = std::move(sequence)](const std::filesystem::path& file) {
    std::call_once(kept->once, [&] { kept->told = conventions_of(*sequence, frames_to_look_at(*sequence)); });
    for (size_t i = 0; i < kept->told.size(); ++i)
      if (is_frame_of(sequence->inputs()[i], file)) return kept->told[i];
    return Told{};
  };
}

}  // namespace

SequenceFiles::SequenceFiles(std::vector<FramePattern> inputs, const ReadOptions& options, const FrameChoice& choice,
                             std::vector<std::string>& notes)
    : inputs_(std::move(inputs)), frames_(list_frames(inputs_, choice, notes)), options_(options) {
  const std::string camera = options.camera_file.string();
  if (FramePattern::is_pattern(camera))
    cameras_.emplace(camera, option("camera"));
  else if (!camera.empty() && options.camera_text.empty())
    camera_list_ = CameraList::of_file(camera, sources_of(frames_));
  tell_ledger();
  const auto told = told_when_asked(std::make_shared<const SequenceFiles>(*this));
  options_.shot_normals = [told](const std::filesystem::path& file) { return told(file).normals; };
  options_.shot_depth = [told](const std::filesystem::path& file) { return told(file).depth; };
}

void SequenceFiles::tell_ledger() const {
  if (!has_file_ledger()) return;
  for (const SequenceFrame& frame : frames_) {
    for (const std::string& path : paths_of(frame))
      reads_file(path, fmt::format("what frame {} is read from", frame.number));
  }
  for (const FramePattern& pattern : inputs_) {
    reads_pattern(pattern);
    if (options_.camera_file.empty()) reads_cameras_beside(pattern);
  }
  if (cameras_)
    reads_pattern(*cameras_);
  else if (options_.camera_text.empty())
    reads_file(options_.camera_file, option("camera"));
}

std::vector<int> SequenceFiles::numbers() const {
  std::vector<int> numbers;
  for (const SequenceFrame& frame : frames_) numbers.push_back(frame.number);
  return numbers;
}

std::string SequenceFiles::name() const {
  std::vector<std::string> names;
  for (const FramePattern& pattern : inputs_) names.push_back(pattern.name());
  return enumerate(names);
}

std::vector<std::string> SequenceFiles::paths_of(const SequenceFrame& frame) const {
  std::vector<std::string> paths;
  for (const FramePattern& pattern : inputs_) paths.push_back(pattern.path_of(frame.source).string());
  return paths;
}

std::string SequenceFiles::camera_of(const SequenceFrame& frame) const {
  if (cameras_) return cameras_->path_of(frame.source).string();
  return camera_list_ ? "" : options_.camera_file.string();
}

ReadOptions SequenceFiles::options_for(const SequenceFrame& frame) const {
  ReadOptions options = options_;
  if (cameras_) options.camera_file = cameras_->path_of(frame.source);
  if (camera_list_) options.camera_text = camera_list_->text_of(frame.source);
  for (auto& [plane, file] : options.plane_files)
    if (FramePattern::is_pattern(file.string()))
      file = FramePattern(file.string(), option("plane-file", plane)).path_of(frame.source);
  return options;
}

}  // namespace gloam
