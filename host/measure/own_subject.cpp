#include "measure/own_subject.h"

#include <cmath>

#include "base/lists.h"
#include "exr/holdings.h"
#include "gloam/error.h"
#include "gloam/metrics.h"
#include "gloam/option.h"
#include "gloam/planes.h"
#include "measure/effects.h"
#include "measure/plans.h"
#include "sequence/plan_files.h"
#include "technique/variant_words.h"

namespace gloam::bench {

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

std::string needs_naming(const Technique& technique) {
  if (technique.views == 1) return "";
  return fmt::format("needs frames of two views: measured where {} names it", option("techniques"));
}

std::string needs_naming(const Technique& technique, const VariantChoice& choice) {
  return choice.both_eyes == true ? "" : needs_naming(technique);
}

void check_any_fits(const std::vector<const Technique*>& left, const VariantChoice& choice,
                    const std::vector<std::string>& effects) {
  std::vector<std::string> chosen;
  if (choice.layers) chosen.push_back(option("layers", word_for(*choice.layers, layers_words)));
  if (choice.both_eyes) chosen.push_back(option("eyes", word_for(*choice.both_eyes, eyes_words)));
  if (left.empty() && !chosen.empty())
    throw UsageError("{}: no technique that makes {} has this variant; there are {}", fmt::join(chosen, " "),
                     enumerate(effects), enumerate(techniques_making(effects)));
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
                const std::vector<std::string>& more, const TellNotes& tell) {
  if (!contains(file.common_planes(), "depth"))
    throw Error("{}: has no depth to measure on; {}", file.path().string(), holdings(file));
  subject.holds = holdings(file);
  std::vector<std::string> planes = planes_to_read(file, techniques);
  for (const std::string& plane : more) {
    if (contains(file.common_planes(), plane)) add_new(planes, plane);
  }
  subject.frame = file.read(planes);
  tell(subject.frame.assumed);
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
unsigned long long bytes_to_measure(const FrameFile& file, const std::string& effect,
                                    const std::vector<const Technique*>& techniques) {
  constexpr unsigned long long images = 4;
  const int width = file.window().width();
  const unsigned long long image = plane_kind(effect).components.size() * Layout(width, file.window().height()).bytes();
  return file.bytes_to_read(planes_to_read(file, techniques)) + bytes_of_plans(file, techniques) +
         images * file.views().size() * image + Comparison::bytes(width, 1);
}

/// Whether the scene is all that the truth needs; else says what does.
bool is_of_scene(const Subject& subject, const TellNotes& tell) {
  if (effect_of(subject.effect).is_of_scene) return true;
  tell(
      {fmt::format("{}: the truth of {} needs more than the scene; gloam reference {} traces it, and {} with {} "
                   "measures it",
                   subject.name, subject.effect, subject.effect, option("frame"), option("truth"))});
  return false;
}

void trace_truth(Subject& subject, const TellNotes& tell) {
  if (!is_of_scene(subject, tell)) return;
  try {
    subject.truth = &subject.truths->truth(subject.frame, subject.effect);
  } catch (const UsageError&) {
    throw;
  } catch (const Error& error) {  // another camera, another scene: then there is no truth
    tell({fmt::format("{}: no truth: {}", subject.name, error.what())});
    subject.truths.reset();
  }
}

}  // namespace

Subject builtin_subject(const SceneRecipe& recipe, const std::string& effect,
                        const std::vector<const Technique*>& techniques, const SceneOptions& options,
                        const TellNotes& tell) {
  if (options.progress) options.progress(recipe.name + ": scene", 0);
  return scene_subject(recipe.name, recipe.kind, load_scene(recipe.name, {}), effect, techniques, options, tell);
}

Subject scene_subject(const std::string& name, const std::string& scene_class, Scene scene, const std::string& effect,
                      const std::vector<const Technique*>& techniques, const SceneOptions& options,
                      const TellNotes& tell) {
  Subject subject;
  subject.name = name;
  subject.effect = effect;
  subject.scene_class = scene_class;
  subject.truths = std::make_unique<Truths>(name, std::move(scene), options);
  subject.radius = {subject.truths->radius(), options.radius ? RadiusSource::flag : RadiusSource::scene};
  FrameFile file(subject.truths->frame_file(), {});
  read_frame(subject, file, techniques, options.more_planes, tell);
  if (is_of_scene(subject, tell)) subject.truth = &subject.truths->truth(subject.frame, effect);
  return subject;
}

Subject own_subject(const OwnFrame& own, const std::string& effect, const std::vector<const Technique*>& techniques,
                    const SceneOptions& options, const TellNotes& tell) {
  Subject subject;
  subject.effect = effect;
  FrameFile file(own.file, own.reading);
  subject.name = file.path().stem().string();
  subject.scene_class = "own";
  subject.memory_bytes = own.afford(file.path().string(), bytes_to_measure(file, effect, techniques));
  read_frame(subject, file, techniques, options.more_planes, tell);
  if (options.radius) subject.radius = {*options.radius, RadiusSource::flag};
  bool is_known = options.radius.has_value();
  if (!own.truths.empty()) {
    std::vector<std::string> notes;
    subject.given = read_truth(own.truths, effect, subject.frame, notes);
    tell(notes);
    subject.truth = &*subject.given;
    const std::optional<double> traced = subject.given->radius;
    if (is_known && traced && std::abs(*traced - subject.radius.value) > 1e-6 * *traced)
      throw UsageError("{}: the truth was made with {:g}; leave it out, or trace another truth",
                       option("radius", fmt::format("{:g}", subject.radius.value)), *traced);
    if (!is_known && traced) {
      subject.radius = {*traced, RadiusSource::truth};
      is_known = true;
    }
  }
  const NamedScene scene = scene_in_attribute(file.text_attribute("gloamScene"));
  if (find_builtin_scene(scene.name)) {
    SceneOptions with_radius = options;
    if (is_known) with_radius.radius = subject.radius.value;
    subject.truths = std::make_unique<Truths>(subject.name, load_scene(scene, tell), with_radius);
    if (!is_known) subject.radius = {subject.truths->radius(), RadiusSource::scene};
    is_known = true;
    if (!subject.truth) trace_truth(subject, tell);
  }
  if (!is_known) {
    std::vector<std::string> notes;
    subject.radius = default_radius(subject.frame, stated_radius(file, notes));
    tell(notes);
  }
  if (!std::isfinite(subject.radius.value) || !(subject.radius.value > 0))
    throw Error("{}: was made with radius {:g}; {} gives one that can be measured", enumerate(own.truths),
                subject.radius.value, option("radius"));
  return subject;
}

}  // namespace gloam::bench
