// gloam capture SCENE -o FRAME.exr
#include "gloam/scene/capture.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>

#include "base/elapsed.h"
#include "camera/camera_json.h"
#include "cli/scene_flags.h"
#include "gloam/error.h"
#include "gloam/radius.h"
#include "gloam/scene/light_field_capture.h"
#include "gloam/visualise.h"

namespace gloam::cli {
namespace {

struct CaptureCommand {
  std::string out, size, planes, peel = "0", path, picture, compression = "zip";
  std::string display, modules;
  std::string stochastic, alpha, stochastic_seed, view2, stereo, convergence, outlines, outline_method, outline_angle;
  bool half = false, toe_in = false, separate = false;
  SceneFlags scene;
  SceneCameraFlags camera;
  JsonFlag json;
};

/// All planes but motion, which needs a path.
std::vector<std::string> planes_of(const CaptureCommand& flags) {
  std::vector<std::string> planes;
  if (!flags.planes.empty()) planes = split_list(flags.planes, "--planes");
  for (const std::string& plane : capture_planes()) {
    if (flags.planes.empty() && plane != "motion") planes.push_back(plane);
  }
  if (contains(planes, "motion") && flags.path.empty())
    throw UsageError("--planes motion needs cameras of two moments; give --camera-path FILE.json");
  if (!flags.path.empty()) add_new(planes, "motion");
  return planes;
}

StochasticOptions stochastic_of(const CaptureCommand& flags) {
  StochasticOptions options;
  if (flags.stochastic.empty()) {
    if (!flags.alpha.empty()) throw UsageError("--alpha is of a stochastic depth map; give --stochastic S too");
    if (!flags.stochastic_seed.empty())
      throw UsageError("--stochastic-seed is of a stochastic depth map; give --stochastic S too");
    return options;
  }
  options.samples = parse_whole_number(flags.stochastic, "--stochastic", 1, 16);
  if (!flags.alpha.empty()) options.alpha = parse_number(flags.alpha, "--alpha", 0, 1);
  if (!flags.stochastic_seed.empty())
    options.seed = parse_whole_number(flags.stochastic_seed, "--stochastic-seed", 0, std::numeric_limits<int>::max());
  return options;
}

/// None where none are wanted.
std::optional<OutlineOptions> outlines_of(const CaptureCommand& flags) {
  if (flags.outlines.empty()) {
    if (!flags.outline_method.empty()) throw UsageError("--outline-method is of outlines; give --outlines EXTENT too");
    if (!flags.outline_angle.empty()) throw UsageError("--outline-angle is of outlines; give --outlines EXTENT too");
    return {};
  }
  OutlineOptions options;
  options.extent = parse_number(flags.outlines, "--outlines", 1e-15, 1e15);
  if (!flags.outline_method.empty()) {
    const std::vector<std::string>& names = outline_methods();
    const auto found = std::find(names.begin(), names.end(), flags.outline_method);
    if (found == names.end())
      throw UsageError("--outline-method {} is not allowed{}; {} are", flags.outline_method,
                       suggestion(flags.outline_method, names), enumerate(names));
    options.method = OutlineMethod(found - names.begin());
  }
  if (flags.outline_angle.empty()) return options;
  if (options.method != OutlineMethod::integrated)
    throw UsageError(
        "--outline-angle tells apart the normals that --outline-method integrated takes the mean of; leave it out");
  options.angle_degrees = parse_number(flags.outline_angle, "--outline-angle", 0, 90);
  return options;
}

/// By how many degrees the second view is turned; none where none is wanted.
std::optional<double> second_view_of(const CaptureCommand& flags) {
  if (flags.view2.empty()) return {};
  const double degrees = parse_number(flags.view2, "--view2", -90, 90);
  if (degrees == 0) throw UsageError("--view2 0 would be the first view again; give -90 to 90 degrees, but not 0");
  return degrees;
}

/// How two eyes stand to each other; none where one view is wanted.
std::optional<StereoRig> stereo_of(const CaptureCommand& flags) {
  if (flags.stereo.empty()) {
    if (!flags.convergence.empty()) throw UsageError("--convergence is of two eyes; give --stereo IPD too");
    if (flags.toe_in) throw UsageError("--toe-in is of two eyes; give --stereo IPD and --convergence D too");
    return {};
  }
  StereoRig rig{parse_number(flags.stereo, "--stereo", 0, 1e30), {}, flags.toe_in};
  if (!flags.convergence.empty()) rig.convergence = parse_number(flags.convergence, "--convergence", 1e-30, 1e30);
  if (flags.toe_in && !rig.convergence)
    throw UsageError("--toe-in turns the eyes towards a depth; give --convergence D too");
  return rig;
}

/// Each says which views a frame has.
void check_second_view_flags(const CaptureCommand& flags) {
  std::vector<std::string> given;
  if (!flags.view2.empty()) given.push_back("--view2");
  if (!flags.stereo.empty()) given.push_back("--stereo");
  if (!flags.path.empty()) given.push_back("--camera-path");
  if (!flags.display.empty()) given.push_back("--display");
  if (given.size() > 1)
    throw UsageError("{} cannot be given together, as each says which views a frame has; give one of them",
                     enumerate(given));
}

/// A camera file may hold more than the one view that two are made of.
void check_single_view(const CaptureCommand& flags, const std::vector<CaptureView>& views) {
  if ((flags.view2.empty() && flags.stereo.empty()) || views.size() == 1) return;
  std::vector<std::string> names;
  for (const CaptureView& view : views) names.push_back("'" + view.name + "'");
  const char* flag = flags.view2.empty() ? "--stereo" : "--view2";
  throw UsageError("{} makes two views of one, and {} has {}; leave out {}, or give a camera of one view", flag,
                   flags.camera.camera, enumerate(names), flag);
}

/// "frame.exr" and 7 make "frame.0007.exr".
std::string numbered(const std::string& path, int number) {
  const std::filesystem::path p(path);
  return (p.parent_path() / fmt::format("{}.{:04}{}", p.stem().string(), number, p.extension().string())).string();
}

/// One moment: what is captured, and the file it goes to.
struct Shot {
  std::string file, picture;
  std::vector<CaptureView> views;
};

/// "frame.exr" and "module07" make "frame.module07.exr".
std::string of_view(const std::string& path, const std::string& view) {
  const std::filesystem::path p(path);
  return (p.parent_path() / fmt::format("{}.{}{}", p.stem().string(), view, p.extension().string())).string();
}

/// The modules that --modules names, by number and from-to; all without it.
std::vector<size_t> chosen_modules(const CaptureCommand& flags, size_t count) {
  std::vector<size_t> chosen;
  if (flags.modules.empty()) {
    for (size_t i = 0; i < count; ++i) chosen.push_back(i);
    return chosen;
  }
  for (const std::string& item : split_list(flags.modules, "--modules")) {
    const size_t dash = item.find('-');
    const int last_allowed = int(count) - 1;
    const int from = parse_whole_number(item.substr(0, dash), "--modules", 0, last_allowed);
    const int to =
        dash == std::string::npos ? from : parse_whole_number(item.substr(dash + 1), "--modules", from, last_allowed);
    for (int i = from; i <= to; ++i) {
      if (std::find(chosen.begin(), chosen.end(), size_t(i)) != chosen.end())
        throw UsageError("--modules {}: names module {} twice; name each once", flags.modules, i);
      chosen.push_back(size_t(i));
    }
  }
  return chosen;
}

/// The display, with the part of the world that it shows: its own, or what the scene's camera frames, whose middle depth comes
/// to lie in the screen.
LightFieldDisplay display_for(const CaptureCommand& flags, const Tracer& tracer) {
  LightFieldDisplay display = read_display(flags.display);
  if (display.world) {
    if (flags.camera.any())
      throw UsageError(
          "--display {}: says itself which part of the world it shows; leave out --camera, --eye, --target "
          "and --fov",
          flags.display);
    return display;
  }
  const FittingSize size = fitting_size(display);
  const auto cameras = flags.camera.cameras(tracer.scene(), size.width, size.height);
  if (cameras.size() != 1)
    throw UsageError("--display {}: shows what one camera frames, and {} has {}; give a camera of one view",
                     flags.display, flags.camera.camera, cameras.size());
  const auto fitted = fitted_to(display, tracer, cameras.begin()->second);
  if (!fitted)
    throw Error(
        "--display {}: the camera shows nothing of the scene that the display could; another --camera or --eye may",
        flags.display);
  return *fitted;
}

/// One file with all modules, or one for each.
std::vector<Shot> shots_of_display(const CaptureCommand& flags, const Tracer& tracer, CaptureOptions& options) {
  const LightFieldDisplay display = display_for(flags, tracer);
  if (flags.size.empty()) options.width = display.width, options.height = display.height;
  const std::vector<CaptureView> views = module_views(display, options.width, options.height);
  std::vector<Shot> shots;
  if (!flags.separate) shots.push_back({flags.out, flags.picture, {}});
  for (const size_t i : chosen_modules(flags, views.size())) {
    const std::string& name = views[i].name;
    if (flags.separate)
      shots.push_back({of_view(flags.out, name), flags.picture.empty() ? "" : of_view(flags.picture, name), {}});
    shots.back().views.push_back(views[i]);
  }
  return shots;
}

std::vector<Shot> shots_of(const CaptureCommand& flags, const Scene& scene, int width, int height) {
  std::vector<Shot> shots;
  if (flags.path.empty()) {
    Shot shot{flags.out, flags.picture, {}};
    for (const auto& [name, camera] : flags.camera.cameras(scene, width, height))
      shot.views.push_back({name, camera, {}});
    check_single_view(flags, shot.views);
    return {shot};
  }
  std::vector<std::string> assumed;
  const std::vector<Camera> cameras = read_camera_path(flags.path, {0, 0, width, height}, assumed);
  note(assumed);
  for (size_t i = 0; i < cameras.size(); ++i) {
    const int number = int(i) + 1;
    shots.push_back({numbered(flags.out, number),
                     flags.picture.empty() ? "" : numbered(flags.picture, number),
                     {{"", cameras[i], cameras[i == 0 ? 0 : i - 1]}}});
  }
  return shots;
}

/// How many surfaces lie under a pixel that shows any.
struct Layers {
  long long pixels = 0, surfaces = 0;
  int most = 0;
  void add(const Frame& frame) {
    for (const View& view : frame.views) {
      const Plane* count = view.find("peel_count");
      if (!count) continue;
      for (int y = 0; y < frame.height(); ++y) {
        for (int x = 0; x < frame.width(); ++x) {
          const int n = int(count->channels[0].at(x, y));
          pixels += n > 0;
          surfaces += n;
          most = std::max(most, n);
        }
      }
    }
  }
  double mean() const { return pixels == 0 ? 0 : double(surfaces) / double(pixels); }
};

struct Figures {
  size_t faces = 0, meshes = 0;
  double load = 0, build = 0, trace = 0, stochastic = 0, outlines = 0, write = 0;
  long long rays = 0;
  Layers layers;
  std::string camera;                    ///< where the first view's camera came from
  long long surfaces = 0;                ///< pixels that show one
  std::optional<VisibleDepths> visible;  ///< what the second view holds
  std::optional<Camera> second;          ///< its camera
  double shift = 0;                      ///< of each eye's principal point, pixels
  std::optional<double> ao_radius;  ///< that suits the scene, else the first frame; none: nothing is in the picture
  std::vector<std::string> files;
};

/// The scene's lit colour as a picture.
void write_colour(const Shot& shot, const Frame& frame) {
  if (shot.picture.empty()) return;
  for (const View& view : frame.views) {
    write_picture(picture_path(shot.picture, view.name, frame.views.size() > 1), view.planes.at("color"));
  }
}

/// The radius is the same in all frames of a sequence.
void state_radius(Frame& frame, Figures& figures) {
  if (!figures.ao_radius) figures.ao_radius = radius_made_from(frame);
  if (figures.ao_radius) frame.numbers["aoRadius"] = *figures.ao_radius;
}

void take(const Shot& shot, const Tracer& tracer, CaptureOptions options, const WriteOptions& write, Figures& figures) {
  options.views = shot.views;
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

/// What the image of a camera spans from its left to its right border: degrees, or scene units.
double span_of(const Camera& camera, int width) {
  const double left = camera.cx / camera.fx, right = (width - camera.cx) / camera.fx;
  if (camera.orthographic) return left + right;
  return (std::atan(left) + std::atan(right)) * 180 / std::numbers::pi;
}

Json stochastic_document(const StochasticOptions& options) {
  if (options.samples == 0) return nullptr;
  return {{"samples", options.samples}, {"alpha", options.alpha}, {"seed", options.seed}};
}

Json outlines_document(const CaptureOptions& options, const Figures& f) {
  if (!options.outlines) return nullptr;
  const OutlineOptions& made = options.outlines->options();
  return {{"extent", made.extent},
          {"method", outline_methods()[size_t(made.method)]},
          {"angle", made.method == OutlineMethod::integrated ? Json(made.angle_degrees) : Json()},
          {"triangles", options.outlines->scene().faces()},
          {"triangles_of_scene", f.faces},
          {"ms", {{"build", 1e3 * options.outlines->build_seconds()}, {"count", 1e3 * f.outlines}}}};
}

Json second_view_document(const CaptureOptions& options, const Figures& f) {
  if (!f.visible) return nullptr;
  return {{"degrees", *options.second_view},
          {"nearest", f.visible->nearest},
          {"median", f.visible->median},
          {"farthest", f.visible->farthest},
          {f.second->orthographic ? "units_across" : "degrees_across", span_of(*f.second, options.width)}};
}

Json stereo_document(const CaptureOptions& options, const Figures& f) {
  if (!options.stereo) return nullptr;
  const StereoRig& rig = *options.stereo;
  return {{"interpupillary_distance", rig.interpupillary_distance},
          {"convergence", rig.convergence ? Json(*rig.convergence) : Json()},
          {"toe_in_degrees", toe_in_degrees(rig)},
          {"shift_pixels", f.shift}};
}

/// "parallel", "converging at depth 2: images shifted by 6.9 pixels each"
std::string convergence_in_words(const StereoRig& rig, double shift) {
  if (!rig.convergence) return "parallel";
  return fmt::format("converging at depth {:g}: {}", *rig.convergence,
                     rig.toe_in ? fmt::format("each turned by {:.3g} degrees", toe_in_degrees(rig))
                                : fmt::format("images shifted by {:.3g} pixels each", shift));
}

Json document(const Scene& scene, const CaptureOptions& options, const Figures& f) {
  Json layers = nullptr;
  if (options.peel > 0) layers = {{"stored", options.peel}, {"mean", f.layers.mean()}, {"max", f.layers.most}};
  return {
      {"scene", scene.name},
      {"faces", f.faces},
      {"meshes", f.meshes},
      {"size", {options.width, options.height}},
      {"files", f.files},
      {"layers", layers},
      {"stochastic", stochastic_document(options.stochastic)},
      {"outlines", outlines_document(options, f)},
      {"view2", second_view_document(options, f)},
      {"stereo", stereo_document(options, f)},
      {"ao_radius", f.ao_radius ? Json(*f.ao_radius) : Json()},
      {"rays", f.rays},
      {"rays_per_second", f.trace > 0 ? double(f.rays) / f.trace : 0},
      {"seconds",
       {{"load", f.load}, {"build", f.build}, {"trace", f.trace}, {"stochastic", f.stochastic}, {"write", f.write}}}};
}

void print(const Scene& scene, const CaptureOptions& options, const Figures& f) {
  fmt::print("{}: {} faces in {} meshes, {}x{}\n", printable(scene.name), f.faces, f.meshes, options.width,
             options.height);
  fmt::print("{}{}\n", f.camera,
             f.ao_radius ? fmt::format("; AO radius that suits: {:g} scene units", *f.ao_radius) : "");
  if (options.peel > 0)
    fmt::print("layers under a pixel: mean {:.2f}, most {}; {} stored\n", f.layers.mean(), f.layers.most, options.peel);
  if (options.stochastic.samples > 0)
    fmt::print("stochastic depth: {} samples, alpha {:g}; choosing them took {:.3f} s of the tracing\n",
               options.stochastic.samples, options.stochastic.alpha, f.stochastic);
  if (options.outlines)
    fmt::print("outlines: {:g} scene units away, {}; building them took {:.3f} s, counting {:.3f} s of the tracing\n",
               options.outlines->options().extent, outline_methods()[size_t(options.outlines->options().method)],
               options.outlines->build_seconds(), f.outlines);
  if (f.visible)
    fmt::print("view2: turned {:g} degrees about depth {:g}, holds depths {:g} to {:g}, {:.3g} {} across\n",
               *options.second_view, f.visible->median, f.visible->nearest, f.visible->farthest,
               span_of(*f.second, options.width), f.second->orthographic ? "scene units" : "degrees");
  if (options.stereo)
    fmt::print("stereo: eyes {:g} scene units apart, {}\n", options.stereo->interpupillary_distance,
               convergence_in_words(*options.stereo, f.shift));
  fmt::print("load {:.2f} s, build {:.2f} s, trace {:.2f} s ({:.1f} million rays per second), write {:.2f} s\n", f.load,
             f.build, f.trace, f.trace > 0 ? double(f.rays) / f.trace * 1e-6 : 0.0, f.write);
  if (f.files.size() == 1)
    fmt::print("wrote {}\n", printable(f.files.front()));
  else
    fmt::print("wrote {} files, {} to {}\n", f.files.size(), printable(f.files.front()), printable(f.files.back()));
}

void check_flags(const CaptureCommand& flags, const WriteOptions& write) {
  check(write);
  check_picture_name(flags.picture, "--picture");
  check_frame_name(flags.out, "-o");
  check_second_view_flags(flags);
  if (flags.display.empty() && !flags.modules.empty())
    throw UsageError("--modules are of a light-field display; give --display FILE too");
  if (flags.display.empty() && flags.separate)
    throw UsageError("--separate is of the modules of a light-field display; give --display FILE too");
  if (!flags.path.empty() && flags.camera.any())
    throw UsageError(
        "--camera-path places the camera and has its field of view; leave out --camera, --eye, --target and "
        "--fov");
  if (!flags.picture.empty() && !flags.planes.empty() && !contains(split_list(flags.planes, "--planes"), "color"))
    throw UsageError("--picture shows the plane color; add it to --planes");
}

/// None of what is written may be what is read, or be written twice.
void check_files(const CaptureCommand& flags, const std::vector<Shot>& shots) {
  std::vector<NamedPath> outputs = {{"--json", flags.json.file()}};
  for (const Shot& shot : shots) {
    outputs.emplace_back("-o", shot.file);
    outputs.emplace_back("--picture", shot.picture);
  }
  check_paths({{"the scene", find_builtin_scene(flags.scene.scene) ? "" : flags.scene.scene},
               {"--camera", flags.camera.camera},
               {"--camera-path", flags.path},
               {"--display", flags.display}},
              outputs);
}

void capture_command(const CaptureCommand& flags) {
  const WriteOptions write{flags.half, flags.compression};
  check_flags(flags, write);
  if (flags.path.empty()) check_files(flags, {{flags.out, flags.picture, {}}});  // before the scene is loaded
  if (!flags.display.empty()) read_display(flags.display);                       // what is wrong with it is said first
  CaptureOptions options;
  if (!flags.size.empty()) std::tie(options.width, options.height) = parse_size(flags.size, "--size");
  options.planes = planes_of(flags);
  options.peel = parse_whole_number(flags.peel, "--peel", 0, 64);
  options.stochastic = stochastic_of(flags);
  const std::optional<OutlineOptions> outline_options = outlines_of(flags);
  options.second_view = second_view_of(flags);
  options.stereo = stereo_of(flags);
  Figures figures;
  const auto start = std::chrono::steady_clock::now();
  const Scene scene = flags.scene.load();
  figures.load = seconds_since(start);
  const Tracer tracer(scene);
  const std::vector<Shot> shots = flags.display.empty() ? shots_of(flags, scene, options.width, options.height)
                                                        : shots_of_display(flags, tracer, options);
  check_files(flags, shots);
  figures.camera = shots.front().views.front().camera.source;
  figures.build = tracer.build_seconds();
  std::optional<Outlines> outlines;
  if (outline_options) options.outlines = &outlines.emplace(tracer, *outline_options);
  figures.faces = scene.faces();
  if (scene.ao_radius > 0) figures.ao_radius = scene.ao_radius;
  figures.meshes = scene.meshes.size();
  const auto bar = progress_bar();
  int taken = 0;
  if (bar) {
    options.progress = [&](int done, int of) { bar(taken * 1000 + int(1000LL * done / of), int(shots.size()) * 1000); };
  }
  for (const Shot& shot : shots) {
    take(shot, tracer, options, write, figures);
    ++taken;
  }
  if (figures.surfaces == 0) note({"nothing of the scene is in the picture; another --camera or --eye may see it"});
  flags.json.write(document(scene, options, figures), figures.files);
  if (!flags.json.only_json()) print(scene, options, figures);
}

}  // namespace

void add_capture(CLI::App& app) {
  auto flags = std::make_shared<CaptureCommand>();
  CLI::App* command = app.add_subcommand("capture", "a G-buffer of a scene: an OBJ or glTF file, or a built-in one");
  command->add_option("scene", flags->scene.scene, "OBJ or glTF file, or a name of gloam list scenes")
      ->required()
      ->type_name("SCENE");
  command->add_option("-o,--output", flags->out, "EXR file to write")->required()->type_name("FRAME.exr");
  command->add_option("--size", flags->size, "of the image; default 1920x1080")->type_name("WxH");
  command->add_option("--planes", flags->planes, "these planes and depth only: " + enumerate(capture_planes()))
      ->type_name("A,B");
  command->add_option("--peel", flags->peel, "depth layers to store per pixel, 0 to 64")->type_name("N");
  command->add_option("--stochastic", flags->stochastic, "samples of a stochastic depth map of all surfaces, 1 to 16")
      ->type_name("S");
  command->add_option("--alpha", flags->alpha, "share of the samples that a surface is offered to; default 0.2")
      ->type_name("A");
  command->add_option("--stochastic-seed", flags->stochastic_seed, "of its random choices; default 0")->type_name("N");
  command
      ->add_option("--outlines", flags->outlines,
                   "count per pixel the outlines, that many scene units around the objects, that it is in")
      ->type_name("EXTENT");
  command
      ->add_option("--outline-method", flags->outline_method,
                   "how outlines are made: " + enumerate(outline_methods()) + "; default integrated")
      ->type_name("NAME");
  command
      ->add_option("--outline-angle", flags->outline_angle,
                   "degrees between face normals that count as one, 0 to 90; default 1")
      ->type_name("DEGREES");
  command->add_option("--view2", flags->view2, "also a second view, turned by that many degrees, -90 to 90")
      ->type_name("ANGLE");
  command
      ->add_option("--stereo", flags->stereo,
                   "two views, left and right: eyes that many scene units apart, the camera between")
      ->type_name("IPD");
  command
      ->add_option("--convergence", flags->convergence, "with --stereo: depth of no disparity; default: parallel eyes")
      ->type_name("D");
  command->add_flag("--toe-in", flags->toe_in, "with --convergence: turn the eyes, instead of shifting their frusta");
  command
      ->add_option("--display", flags->display,
                   "the views of all optical modules of a light-field display (docs/light-field.md), in its size")
      ->type_name("FILE.json");
  command->add_option("--modules", flags->modules, "with --display: these only, by number: 0,5,10-19")
      ->type_name("N,N-N");
  command->add_flag("--separate", flags->separate, "with --display: one file for each module, FRAME.module07.exr");
  command->add_option("--camera-path", flags->path, "camera JSON with a \"path\": one frame per camera, with motion")
      ->type_name("FILE");
  command->add_option("--picture", flags->picture, "also the colour as a picture")->type_name("COLOUR.png");
  command->add_flag("--half", flags->half, "store bounded planes as half");
  command->add_option("--compression", flags->compression, "zip, zips, piz, rle or none")->type_name("NAME");
  flags->camera.add_to(*command);
  flags->scene.add_settings_to(*command);
  flags->json.add_to(*command);
  command->footer(
      "Planes are sampled at pixel centres. Examples:\n"
      "  gloam capture colonnade -o colonnade.exr --size 960x540 --picture colonnade.png\n"
      "  gloam capture statue --faces 500000 -o statue.exr --peel 8\n"
      "  gloam capture fence -o fence.exr --stochastic 4 --view2 30\n"
      "  gloam capture courtyard -o courtyard.exr --outlines 0.5\n"
      "  gloam capture colonnade -o pair.exr --stereo 0.065 --convergence 2\n"
      "  gloam capture statue -o modules.exr --display data/displays/small.json\n"
      "  gloam capture hairball -o hair.exr --stochastic 16 --alpha 0.1 --stochastic-seed 7\n"
      "  gloam capture house.glb -o house.exr --camera Kitchen --planes depth,normal\n"
      "  gloam capture house.obj -o house.exr --eye 4,1.7,6 --target 0,1,0 --fov 70");
  command->callback([flags] { capture_command(*flags); });
}

}  // namespace gloam::cli
