#include "cli/compare/sequence_files.h"

#include <algorithm>

#include "gloam/error.h"

namespace gloam::cli {
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

/// Whose depth, cameras and motion count: as for the background, those of --frame, else the test's, else the truth's.
struct SurfaceFile {
  std::string name;
  Frame frame;
  bool is_reference = false;
};

SurfaceFile surface_file(ComparedFrame& c, const ReadOptions& options) {
  if (!c.flags.frame.empty()) {
    FrameFile file(c.flags.frame, options_beside(options, c.flags.frame));
    if (!contains(file.common_planes(), "depth"))
      throw Error("{}: no depth to tell the background by; {}", c.flags.frame, holdings(file));
    return {"--frame", surfaces_frame(file)};
  }
  for (Side* side : {&c.test, &c.reference}) {
    const std::vector<std::string> planes = side->file.common_planes();
    if (!contains(planes, "depth") && !contains(planes, "motion")) continue;
    Frame frame = surfaces_frame(side->file);
    const Overlap& overlap = c.overlap;
    if (!covers(frame, overlap.window, overlap.layout)) continue;
    const bool is_reference = side == &c.reference;
    return {is_reference ? "the truth" : "the test", std::move(frame), is_reference};
  }
  return {};
}

Surfaces surfaces_under(const ComparedFrame& c, const SurfaceFile& from,
                        const std::pair<std::string, std::string>& views) {
  if (from.name.empty()) return {};
  if (from.name != "--frame")
    return surfaces_of(from.frame, from.is_reference ? views.second : views.first, c.overlap.window);
  const Window window = window_under(from.frame, c.flags.frame, c.test.frame, c.overlap.window, c.overlap.layout);
  return surfaces_of(from.frame, view_of(from.frame, views.first), window);
}

}  // namespace

ComparedShot::ComparedShot(const CompareFlags& flags, const FrameChoice& choice)
    : flags_(flags), shot_([&] {
        std::vector<FramePattern> patterns = {FramePattern(flags.test, "TEST.exr")};
        reference_ = add_pattern(patterns, flags.reference, "REF.exr");
        frame_ = add_pattern(patterns, flags.frame, "--frame");
        return ShotFiles(std::move(patterns), flags.frame_flags, choice);
      }()) {}

CompareFlags ComparedShot::flags_of(const SequenceFrame& frame) const {
  const std::vector<std::string> paths = shot_.paths_of(frame);
  CompareFlags flags = flags_;
  flags.test = paths.front();
  if (reference_) flags.reference = paths[*reference_];
  if (frame_) flags.frame = paths[*frame_];
  return flags;
}

std::vector<std::string> ComparedShot::files_of_all_frames() const {
  std::vector<std::string> files;
  if (!reference_ && !flags_.reference.empty()) files.push_back(flags_.reference);
  if (!frame_ && !flags_.frame.empty()) files.push_back(flags_.frame);
  return files;
}

ReadOptions ComparedShot::options_of(const SequenceFrame& frame) const {
  ReadOptions options = shot_.options_for(frame);
  options.as_stored = true;
  return options;
}

void ComparedShot::check_outputs(const std::string& movie) const {
  const std::vector<NamedPath> others = {{"-o", flags_.picture}, {"--json", flags_.json.file()}};
  std::vector<NamedPath> inputs;  // the others are frames, of which the shot has told
  for (const std::string& file : files_of_all_frames()) inputs.emplace_back("a file that is compared", file);
  check_paths(inputs, others);
  if (movie.empty()) return;
  if (!FramePattern::is_pattern(movie))
    throw UsageError("--differences {}: has no place for the frame's number; write one, such as differences.####.png",
                     movie);
  cli::check_outputs({{"--differences", FramePattern(movie, "--differences")}}, shot_, others);
}

ComparedFrame read_compared_frame(const ComparedShot& shot, const SequenceFrame& at) {
  const CompareFlags flags = shot.flags_of(at);
  const ReadOptions options = shot.options_of(at);
  ComparedFrame c{flags,
                  {FrameFile(flags.test, options), {}},
                  {FrameFile(flags.reference, options_beside(options, flags.reference)), {}},
                  {},
                  {},
                  {},
                  0,
                  false,
                  {},
                  {}};
  c.pairs = pair_views(c.test.file, c.reference.file, !options.views.empty());
  c.planes = survey_sides(c.test, c.reference, flags.plane, !flags.frame.empty());
  note_other_camera(c.test.file, c.reference.file);
  if (c.planes.test == "ao" || c.planes.test == "ao_raw") note_other_radius(c.test.file, c.reference.file);
  c.overlap = overlap_of(c.test, c.reference);
  c.exposure = exposure_of(flags, c.reference.file, c.planes.reference);
  const SurfaceFile from = surface_file(c, options);
  c.surfaces_from = from.name;
  const std::vector<std::string> standing = shot.files_of_all_frames();
  const bool stands = contains(standing, from.name == "--frame" ? flags.frame
                                         : from.is_reference    ? flags.reference
                                                                : "");
  const Rows all{0, c.overlap.layout.height};
  const Frame tests = c.test.read(c.planes.test, c.overlap, all),
              truths = c.reference.read(c.planes.reference, c.overlap, all);
  const Frame none;
  for (const auto& views : c.pairs) {
    const std::optional<Mask> known =
        mask_of(flags, flags.frame.empty() ? none : from.frame, c.test, c.reference, views, c.overlap, all);
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

}  // namespace gloam::cli
