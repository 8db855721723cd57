#include "comparison/eyes.h"

#include <algorithm>
#include <array>
#include <limits>

#include "exr/holdings.h"
#include "exr/options_beside.h"
#include "gloam/error.h"
#include "gloam/option.h"
#include "gloam/planes.h"
#include "shot/memory.h"

namespace gloam::comparison {
namespace {

EyeFile opened(const std::string& path, const ReadOptions& options) { return {FrameFile(path, options), {}}; }

/// The file with both views, or the file of each eye.
std::vector<EyeFile> open_results(const ComparedFiles& files, const ReadOptions& options) {
  std::vector<EyeFile> results;
  if (files.reference.empty()) {
    results.push_back(opened(files.test, options));
    const std::vector<std::string>& views = results[0].file.views();
    if (views.size() == 1)
      throw Error("{}: holds one view, and the stereo inconsistency is between two; give the file of the other eye too",
                  files.test);
    if (views.size() > 2)
      throw Error("{}: has the views {}; {} says which two", files.test, enumerate(views), option("views", "A,B"));
    return results;
  }
  for (const std::string& path : {files.test, files.reference}) {
    ReadOptions own = options_beside(options, path);
    own.channels = options.channels;
    results.push_back(opened(path, own));
    const std::vector<std::string>& views = results.back().file.views();
    if (views.size() == 1) continue;
    throw Error("{}: has the views {}; of two files each holds one view", path, enumerate(views));
  }
  return results;
}

/// The file of the frame; empty where none is named.
std::vector<EyeFile> open_frame(const ComparedFiles& files, const ReadOptions& options) {
  std::vector<EyeFile> frames;
  if (!files.frame.empty()) frames.push_back(opened(files.frame, options_beside(options, files.frame)));
  return frames;
}

/// The plane asked for. Refuses depth: a point's depth differs between the eyes.
std::string plane_asked_for(const std::vector<EyeFile>& results, const std::string& asked) {
  if (plane_kind(asked).meaning == PlaneKind::view_depth)
    throw UsageError("{}: a point's depth is another for each eye; name a result", option("what", asked));
  for (const EyeFile& result : results) {
    const std::vector<std::string> planes = result.file.common_planes();
    if (!contains(planes, asked))
      throw Error("{}: no plane '{}'{}; {}", result.name(), asked, suggestion(asked, planes), holdings(result.file));
  }
  return asked;
}

/// The first plane that all files have, results before inputs.
std::string plane_to_compare(const std::vector<EyeFile>& results) {
  const FrameFile& first = results.front().file;
  std::vector<std::string> order = results_among(first.common_planes());
  for (const std::string& plane : inputs_among(first.common_planes())) order.push_back(plane);
  for (const std::string& plane : order) {
    const bool is_in_all = std::all_of(results.begin(), results.end(), [&](const EyeFile& result) {
      return contains(result.file.common_planes(), plane);
    });
    if (is_in_all && plane_kind(plane).meaning != PlaneKind::view_depth) return plane;
  }
  throw Error("{}: nothing that can be compared between two eyes; {}", results.front().name(), holdings(first));
}

/// One view of a file, and the part of its pixels that lies under the images.
struct Source {
  const EyeFile* input = nullptr;
  const View* view = nullptr;
  Window window;
};

/// One source for each eye.
using Sources = std::array<Source, 2>;

Sources sources_of(const std::vector<EyeFile>& results) {
  const Frame& first = results.front().frame;
  if (results.size() == 1)
    return {Source{&results[0], &first.views[0], first.window}, Source{&results[0], &first.views[1], first.window}};
  const Frame& second = results[1].frame;
  if (first.width() != second.width() || first.height() != second.height())
    throw Error("{} is {}x{} and {} is {}x{}; both eyes need images of one size", results[0].name(), first.width(),
                first.height(), results[1].name(), second.width(), second.height());
  return {Source{&results[0], &first.views[0], first.window}, Source{&results[1], &second.views[0], second.window}};
}

/// The views of the frame for those of the results: by name, or in order if each eye has a file.
Sources sources_of(const EyeFile& extra, const std::vector<EyeFile>& results) {
  const Frame &frame = extra.frame, &first = results.front().frame;
  if (frame.views.size() < 2)
    throw Error("{}: holds one view, and the results two; give the frame that they were made of",
                option("frame", extra.name()));
  if (results.size() == 2 && frame.views.size() > 2)
    throw Error("{}: has the views {}; {} says which two", option("frame", extra.name()), enumerate(extra.file.views()),
                option("views", "A,B"));
  const Window under = window_under(frame, extra.name(), first, first.window, Layout(first.width(), first.height()));
  Sources sources;
  for (size_t i = 0; i < 2; ++i) {
    const View& view = results.size() == 2 ? frame.views[i] : frame.view(view_of(frame, first.views[i].name));
    sources[i] = {&extra, &view, under == Window{} ? frame.window : under};
  }
  return sources;
}

/// Names of the eyes: the views' own, if these differ.
std::array<std::string, 2> names_of(const std::vector<Sources>& sources) {
  for (const Sources& s : sources) {
    const std::string &left = s[0].view->name, &right = s[1].view->name;
    if (!left.empty() && !right.empty() && left != right) return {left, right};
  }
  return {"left", "right"};
}

bool have_cameras(const Sources& sources) {
  return std::all_of(sources.begin(), sources.end(),
                     [](const Source& s) { return s.view->camera && s.view->camera->pose.has_value(); });
}

/// Sources in order of preference: the frame first, since the user named it. But the meaning of depth and normals may depend on the
/// camera: files with a camera come before a file without one.
std::vector<Sources> sources_of(const std::vector<EyeFile>& frames, const std::vector<EyeFile>& results) {
  std::vector<Sources> sources;
  for (const EyeFile& frame : frames) sources.push_back(sources_of(frame, results));
  sources.push_back(sources_of(results));
  std::stable_partition(sources.begin(), sources.end(), have_cameras);
  return sources;
}

/// The first sources that have the plane for both eyes; null if none has.
const Sources* first_with(const std::vector<Sources>& sources, const std::string& plane) {
  for (const Sources& s : sources) {
    if (s[0].view->find(plane) && s[1].view->find(plane)) return &s;
  }
  return nullptr;
}

/// A camera for a window that starts elsewhere.
Camera moved(Camera camera, const Window& from, const Window& to) {
  camera.cx += to.x0 - from.x0;
  camera.cy += to.y0 - from.y0;
  return camera;
}

void take_plane(Frame& pair, const Sources& sources, const std::string& plane) {
  for (size_t i = 0; i < 2; ++i) {
    const Source& s = sources[i];
    pair.views[i].planes[plane] = cropped(*s.view->find(plane), s.input->frame.window, s.window);
  }
}

std::string what_is_missing() {
  return fmt::format("; {} names the frame that it was made of", option("frame", "FRAME.exr"));
}

/// The plane of `results` with the depth, the normals and the cameras of the first sources that have them.
Frame pair_of(const Sources& results, const std::vector<Sources>& sources, const std::string& plane) {
  const std::string name = results[0].input->name();
  if (!have_cameras(sources.front()))
    throw Error(
        "{}: no camera with a pose for both views, so that nobody knows where a pixel lies in the other{}, {} the "
        "cameras",
        name, what_is_missing(), option("camera", "FILE.json"));
  const Sources& cameras = sources.front();
  for (const Source& eye : results) {
    if (!eye.view->find(plane))
      throw Error("{}: '{}' is of no use: {}", eye.input->name(), plane, fmt::join(eye.input->frame.assumed, "; "));
  }
  const Sources* depth = first_with(sources, "depth");
  if (!depth) throw Error("{}: no depth for both views{}", name, what_is_missing());
  Frame pair;
  pair.display = results[0].input->frame.display;
  pair.window = results[0].window;
  pair.views.resize(2);
  const std::array<std::string, 2> names = names_of(sources);
  for (size_t i = 0; i < 2; ++i) {
    pair.views[i].name = names[i];
    pair.views[i].camera = moved(*cameras[i].view->camera, cameras[i].window, pair.window);
  }
  if (const Sources* normals = first_with(sources, "normal")) take_plane(pair, *normals, "normal");
  take_plane(pair, *depth, "depth");
  take_plane(pair, results, plane);
  return pair;
}

/// The assumptions about the first sources; about all sources if their normals are unusable.
void note_assumptions(const std::vector<Sources>& sources, bool lacks_normals, std::vector<std::string>& notes) {
  for (const Sources& s : sources) {
    if (&s != &sources.front() && !lacks_normals) break;
    for (const Source& source : s) {
      for (const std::string& sentence : source.input->frame.assumed) add_new(notes, sentence);
    }
  }
  if (lacks_normals)
    add_new(notes, fmt::format("no normals for both views: pixels count without the normal-check; {} gives them",
                               option("frame", "FRAME.exr")));
}

/// Adds the files' names to an error about inputs that cannot be compared.
StereoInconsistency inconsistency_of(const ComparedFiles& files, const Frame& pair, const std::string& plane,
                                     const StereoOptions& check) {
  try {
    return stereo_inconsistency(pair, plane, check);
  } catch (const Error& error) {
    throw Error("{}{}: {}", files.test, files.reference.empty() ? "" : " and " + files.reference, error.what());
  }
}

}  // namespace

TwoEyes::TwoEyes(const ComparedFiles& files, ReadOptions options, const StereoOptions& check)
    : files_(files), check_(check) {
  options.as_stored = true;
  results_ = open_results(files, options);
  frames_ = open_frame(files, options);
  plane_ = files.plane.empty() ? plane_to_compare(results_) : plane_asked_for(results_, files.plane);
  if (check.normal_check) geometry_.push_back("normal");
}

unsigned long long TwoEyes::bytes() const {
  std::vector<std::string> planes = geometry_;
  unsigned long long bytes = 0;
  for (const EyeFile& frame : frames_) bytes += frame.file.bytes_to_read(planes);
  add_new(planes, plane_);
  for (const EyeFile& result : results_) bytes += result.file.bytes_to_read(planes);
  return process_bytes + 2 * bytes;
}

EyeFigures TwoEyes::compare(std::vector<std::string>& notes) {
  for (EyeFile& frame : frames_) frame.read(geometry_);
  std::vector<std::string> planes = geometry_;
  add_new(planes, plane_);
  for (EyeFile& result : results_) result.read(planes);
  const std::vector<Sources> sources = sources_of(frames_, results_);
  EyeFigures figures{.pair = pair_of(sources_of(results_), sources, plane_), .plane = plane_, .result = {}};
  figures.result = inconsistency_of(files_, figures.pair, plane_, check_);
  note_assumptions(sources, check_.normal_check && !figures.result.normal_check, notes);
  return figures;
}

void write_errors(const std::string& path, const EyeFigures& figures) {
  Frame out;
  out.display = figures.pair.display;
  out.window = figures.pair.window;
  for (size_t i = 0; i < 2; ++i) {
    View view;
    view.name = figures.pair.views[i].name;
    view.camera = figures.pair.views[i].camera;
    view.planes["depth"] = figures.pair.views[i].find("depth")->clone();
    Plane& errors = view.planes["inconsistency"] = {"inconsistency", {}};
    errors.channels.push_back(figures.result.views[i].error.clone());
    errors.channels[0].fill_padding(std::numeric_limits<float>::quiet_NaN());
    out.views.push_back(std::move(view));
  }
  write_frame(path, out);
}

}  // namespace gloam::comparison
