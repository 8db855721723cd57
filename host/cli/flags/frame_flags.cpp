#include "cli/flags/frame_flags.h"

#include <limits>

#include "cli/flags/memory.h"
#include "cli/flags/options.h"
#include "exr/read_words.h"
#include "gloam/error.h"
#include "gloam/frame_pattern.h"
#include "normalise/normal_axes.h"

namespace gloam::cli {
void FrameArguments::add_to(CLI::App& app) {
  app.add_option("frame", frame, "EXR file")->required()->type_name("FRAME.exr");
  app.add_option("other_eye", other_eye, "the second eye, where FRAME.exr holds one view and this file the other")
      ->type_name("RIGHT.exr");
  app.add_option("--history", history, "what gloam run wrote for the frame before, for techniques that accumulate")
      ->type_name("PREVIOUS.exr")
      ->group("Reading the frame");
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
  constexpr double infinity = std::numeric_limits<double>::infinity(), most_float = std::numeric_limits<float>::max();
  app.add_option("--camera", camera, "camera JSON; default: the one beside the frame, if any")
      ->type_name("FILE")
      ->group("Reading the frame");
  add_number(app, "--fov", fov, {1, 179}, "horizontal field of view, 1 to 179 degrees, over every other camera")
      ->type_name("DEG")
      ->group("Reading the frame");
  add_choice(app, "--depth", depth, depth_words, "what depth values mean")->group("Reading the frame");
  add_number(app, "--near", near, {0, infinity}, "near plane, scene units (for ndc and reversed)")
      ->type_name("Z")
      ->group("Reading the frame");
  add_number(app, "--far", far, {0, infinity}, "far plane, scene units; depth there is background")
      ->type_name("Z")
      ->group("Reading the frame");
  add_number(app, "--background", background, {-most_float, most_float, true}, "the depth value that means background")
      ->type_name("VALUE")
      ->group("Reading the frame");
  add_choice(app, "--normal-space", normals.space, normal_space_words, "space of the normals")
      ->group("Reading the frame");
  add_choice(app, "--normal-range", normals.range, normal_range_words, "normals from -1 to 1, or from 0 to 1")
      ->group("Reading the frame");
  add_parsed(app, "--normal-axes", normals.axes, parse_normal_axes,
             "the axis that each component of the normals lies along: x,-y,z has y down; auto")
      ->type_name("X,Y,Z")
      ->group("Reading the frame");
  app.add_option("--plane", planes,
                 "take a plane from these channels or layer: depth=Layer.Z; none: leave the plane out (repeatable)")
      ->type_name("PLANE=CHANNELS")
      ->group("Reading the frame")
      ->expected(1)
      ->take_all();
  CLI::Option* one =
      app.add_option("--view", view, "use this view only")->type_name("NAME")->group("Reading the frame");
  app.add_option("--views", views, "use these views, in this order")
      ->type_name("A,B")
      ->group("Reading the frame")
      ->excludes(one);
  app.add_option("--limit-memory", limit_memory,
                 "refuse, before anything is decoded, what would take more; default: what is available")
      ->check(accepted_by(parse_memory, "--limit-memory"))  // stays text, for messages; CLI11's sizes know no 1.5G
      ->type_name("4G|512M")
      ->group("Reading the frame");
}

ReadOptions FrameFlags::read_options() const {
  ReadOptions options;
  options.camera_file = camera;
  options.fov_degrees = fov;
  options.near = near;
  options.far = far;
  if (background) options.background = float(*background);
  options.depth = depth;
  options.normals = normals;
  if (!view.empty()) options.views = {view};
  if (!views.empty()) options.views = split_list(views, "--views");
  for (const std::string& plane : planes) {
    const size_t equals = plane.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == plane.size()) {
      throw UsageError("--plane '{}' is not PLANE=CHANNELS; write depth=Layer.Z", plane);
    }
    options.channels[plane.substr(0, equals)] = plane.substr(equals + 1);
  }
  return options;
}

}  // namespace gloam::cli
