// gloam capture SCENE -o FRAME.exr
#include "gloam/scene/capture.h"

#include <chrono>
#include <memory>
#include <optional>

#include "base/elapsed.h"
#include "camera/camera_json.h"
#include "cli/capture/command.h"
#include "cli/capture/flags.h"
#include "cli/capture/shots.h"
#include "cli/flags/shot_flags.h"
#include "gloam/display_json.h"
#include "gloam/error.h"
#include "gloam/light_field.h"
#include "gloam/margin.h"
#include "gloam/radius.h"
#include "gloam/scene/light_field_capture.h"
#include "gloam/scene/sky_map.h"
#include "gloam/visualise.h"
#include "scene/scene_of_frame.h"

namespace gloam::cli {
namespace {

/// The scene's lit colour as a picture.
void write_colour(const CaptureShot& shot, const Frame& frame) {
  if (shot.picture.empty()) return;
  for (const View& view : frame.views) {
    write_picture(picture_path(shot.picture, view.name, frame.views.size() > 1),
                  part_of(view.planes.at("color"), frame.window, frame.display));
  }
}

/// The radius is the same in all frames of a sequence.
void state_radius(Frame& frame, CaptureFigures& figures) {
  if (!figures.ao_radius) figures.ao_radius = radius_made_from(frame);
  if (figures.ao_radius) frame.numbers["aoRadius"] = *figures.ao_radius;
}

void take(const CaptureShot& shot, const Tracer& tracer, CaptureOptions options, const WriteOptions& write,
          CaptureFigures& figures) {
  options.views = shot.views;
  if (!options.stochastic.radius) options.stochastic.radius = figures.ao_radius;
  CaptureResult result = capture(tracer, options);
  state_radius(result.frame, figures);
  figures.trace += result.seconds;
  figures.stochastic += result.stochastic_seconds;
  figures.outlines += result.outline_seconds;
  figures.rays += result.rays;
  figures.layers.add(result.frame);
  figures.surfaces += result.surfaces;
  figures.visible = result.visible;
  if (result.visible) figures.second = result.frame.views.back().camera;
  if (options.stereo)
    figures.shift = 0.5 * (result.frame.views.back().camera->cx - result.frame.views.front().camera->cx);
  const auto start = std::chrono::steady_clock::now();
  write_frame(shot.file, result.frame, write);
  write_colour(shot, result.frame);
  figures.write += seconds_since(start);
  figures.files.push_back(shot.file);
}

/// Frames of a moving camera have numbers in their names; one frame has none.
void check_moving_flags(const CaptureCommand& flags) {
  if (!flags.path.empty() && !flags.shot.empty())
    throw UsageError("--camera-path and --shot both move the camera; give one of them");
  const std::string moving = flags.moving();
  if (!moving.empty() && flags.camera.any())
    throw UsageError("{} places the camera and has its field of view; leave out --camera, --eye, --target and --fov",
                     moving);
  if (!moving.empty()) return;
  if (flags.choice.frames)
    throw UsageError("--frames: one camera makes one frame; give --camera-path FILE.json or --shot NAME too");
  for (const auto& [flag, name] : {std::pair("-o", flags.out), std::pair("--picture", flags.picture)}) {
    if (FramePattern::is_pattern(name))
      throw UsageError(
          "{} {}: is the name of many frames, and one camera makes one; give --camera-path FILE.json or "
          "--shot NAME too",
          flag, name);
  }
}

void check_flags(const CaptureCommand& flags) {
  check_picture_name(flags.picture, "--picture");
  check_frame_name(flags.out, "-o");
  if (!flags.sky.empty()) check_frame_name(flags.sky, "--sky");
  if (FramePattern::is_pattern(flags.sky))
    throw UsageError("--sky {}: is the name of many files, and the sky is one; give a name without #", flags.sky);
  check_second_view_flags(flags);
  if (flags.display.empty() && !flags.modules.empty())
    throw UsageError("--modules are for a light-field display; give --display FILE too");
  if (!flags.display.empty() && flags.overscan)
    throw UsageError("--overscan: the views of a light-field display end where its screen does; leave it out");
  if (flags.display.empty() && flags.separate)
    throw UsageError("--separate is for the modules of a light-field display; give --display FILE too");
  check_moving_flags(flags);
  if (!flags.picture.empty() && !flags.planes.empty() && !contains(split_list(flags.planes, "--planes"), "color"))
    throw UsageError("--picture shows the plane color; add it to --planes");
}

/// Words for the values of an enumeration, which are numbered from 0.
template <typename Value>
Choices<Value> by_name(const std::vector<std::string>& names) {
  Choices<Value> choices;
  for (const std::string& name : names) choices.emplace_back(name, Value(choices.size()));
  return choices;
}

/// Throws UsageError if an output is also an input or another output.
void check_files(const CaptureCommand& flags, const std::vector<CaptureShot>& shots) {
  std::vector<NamedPath> outputs = {{"--json", flags.json.file()}, {"--sky", flags.sky}};
  for (const CaptureShot& shot : shots) {
    outputs.emplace_back("-o", shot.file);
    outputs.emplace_back("--picture", shot.picture);
    std::vector<std::string> views;
    for (const CaptureView& view : shot.views) views.push_back(view.name);
    check_pictures({"--picture", shot.picture}, views);
  }
  check_paths({{"the scene", find_builtin_scene(flags.scene.scene) ? "" : flags.scene.scene},
               {"--camera", flags.camera.camera},
               {"--camera-path", flags.path},
               {"--display", flags.display}},
              outputs);
}

CaptureOptions options_of(const CaptureCommand& flags) {
  CaptureOptions options;
  std::optional<Size> size = flags.size;
  if (!size && !flags.path.empty()) size = stated_size(flags.path);
  if (size) std::tie(options.width, options.height) = *size;
  if (flags.overscan)
    std::tie(options.margin_x, options.margin_y) = flags.overscan->around({options.width, options.height});
  options.planes = planes_of(flags);
  options.peel = flags.peel;
  options.peel_light = flags.peel_light;
  options.stochastic = stochastic_of(flags);
  options.second_view = second_view_of(flags);
  options.stereo = stereo_of(flags);
  return options;
}

/// The path, for an image of the size of the frames, or of a small one that a display is fitted to. Reports a display's errors.
std::optional<CameraPath> path_for(const CaptureCommand& flags, const CaptureOptions& options) {
  if (flags.display.empty()) return path_of(flags, options.width, options.height);
  const FittingSize size = fitting_size(read_display(flags.display));
  return path_of(flags, size.width, size.height);
}

/// All frames of a path have the radius of its first frame, whichever of them are made.
std::optional<double> radius_of_first_frame(const CaptureCommand& flags, const CameraPath& path, const Tracer& tracer,
                                            CaptureOptions options) {
  CaptureCommand first = flags;
  first.choice.frames = {1};
  options.views = (flags.display.empty() ? shots_of_path(first, path) : shots_of_display(first, tracer, options, &path))
                      .front()
                      .views;
  return suitable_radius(tracer, options);
}

void capture_command(const CaptureCommand& flags) {
  const WriteOptions write{flags.half, flags.compression};
  check_flags(flags);
  if (flags.moving().empty()) check_files(flags, {{flags.out, flags.picture, {}}});  // before the scene is loaded
  CaptureOptions options = options_of(flags);
  const std::optional<OutlineOptions> outlines = outlines_of(flags);
  const std::optional<CameraPath> path = path_for(flags, options);
  std::vector<CaptureShot> shots;
  if (path && flags.display.empty()) {
    shots = shots_of_path(flags, *path);
    check_files(flags, shots);
  }
  MovingScene scene(flags.scene.named(), path ? path->recipe : nullptr, outlines, note);
  if (!flags.display.empty()) shots = shots_of_display(flags, scene.tracer(), options, path ? &*path : nullptr);
  if (shots.empty()) shots.push_back(single_shot(flags, scene.scene(), options.width, options.height));
  check_files(flags, shots);
  CaptureFigures figures;
  figures.camera = shots.front().views.front().camera.source;
  figures.faces = scene.scene().faces();
  figures.meshes = scene.scene().meshes.size();
  if (scene.scene().ao_radius > 0)
    figures.ao_radius = scene.scene().ao_radius;
  else if (shots.front().frame > 1)
    figures.ao_radius = radius_of_first_frame(flags, *path, scene.tracer(), options);
  const auto bar = progress_bar();
  int taken = 0;
  if (bar) {
    options.progress = [&](int done, int of) { bar(taken * 1000 + int(1000LL * done / of), int(shots.size()) * 1000); };
  }
  for (const CaptureShot& shot : shots) {
    scene.go_to(shot.frame);
    options.previous_scene = scene.previous();
    options.outlines = scene.outlines();
    take(shot, scene.tracer(), options, write, figures);
    ++taken;
  }
  if (!flags.sky.empty()) {
    write_frame(flags.sky, sky_map(scene.scene()), write);
    figures.files.push_back(flags.sky);
  }
  figures.load = scene.load_seconds();
  figures.build = scene.build_seconds();
  if (figures.surfaces == 0) note({"nothing of the scene is in the picture; another --camera or --eye may see it"});
  flags.json.write(capture_document(scene.scene(), options, figures), figures.files);
  if (!flags.json.only_json()) print_capture(scene.scene(), options, figures);
}

}  // namespace

void add_capture(CLI::App& app) {
  auto flags = std::make_shared<CaptureCommand>();
  CLI::App* command = app.add_subcommand("capture", "a G-buffer of a scene: an OBJ or glTF file, or a built-in one");
  add_text(*command, "scene", flags->scene.scene, "SCENE", "OBJ or glTF file, or a name of gloam list scenes")
      ->required();
  add_text(*command, "-o,--output", flags->out, "FRAME.exr", "EXR file to write")->required();
  add_parsed(*command, "--size", flags->size, parse_size,
             "of the image; default: that of the file of --camera-path, else 1920x1080", "WxH");
  add_parsed(*command, "--overscan", flags->overscan, parse_overscan,
             "margin to render around the image, on each side: a share of its size, 10%, or pixels, 64px; --size stays "
             "the display window, and occluders in the margin count",
             "10%|64px");
  add_text(*command, "--planes", flags->planes, "A,B", "these planes and depth only: " + enumerate(capture_planes()));
  add_number(*command, "--peel", flags->peel, {0, 64}, "depth layers to store per pixel, 0 to 64", "N");
  command->add_flag("--peel-light", flags->peel_light,
                    "with --peel: also colour and normal of each layer, for light from hidden surfaces (dp-indirect)");
  add_number(*command, "--stochastic", flags->stochastic, {1, 16},
             "depths per pixel of a map of surfaces for techniques over stochastic depth, 1 to 16", "S");
  add_choice(*command, "--stochastic-surfaces", flags->stochastic_surfaces,
             by_name<StochasticSurfaces>(stochastic_surfaces()),
             "which surfaces the map is made of: all, those behind the nearest, or of these the ones that may be "
             "within the radius of something visible; default hidden");
  add_number(*command, "--stochastic-radius", flags->stochastic_radius, allowed_radii,
             "of a map of relevant surfaces: the radius of the technique that reads it; default: the one that suits",
             "R");
  add_number(*command, "--stochastic-reach", flags->stochastic_reach, {0, 1},
             "and that technique's max_reach, the cap on the radius on the screen in widths of the image; default 0.25",
             "SHARE");
  add_choice(
      *command, "--stochastic-subset", flags->stochastic_subset, by_name<StochasticSubset>(stochastic_subsets()),
      "which of these each depth holds: chosen at random, stratified; or the nearest, front to back; default nearest");
  add_number(
      *command, "--alpha", flags->alpha, {0, 1},
      "of a stratified map: the share of a pixel's samples that a surface may take, so that others show what is behind "
      "it; smaller shows more of what is far behind; default 0.25",
      "A");
  add_number(*command, "--stochastic-seed", flags->stochastic_seed, allowed_seeds,
             "of the random choices of a stratified map; default 0", "N");
  add_number(*command, "--outlines", flags->outlines, {1e-15, 1e15},
             "count per pixel the outlines, that many scene units around the objects, that it is in", "EXTENT");
  add_choice(*command, "--outline-method", flags->outline_method, by_name<OutlineMethod>(outline_methods()),
             "how outlines are made; default mitre");
  add_number(*command, "--outline-angle", flags->outline_angle, {0, 90},
             "degrees between face normals that count as one, 0 to 90; default 1", "DEGREES");
  add_number(*command, "--view2", flags->view2, {-90, 90}, "also a second view, turned by that many degrees, -90 to 90",
             "ANGLE");
  add_number(*command, "--stereo", flags->stereo, {0, 1e30},
             "two views, left and right: eyes that many scene units apart, the camera between", "IPD");
  add_number(*command, "--convergence", flags->convergence, {1e-30, 1e30},
             "with --stereo: depth of no disparity; default: parallel eyes", "D");
  command->add_flag("--toe-in", flags->toe_in, "with --convergence: turn the eyes, instead of shifting their frusta");
  add_text(*command, "--display", flags->display, "FILE.json",
           "the views of all optical modules of a light-field display (docs/light-field.md), in its size");
  command->add_option("--modules", flags->modules, "with --display: these only, by number: 0,5,10-19")
      ->check(accepted_by(parse_modules, "--modules"))  // stays text: the display decides the number of modules
      ->type_name("N,N-N");
  command->add_flag("--separate", flags->separate, "with --display: one file for each module, FRAME.module07.exr");
  add_text(*command, "--camera-path", flags->path, "FILE",
           "camera JSON with a \"path\": one frame per camera, with motion");
  add_text(*command, "--shot", flags->shot, "NAME",
           "a moving camera of a built-in scene, of gloam list shots: frames with motion");
  add_frames(*command, flags->choice);
  add_text(*command, "--picture", flags->picture, "COLOUR.png", "also the colour as a picture");
  add_text(*command, "--sky", flags->sky, "SKY.exr",
           "also the scene's sky, without the sun, as a lat-long map for --environment (axes openexr)");
  command->add_flag("--half", flags->half, "store bounded planes as half");
  add_compression(*command, flags->compression);
  flags->camera.add_to(*command);
  flags->scene.add_settings_to(*command);
  flags->json.add_to(*command);
  command->footer(
      "Planes are sampled at pixel centres. Examples:\n"
      "  gloam capture colonnade -o colonnade.exr --size 960x540 --picture colonnade.png\n"
      "  gloam capture temple -o temple.exr --size 960x540 --overscan 25%\n"
      "  gloam capture statue --faces 500000 -o statue.exr --peel 8\n"
      "  gloam capture fence -o fence.exr --stochastic 4 --view2 30\n"
      "  gloam capture courtyard -o courtyard.exr --outlines 0.5\n"
      "  gloam capture colonnade -o pair.exr --stereo 0.065 --convergence 2\n"
      "  gloam capture gallery -o 'shot.####.exr' --shot walk --frames 1-12 --size 960x540\n"
      "  gloam capture statue -o modules.exr --display data/displays/small.json\n"
      "  gloam capture pillar -o pillar.exr --stochastic 4 --stochastic-surfaces relevant\n"
      "  gloam capture hairball -o hair.exr --stochastic 16 --stochastic-subset stratified --alpha 0.1\n"
      "  gloam capture gallery -o gallery.exr --sky sky.exr\n"
      "  gloam capture house.glb -o house.exr --camera Kitchen --planes depth,normal\n"
      "  gloam capture house.obj -o house.exr --eye 4,1.7,6 --target 0,1,0 --fov 70");
  command->callback([flags] { capture_command(*flags); });
}

}  // namespace gloam::cli
