// gloam reference KIND FRAME.exr --scene SCENE -o REF.exr
#include <memory>

#include "cli/auto/composite.h"
#include "cli/flags/given_flags.h"
#include "cli/flags/radius.h"
#include "cli/flags/shot_flags.h"
#include "cli/reference/job.h"
#include "gloam/error.h"
#include "gloam/frame_pattern.h"
#include "gloam/scene/bounces_reference.h"
#include "gloam/scene/contact_reference.h"

namespace gloam::cli {
namespace {

int samples_of(const Reference& result, const ReferenceJob& job) {
  return int(result.frame.numbers.at(job.plane + "Samples"));
}

Json document(const Reference& result, const ReferenceJob& job, const Scene& scene) {
  const double seconds = result.seconds;
  Json json = {{"scene", scene.name},
               {"faces", scene.faces()},
               {"samples", samples_of(result, job)},
               {"noise", result.noise},
               {"largest_noise", result.largest_noise},
               {"unlike_share", result.unlike_share},
               {"resumed_share", result.resumed_share},
               {"rays", result.rays},
               {"seconds", seconds},
               {"rays_per_second", seconds > 0 ? double(result.rays) / seconds : 0}};
  for (const auto& [name, word] : job.words) json[name] = word;
  for (const auto& [name, number] : job.numbers) json[name] = number;
  return json;
}

void print(const Reference& result, const ReferenceJob& job, const Scene& scene, const ReferenceCommand& flags) {
  fmt::print("{}: {} faces; {}, {} rays per pixel\n", printable(scene.name), scene.faces(), job.heading,
             samples_of(result, job));
  if (result.resumed_share > 0) fmt::print("went on with {:.0f} % of an interrupted run\n", 100 * result.resumed_share);
  fmt::print("noise {:.5f} RMS, largest {:.4f} (from {})\n", result.noise, result.largest_noise, job.noise_from);
  fmt::print("{:.1f} million rays in {:.1f} s, {:.1f} million per second\n", double(result.rays) * 1e-6, result.seconds,
             result.seconds > 0 ? double(result.rays) / result.seconds * 1e-6 : 0.0);
  fmt::print("wrote {}\n", printable(flags.out));
}

/// Throws UsageError for flags and names that do not go with one frame.
void check_flags(const ReferenceCommand& flags) {
  check_frame_name(flags.out, "-o");
  check_picture_name(flags.picture, "--picture");
  if (FramePattern::is_pattern(flags.frame)) return;
  for (const auto& [flag, name] : {std::pair("-o", flags.out), std::pair("--picture", flags.picture)}) {
    if (FramePattern::is_pattern(name))
      throw UsageError("{} {}: is a pattern, and {} is one frame; write both as patterns, such as shot.####.exr", flag,
                       name, flags.frame);
  }
  const char* of_shots = flags.choice.frames    ? "--frames"
                         : flags.choice.missing ? "--missing"
                         : flags.resume         ? "--resume"
                                                : "";
  if (*of_shots)
    throw UsageError("{}: is for a shot, and {} is one frame; write its number as in shot.####.exr", of_shots,
                     flags.frame);
}

void reference_on_frame(const ReferenceCommand& flags, const ReferenceJob& job) {
  const WriteOptions write{flags.half, flags.compression};
  const std::string checkpoint = flags.out + ".partial";
  check_paths({{"the frame", flags.frame},
               {"--scene", find_builtin_scene(flags.scene.scene) ? "" : flags.scene.scene},
               {"--camera", flags.frame_flags.camera},
               {"--environment", flags.request.environment}},
              {{"-o", flags.out}, {"--picture", flags.picture}, {"--json", flags.json.file()}},
              {{"the unfinished", checkpoint}});
  const auto bar = progress_bar();
  ReferenceOptions options;
  options.seed = uint32_t(flags.seed);
  options.checkpoint = checkpoint;
  if (bar) options.progress = [&bar](double share) { bar(int(share * 1000), 1000); };
  FrameFiles files({flags.frame}, flags.frame_flags.read_options());
  check_pictures({"--picture", flags.picture}, files.views());
  SceneOfFrame scene(flags.scene.named(), note);
  const TracedFrame traced = trace_frame(flags, job, files, scene, options);
  const Reference& result = traced.truth;
  std::optional<RadiusReport> report;
  if (traced.radius) report.emplace(*traced.radius, traced.frame, std::nullopt);
  note(result.notes);
  if (result.unlike_share > most_unlike)
    note({fmt::format("in {:.1f} % of the pixels looked at the scene is over 1 % nearer or farther than the frame",
                      100 * result.unlike_share)});
  write_frame(flags.out, result.frame, write);
  std::error_code gone;
  std::filesystem::remove(checkpoint, gone);
  write_pictures(flags.picture, job, traced);
  Json figures = document(result, job, scene.tracer().scene());
  if (report) report->add_to(figures);
  flags.json.write(figures, {flags.out});
  if (flags.json.only_json()) return;
  if (report) report->print();
  print(result, job, scene.tracer().scene(), flags);
}

/// "  ao  share of the directions that are open\n"
std::string kinds_in_words() {
  std::string words;
  for (const ReferenceKind& kind : reference_kinds()) words += fmt::format("  {:<19} {}\n", kind.name, kind.help);
  return words;
}

void reference_command(ReferenceCommand flags, const CLI::App& command) {
  flags.given = contents_in_words(command);
  flags.request.falloff_settings = flags.scene.take_dotted_settings();
  const ReferenceJob job = job_of(flags.request, as_flag);
  check_flags(flags);
  if (FramePattern::is_pattern(flags.frame)) return reference_on_shot(flags, job);
  reference_on_frame(flags, job);
}

glm::dvec3 parse_direction(const std::string& text, const std::string& flag) {
  const glm::dvec3 direction = parse_point(text, flag);
  if (direction == glm::dvec3(0)) throw UsageError("{} {} is not allowed; a direction that is not 0 is", flag, text);
  return direction;
}

/// Flags of single kinds.
void add_kind_flags(CLI::App& command, ReferenceRequest& request) {
  add_number(command, "--bounces", request.bounces, {0, most_bounces},
             "of bounces: reflections after which a path ends; default 128", "N");
  add_number(
      command, "--length", request.length, {allowed_radii.least, allowed_radii.most, true},
      "of contact: reach of an occluder, scene units, or inf; default: the scene's AO radius, else made from the "
      "frame",
      "L");
  add_parsed(command, "--light-direction", request.light_direction, parse_direction,
             "of contact: towards the light, in the world; default: the scene's sun", "X,Y,Z");
  add_parsed(command, "--light-position", request.light_position, parse_point, "of contact: the light, scene units",
             "X,Y,Z");
  add_number(command, "--light-angle", request.light_angle, {0, most_light_angle},
             "of contact: angular radius of the light's disc; default 0, a point", "DEGREES");
  add_color_holds(command, request.color_holds, "of composite: ");
  add_ambient(command, request.ambient, "of composite: ");
  add_text(command, "--environment", request.environment, "FILE.exr",
           "of environment and composite: the light, a lat-long map");
  add_choice(command, "--environment-axes", request.environment_axes, environment_axes(),
             "of environment and composite: how the world lies in the map; openexr (default): +y is up and its middle "
             "looks along "
             "+z; blender: +z is up and its middle looks along +x");
  add_number(command, "--environment-turn", request.environment_turn, {-360, 360},
             "of environment and composite: turns it about the up axis, counter-clockwise seen from above", "DEGREES");
}

}  // namespace

void add_reference(CLI::App& app) {
  auto flags = std::make_shared<ReferenceCommand>();
  ReferenceRequest& request = flags->request;
  CLI::App* command = app.add_subcommand("reference", "ray-traced truth for a frame whose scene is at hand");
  add_text(*command, "what", request.what, type_of_words(reference_names()), "what is traced")->required();
  add_text(*command, "frame", flags->frame, "FRAME.exr",
           "EXR file with depth, a camera and perhaps normals, roughness and reflectance; or a shot, 'shot.####.exr'")
      ->required();
  add_text(*command, "--scene", flags->scene.scene, "SCENE",
           "OBJ or glTF file, or a built-in name; default: the built-in one that the frame names");
  add_text(*command, "-o,--output", flags->out, "REF.exr", "EXR file to write, of a shot truth.####.exr")->required();
  add_number(*command, "--samples", request.samples, allowed_rays,
             "rays (bounces: paths) per pixel, rounded up to a multiple of 32; default 256, of reflections 1024", "N");
  add_number(*command, "--radius", request.radius, {allowed_radii.least, allowed_radii.most, true},
             "reach of an occluder, scene units, or inf; default: the scene's own, else made from the frame", "R");
  add_text(*command, "--falloff", request.falloff, "none|NAME",
           "none, or a technique: its contribution at the true first hit (--set hbao+.bias=0.2)");
  add_kind_flags(*command, request);
  add_number(*command, "--seed", flags->seed, {0, 1 << 30}, "of the sample set; in a shot the frame's number is added",
             "N");
  add_text(*command, "--picture", flags->picture, "AO.png", "also as a picture");
  command->add_flag("--half", flags->half, "store as half");
  add_keep_margin(*command, flags->keep_margin);
  add_compression(*command, flags->compression);
  add_frames(*command, flags->choice);
  add_missing(*command, flags->choice);
  add_resume(*command, flags->resume);
  flags->scene.add_settings_to(*command);
  flags->frame_flags.add_to(*command);
  flags->json.add_to(*command);
  command->footer(
      "Kinds:\n" + kinds_in_words() +
      "Interrupted after its first 15 s, it goes on when run again from what it kept last. Examples:\n"
      "  gloam reference ao colonnade.exr -o colonnade_ao_ref.exr --samples 1024\n"
      "  gloam reference ao house.exr --scene house.glb -o ref.exr --radius 0.3\n"
      "  gloam reference ao colonnade.exr -o own.exr --falloff hbao+\n"
      "  gloam reference ao 'shot.####.exr' -o 'truth.####.exr' --frames 1-48 --samples 512 --resume\n"
      "  gloam reference reflection gallery.exr -o gallery_reflection_ref.exr --samples 1024\n"
      "  gloam reference bounces courtyard.exr -o courtyard_bounces_ref.exr --samples 1024\n"
      "  gloam reference contact courtyard.exr -o courtyard_contact_ref.exr --length 0.5 --light-angle 1.5\n"
      "  gloam reference environment statue.exr -o statue_light_ref.exr --environment sky.exr --radius inf\n"
      "  gloam reference composite gallery.exr -o gallery_picture_ref.exr --samples 512");
  command->callback([flags, command] { reference_command(*flags, *command); });
}

}  // namespace gloam::cli
