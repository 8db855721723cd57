#include "gloam/composition.h"

#include <algorithm>
#include <limits>

#include "base/lists.h"
#include "base/words.h"
#include "frame/untouched.h"
#include "gloam/error.h"
#include "gloam/option.h"

namespace gloam {
namespace {

using Names = std::vector<std::string>;
using Ambient = Composition::Ambient;

constexpr const char* no_albedo = "the frame has no 'albedo'";

/// "give --ambient R,G,B, or capture it (--planes color,ambient)"
std::string ways_to_ambient() {
  return fmt::format("give {}, or capture it ({})", option("ambient", "R,G,B"), option("planes", "color,ambient"));
}

std::string ambient_unknown() {
  return "how much of the colour is ambient light is unknown: the frame has no 'ambient'; " + ways_to_ambient();
}

/// Whether what is darkened holds light of lamps and the sun too.
bool holds_direct_light(Ambient ambient) { return ambient == Ambient::colour || ambient == Ambient::illumination; }

/// What decides about the parts.
struct Known {
  const Names& frame;
  const Names& computed;
  const ComposeOptions& options;
  Ambient ambient;
  bool has(const char* plane) const { return contains(frame, plane); }
  bool is_computed(const char* plane) const { return contains(computed, plane); }
};

Ambient ambient_of(const Names& frame, const ComposeOptions& options) {
  if (options.ambient) return Ambient::even_sky;
  if (contains(frame, "ambient")) return Ambient::plane;
  if (!options.holds.ambient) return Ambient::unknown;
  return has_illumination(frame) ? Ambient::illumination : Ambient::colour;
}

// Why a part is not used; empty if it is.

std::string why_no_indirect(const Known& known) {
  if (known.options.holds.indirect) return "the colour holds indirect light already";
  return known.has("albedo") ? "" : no_albedo;
}

std::string why_no_environment(const Known& known) {
  if (!known.has("albedo")) return no_albedo;
  if (known.options.holds.ao)
    return "it takes the place of ambient light, and the colour's is occluded already: how much of it is there is "
           "unknown";
  return holds_direct_light(known.ambient) ? ambient_unknown() : "";
}

bool takes_indirect(const Known& known) { return known.is_computed("indirect") && why_no_indirect(known).empty(); }
bool takes_environment(const Known& known) {
  return known.is_computed("environment") && why_no_environment(known).empty();
}

/// Of `ao` and `bounces` alike.
std::string why_no_visibility(const Known& known) {
  if (known.options.holds.ao) return "the colour holds ambient occlusion already";
  if (takes_environment(known)) return "'environment' is in place of the ambient light, and occluded by itself";
  return known.ambient == Ambient::unknown ? std::string("the colour holds no ambient light, and ") + ambient_unknown()
                                           : "";
}

std::string why_no_bounces(const Known& known) {
  if (known.options.holds.indirect) return "the colour holds indirect light already";
  if (known.options.holds.ambient && takes_indirect(known)) return "'indirect' holds reflected ambient light already";
  return why_no_visibility(known);
}

std::string why_no_ao(const Known& known) {
  if (std::string why = why_no_visibility(known); !why.empty()) return why;
  return known.is_computed("bounces") && why_no_bounces(known).empty() ? "'bounces' holds ambient occlusion already"
                                                                       : "";
}

std::string why_no_reflection(const Known& known) {
  return known.options.holds.reflection ? "the colour holds reflections already" : "";
}

std::string why_no_contact(const Known& known) {
  if (known.options.holds.shadows) return "the colour holds shadows already";
  return holds_direct_light(known.ambient) ? ambient_unknown() : "";
}

/// A part that a picture can be made of.
struct PartRule {
  const char* plane;
  std::string (*why_not)(const Known& known);
  const char* how;
};

const std::vector<PartRule>& rules() {
  static const std::vector<PartRule> all = {
      {"ao", why_no_ao, "darkens ambient light"},
      {"bounces", why_no_bounces, "darkens ambient light, with light reflected between surfaces"},
      {"indirect", why_no_indirect, "adds light from the surfaces around, times albedo"},
      {"reflection", why_no_reflection, "adds what glossy surfaces mirror"},
      {"environment", why_no_environment, "is in place of the ambient light, times albedo"},
      {"contact", why_no_contact, "darkens direct light"}};
  return all;
}

// --- Rows

/// The rows of a view's planes that are at hand; null: none.
struct Row {
  const float *visibility, *environment, *indirect, *reflection, *contact, *ambient, *albedo, *metallic, *depth;
};

/// How one channel is composed.
struct Rules {
  bool holds_ambient;
  Ambient ambient;
  float sky;  ///< of an even sky
};

/// Values of a row, small enough to stay in the fastest cache.
struct Buffers {
  std::vector<float> ambient, diffuse, added, untouched;
  explicit Buffers(int width)
      : ambient(size_t(width)), diffuse(size_t(width)), added(size_t(width)), untouched(size_t(width)) {}
};

void diffuse_albedo(const Row& row, int width, float* to) {
  if (!row.albedo) return;
  if (!row.metallic) {
    std::copy_n(row.albedo, width, to);
    return;
  }
  for (int x = 0; x < width; ++x) to[x] = row.albedo[x] * (1 - row.metallic[x]);
}

/// The colour's own ambient light is at most the colour, less the light that is left as it is. `to` holds illumination times albedo,
/// where that is darkened.
void ambient_light(const Row& row, const Rules& rules, const float* colour, const Buffers& of, int width, float* to) {
  const float *diffuse = of.diffuse.data(), *untouched = of.untouched.data();
  if (rules.ambient == Ambient::colour)
    std::copy_n(colour, width, to);
  else if (rules.ambient == Ambient::illumination)
    for (int x = 0; x < width; ++x) to[x] = std::max(to[x], 0.0f);
  else if (row.ambient)
    std::copy_n(row.ambient, width, to);
  else if (rules.sky > 0)
    for (int x = 0; x < width; ++x) to[x] = diffuse[x] * rules.sky;
  else
    std::fill_n(to, width, 0.0f);
  if (!rules.holds_ambient) return;
  for (int x = 0; x < width; ++x) to[x] = std::min(to[x], std::max(colour[x] - untouched[x], 0.0f));
}

/// What the picture has in place of the colour's ambient light, less that light.
void change_ambient(const Row& row, const Rules& rules, const float* ambient, const float* diffuse, int width,
                    float* added) {
  const float held = rules.holds_ambient ? 1.0f : 0.0f;
  if (row.environment)
    for (int x = 0; x < width; ++x) added[x] = diffuse[x] * row.environment[x] - held * ambient[x];
  else if (row.visibility)
    for (int x = 0; x < width; ++x) added[x] = (row.visibility[x] - held) * ambient[x];
  else
    for (int x = 0; x < width; ++x) added[x] = (1 - held) * ambient[x];
}

void add_light(const Row& row, const Rules& rules, const float* colour, const Buffers& of, int width, float* added) {
  const float *ambient = of.ambient.data(), *diffuse = of.diffuse.data(), *untouched = of.untouched.data();
  const float held = rules.holds_ambient ? 1.0f : 0.0f;
  if (row.indirect)
    for (int x = 0; x < width; ++x) added[x] += diffuse[x] * row.indirect[x];
  if (row.reflection)
    for (int x = 0; x < width; ++x) added[x] += row.reflection[x];
  if (row.contact)
    for (int x = 0; x < width; ++x)
      added[x] += (row.contact[x] - 1) * std::max(colour[x] - held * ambient[x] - untouched[x], 0.0f);
}

/// Two choices in turn, where one condition of two would keep the loop from being vectorised.
void take_sum(const float* added, int width, float* colour) {
  for (int x = 0; x < width; ++x) {
    const float sum = colour[x] + added[x];
    const float finite = sum - sum == 0 ? sum : colour[x];
    colour[x] = added[x] == 0 ? colour[x] : finite;
  }
}

void leave_background(const float* depth, int width, float* added) {
  constexpr float background = std::numeric_limits<float>::infinity();
  for (int x = 0; x < width; ++x) added[x] = depth[x] == background ? 0.0f : added[x];
}

/// `buffers` hold the untouched light, and as ambient light illumination times albedo, where that is darkened.
void compose_row(const Row& row, const Rules& rules, int width, Buffers& buffers, float* colour) {
  float *ambient = buffers.ambient.data(), *diffuse = buffers.diffuse.data(), *added = buffers.added.data();
  diffuse_albedo(row, width, diffuse);
  ambient_light(row, rules, colour, buffers, width, ambient);
  change_ambient(row, rules, ambient, diffuse, width, added);
  add_light(row, rules, colour, buffers, width, added);
  if (row.depth) leave_background(row.depth, width, added);
  take_sum(added, width, colour);
}

/// The channels that a component of colour is composed of, in the order of `Row`.
struct Channels {
  const Channel *visibility, *environment, *indirect, *reflection, *contact, *ambient, *albedo, *metallic, *depth;
  Row row(int y) const {
    const auto of = [y](const Channel* channel) { return channel ? channel->row(y) : nullptr; };
    return {of(visibility), of(environment), of(indirect), of(reflection), of(contact),
            of(ambient),    of(albedo),      of(metallic), of(depth)};
  }
};

Channels channels_of(const View& view, const View& computed, const Composition& composition, size_t component) {
  const Layout& layout = view.planes.at("color").channels.front().layout();
  const auto part = [&](const char* name) {
    return composition.uses(name) ? channel_for(computed.find(name), component, layout) : nullptr;
  };
  const auto own = [&](const char* name) { return channel_for(view.find(name), component, layout); };
  return {part(composition.uses("bounces") ? "bounces" : "ao"),
          part("environment"),
          part("indirect"),
          part("reflection"),
          part("contact"),
          composition.ambient == Ambient::plane ? own("ambient") : nullptr,
          own("albedo"),
          own("metallic"),
          own("depth")};
}

/// What occlusion darkens of the colour, and what it leaves alone.
Names notes_on_darkening(const Composition& composition) {
  const bool darkens = composition.uses("ao") || composition.uses("bounces");
  Names notes;
  if (darkens && composition.ambient == Ambient::colour)
    notes.push_back(fmt::format(
        "the frame has no 'ambient', so ambient occlusion darkens all of its colour{}, light of the sun too; {}",
        composition.untouched.empty() ? "" : " but " + enumerate(composition.untouched), ways_to_ambient()));
  if (darkens && composition.ambient == Ambient::illumination)
    notes.push_back(note_on_illumination(composition.options.names_in_file));
  if (!composition.untouched.empty() && (darkens || composition.uses("contact")))
    notes.push_back(note_on_untouched(composition.untouched, composition.options.names_in_file));
  return notes;
}

}  // namespace

bool Composition::uses(const std::string& plane) const {
  return std::any_of(parts.begin(), parts.end(),
                     [&](const ComposedPart& part) { return part.plane == plane && part.is_used; });
}

const Names& part_planes() {
  static const Names names = [] {
    Names all;
    for (const PartRule& rule : rules()) all.emplace_back(rule.plane);
    return all;
  }();
  return names;
}

const Names& planes_to_compose() {
  static const Names names = [] {
    Names all = {"color", "ambient", "albedo", "metallic", "depth"};
    add_new(all, planes_of_darkened_light());
    return all;
  }();
  return names;
}

Composition composition_of(const Names& frame, const Names& computed, const ComposeOptions& options) {
  if (!contains(frame, "color")) throw Error("the frame has no 'color', which the picture begins with");
  if (options.ambient && !contains(frame, "albedo"))
    throw UsageError("{}: is the light of a sky, which the surfaces reflect, and {}; leave it out",
                     option("ambient", fmt::format("{:g}", fmt::join(*options.ambient, ","))), no_albedo);
  Composition composition;
  composition.ambient = ambient_of(frame, options);
  composition.options = options;
  composition.untouched = untouched_of(frame);
  const Known known{frame, computed, options, composition.ambient};
  for (const PartRule& rule : rules()) {
    if (!known.is_computed(rule.plane)) continue;
    const std::string why_not = rule.why_not(known);
    composition.parts.push_back({rule.plane, why_not.empty(), why_not.empty() ? rule.how : why_not});
  }
  add_new(composition.notes, notes_on_darkening(composition));
  if (!options.holds.ambient && composition.ambient != Ambient::unknown)
    composition.notes.push_back("the colour holds no ambient light, so the picture gets it beside the colour");
  return composition;
}

ColorHolds holds_of_picture(const Composition& composition) {
  ColorHolds holds = composition.options.holds;
  holds.ambient |= composition.ambient != Ambient::unknown || composition.uses("environment");
  holds.ao |= composition.uses("ao") || composition.uses("bounces") || composition.uses("environment");
  holds.indirect |= composition.uses("indirect");
  holds.reflection |= composition.uses("reflection");
  holds.shadows |= composition.uses("contact");
  return holds;
}

std::map<std::string, std::string> attributes_of(const Composition& composition) {
  static const Choices<Ambient> words = {{"plane", Ambient::plane},
                                         {"even sky", Ambient::even_sky},
                                         {"illumination", Ambient::illumination},
                                         {"all of color", Ambient::colour},
                                         {"unknown", Ambient::unknown}};
  Names used;
  for (const ComposedPart& part : composition.parts) {
    if (part.is_used) used.push_back(part.plane);
  }
  return {{color_holds_attribute, in_words(holds_of_picture(composition))},
          {"gloamComposite", fmt::format("{}; color had {}; ambient: {}",
                                         used.empty() ? "nothing" : fmt::format("{}", fmt::join(used, " ")),
                                         in_words(composition.options.holds), word_for(composition.ambient, words))}};
}

void compose(View& colour, const View& computed, const Composition& composition) {
  Plane& color = colour.planes.at("color");
  const Layout layout = color.channels.front().layout();
  Buffers buffers(layout.width);
  for (size_t i = 0; i < color.channels.size(); ++i) {
    const Channels channels = channels_of(colour, computed, composition, i);
    const DarkenedLight light(colour, i);
    const Rules rules{composition.options.holds.ambient, composition.ambient,
                      composition.ambient == Ambient::even_sky ? float((*composition.options.ambient)[i]) : 0.0f};
    for (int y = 0; y < layout.height; ++y) {
      light.untouched(y, buffers.untouched.data());
      if (rules.ambient == Ambient::illumination) light.illuminated(y, buffers.ambient.data());
      compose_row(channels.row(y), rules, layout.width, buffers, color.channels[i].row(y));
    }
  }
}

Composition compose(Frame& colour, const Frame& computed, const ComposeOptions& options) {
  const Composition composition = composition_of(common_planes(colour), common_planes(computed), options);
  for (View& view : colour.views) compose(view, computed.view(view.name), composition);
  return composition;
}

}  // namespace gloam
