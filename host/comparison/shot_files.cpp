#include "comparison/shot_files.h"

#include <algorithm>

#include "base/lists.h"
#include "exr/options_beside.h"
#include "gloam/option.h"
#include "shot/memory.h"

namespace gloam::comparison {
namespace {

/// Patterns among the names of the files. Appends nothing for one file.
std::optional<size_t> add_pattern(std::vector<FramePattern>& patterns, const std::string& path,
                                  const std::string& flag) {
  if (path.empty() || !FramePattern::is_pattern(path)) return {};
  patterns.emplace_back(path, flag);
  return patterns.size() - 1;
}

/// Reads the planes that tell where surfaces are.
Frame surfaces_frame(FrameFile& file) {
  std::vector<std::string> planes;
  for (const char* plane : {"depth", "motion"}) {
    if (contains(file.common_planes(), plane)) planes.push_back(plane);
  }
  return file.read(planes);
}

Surfaces surfaces_of(const Frame& frame, const std::string& name, const Window& window) {
  const View& view = frame.view(name);
  Surfaces surfaces;
  surfaces.window = window == Window{} ? frame.window : window;
  surfaces.camera = view.camera;
  if (const Plane* depth = view.find("depth"))
    surfaces.depth = std::move(cropped(*depth, frame.window, window).channels[0]);
  if (const Plane* motion = view.find("motion")) surfaces.motion = cropped(*motion, frame.window, window);
  return surfaces;
}

/// Whose depth, cameras and motion count: as for the background, those of the frame, else the test's, else the truth's.
struct SurfaceFile {
  std::string name, path;
  Frame frame;
  bool is_frame = false, is_reference = false;
};

SurfaceFile surface_file(ComparedFrame& c, const ReadOptions& options) {
  if (!c.files.frame.empty()) {
    FrameFile file = background_file(c.files, options);
    return {option("frame"), c.files.frame, surfaces_frame(file), true, false};
  }
  for (Side* side : {&c.test, &c.reference}) {
    const std::vector<std::string> planes = side->file.common_planes();
    if (!contains(planes, "depth") && !contains(planes, "motion")) continue;
    Frame frame = surfaces_frame(side->file);
    const Overlap& overlap = c.overlap;
    if (!covers(frame, overlap.window, overlap.layout)) continue;
    const bool is_reference = side == &c.reference;
    return {is_reference ? "the truth" : "the test", side->file.path().string(), std::move(frame), false, is_reference};
  }
  return {};
}

Surfaces surfaces_under(const ComparedFrame& c, const SurfaceFile& from,
                        const std::pair<std::string, std::string>& views) {
  if (from.name.empty()) return {};
  if (!from.is_frame) return surfaces_of(from.frame, from.is_reference ? views.second : views.first, c.overlap.window);
  const Window window = window_under(from.frame, c.files.frame, c.test.frame, c.overlap.window, c.overlap.layout);
  return surfaces_of(from.frame, view_of(from.frame, views.first), window);
}

}  // namespace

ComparedShot::ComparedShot(const ComparedFiles& files, const ReadOptions& options, const FrameChoice& choice,
                           std::vector<std::string>& notes)
    : files_(files), shot_([&] {
        std::vector<FramePattern> patterns = {FramePattern(files.test, "TEST.exr")};
        reference_ = add_pattern(patterns, files.reference, "REF.exr");
        frame_ = add_pattern(patterns, files.frame, option("frame"));
        return SequenceFiles(std::move(patterns), options, choice, notes);
      }()) {}

ComparedFiles ComparedShot::files_of(const SequenceFrame& frame) const {
  const std::vector<std::string> paths = shot_.paths_of(frame);
  ComparedFiles files = files_;
  files.test = paths.front();
  if (reference_) files.reference = paths[*reference_];
  if (frame_) files.frame = paths[*frame_];
  return files;
}

std::vector<std::string> ComparedShot::files_of_all_frames() const {
  std::vector<std::string> files;
  if (!reference_ && !files_.reference.empty()) files.push_back(files_.reference);
  if (!frame_ && !files_.frame.empty()) files.push_back(files_.frame);
  return files;
}

ReadOptions ComparedShot::options_of(const SequenceFrame& frame) const {
  ReadOptions options = shot_.options_for(frame);
  options.as_stored = true;
  return options;
}

unsigned long long ComparedShot::bytes() const {
  const SequenceFrame& first = shot_.frames().front();
  const ComparedFiles files = files_of(first);
  const ReadOptions options = options_of(first);
  const FrameFile test(files.test, options), reference(files.reference, options_beside(options, files.reference));
  return process_bytes + 2 * (bytes_of_comparison(files, options, test, reference, true) - process_bytes);
}

ComparedFrame read_compared_frame(const ComparedShot& shot, const SequenceFrame& at, std::vector<std::string>& notes) {
  const ComparedFiles files = shot.files_of(at);
  const ReadOptions options = shot.options_of(at);
  ComparedFrame c{files,
                  {FrameFile(files.test, options), {}},
                  {FrameFile(files.reference, options_beside(options, files.reference)), {}},
                  {},
                  {},
                  {},
                  0,
                  false,
                  {},
                  {}};
  c.pairs = pair_views(c.test.file, c.reference.file, !options.views.empty(), notes);
  c.planes = survey_sides(c.test, c.reference, files.plane, !files.frame.empty());
  note_differences(c.test.file, c.reference.file, c.planes, notes);
  c.overlap = overlap_of(c.test, c.reference);
  c.exposure = exposure_of(files, c.reference.file, c.planes.reference);
  const SurfaceFile from = surface_file(c, options);
  c.surfaces_from = from.name;
  const bool stands = (from.is_frame || from.is_reference) && contains(shot.files_of_all_frames(), from.path);
  const Rows all{0, c.overlap.layout.height};
  const Frame tests = c.test.read(c.planes.test, c.overlap, all),
              truths = c.reference.read(c.planes.reference, c.overlap, all);
  const Frame none;
  for (const auto& views : c.pairs) {
    const std::optional<Mask> known =
        mask_of(files, files.frame.empty() ? none : from.frame, c.test, c.reference, views, c.overlap, all);
    c.is_background_known = c.is_background_known || known.has_value();
    c.views.push_back(
        {without_confidence(c.test.rows_of(tests, c.planes.test, views.first, c.overlap, all)),
         without_confidence(c.reference.rows_of(truths, c.planes.reference, views.second, c.overlap, all)),
         known ? *known : Mask(size_t(c.overlap.layout.width) * size_t(c.overlap.layout.height), 1),
         surfaces_under(c, from, views)});
    // one frame's motion is not that of all others
    if (stands) c.views.back().surfaces.motion.reset();
  }
  return c;
}

}  // namespace gloam::comparison
