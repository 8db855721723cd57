#include "gloam/plan.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <tuple>

#include "base/lists.h"
#include "gloam/planes.h"
#include "gloam/radius.h"
#include "plan/adaptive.h"
#include "plan/mask.h"
#include "plan/resample.h"

namespace gloam {
namespace {

using Techniques = std::vector<const Technique*>;

const Technique* technique_named(const std::string& name) {
  for (const Technique& t : registry()) {
    if (t.name == name) return &t;
  }
  return nullptr;
}

/// Whether a technique makes a plane, by itself or where it is asked to.
bool makes(const Technique& t, const std::string& plane) {
  return contains(t.writes, plane) || contains(t.extras, plane);
}

/// All planes that any technique makes, for suggestions.
std::vector<std::string> plane_and_technique_names() {
  std::vector<std::string> names = technique_names();
  for (const Technique& t : registry()) {
    for (const std::string& plane : t.writes) add_new(names, plane);
    for (const std::string& plane : t.extras) add_new(names, plane);
  }
  return names;
}

/// What is asked for: planes, and the techniques that shall make them.
struct Wanted {
  std::vector<std::string> outputs;
  Techniques makers;  ///< in order of preference
};

/// How many techniques leave their outputs to this one.
std::ptrdiff_t followed_by_default(const Technique& technique) {
  return std::count_if(registry().begin(), registry().end(),
                       [&](const Technique& other) { return other.then == technique.name; });
}

/// The technique that makes a plane: one of the makers, else the one of the registry that says it is the default for it, else
/// the one that follows most others by default, else the one that reads the fewest planes (the first by name of these); never
/// the one that asks.
const Technique* maker_of(const std::string& plane, const Technique* asking, const Techniques& makers) {
  for (const Technique* t : makers) {
    if (t != asking && makes(*t, plane)) return t;
  }
  const auto rank = [&](const Technique& t) {
    return std::tuple(!contains(t.default_for, plane), -followed_by_default(t), t.reads.size());
  };
  const Technique* simplest = nullptr;
  for (const Technique& t : registry()) {
    if (&t == asking || !makes(t, plane)) continue;
    if (!simplest || rank(t) < rank(*simplest)) simplest = &t;
  }
  return simplest;
}

/// Whether a technique makes of what another writes one of the outputs that the other leaves to a follower.
bool follows(const Technique& follower, const Technique& technique) {
  return std::any_of(follower.writes.begin(), follower.writes.end(),
                     [&](const std::string& plane) {
                       return contains(outputs_of(technique), plane) && !contains(technique.writes, plane);
                     }) &&
         reads_from(follower, technique);
}

/// The technique that --filter names; throws UsageError unless it fits.
const Technique& follower_named(const std::string& name, const Technique& technique) {
  const Technique* follower = technique_named(name);
  if (follower && follows(*follower, technique)) return *follower;
  std::vector<std::string> fitting;
  for (const Technique& t : registry()) {
    if (follows(t, technique)) fitting.push_back(t.name);
  }
  if (fitting.empty())
    throw UsageError("--filter {}: {} leaves nothing to a filter; only none fits", name, technique.name);
  fitting.push_back("none");
  throw UsageError("--filter {}: is no filter for {}{}; there are {}", name, technique.name,
                   follower ? "" : suggestion(name, fitting), enumerate(fitting));
}

/// A technique asked for brings its follower: its own, or the one that the request names.
void add_makers(Wanted& wanted, const Technique& technique, const std::string& then) {
  wanted.makers.push_back(&technique);
  const std::string follower = then.empty() ? technique.then : then;
  if (follower.empty() || follower == "none") return;
  wanted.makers.push_back(then.empty() ? &find_technique(follower) : &follower_named(then, technique));
}

/// A technique's outputs, without those that only a follower would make where there shall be none.
void want_outputs(Wanted& wanted, const Technique& technique, const std::string& then) {
  for (const std::string& plane : outputs_of(technique)) {
    if (then != "none" || contains(technique.writes, plane)) add_new(wanted.outputs, plane);
  }
}

/// The technique that a plane is asked of: what makes it, or what that follows where its work is not at hand. Who asks
/// for `ao` asks for an estimate and its filter.
const Technique* asked_for(const std::string& plane, const std::vector<std::string>& available,
                           const Techniques& makers) {
  const Technique* maker = maker_of(plane, nullptr, makers);
  if (!maker) return nullptr;
  for (const std::string& source : maker->reads) {
    const Technique* before = contains(available, source) ? nullptr : maker_of(source, maker, makers);
    if (before && follows(*maker, *before)) return before;
  }
  return maker;
}

void want_plane(Wanted& wanted, const std::string& plane, const std::vector<std::string>& available,
                const std::string& then) {
  const Technique* technique = asked_for(plane, available, wanted.makers);
  if (!technique && !contains(available, plane)) {
    throw UsageError("nothing makes '{}'{} (gloam list techniques shows what there is)", plane,
                     suggestion(plane, plane_and_technique_names()));
  }
  if (technique) add_makers(wanted, *technique, then);
  add_new(wanted.outputs, plane);
}

bool is_extra(const Wanted& wanted, const std::string& plane) {
  return std::any_of(wanted.makers.begin(), wanted.makers.end(),
                     [&](const Technique* maker) { return contains(maker->extras, plane); });
}

void want_extra(Wanted& wanted, const std::string& plane) {
  std::vector<std::string> known;
  for (const Technique* maker : wanted.makers) {
    for (const std::string& extra : maker->extras) add_new(known, extra);
  }
  if (!contains(known, plane)) {
    throw UsageError("--with {}: {} does not make it{}; {}", plane, wanted.makers.front()->name,
                     suggestion(plane, known), known.empty() ? "it has no extras" : "it has " + enumerate(known));
  }
  add_new(wanted.outputs, plane);
}

Wanted wanted_by(const PlanRequest& request, const std::vector<std::string>& available) {
  Wanted wanted;
  for (const std::string& output : request.outputs) {
    if (const Technique* technique = technique_named(output)) add_makers(wanted, *technique, request.then);
  }
  for (const std::string& output : request.outputs) {
    if (const Technique* technique = technique_named(output))
      want_outputs(wanted, *technique, request.then);
    else
      want_plane(wanted, output, available, request.then);
  }
  for (const std::string& plane : request.with) want_extra(wanted, plane);
  for (const std::string& plane : request.only) {
    if (contains(wanted.outputs, plane) || is_extra(wanted, plane)) continue;
    throw UsageError("{}: no output '{}'{}; there are {}", request.outputs.front(), plane,
                     suggestion(plane, wanted.outputs), enumerate(wanted.outputs));
  }
  if (!request.only.empty()) {
    wanted.outputs.clear();
    for (const std::string& plane : request.only) add_new(wanted.outputs, plane);
    for (const std::string& plane : request.with) add_new(wanted.outputs, plane);
  }
  return wanted;
}

/// The plane that a request's mask names: the one that a technique of that name makes, or the name itself. What makes it joins
/// the makers.
std::string want_mask(Wanted& wanted, const std::string& mask, const std::vector<std::string>& available) {
  if (mask.empty()) return "";
  std::string plane = mask;
  if (const Technique* technique = technique_named(mask)) {
    plane = technique->writes.front();
    wanted.makers.push_back(technique);
  } else if (!contains(available, plane) && !maker_of(plane, nullptr, wanted.makers)) {
    std::vector<std::string> names = plane_and_technique_names();
    names.insert(names.end(), available.begin(), available.end());
    throw UsageError(
        "--only {}: is neither a plane at hand nor a technique that makes one{}; --plane mask=CHANNEL takes any "
        "channel "
        "of the file as 'mask'",
        mask, suggestion(mask, names));
  }
  if (plane_kind(plane).components.size() != 1 || is_stack(plane))
    throw UsageError("--only {}: '{}' is no single value per pixel; corner-mask makes a mask", mask, plane);
  return plane;
}

/// Walks back from planes to what makes them, and to the planes at hand.
class Walk {
 public:
  /// `also`: planes that are needed beside the outputs. `mask`: one that is needed before them; may be empty.
  Walk(const Wanted& wanted, std::vector<std::string> available, const std::vector<std::string>& also,
       const std::string& mask)
      : wanted_(wanted), available_(std::move(available)) {
    if (!mask.empty()) need(mask, nullptr);
    for (const std::string& output : wanted.outputs) need(output, nullptr);
    for (const std::string& plane : also) need(plane, nullptr);
  }

