#include "comparison/shot.h"

#include <algorithm>

#include "base/lists.h"
#include "gloam/option.h"
#include "gloam/visualise.h"
#include "picture/picture_path.h"

namespace gloam::comparison {
namespace {

/// A comparison so far.
struct Comparing {
  const ComparedShot& shot;
  const FrameProgress& progress;
  std::vector<std::string>& notes;
  ShotFigures figures = {};
  std::vector<FlickerMeter> meters = {};                      ///< of each view
  Layout layout = {};                                         ///< the first frame's
  std::vector<std::string> motions = {}, surfaces_from = {};  ///< each once
  bool is_background_known = false;
};

/// Throws Error for a frame that is unlike the first one.
void check_like_first(const Comparing& c, const ComparedFrame& frame) {
  const Layout& layout = frame.overlap.layout;
  if (layout.width != c.layout.width || layout.height != c.layout.height)
    throw Error("{} is {}x{}, and the first frame {}x{}; compare frames of one size, chosen by {}", frame.files.test,
                layout.width, layout.height, c.layout.width, c.layout.height, option("frames"));
  if (frame.pairs != c.figures.views)
    throw Error("{} has other views than the first frame; {} says which to compare", frame.files.test,
                option("view", "NAME"));
  if (frame.planes.test != c.figures.planes.test || frame.planes.reference != c.figures.planes.reference)
    throw Error("{} and {} are compared by {} and {}, and the first frame by {} and {}; {} says which",
                frame.files.test, frame.files.reference, frame.planes.test, frame.planes.reference,
                c.figures.planes.test, c.figures.planes.reference, option("what", "PLANE"));
}

void take_first(Comparing& c, const ComparedFrame& frame) {
  c.figures.planes = frame.planes;
  c.layout = frame.overlap.layout;
  c.figures.views = frame.pairs;
  c.meters.resize(frame.pairs.size());
}

/// Adds the pair with the frame before: none after a gap, since motion is from one frame to the next.
std::optional<FlickerSums> add_pair(Comparing& c, ComparedFrame& frame, int number) {
  const bool follows = !c.figures.frames.empty() && c.figures.frames.back().number == number - 1;
  std::optional<FlickerSums> pair;
  for (size_t i = 0; i < frame.views.size(); ++i) {
    FlickerMeter& meter = c.meters[i];
    if (!follows) meter.begin_anew();
    const std::optional<FlickerSums> sums = meter.add(std::move(frame.views[i]));
    if (!sums) continue;
    pair = pair.value_or(FlickerSums{}) += *sums;
    add_new(c.motions, in_words(*meter.source()));
  }
  if (pair) c.figures.sums += *pair, ++c.figures.pairs;
  return pair;
}

void add_frame(Comparing& c, const SequenceFrame& at, bool with_range) {
  ComparedFrame frame = read_compared_frame(c.shot, at, c.notes);
  if (c.figures.frames.empty()) take_first(c, frame);
  check_like_first(c, frame);
  FrameFigures row{at.number, {}, {}, frame.exposure, {}};
  for (const SequenceFramePlanes& view : frame.views) {
    row.views.push_back(
        naming(frame.files, [&] { return gloam::compare(view.test, view.truth, view.foreground, frame.exposure); }));
    if (with_range)
      c.figures.range = std::max(c.figures.range, difference_range(view.test, view.truth, view.foreground));
  }
  row.figures = pooled(row.views);
  c.is_background_known = c.is_background_known || frame.is_background_known;
  if (!frame.surfaces_from.empty()) add_new(c.surfaces_from, frame.surfaces_from);
  row.pair = add_pair(c, frame, at.number);
  c.figures.frames.push_back(std::move(row));
}

/// Writes the differences of every frame in the colours of one scale. Decodes all frames again: the scale is known only now.
void draw_differences(Comparing& c, const std::string& pictures) {
  const FramePattern pattern(pictures, option("differences"));
  size_t next = 0;
  for_each_frame(c.shot, c.progress, [&](const SequenceFrame& at) {
    const ComparedFrame frame = read_compared_frame(c.shot, at, c.notes);
    const FrameFigures& row = c.figures.frames[next++];
    check_like_first(c, frame);
    for (size_t i = 0; i < frame.views.size(); ++i) {
      const SequenceFramePlanes& view = frame.views[i];
      write_difference_picture(
          picture_path(pattern.path_of(at.number).string(), c.figures.views[i].first, c.figures.views.size() > 1),
          view.test, view.truth, view.foreground, row.views[i],
          {frame.test.file.path().filename().string(), frame.reference.file.path().filename().string(),
           float(c.figures.range), frame.exposure});
    }
  });
}

/// "plane (of the test)"
std::string motion_in_words(const Comparing& c) {
  if (c.motions.empty()) return "none, no two frames follow one another";
  std::string words = fmt::format("{}", fmt::join(c.motions, " or "));
  const bool has_motion = c.motions != std::vector<std::string>{in_words(MotionSource::still)};
  if (has_motion && !c.surfaces_from.empty()) words += fmt::format(", of {}", fmt::join(c.surfaces_from, " or "));
  return words;
}

void note_assumptions(Comparing& c) {
  for (const std::string& file : c.shot.files_of_all_frames())
    c.notes.push_back(fmt::format("{} is one file for all frames: the camera is taken to stand still", file));
  if (!c.is_background_known)
    c.notes.push_back(fmt::format("no depth in either file: every pixel counts; {} tells the background",
                                  option("frame", "'FRAME.####.exr'")));
  if (c.figures.pairs == 0)
    c.notes.push_back("no two frames follow one another: flicker is not measured; it is of frames such as 7 and 8");
}

}  // namespace

const FrameFigures& ShotFigures::worst() const {
  return *std::max_element(frames.begin(), frames.end(), [](const FrameFigures& a, const FrameFigures& b) {
    return a.figures.rmse < b.figures.rmse;
  });
}

Metrics ShotFigures::means() const {
  std::vector<Metrics> all;
  double rmse = 0;
  long long pixels = 0;
  for (const FrameFigures& frame : frames) {
    all.push_back(frame.figures);
    all.back().pixels = 1;  // `pooled` weighs by pixels
    rmse += frame.figures.rmse;
    pixels += frame.figures.pixels;
  }
  Metrics means = pooled(all);
  means.rmse = rmse / double(frames.size());
  means.pixels = pixels;
  return means;
}

ShotFigures compare_shot(const ComparedShot& shot, const std::string& pictures, const FrameProgress& progress,
                         std::vector<std::string>& notes) {
  Comparing c{.shot = shot, .progress = progress, .notes = notes};
  for_each_frame(shot, progress, [&](const SequenceFrame& frame) { add_frame(c, frame, !pictures.empty()); });
  note_assumptions(c);
  c.figures.motion = motion_in_words(c);
  if (!pictures.empty()) draw_differences(c, pictures);
  return std::move(c.figures);
}

}  // namespace gloam::comparison
