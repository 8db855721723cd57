#include "cli/bench/subjects.h"

#include <cmath>

#include "cli/flags/memory.h"
#include "cli/flags/notes.h"
#include "gloam/error.h"
#include "gloam/metrics.h"
#include "gloam/planes.h"
#include "measure/effects.h"

namespace gloam::cli {

using namespace gloam::bench;

void erase_status() {
  if (shows_progress()) fmt::print(stderr, "\r\033[K");
}

/// Shows the current work on a terminal, in a line that the next one overwrites.
void show_status(const std::string& what, double share) {
  if (!shows_progress()) return;
  fmt::print(stderr, "\r\033[K{} {:.0f} %", printable(what), 100 * share);
  std::fflush(stderr);
}

void make_output_folder(const std::filesystem::path& folder) {
  std::error_code error, unknown;
  std::filesystem::create_directories(folder, error);
  if (std::filesystem::exists(folder, unknown) && !std::filesystem::is_directory(folder, unknown))
    throw Error("-o {}: is a file; name a folder", folder.string());
  if (error) throw Error("-o {}: cannot be made ({})", folder.string(), error.message());
}

std::vector<std::string> techniques_making(const std::vector<std::string>& effects) {
  std::vector<std::string> names;
  for (const Technique& t : registry()) {
    if (why_not_measured(t, effects).empty()) names.push_back(t.name);
  }
  return names;
}

std::string why_not_measured(const Technique& technique, const std::vector<std::string>& effects) {
  if (is_filter(technique)) return "is a filter: its time is part of the techniques that it follows";
  if (contains(effects, measured_plane(technique))) return "";
  return fmt::format("makes {}, {} {}", enumerate(technique.writes), effects.size() == 1 ? "not" : "none of",
                     enumerate(effects));
}

std::vector<std::string> parse_effects(const std::string& list) {
  const std::vector<std::string> known = effect_names();
  if (list == "all") return known;
  const std::vector<std::string> named = split_list(list, "--effects");
  for (const std::string& name : named) {
    if (!contains(known, name))
      throw UsageError("--effects: no effect '{}' is measured{}; there are {} and all", name, suggestion(name, known),
                       enumerate(known));
  }
  std::vector<std::string> chosen;
  for (const std::string& name : known) {
    if (contains(named, name)) chosen.push_back(name);
  }
  return chosen;
}

std::string needs_naming(const Technique& technique) {
  return technique.views > 1 ? "needs frames of two views: measured where --techniques names it" : "";
}

namespace {

/// Adds all available layers of the stacks that a technique reads: other settings may read more layers than its defaults.
void add_layers(const Technique& technique, const std::vector<std::string>& available,
                std::vector<std::string>& planes) {
  for (const std::string& plane : available) {
    const std::optional<StackLayer> layer = stack_layer(plane);
    if (layer && contains(technique.reads, layer->stack)) add_new(planes, plane);
  }
}

/// Planes of a file that any technique reads, and that the baselines and figures need.
std::vector<std::string> planes_to_read(const FrameFile& file, const std::vector<const Technique*>& techniques) {
  const std::vector<std::string> available = file.common_planes();
  std::vector<std::string> planes;
  for (const char* plane : {"depth", "normal"}) {
    if (contains(available, plane)) planes.push_back(plane);
  }
  for (const Technique* t : techniques) {
    for (const Technique* each : {t, over_all_layers(*t)}) {
      if (!each) continue;
      add_layers(*each, available, planes);
      try {
        for (const std::string& plane : whole_plan({each, "", 0.5}, available, "").inputs) add_new(planes, plane);
      } catch (const MissingPlanes&) {  // reported where the technique is skipped
      }
    }
  }
  return planes;
}

void read_frame(Subject& subject, FrameFile& file, const std::vector<const Technique*>& techniques,
                const std::vector<std::string>& more) {
  if (!contains(file.common_planes(), "depth"))
    throw Error("{}: has no depth to measure on; {}", file.path().string(), holdings(file));
  subject.holds = holdings(file);
  std::vector<std::string> planes = planes_to_read(file, techniques);
  for (const std::string& plane : more) {
    if (contains(file.common_planes(), plane)) add_new(planes, plane);
  }
  subject.frame = file.read(planes);
  note(subject.frame.assumed);
}

/// Memory of the plans that are measured in turn and so are on the device together: each preset, at full and half resolution.
unsigned long long bytes_of_plans(const FrameFile& file, const std::vector<const Technique*>& techniques) {
  const Layout layout(file.window().width(), file.window().height());
  unsigned long long bytes = 0;
  for (const Technique* technique : techniques) {
    for (const int resolution : {1, 2}) {
      try {
        const Plan plan = whole_plan({.technique = technique, .resolution = resolution}, file.common_planes(), "");
        bytes += std::max<size_t>(technique->presets.size(), 1) *
                 bytes_beside_frame(plan, layout, file.views().size(), true);
      } catch (const Error&) {  // reported where the technique is skipped
      }
    }
  }
  return bytes;
}

/// Counts the plans, the truth, an image that is measured against it, and masks.
unsigned long long planned_memory_of(const FrameFile& file, const FrameFlags& flags, const std::string& effect,
                                     const std::vector<const Technique*>& techniques) {
  constexpr unsigned long long images = 4;
  const int width = file.window().width();
  const unsigned long long image = plane_kind(effect).components.size() * Layout(width, file.window().height()).bytes();
  const unsigned long long bytes = process_bytes_with_device + file.bytes_to_read(planes_to_read(file, techniques)) +
                                   bytes_of_plans(file, techniques) + images * file.views().size() * image +
                                   Comparison::bytes(width, 1);
  return planned_memory(flags, file.path().string(), bytes, "name fewer --techniques, or crop or shrink the frame");
}

/// Whether the scene is all that the truth needs; else says what does.
bool is_of_scene(const Subject& subject) {
  if (effect_of(subject.effect).is_of_scene) return true;
  note(
      {fmt::format("{}: the truth of {} needs more than the scene; gloam reference {} traces it, and --frame with "
                   "--truth measures it",
                   subject.name, subject.effect, subject.effect)});
  return false;
}

void trace_truth(Subject& subject) {
  if (!is_of_scene(subject)) return;
  try {
    subject.truth = &subject.truths->truth(subject.frame, subject.effect);
  } catch (const UsageError&) {
    throw;
  } catch (const Error& error) {  // another camera, another scene: then there is no truth
    note({fmt::format("{}: no truth: {}", subject.name, error.what())});
    subject.truths.reset();
  }
}

/// The techniques' default cap on the radius; none if no technique has one.
std::optional<double> default_cap(const std::vector<const Technique*>& techniques) {
  for (const Technique* technique : techniques) {
    const ParameterValues initial(technique->parameters);
    if (initial.has("max_reach")) return initial.number("max_reach");
  }
  return {};
}

}  // namespace

RadiusReport report_of(const Subject& subject, const std::vector<const Technique*>& techniques) {
  return RadiusReport(subject.radius, subject.frame, default_cap(techniques));
}

Subject builtin_subject(const SceneRecipe& recipe, const std::string& effect,
                        const std::vector<const Technique*>& techniques, const SceneOptions& options) {
  show_status(recipe.name + ": scene", 0);
  return scene_subject(recipe.name, recipe.kind, load_scene(recipe.name, {}), effect, techniques, options);
}

Subject scene_subject(const std::string& name, const std::string& scene_class, Scene scene, const std::string& effect,
                      const std::vector<const Technique*>& techniques, const SceneOptions& options) {
  Subject subject;
  subject.name = name;
  subject.effect = effect;
  subject.scene_class = scene_class;
  subject.truths = std::make_unique<Truths>(name, std::move(scene), options);
  subject.radius = {subject.truths->radius(), options.radius ? RadiusSource::flag : RadiusSource::scene};
  FrameFile file(subject.truths->frame_file(), {});
  read_frame(subject, file, techniques, options.more_planes);
  if (is_of_scene(subject)) subject.truth = &subject.truths->truth(subject.frame, effect);
  return subject;
}

/// The user's frame. Its scene is known if the header names a built-in one.
Subject own_subject(const std::string& frame, const FrameFlags& flags, const std::vector<std::string>& truths,
                    const std::string& effect, const std::vector<const Technique*>& techniques,
                    const SceneOptions& options) {
  Subject subject;
  subject.effect = effect;
  FrameFile file(frame, flags.read_options());
  subject.name = file.path().stem().string();
  subject.scene_class = "own";
  subject.memory_bytes = planned_memory_of(file, flags, effect, techniques);
  read_frame(subject, file, techniques, options.more_planes);
  if (options.radius) subject.radius = {*options.radius, RadiusSource::flag};
  bool is_known = options.radius.has_value();
  if (!truths.empty()) {
    std::vector<std::string> notes;
    subject.given = read_truth(truths, effect, subject.frame, notes);
    note(notes);
    subject.truth = &*subject.given;
    const std::optional<double> traced = subject.given->radius;
    if (is_known && traced && std::abs(*traced - subject.radius.value) > 1e-6 * *traced)
      throw UsageError("--radius {:g}: the truth was made with {:g}; leave it out, or trace another truth",
                       subject.radius.value, *traced);
    if (!is_known && traced) {
      subject.radius = {*traced, RadiusSource::truth};
      is_known = true;
    }
  }
  const SceneFlags scene = scene_named_by(file.text_attribute("gloamScene"));
  if (find_builtin_scene(scene.scene)) {
    SceneOptions with_radius = options;
    if (is_known) with_radius.radius = subject.radius.value;
    subject.truths = std::make_unique<Truths>(subject.name, scene.load(), with_radius);
    if (!is_known) subject.radius = {subject.truths->radius(), RadiusSource::scene};
    is_known = true;
    if (!subject.truth) trace_truth(subject);
  }
  if (!is_known) subject.radius = default_radius(subject.frame, stated_radius(file));
  if (!std::isfinite(subject.radius.value) || !(subject.radius.value > 0))
    throw Error("{}: was made with radius {:g}; --radius gives one that can be measured", enumerate(truths),
                subject.radius.value);
  return subject;
}

}  // namespace gloam::cli