  Techniques order;  ///< techniques to run
  std::vector<std::string> inputs, missing;
  std::vector<std::pair<std::string, std::string>> skipped;

 private:
  void need(const std::string& plane, const Technique* asking) {
    if (contains(made_, plane) || contains(inputs, plane) || contains(missing, plane)) return;
    const Technique* maker = maker_of(plane, asking, wanted_.makers);
    if (std::find(order.begin(), order.end(), maker) != order.end()) return;  // an extra of what is made
    const bool under_way = maker && std::find(begun_.begin(), begun_.end(), maker) != begun_.end();
    const bool asked_for =
        maker && std::find(wanted_.makers.begin(), wanted_.makers.end(), maker) != wanted_.makers.end();
    if (contains(available_, plane) && (!asked_for || under_way)) {
      inputs.push_back(plane);
      if (maker && !under_way) skipped.emplace_back(maker->name, fmt::format("the file has '{}'", plane));
    } else if (!maker || under_way) {
      missing.push_back(plane);
    } else {
      schedule(*maker);
    }
  }

  void schedule(const Technique& technique) {
    begun_.push_back(&technique);
    for (const std::string& plane : technique.reads) need(plane, &technique);
    order.push_back(&technique);
    for (const std::string& plane : technique.writes) made_.push_back(plane);
  }

