// gloam reference ao|reflection FRAME.exr --scene SCENE -o REF.exr
#include "gloam/scene/reference.h"

#include <cmath>
#include <memory>

#include "cli/memory.h"
#include "cli/radius.h"
#include "cli/scene_flags.h"
#include "gloam/error.h"
#include "gloam/scene/reflection_reference.h"
#include "gloam/visualise.h"

namespace gloam::cli {
namespace {

struct ReferenceCommand {
  std::string what, frame, out, falloff = "none", picture, compression = "zip";
  std::optional<int> samples;
  std::optional<double> radius;
  int seed = 0;
  bool half = false;
  SceneFlags scene;
  FrameFlags frame_flags;
  JsonFlag json;
};

/// The scene that the user names, else the one in the frame's header.
Scene load_scene_of(const ReferenceCommand& flags, const FrameFile& file) {
  if (!flags.scene.scene.empty()) return flags.scene.load();
  SceneFlags named = scene_named_by(file.text_attribute("gloamScene"));
  if (named.scene.empty()) throw UsageError("{}: does not say which scene it shows; give --scene SCENE", flags.frame);
  if (!find_builtin_scene(named.scene))
    throw UsageError("{}: shows '{}', which is not built in; give --scene and the file", flags.frame, named.scene);
  named.settings.insert(named.settings.end(), flags.scene.settings.begin(), flags.scene.settings.end());
  return named.load();
}

/// The technique whose contribution is traced; null for no falloff.
const Technique* falloff_technique(const std::string& name) {
  if (name == "none") return nullptr;
  std::vector<std::string> names = {"none"};
  for (const Technique& t : registry()) {
    if (!t.contribution) continue;
    if (t.name == name) return &t;
    names.push_back(t.name);
  }
  throw UsageError("--falloff {} is not allowed{}; {} are", name, suggestion(name, names), enumerate(names));
}

/// `settings`: those of the falloff's technique, --set hbao+.bias=0.2.
void set_falloff(AoReferenceOptions& options, const std::string& name, const Settings& settings) {
  const Technique* technique = falloff_technique(name);
  options.falloff = name;
  ParameterValues values(technique ? technique->parameters : ParameterList());
  for (const auto& [key, value] : settings) {
    const size_t dot = key.rfind('.');
    if (!technique || key.substr(0, dot) != technique->name)
      throw UsageError("--set {}: the falloff is {}; with --falloff {} it can be set", key, name, key.substr(0, dot));
    if (key.substr(dot + 1) == "radius")
      throw UsageError("--set {}: the radius is the reference's; give --radius", key);
    values.set(key.substr(dot + 1), value, technique->name);
  }
  if (!technique) return;
  for (const Parameter& p : technique->parameters) {
    if (p.name == "radius") continue;  // the reference has its own radius
    options.falloff_parameters += (options.falloff_parameters.empty() ? "" : " ") + p.name + "=" + values.text(p.name);
  }
  options.contribution = [contribution = technique->contribution, values](double cosine, double distance) {
    return contribution(values, cosine, distance);
  };
}

/// Adds a note if the frame's header names another scene. It may still be the right one, from a file that was moved or renamed.
void note_other_scene(const FrameFile& file, const Scene& scene) {
  const std::string named = file.text_attribute("gloamScene");
  if (named.empty() || named == scene.name) return;
  note({fmt::format("the frame says that it shows '{}', and the scene is '{}'", named, scene.name)});
}

/// The radius of the flag, else of the frame's header, else of the scene; none if the radius is to be derived from the frame.
std::optional<Radius> known_radius(const ReferenceCommand& flags, const FrameFile& file, const Scene& scene) {
  if (flags.radius) return Radius{*flags.radius, RadiusSource::flag};
  if (const std::optional<double> stated = stated_radius(file)) return Radius{*stated, RadiusSource::scene};
  if (scene.ao_radius > 0) return Radius{scene.ao_radius, RadiusSource::scene};
  return {};
}

/// The tracing job, from the command line.
struct Job {
  std::string plane;
  std::vector<std::string> reads;
  Json settings;                               ///< for --json
  std::string heading;                         ///< "falloff none"
  std::function<Radius(const Frame&)> radius;  ///< empty: the job has no radius
  std::function<Reference(const Tracer&, const Frame&, double radius)> trace;
};

template <typename Options>
void set_common(Options& options, const ReferenceCommand& flags, const std::string& checkpoint,
                const std::function<void(double)>& progress) {
  options.samples = flags.samples.value_or(options.samples);
  options.seed = uint32_t(flags.seed);
  options.checkpoint = checkpoint;
  options.progress = progress;
}

Job ao_job(AoReferenceOptions options, const ReferenceCommand& flags, const FrameFile& file, const Scene& scene) {
  const std::optional<Radius> known = known_radius(flags, file, scene);
  if (options.contribution && known && !std::isfinite(known->value))
    throw UsageError("--radius inf: the falloff of {} is in relation to the radius; give a finite one", flags.falloff);
  Job job;
  job.plane = "ao";
  job.reads = {"depth", "normal"};
  job.settings = {{"falloff", options.falloff}};
  job.heading = fmt::format("falloff {}", options.falloff);
  job.radius = [known](const Frame& frame) { return known.value_or(default_radius(frame, {})); };
  job.trace = [options](const Tracer& tracer, const Frame& frame, double radius) {
    AoReferenceOptions with_radius = options;
    with_radius.radius = radius;
    return ao_reference(tracer, frame, with_radius);
  };
  return job;
}

Job reflection_job(const ReflectionReferenceOptions& options) {
  Job job;
  job.plane = "reflection";
  job.reads = {"depth", "normal", "roughness", "reflectance"};
  job.settings = Json::object();
  job.heading = "two bounces";
  job.trace = [options](const Tracer& tracer, const Frame& frame, double) {
    return reflection_reference(tracer, frame, options);
  };
  return job;
}

/// Throws UsageError for flags of ambient occlusion.
void check_reflection(const ReferenceCommand& flags) {
  if (flags.radius) throw UsageError("--radius {}: a reflection has no radius; leave it out", *flags.radius);
  if (flags.falloff != "none")
    throw UsageError("--falloff {}: a reflection has no falloff; leave it out", flags.falloff);
}

int samples_of(const Reference& result, const Job& job) { return int(result.frame.numbers.at(job.plane + "Samples")); }

Json document(const Reference& result, const Job& job, const Scene& scene) {
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
  json.update(job.settings);
  return json;
}

void print(const Reference& result, const Job& job, const Scene& scene, const ReferenceCommand& flags) {
  fmt::print("{}: {} faces; {}, {} rays per pixel\n", printable(scene.name), scene.faces(), job.heading,
             samples_of(result, job));
  if (result.resumed_share > 0) fmt::print("went on with {:.0f} % of an interrupted run\n", 100 * result.resumed_share);
  fmt::print("noise {:.5f} RMS, largest {:.4f} (from two independent halves of the rays)\n", result.noise,
             result.largest_noise);
  fmt::print("{:.1f} million rays in {:.1f} s, {:.1f} million per second\n", double(result.rays) * 1e-6, result.seconds,
             result.seconds > 0 ? double(result.rays) / result.seconds * 1e-6 : 0.0);
  fmt::print("wrote {}\n", printable(flags.out));
}

const std::vector<std::string>& kinds() {
  static const std::vector<std::string> kinds = {"ao", "reflection"};
  return kinds;
}

void reference_command(ReferenceCommand flags) {
  if (!contains(kinds(), flags.what))
    throw UsageError("reference: no '{}'{}; there are {}", flags.what, suggestion(flags.what, kinds()),
                     enumerate(kinds()));
  const bool is_ao = flags.what == "ao";
  if (!is_ao) check_reflection(flags);
  const WriteOptions write{flags.half, flags.compression};
  check_frame_name(flags.out, "-o");
  check_picture_name(flags.picture, "--picture");
  const std::string checkpoint = flags.out + ".partial";
  check_paths(
      {{"the frame", flags.frame},
       {"--scene", find_builtin_scene(flags.scene.scene) ? "" : flags.scene.scene},
       {"--camera", flags.frame_flags.camera}},
      {{"-o", flags.out}, {"the unfinished", checkpoint}, {"--picture", flags.picture}, {"--json", flags.json.file()}});
  const auto bar = progress_bar();
  std::function<void(double)> progress;
  if (bar) progress = [&bar](double share) { bar(int(share * 1000), 1000); };
  AoReferenceOptions ao;
  ReflectionReferenceOptions reflection;
  if (is_ao) {
    set_common(ao, flags, checkpoint, progress);
    set_falloff(ao, flags.falloff, flags.scene.take_dotted_settings());
  } else {
    set_common(reflection, flags, checkpoint, progress);
  }
  FrameFile file(flags.frame, flags.frame_flags.read_options());
  if (!contains(file.common_planes(), "depth")) throw Error("{}: has no depth; {}", flags.frame, holdings(file));
  const Scene scene = load_scene_of(flags, file);
  const Job job = is_ao ? ao_job(ao, flags, file, scene) : reflection_job(reflection);
  planned_memory(flags.frame_flags, flags.frame, process_bytes_with_device + 2 * file.bytes_to_read(job.reads),
                 "crop or shrink the frame");
  const Frame frame = file.read(job.reads);
  note(frame.assumed);
  note_other_scene(file, scene);
  const Radius radius = job.radius ? job.radius(frame) : Radius();
  std::optional<RadiusReport> report;
  if (job.radius) report.emplace(radius, frame, std::nullopt);
  const Tracer tracer(scene);
  const Reference result = job.trace(tracer, frame, radius.value);
  note(result.notes);
  if (result.unlike_share > 0.005)
    note({fmt::format("in {:.1f} % of the pixels looked at the scene is over 1 % nearer or farther than the frame",
                      100 * result.unlike_share)});
  write_frame(flags.out, result.frame, write);
  std::error_code gone;
  std::filesystem::remove(checkpoint, gone);
  for (const View& view : result.frame.views) {
    if (flags.picture.empty()) break;
    write_picture(picture_path(flags.picture, view.name, result.frame.views.size() > 1), view.planes.at(job.plane),
                  frame.view(view.name).find("depth"));
  }
  Json figures = document(result, job, scene);
  if (report) report->add_to(figures);
  flags.json.write(figures, {flags.out});
  if (flags.json.only_json()) return;
  if (report) report->print();
  print(result, job, scene, flags);
}

}  // namespace

void add_reference(CLI::App& app) {
  auto flags = std::make_shared<ReferenceCommand>();
  CLI::App* command = app.add_subcommand("reference", "ray-traced truth for a frame whose scene is at hand");
  command->add_option("what", flags->what, "what is traced")->required()->type_name(type_of_words(kinds()));
  command
      ->add_option("frame", flags->frame,
                   "EXR file with depth, a camera and perhaps normals, roughness and reflectance")
      ->required()
      ->type_name("FRAME.exr");
  command
      ->add_option("--scene", flags->scene.scene,
                   "OBJ or glTF file, or a built-in name; default: the built-in one that the frame names")
      ->type_name("SCENE");
  command->add_option("-o,--output", flags->out, "EXR file to write")->required()->type_name("REF.exr");
  add_number(*command, "--samples", flags->samples, allowed_rays,
             "rays per pixel, rounded up to a multiple of 32; default 256, of reflections 1024")
      ->type_name("N");
  add_number(*command, "--radius", flags->radius, {allowed_radii.least, allowed_radii.most, true},
             "reach of an occluder, scene units, or inf; default: the scene's own, else made from the frame")
      ->type_name("R");
  command
      ->add_option("--falloff", flags->falloff,
                   "none, or a technique: its contribution at the true first hit (--set hbao+.bias=0.2)")
      ->type_name("none|NAME");
  add_number(*command, "--seed", flags->seed, {0, 1 << 30}, "of the sample set")->type_name("N");
  command->add_option("--picture", flags->picture, "also as a picture")->type_name("AO.png");
  command->add_flag("--half", flags->half, "store as half");
  add_compression(*command, flags->compression);
  flags->scene.add_settings_to(*command);
  flags->frame_flags.add_to(*command);
  flags->json.add_to(*command);
  command->footer(
      "Interrupted after its first 15 s, it goes on when run again from what it kept last. Examples:\n"
      "  gloam reference ao colonnade.exr -o colonnade_ao_ref.exr --samples 1024\n"
      "  gloam reference ao house.exr --scene house.glb -o ref.exr --radius 0.3\n"
      "  gloam reference ao colonnade.exr -o own.exr --falloff hbao+\n"
      "  gloam reference reflection gallery.exr -o gallery_reflection_ref.exr --samples 1024");
  command->callback([flags] { reference_command(*flags); });
}

}  // namespace gloam::cli
