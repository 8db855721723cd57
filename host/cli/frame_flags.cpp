#include "cli/frame_flags.h"

#include <cmath>
#include <limits>

#include "cli/options.h"
#include "gloam/error.h"

namespace gloam::cli {

void FrameArguments::add_to(CLI::App& app) {
  app.add_option("frame", frame, "EXR file")->required()->type_name("FRAME.exr");
  app.add_option("other_eye", other_eye, "the second eye, where FRAME.exr holds one view and this file the other")
      ->type_name("RIGHT.exr");
  app.add_option("--history", history, "what gloam run wrote for the frame before, for techniques that accumulate")
      ->type_name("PREVIOUS.exr")
      ->group("Reading the frame");
}

FrameFiles FrameArguments::open(const ReadOptions& options) const {
  std::vector<std::string> paths = {frame};
  if (!other_eye.empty()) paths.push_back(other_eye);
  FrameFiles files(paths, options);
  if (!history.empty()) files.take_history(history);
  return files;
}

void FrameFlags::add_to(CLI::App& app) {
  app.add_option("--camera", camera, "camera JSON; default: the one beside the frame, if any")
      ->type_name("FILE")
      ->group("Reading the frame");
  app.add_option("--fov", fov, "horizontal field of view, 1 to 179 degrees, over every other camera")
      ->type_name("DEG")
      ->group("Reading the frame");
  app.add_option("--depth", depth, "what depth values mean: auto, z, ray, ndc or reversed")
      ->type_name("CONVENTION")
      ->group("Reading the frame");
  app.add_option("--near", near, "near plane, scene units (for ndc and reversed)")
      ->type_name("Z")
      ->group("Reading the frame");
  app.add_option("--far", far, "far plane, scene units; depth there is background")
      ->type_name("Z")
      ->group("Reading the frame");
  app.add_option("--background", background, "the depth value that means background")
      ->type_name("VALUE")
      ->group("Reading the frame");
  app.add_option("--normal-space", normal_space, "space of the normals: auto, view or world")
      ->type_name("SPACE")
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
      ->type_name("4G|512M")
      ->group("Reading the frame");
}

/// What a float holds, or an infinity.
static float parse_depth_value(const std::string& text, const std::string& flag) {
  const double infinity = std::numeric_limits<double>::infinity(), most = std::numeric_limits<float>::max();
  const double value = parse_number(text, flag, -infinity, infinity);
  if (std::isfinite(value) && std::abs(value) > most)
    throw UsageError("{} {} is not allowed; a number from {:g} to {:g}, inf or -inf is", flag, text, -most, most);
  return float(value);
}

ReadOptions FrameFlags::read_options() const {
  ReadOptions options;
  options.camera_file = camera;
  if (!fov.empty()) options.fov_degrees = parse_number(fov, "--fov", 1, 179);
  const double most = std::numeric_limits<double>::infinity();
  if (!near.empty()) options.near = parse_number(near, "--near", 0, most);
  if (!far.empty()) options.far = parse_number(far, "--far", 0, most);
  if (!background.empty()) options.background = parse_depth_value(background, "--background");
  options.depth = one_of<DepthConvention>(depth, "--depth",
                                          {{"auto", DepthConvention::automatic},
                                           {"z", DepthConvention::z},
                                           {"ray", DepthConvention::ray},
                                           {"ndc", DepthConvention::ndc},
                                           {"reversed", DepthConvention::reversed}});
  options.normal_space = one_of<NormalSpace>(
      normal_space, "--normal-space",
      {{"auto", NormalSpace::automatic}, {"view", NormalSpace::view}, {"world", NormalSpace::world}});
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