  const Wanted& wanted_;
  const std::vector<std::string> available_;
  Techniques begun_;
  std::vector<std::string> made_;
};

/// Planes, and the stacks whose first layer is among them.
std::vector<std::string> with_stacks(std::vector<std::string> planes) {
  for (const StackKind& stack : stack_kinds()) {
    if (contains(planes, layer_name(stack.name, 0))) add_new(planes, stack.name);
  }
  return planes;
}

/// All layers up to the last one at hand, front to back.
std::vector<std::string> layers_of(const std::string& stack, const std::vector<std::string>& available) {
  int last = 0;
  for (const std::string& plane : available) {
    const std::optional<StackLayer> layer = stack_layer(plane);
    if (layer && layer->stack == stack) last = std::max(last, layer->number);
  }
  std::vector<std::string> layers;
  for (int number = 0; number <= last; ++number) layers.push_back(layer_name(stack, number));
  return layers;
}

/// Of missing planes, what is made of one that nothing else reads, by a technique that nobody asked for.
std::map<std::string, std::string> substitutes(const Wanted& wanted, const Techniques& order,
                                               const std::vector<std::string>& missing) {
  std::map<std::string, std::string> instead;
  for (const std::string& plane : missing) {
    Techniques readers;
    for (const Technique* t : order) {
      if (contains(t->reads, plane)) readers.push_back(t);
    }
    if (readers.size() != 1 || readers.front()->writes.size() != 1) continue;
    const bool is_asked_for =
        std::find(wanted.makers.begin(), wanted.makers.end(), readers.front()) != wanted.makers.end();
    if (!is_asked_for) instead[plane] = readers.front()->writes.front();
  }
  return instead;
}

/// What makes a plane that no technique makes: "gloam capture --peel N"; empty where that is not known.
std::string maker_outside(const std::string& plane) {
  return is_stack(plane) ? stack_kind(plane).source : plane_kind(plane).source;
}

/// "gloam capture --peel N makes 'peel'", with all of `planes` that it makes.
std::string source_of(const std::string& plane, const std::vector<std::string>& planes) {
  const std::string source = maker_outside(plane);
  if (source.empty()) return "";
  std::vector<std::string> made;
  for (const std::string& other : planes) {
    if (maker_outside(other) == source) made.push_back("'" + other + "'");
  }
  return fmt::format("{} makes {}", source, enumerate(made));
}

/// Planes that are not at hand, in words; what would take least first.
[[noreturn]] void throw_missing(const std::string& technique, const std::vector<std::string>& missing,
                                const std::map<std::string, std::string>& instead, const std::string& holds) {
  std::vector<std::string> quoted;
  std::string sources;
  for (const std::string& plane : missing) {
    const auto least = instead.find(plane);
    quoted.push_back("'" + (least == instead.end() ? plane : least->second) + "'");
    const std::string first = least == instead.end() ? "" : source_of(least->second, {least->second});
    const std::string own = source_of(plane, missing);
    if (sources.find(own) != std::string::npos && first.empty()) continue;  // said of another plane
    if (!first.empty()) sources += first + (own.empty() ? "; " : ", or " + own + ", which does as well; ");
    if (first.empty() && !own.empty()) sources += own + "; ";
  }
  throw MissingPlanes(
      fmt::format("{}: needs {}, and {} ({}see docs/gbuffer.md)", technique, enumerate(quoted), holds, sources),
      missing, instead);
}

/// Planes to take from the frame: a stack is taken layer by layer.
void take_inputs(Plan& plan, const std::vector<std::string>& inputs, const std::vector<std::string>& available,
                 std::vector<std::string>& missing) {
  for (const std::string& input : inputs) {
    if (is_stack(input)) plan.stacks[input] = layers_of(input, available);
    for (const std::string& plane : is_stack(input) ? plan.stacks[input] : std::vector<std::string>{input}) {
      add_new(plan.inputs, plane);
      if (!contains(available, plane)) add_new(missing, plane);
    }
  }
}

std::string upper_case(std::string name) {
  for (char& c : name) c = char(std::toupper(static_cast<unsigned char>(c)));
  return name;
}

std::string layer_count_define(const Binding& binding) { return upper_case(binding.argument) + "_LAYERS"; }

/// Planes made beside the others because they are asked for.
void add_extras(Pass& pass, const std::vector<std::string>& outputs) {
  for (const Binding& extra : pass.extras) {
    if (!contains(outputs, extra.plane)) continue;
    pass.writes.push_back(extra);
    pass.defines.emplace_back("WITH_" + upper_case(extra.argument), 1);
  }
}

/// Layers of a stack that the frame has, or that an earlier pass writes.
int layers_at_hand(const Plan& plan, const std::string& stack) {
  if (const auto known = plan.stacks.find(stack); known != plan.stacks.end()) return int(known->second.size());
  for (const PlannedPass& planned : plan.passes) {
    for (const Binding& written : planned.pass.writes) {
      if (written.plane == stack) return written.layers;
    }
  }
  return 0;
}

[[noreturn]] void throw_too_few_layers(const Technique& technique, const Binding& binding, int layers, bool are_made) {
  const std::string few = fmt::format("{}: needs {} layers of '{}', and there are {}; ", technique.name, binding.layers,
                                      binding.plane, layers);
  if (are_made) throw UsageError("{}make more, or ask for fewer", few);
  throw MissingPlanes(few + stack_kind(binding.plane).source + " makes them", {layer_name(binding.plane, layers)});
}

/// What the pass's kernel has to know of the stacks that it reads.
void define_layers(Pass& pass, const Plan& plan, const Technique& technique) {
  for (const Binding& binding : pass.reads) {
    if (!is_stack(binding.plane)) continue;
    const int layers = layers_at_hand(plan, binding.plane);
    if (binding.layers > layers)
      throw_too_few_layers(technique, binding, layers, plan.stacks.count(binding.plane) == 0);
    pass.defines.emplace_back(layer_count_define(binding), binding.layers > 0 ? binding.layers : layers);
  }
}

/// Leaves out the layers at the end of a stack that no pass reads.
void trim_stacks(Plan& plan) {
  for (auto& [stack, layers] : plan.stacks) {
    size_t needed = 0;
    for (const PlannedPass& planned : plan.passes) {
      for (const Binding& binding : planned.pass.reads) {
        if (binding.plane == stack)
          needed = std::max(needed, binding.layers > 0 ? size_t(binding.layers) : layers.size());
      }
    }
    for (size_t i = needed; i < layers.size(); ++i) std::erase(plan.inputs, layers[i]);
    layers.resize(needed);
  }
  std::erase_if(plan.stacks, [](const auto& stack) { return stack.second.empty(); });
}

/// What of the frame is not taken, and why. Layers are told as one, by the name of their stack.
void skip_the_rest(Plan& plan, const std::vector<std::string>& available) {
  std::vector<std::string> told;
  for (const std::string& plane : available) {
    if (contains(plan.inputs, plane)) continue;
    const std::optional<StackLayer> layer = stack_layer(plane);
    const bool computed = contains(plan.outputs, plane);
    const std::string name = layer && !computed ? layer->stack : plane;
    if (contains(told, name)) continue;
    told.push_back(name);
    plan.skipped.emplace_back(name, computed ? "asked for, so it is computed" : "no pass reads it; not decoded");
  }
}

/// Every setting reaches at least one planned technique, or is an error.
void apply(const PlanRequest& request, const Techniques& order, const std::string& main,
           std::vector<ParameterValues>& values) {
  const auto set_where_known = [&](const std::string& name, const std::string& value, const std::string& only) {
    bool known = false;
    for (size_t i = 0; i < order.size(); ++i) {
      if ((!only.empty() && order[i]->name != only) || !values[i].has(name)) continue;
      values[i].set(name, value, order[i]->name);
      known = true;
    }
    return known;
  };
  if (!request.preset.empty()) {
    bool found = false;
    std::vector<std::string> names;
    for (const Technique* t : order) {
      for (const Preset& preset : t->presets) {
        names.push_back(preset.name);
        if (preset.name != request.preset) continue;
        found = true;
        for (const auto& [name, value] : preset.settings) set_where_known(name, value, t->name);
      }
    }
    if (!found) {
      throw UsageError("{}: no preset '{}'{}; {}", main, request.preset, suggestion(request.preset, names),
                       names.empty() ? "it has none" : "it has " + enumerate(names));
    }
  }
  for (const auto& [name, value] : request.settings) {
    const size_t dot = name.find('.');
    const std::string only = dot == std::string::npos ? "" : name.substr(0, dot);
    const std::string bare = dot == std::string::npos ? name : name.substr(dot + 1);
    if (set_where_known(bare, value, only)) continue;
    std::vector<std::string> known;
    for (const Technique* t : order) {
      for (const Parameter& p : t->parameters) {
        if (!contains(known, p.name)) known.push_back(p.name);
      }
    }
    throw UsageError("{}: no parameter '{}'{}{}", main, name, suggestion(bare, known),
                     known.empty() ? "; it has none" : fmt::format("; there are {}", enumerate(known)));
  }
}

void set_default_radius(double radius, const Techniques& order, std::vector<ParameterValues>& values) {
  for (size_t i = 0; i < order.size(); ++i) {
    for (const Parameter& p : order[i]->parameters) {
      if (is_radius(p)) values[i].set(p.name, fmt::format("{}", float(radius)), order[i]->name);
    }
  }
}

/// What a technique says of its follower.
void set_followers(const Techniques& order, std::vector<ParameterValues>& values) {
  for (const Technique* technique : order) {
    for (size_t i = 0; i < order.size(); ++i) {
      if (order[i]->name != technique->then) continue;
      for (const auto& [name, value] : technique->then_with) values[i].set(name, value, order[i]->name);
    }
  }
}

/// A follower works on the same radius as the technique it follows.
void inherit(const Techniques& order, std::vector<ParameterValues>& values) {
  for (size_t from = 0; from < order.size(); ++from) {
    for (size_t to = from + 1; to < order.size(); ++to) {
      if (order[from]->then.empty()) continue;
      if (order[to] != &resampling() && !reads_from(*order[to], *order[from])) continue;
      for (const Parameter& p : order[from]->parameters) {
        if (values[to].has(p.name)) values[to].set(p.name, values[from].text(p.name), order[to]->name);
      }
    }
  }
}

/// What makes layers makes as many as are asked for: parameters of the same name.
void pass_on_to_stacks(const Techniques& order, std::vector<ParameterValues>& values) {
  for (size_t reader = 0; reader < order.size(); ++reader) {
    for (size_t maker = 0; maker < reader; ++maker) {
      const bool makes_its_layers = std::any_of(
          order[maker]->writes.begin(), order[maker]->writes.end(),
          [&](const std::string& plane) { return is_stack(plane) && contains(order[reader]->reads, plane); });
      if (!makes_its_layers) continue;
      for (const Parameter& p : order[reader]->parameters) {
        if (values[maker].has(p.name)) values[maker].set(p.name, values[reader].text(p.name), order[maker]->name);
      }
    }
  }
}

/// A mask is made for the technique that it restricts: parameters of the same name, such as the radius.
void pass_on_to_mask(const Techniques& order, const Technique& restricted, const std::string& mask,
                     std::vector<ParameterValues>& values) {
  const size_t asks = size_t(std::find(order.begin(), order.end(), &restricted) - order.begin());
  if (asks == order.size()) return;
  for (size_t maker = 0; maker < order.size(); ++maker) {
    if (!contains(order[maker]->writes, mask)) continue;
    for (const Parameter& p : restricted.parameters) {
      if (values[maker].has(p.name)) values[maker].set(p.name, values[asks].text(p.name), order[maker]->name);
    }
  }
}

std::vector<Pass> passes_of(const Technique& technique, const ParameterValues& values) {
  return technique.passes ? technique.passes(values) : std::vector<Pass>();
}

/// A mask is made of all pixels, before what it restricts.
Techniques without_maker(Techniques techniques, const std::string& mask) {
  std::erase_if(techniques, [&](const Technique* t) { return contains(t->writes, mask); });
  return techniques;
}

bool is_adaptive(const PlanRequest& request) { return !request.adaptive.empty() && request.adaptive != "none"; }

/// The technique that --elsewhere names: one that makes the same as the one asked for, before that one.
const Technique* want_elsewhere(const PlanRequest& request, const Wanted& wanted) {
  if (request.elsewhere.empty()) return nullptr;
  const std::string& name = request.elsewhere;
  if (request.mask.empty()) throw UsageError("--elsewhere {}: nothing says where it does; add --only MASK", name);
  if (request.resolution > 1)
    throw UsageError("--elsewhere {}: works at full resolution; leave out --resolution", name);
  if (is_adaptive(request))
    throw UsageError("--elsewhere {}: goes without --adaptive {}; leave one of them out", name, request.adaptive);
  if (wanted.makers.empty())
    throw UsageError("--elsewhere {}: nothing is estimated where the mask is; leave it out", name);
  const Technique& technique = find_technique(name);
  const Technique& asked_for = *wanted.makers.front();
  if (&technique == &asked_for)
    throw UsageError("--elsewhere {}: is what runs where the mask is, too; leave out --only and --elsewhere", name);
  if (technique.writes != asked_for.writes || technique.views > 1)
    throw UsageError("--elsewhere {}: makes {}, and {} makes {}; name an estimate of the same", name,
                     enumerate(technique.writes), asked_for.name, enumerate(asked_for.writes));
  for (const std::string& extra : wanted.outputs) {
    if (contains(asked_for.extras, extra) && !contains(technique.extras, extra))
      throw UsageError("--elsewhere {}: does not make '{}', which is asked for; leave that out", name, extra);
  }
  return &technique;
}

/// Leaves out the passes that only repeat cells.
void put_out_cells(Plan& plan) {
  for (std::string& output : plan.outputs) {
    const auto repeats = std::find_if(plan.passes.begin(), plan.passes.end(), [&](const PlannedPass& planned) {
      return planned.pass.repeats_cells && planned.pass.writes.front().plane == output;
    });
    if (repeats == plan.passes.end()) continue;
    output = repeats->pass.reads.front().plane;
    plan.passes.erase(repeats);
  }
}

}  // namespace

const std::vector<std::string>& outputs_of(const Technique& technique) {
  return technique.outputs.empty() ? technique.writes : technique.outputs;
}

bool reads_from(const Technique& reader, const Technique& writer) {
  return std::any_of(reader.reads.begin(), reader.reads.end(),
                     [&](const std::string& plane) { return contains(writer.writes, plane); });
}

namespace {

/// Motion is told in pixels of the image.
void check_full_resolution(const PlanRequest& request, const Techniques& techniques) {
  if (request.resolution == 1) return;
  for (const Technique* technique : techniques) {
    if (contains(technique->reads, "motion"))
      throw UsageError("{}: works at full resolution, as motion is in its pixels; leave out --resolution",
                       technique->name);
  }
}

}  // namespace

Plan make_plan(const PlanRequest& request, const std::vector<std::string>& available, const std::string& holds) {
  Wanted wanted = wanted_by(request, available);
  const Techniques asked_for = wanted.makers;
  const Technique* elsewhere = want_elsewhere(request, wanted);
  const std::string mask = want_mask(wanted, request.mask, available);
  const bool is_reduced = request.resolution > 1;
  std::vector<std::string> also = is_reduced ? resampling().reads : std::vector<std::string>();
  if (elsewhere) also.insert(also.end(), elsewhere->reads.begin(), elsewhere->reads.end());
  Walk walk(wanted, with_stacks(available), also, mask);
  check_full_resolution(request, walk.order);
  Plan plan;
  plan.technique = wanted.makers.empty() ? request.outputs.front() : wanted.makers.front()->name;
  take_inputs(plan, walk.inputs, available, walk.missing);
  if (!walk.missing.empty())
    throw_missing(plan.technique, walk.missing, substitutes(wanted, walk.order, walk.missing), holds);
  if (elsewhere) walk.order.insert(std::find(walk.order.begin(), walk.order.end(), asked_for.front()), elsewhere);
  if (is_adaptive(request)) walk.order.push_back(&adapting());
  if (is_reduced) walk.order.push_back(&resampling());
  std::vector<ParameterValues> values;
  for (const Technique* t : walk.order) values.emplace_back(t->parameters);
  if (request.radius) set_default_radius(*request.radius, walk.order, values);
  set_followers(walk.order, values);
  // Twice: what a follower inherits is already set, and what is said of the follower itself wins.
  apply(request, walk.order, plan.technique, values);
  inherit(walk.order, values);
  pass_on_to_stacks(walk.order, values);
  if (!mask.empty() && !asked_for.empty()) pass_on_to_mask(walk.order, *asked_for.front(), mask, values);
  apply(request, walk.order, plan.technique, values);
  for (size_t i = 0; i < walk.order.size(); ++i) {
    for (Pass& pass : passes_of(*walk.order[i], values[i])) {
      add_extras(pass, wanted.outputs);
      define_layers(pass, plan, *walk.order[i]);
      plan.passes.push_back({walk.order[i], std::move(pass), values[i]});
    }
  }
  trim_stacks(plan);
  plan.outputs = wanted.outputs;
  plan.resolution = request.resolution;
  if (is_reduced) reduce(plan, without_maker(asked_for, mask), values.back(), !request.as_cells);
  plan.mask = mask;
  if (!mask.empty())
    restrict_to_mask(plan, elsewhere ? Techniques{asked_for.front(), elsewhere} : asked_for, elsewhere);
  if (is_adaptive(request)) adapt(plan, without_maker(asked_for, mask), request.adaptive, values.back());
  if (request.as_cells) put_out_cells(plan);
  plan.skipped = walk.skipped;
  skip_the_rest(plan, available);
  if (contains(plan.inputs, "depth"))
    plan.depends_on_pixels.push_back("background: recognised when the depth is decoded");
  if (contains(plan.inputs, "normal")) {
    plan.depends_on_pixels.push_back("normal space: compared with the depth where neither file nor flag says it");
  }
  return plan;
}

std::map<std::string, int> plane_scales(const Plan& plan) {
  std::map<std::string, int> scales;
  for (const PlannedPass& planned : plan.passes) {
    for (const Binding& b : planned.pass.reads) scales.emplace(b.plane, b.layers > 0 ? planned.scale : 1);
    for (const Binding& b : planned.pass.writes)
      scales.emplace(b.plane, b.layers > 0 && !b.as_launched ? planned.scale : planned.pass.scale);
  }
  return scales;
}

}  // namespace gloam
