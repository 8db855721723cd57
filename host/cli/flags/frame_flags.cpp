#include "cli/flags/frame_flags.h"

#include <algorithm>
#include <limits>

#include "cli/flags/memory.h"
#include "cli/flags/options.h"
#include "exr/read_words.h"
#include "gloam/error.h"
#include "gloam/frame_pattern.h"
#include "normalise/depth_encoding.h"
#include "normalise/normal_axes.h"

namespace gloam::cli {
namespace {

constexpr const char* reading_heading = "Reading the frame";

/// Files of planes. Where no frame is given, the depth's file is the frame.
void add_plane_file_flags(CLI::App& app, FrameFlags& flags) {
  CLI::Option* of_depth =
      add_text(app, "--depth-file", flags.depth_file, "FILE",
               "depth in a file of its own: EXR, PNG, TIFF, PFM, HDR, NPY, NPZ, HDF5; needs no FRAME.exr beside it");
  add_text(app, "--normal-file", flags.normal_file, "FILE", "normals in a file of their own");
  add_text(app, "--color-file", flags.color_file, "FILE", "colours in a file of their own");
  add_text(app, "--plane-file", flags.plane_files, "PLANE=FILE", "any plane in a file of its own (repeatable)")
      ->expected(1)
      ->take_all();
  CLI::Option* frame = app.get_option_no_throw("frame");
  if (!frame) return;
  of_depth->each([frame](const std::string& file) {
    if (frame->count() > 0) return;
    frame->add_result(file);
    frame->run_callback();
  });
}

/// "PLANE=FILE" as its two sides. Throws UsageError, with `example`, for another form.
std::pair<std::string, std::string> sides_of(const std::string& text, const char* flag, const char* what,
                                             const char* example) {
  const size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
    throw UsageError("{} '{}' is not {}; write {}", flag, text, what, example);
  return {text.substr(0, equals), text.substr(equals + 1)};
}

std::map<std::string, std::filesystem::path> planes_with_files(const FrameFlags& flags) {
  std::map<std::string, std::filesystem::path> files;
  const auto add = [&](const std::string& plane, const std::string& file) {
    if (!file.empty() && !files.emplace(plane, file).second)
      throw UsageError("--plane-file {}={}: the plane has the file {} already", plane, file, files.at(plane).string());
  };
  add("depth", flags.depth_file);
  add("normal", flags.normal_file);
  add("color", flags.color_file);
  for (const std::string& text : flags.plane_files) {
    const auto [plane, file] = sides_of(text, "--plane-file", "PLANE=FILE", "roughness=rough.png");
    add(plane, file);
  }
  return files;
}

}  // namespace

void FrameArguments::add_to(CLI::App& app) {
  add_text(app, "frame", frame, "FRAME.exr", "EXR file, or PNG, TIFF, PFM, HDR, NPY, NPZ, HDF5")->required();
  add_text(app, "other_eye", other_eye, "RIGHT.exr",
           "the second eye, where FRAME.exr holds one view and this file the other");
  add_text(app, "--history", history, "PREVIOUS.exr",
           "what gloam run wrote for the frame before, for techniques that accumulate")
      ->group(reading_heading);
}

std::vector<std::string> FrameArguments::files() const {
  std::vector<std::string> paths = {frame};
  if (!other_eye.empty()) paths.push_back(other_eye);
  return paths;
}

bool FrameArguments::has_pattern() const {
  return FramePattern::is_pattern(frame) || (!other_eye.empty() && FramePattern::is_pattern(other_eye));
}

FrameFiles FrameArguments::open(const ReadOptions& options) const {
  FrameFiles files(this->files(), options);
  if (!history.empty()) files.take_history(history);
  return files;
}

void FrameFlags::add_to(CLI::App& app) {
  const Heading heading(app, reading_heading);
  constexpr double infinity = std::numeric_limits<double>::infinity(), most_float = std::numeric_limits<float>::max();
  add_text(app, "--camera", camera, "FILE", "camera JSON; default: the one beside the frame, if any");
  add_number(app, "--fov", fov, {1, 179}, "horizontal field of view, 1 to 179 degrees, over every other camera", "DEG");
  add_choice(app, "--depth", depth, depth_words, "what depth values mean");
  add_number(app, "--near", near, {0, infinity}, "near plane, scene units (for ndc and reversed)", "Z");
  add_number(app, "--far", far, {0, infinity}, "far plane, scene units; depth there is background", "Z");
  add_number(app, "--background", background, {-most_float, most_float, true}, "the stored depth that means background",
             "VALUE");
  add_number(app, "--depth-scale", depth_scale, {-most_float, most_float},
             "what is stored as depth is multiplied by this: 0.001 makes metres of millimetres", "S");
  add_number(app, "--depth-offset", depth_offset, {-most_float, most_float}, "and this is added", "VALUE");
  add_choice(app, "--depth-bytes", depth_bytes, depth_bytes_words,
             "depth of 24 bits in three bytes: red is the lowest, or the highest");
  add_parsed(app, "--depth-encoding", depth_encoding, parse_depth_encoding,
             "what was done to stored depth: srgb (the curve), bottom-up (rows), wrapped (16 bits); plain: nothing",
             "A,B");
  add_choice(app, "--normal-space", normals.space, normal_space_words, "space of the normals");
  add_choice(app, "--normal-range", normals.range, normal_range_words, "normals from -1 to 1, from 0 to 1, or that with the sRGB curve");
  add_parsed(app, "--normal-axes", normals.axes, parse_normal_axes,
             "the axis that each component of the normals lies along: x,-y,z has y down; auto", "X,Y,Z");
  add_text(app, "--plane", planes, "PLANE=CHANNELS",
           "take a plane from these channels or layer: depth=Layer.Z; none: leave the plane out (repeatable)")
      ->expected(1)
      ->take_all();
  add_plane_file_flags(app, *this);
  CLI::Option* one = add_text(app, "--view", view, "NAME", "use this view only");
  add_text(app, "--views", views, "A,B", "use these views, in this order")->excludes(one);
  app.add_option("--limit-memory", limit_memory,
                 "refuse, before anything is decoded, what would take more; default: what is available")
      ->check(accepted_by(parse_memory, "--limit-memory"))  // stays text, for messages; CLI11's sizes know no 1.5G
      ->type_name("4G|512M");
}

bool FrameFlags::changes_depth() const {
  return near || far || background || depth_scale || depth_offset || depth_bytes != DepthBytes::automatic ||
         depth_encoding || planes_with_files(*this).count("depth") > 0 || depth != DepthConvention::automatic ||
         std::any_of(planes.begin(), planes.end(),
                     [](const std::string& plane) { return plane.starts_with("depth="); });
}

ReadOptions FrameFlags::read_options() const {
  ReadOptions options;
  options.camera_file = camera;
  options.fov_degrees = fov;
  options.near = near;
  options.far = far;
  if (background) options.background = float(*background);
  options.depth = depth;
  options.depth_scale = depth_scale;
  options.depth_offset = depth_offset;
  options.depth_bytes = depth_bytes;
  options.depth_encoding = depth_encoding;
  options.plane_files = planes_with_files(*this);
  options.normals = normals;
  if (!view.empty()) options.views = {view};
  if (!views.empty()) options.views = split_list(views, "--views");
  for (const std::string& plane : planes) {
    const auto [name, channels] = sides_of(plane, "--plane", "PLANE=CHANNELS", "depth=Layer.Z");
    options.channels[name] = channels;
  }
  return options;
}

std::vector<const CLI::Option*> reading_flags(const CLI::App& app) {
  return app.get_options(
      [](const CLI::Option* option) { return option->get_group() == reading_heading && option->count() > 0; });
}

std::string reading_text(const CLI::App& app) {
  std::string text;
  for (const CLI::Option* option : reading_flags(app))
    for (const std::string& value : option->results()) text += " " + option->get_name() + " " + quoted_for_shell(value);
  return text;
}

void check_no_reading_flags(const CLI::App& app, const std::vector<std::string>& allowed) {
  for (const CLI::Option* option : reading_flags(app)) {
    if (!contains(allowed, option->get_name()))
      throw UsageError("{}: says how frames are read, and those of a set say it themselves; leave it out",
                       option->get_name());
  }
}

void check_no_frames(const FrameChoice& choice, const std::string& frame) {
  if (choice.frames)
    throw UsageError("--frames: is for a shot, and {} is one frame; write its number as in shot.####.exr", frame);
}

}  // namespace gloam::cli
