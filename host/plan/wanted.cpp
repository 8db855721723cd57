#include "plan/wanted.h"

#include <algorithm>
#include <tuple>

#include "base/lists.h"
#include "gloam/option.h"
#include "gloam/planes.h"

namespace gloam {
namespace {

const Technique* technique_named(const std::string& name) {
  for (const Technique& t : registry()) {
    if (t.name == name) return &t;
  }
  return nullptr;
}

/// Whether a technique makes a plane, by default or as an extra.
bool makes(const Technique& t, const std::string& plane) {
  return contains(t.writes, plane) || contains(t.extras, plane);
}

/// Names of all planes that any technique makes, and of all techniques, for suggestions.
std::vector<std::string> plane_and_technique_names() {
  std::vector<std::string> names = technique_names();
  for (const Technique& t : registry()) {
    for (const std::string& plane : t.writes) add_new(names, plane);
    for (const std::string& plane : t.extras) add_new(names, plane);
  }
  return names;
}

/// Number of techniques that leave their outputs to this one.
std::ptrdiff_t followed_by_default(const Technique& technique) {
  return std::count_if(registry().begin(), registry().end(),
                       [&](const Technique& other) { return other.then == technique.name; });
}

}  // namespace

bool filters_extra_of(const Technique& filter, const Technique& technique) {
  return followed_by_default(filter) > 0 &&
         std::any_of(filter.reads.begin(), filter.reads.end(),
                     [&](const std::string& plane) { return contains(technique.extras, plane); });
}

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

namespace {

/// Whether a technique makes, from the outputs of another, an output that the other leaves to a follower.
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
    throw UsageError("{}: {} leaves nothing to a filter; only none fits", option("filter", name), technique.name);
  fitting.push_back("none");
  throw UsageError("{}: is no filter for {}{}; there are {}", option("filter", name), technique.name,
                   follower ? "" : suggestion(name, fitting), enumerate(fitting));
}

/// The filter for a plane that is made from an extra of a technique: `bilateral` for `ao`, where `ao_raw` is an extra. nullptr: none.
const Technique* filter_for(const std::string& plane, const Technique& technique) {
  for (const Technique& t : registry()) {
    if (contains(t.writes, plane) && filters_extra_of(t, technique)) return &t;
  }
  return nullptr;
}

/// Adds a technique asked for, and its follower: its own, or the one that the request names.
void add_makers(Wanted& wanted, const Technique& technique, const std::string& then) {
  wanted.makers.push_back(&technique);
  const std::string follower = then.empty() ? technique.then : then;
  if (follower.empty() || follower == "none") return;
  wanted.makers.push_back(then.empty() ? &find_technique(follower) : &follower_named(then, technique));
}

/// Adds a technique's outputs, without those that only a follower would make if there is none.
void want_outputs(Wanted& wanted, const Technique& technique, const std::string& then) {
  for (const std::string& plane : outputs_of(technique)) {
    if (then != "none" || contains(technique.writes, plane)) add_new(wanted.outputs, plane);
  }
}

/// The technique to make a plane: its maker, or the technique that leaves the plane to that maker if its input is not at hand. A
/// request for `ao` thus asks for an estimate and its filter.
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
  const Techniques makers = wanted.makers;
  for (const Technique* maker : makers) {
    for (const std::string& extra : maker->extras) add_new(known, extra);
    if (const Technique* filter = filter_for(plane, *maker)) {
      wanted.makers.push_back(filter);
      add_new(known, plane);
    }
  }
  if (!contains(known, plane)) {
    throw UsageError("{}: {} does not make it{}; {}", option("with", plane), wanted.makers.front()->name,
                     suggestion(plane, known), known.empty() ? "it has no extras" : "it has " + enumerate(known));
  }
  add_new(wanted.outputs, plane);
}

}  // namespace

Wanted wanted_by(const PlanRequest& request, const std::vector<std::string>& available) {
  Wanted wanted;
  for (const std::string& output : request.outputs) {
    if (const Technique* technique = technique_named(output)) add_makers(wanted, *technique, request.filter);
  }
  for (const std::string& output : request.outputs) {
    if (const Technique* technique = technique_named(output))
      want_outputs(wanted, *technique, request.filter);
    else
      want_plane(wanted, output, available, request.filter);
  }
  for (const std::string& plane : request.with) want_extra(wanted, plane);
  for (const std::string& plane : request.only_outputs) {
    if (contains(wanted.outputs, plane) || is_extra(wanted, plane)) continue;
    throw UsageError("{}: no output '{}'{}; there are {}", request.outputs.front(), plane,
                     suggestion(plane, wanted.outputs), enumerate(wanted.outputs));
  }
  if (request.only_filtered && request.only_outputs.empty())
    std::erase_if(wanted.outputs, [&, outputs = wanted.outputs](const std::string& plane) {
      return plane.ends_with("_raw") && contains(outputs, plane.substr(0, plane.size() - 4)) &&
             !contains(request.outputs, plane) && !contains(request.with, plane);
    });
  if (!request.only_outputs.empty()) {
    wanted.outputs.clear();
    for (const std::string& plane : request.only_outputs) add_new(wanted.outputs, plane);
    for (const std::string& plane : request.with) add_new(wanted.outputs, plane);
  }
  return wanted;
}

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
        "{}: is neither a plane at hand nor a technique that makes one{}; {} takes any channel of the file as 'mask'",
        option("only", mask), suggestion(mask, names), channels_option("mask", "CHANNEL"));
  }
  if (plane_kind(plane).components.size() != 1 || is_stack(plane))
    throw UsageError("{}: '{}' has several values per pixel; corner-mask makes a mask", option("only", mask), plane);
  return plane;
}

bool is_adaptive(const PlanRequest& request) { return !request.adaptive.empty() && request.adaptive != "none"; }

const Technique* want_elsewhere(const PlanRequest& request, const Wanted& wanted) {
  if (request.elsewhere.empty()) return nullptr;
  const std::string& name = request.elsewhere;
  if (request.only.empty())
    throw UsageError("{}: needs a mask; add {}", option("elsewhere", name), option("only", "MASK"));
  if (request.resolution > 1)
    throw UsageError("{}: works at full resolution; leave out {}", option("elsewhere", name), option("resolution"));
  if (is_adaptive(request))
    throw UsageError("{}: goes without {}; leave one of them out", option("elsewhere", name),
                     option("adaptive", request.adaptive));
  if (wanted.makers.empty())
    throw UsageError("{}: nothing is estimated inside the mask; leave {} out", option("elsewhere", name),
                     option("elsewhere"));
  const Technique& technique = find_technique(name);
  const Technique& asked_for = *wanted.makers.front();
  if (&technique == &asked_for)
    throw UsageError("{}: also runs inside the mask; leave out {} and {}", option("elsewhere", name), option("only"),
                     option("elsewhere"));
  if (technique.writes != asked_for.writes || technique.views > 1)
    throw UsageError("{}: makes {}, and {} makes {}; name an estimate of the same planes", option("elsewhere", name),
                     enumerate(technique.writes), asked_for.name, enumerate(asked_for.writes));
  for (const std::string& extra : wanted.outputs) {
    if (contains(asked_for.extras, extra) && !contains(technique.extras, extra))
      throw UsageError("{}: does not make '{}', which is asked for; leave that out", option("elsewhere", name), extra);
  }
  return &technique;
}

}  // namespace gloam
