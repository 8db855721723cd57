#include "exr/channel_names.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <set>
#include <string_view>
#include <tuple>

#include "base/lists.h"
#include "gloam/error.h"
#include "gloam/planes.h"

namespace gloam {
namespace {

// --- Names
// ------------------------------------------------------------------------------------------------------------

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = char(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> pieces;
  size_t begin = 0;
  for (size_t end; (end = text.find(separator, begin)) != std::string::npos; begin = end + 1)
    pieces.push_back(text.substr(begin, end - begin));
  pieces.push_back(text.substr(begin));
  return pieces;
}

std::string join(const std::vector<std::string>& pieces) {
  std::string text;
  for (const std::string& piece : pieces) text += (text.empty() ? "" : ".") + piece;
  return text;
}

/// Letters and digits in lower case, without what renderers put before every pass:
/// "FinalImageMovieRenderQueue_WorldDepth" and "World Depth" are both "worlddepth".
std::string canonical(std::string_view layer) {
  std::string text;
  for (char c : layer)
    if (std::isalnum(static_cast<unsigned char>(c))) text += char(std::tolower(static_cast<unsigned char>(c)));
  for (std::string_view prefix : {"finalimage", "pathtracer", "movierenderqueue"})
    if (text.starts_with(prefix) && text.size() > prefix.size()) text.erase(0, prefix.size());
  return text;
}

// --- The table
// --------------------------------------------------------------------------------------------------------

/// How sure a spelling is: smaller wins.
enum Rank { own, renderer, generic, last_resort, only_rgba = 50 };

/// A layer and the channels in it that make up a plane.
struct Spelling {
  const char* plane;
  const char* layer;       ///< canonical; "" = no layer at all; "*" = any layer, for channels whose own name is enough
  const char* components;  ///< alternatives, best first, separated by '|'; components of one separated by ','
  Rank rank;
  Said said = Said::nothing;
  float y_scale = 1;  ///< for the second component: -1 turns y up into y down
};

constexpr const char* xyz = "x,y,z|r,g,b";
constexpr const char* rgb = "r,g,b|x,y,z";
constexpr const char* one = "z|v|r|y|x|a|depth";

const std::vector<Spelling>& spellings() {
  using enum Said;
  static const std::vector<Spelling> table = {
      // Depth. gloam and OpenEXR: Z. Blender: Depth.Z, file output depth.V. RenderMan: z. Karma: Pz, hitPz, depth.
      // Mitsuba 2: the name that the user gave ("dd.y", "depth.Y"), Mitsuba 3: <name>.T, both ray distances.
      {"depth", "", "z", own},
      {"depth", "depth", "z", renderer, planar},
      {"depth", "depth", one, renderer},
      {"depth", "z", one, renderer},
      {"depth", "zdepth", one, renderer},
      {"depth", "depthz", one, renderer},
      {"depth", "worlddepth", one, renderer},
      {"depth", "scenedepth", one, renderer},
      {"depth", "depthpass", one, generic},
      {"depth", "zpass", one, generic},
      {"depth", "pz", one, renderer},
      {"depth", "hitpz", one, renderer},
      {"depth", "rayhitpz", one, renderer},
      {"depth", "cameradepth", one, generic},
      {"depth", "lineardepth", one, generic},
      {"depth", "depth", "t", renderer, ray_distance},
      {"depth", "dd", "y|t", renderer, ray_distance},
      {"depth", "y", "t", renderer, ray_distance},
      {"depth", "*", "t", last_resort, ray_distance},
      {"depth", "distance", "y|t|z|v|r|x", generic, ray_distance},
      {"depth", "raydistance", "y|t|z|v|r|x", generic, ray_distance},
      {"depth", "*", "depth|pz|hitpz|ray:hitpz|zdepth", generic},
      {"depth", "*", "distance", last_resort, ray_distance},

      // Normals. Blender: Normal. Arnold, Karma: N. RenderMan: Nn, __Nworld. Mitsuba: the user's name ("nn").
      {"normal", "n", "x,y,z", own},
      {"normal", "n", "r,g,b", renderer},
      {"normal", "normal", xyz, renderer},
      {"normal", "normals", xyz, renderer},
      {"normal", "nworld", xyz, renderer, world_space},
      {"normal", "nn", xyz, renderer},
      {"normal", "worldnormal", xyz, renderer, world_space},
      {"normal", "worldnormals", xyz, renderer, world_space},
      {"normal", "normalworld", xyz, renderer, world_space},
      {"normal", "shnormal", xyz, renderer},
      {"normal", "shadingnormal", xyz, renderer},
      {"normal", "smoothnormal", xyz, generic},
      {"normal", "hitn", xyz, renderer},
      {"normal", "rayhitn", xyz, renderer},
      {"normal", "ns", xyz, generic},
      {"normal", "cameranormal", xyz, generic, view_space},
      {"normal", "viewnormal", xyz, generic, view_space},
      {"normal", "normalcamera", xyz, generic, view_space},
      {"normal", "neye", xyz, generic, view_space},
      {"normal", "ncam", xyz, generic, view_space},
      {"normal", "geonormal", xyz, last_resort},
      {"normal", "ng", xyz, last_resort},
      {"normal", "ngn", xyz, last_resort},
      {"normal", "hitng", xyz, last_resort},

      // The finished picture. Blender: Combined, single-layer files R G B. Unreal: FinalImage or no layer at all.
      {"color", "", "r,g,b", own},
      {"color", "combined", rgb, renderer},
      {"color", "beauty", rgb, renderer},
      {"color", "rgba", rgb, renderer},
      {"color", "rgb", rgb, renderer},
      {"color", "finalimage", rgb, renderer},
      {"color", "image", rgb, generic},
      {"color", "c", rgb, renderer},
      {"color", "ci", rgb, renderer},
      {"color", "color", rgb, generic},
      {"color", "main", rgb, generic},
      {"alpha", "", "a", own},
      {"alpha", "combined", "a", renderer},
      {"alpha", "beauty", "a", renderer},
      {"alpha", "rgba", "a", renderer},
      {"alpha", "finalimage", "a", renderer},
      {"alpha", "image", "a", generic},
      {"alpha", "c", "a", renderer},
      {"alpha", "ci", "a", renderer},
      {"alpha", "color", "a", generic},
      {"alpha", "main", "a", generic},
      {"alpha", "alpha", "a|r|v|x|y|z", generic},
      {"alpha", "*", "alpha", generic},

      // Material.
      {"albedo", "albedo", rgb, own},
      {"albedo", "diffusealbedo", rgb, renderer},
      {"albedo", "diffcol", rgb, renderer},
      {"albedo", "basecolor", rgb, renderer},
      {"albedo", "basecolour", rgb, renderer},
      {"albedo", "diffusecolor", rgb, generic},
      {"albedo", "rawalbedo", rgb, generic},
      {"albedo", "denoisealbedo", rgb, last_resort},
      {"albedo", "denoisingalbedo", rgb, last_resort},
      {"roughness", "*", "roughness", own},
      {"roughness", "roughness", "x|r|v|y|z|a", renderer},
      {"roughness", "specularroughness", "x|r|v|y|z|a", renderer},
      {"roughness", "*", "specularroughness", renderer},
      {"reflectance", "reflectance", rgb, own},
      {"reflectance", "specularalbedo", rgb, renderer},
      {"reflectance", "glosscol", rgb, renderer},
      {"reflectance", "specularcolor", rgb, generic},

      // Geometry.
      {"position", "p", "x,y,z", own},
      {"position", "p", "r,g,b", renderer},
      {"position", "position", xyz, renderer},
      {"position", "pworld", xyz, renderer},
      {"position", "worldposition", xyz, renderer},
      {"position", "absoluteworldposition", xyz, renderer},
      {"position", "hitp", xyz, renderer},
      {"position", "rayhitp", xyz, renderer},
      {"position", "pp", xyz, generic},
      {"back_depth", "*", "backz", own},
      {"back_depth", "backz", "z|v|r|y|x", generic},
      {"back_depth", "backdepth", "z|v|r|y|x", generic},
      {"instance", "*", "instance", own},
      {"instance", "instance", "x|r|v|y|z|id", generic},
      {"instance", "instanceid", "x|r|v|y|z|id", generic},
      {"instance", "shapeindex", "i|x|r|y", generic},
      {"peel_count", "peel", "count", own},
      {"outline_count", "outline", "count", own},
      {"seen_by_both", "", "both", own},
      {"mask", "", "mask", own},
      {"mask", "mask", "r|v|x|y|z|a|mask", generic},
      // Blender's Vector holds previous - current in x and y, y up.
      {"motion", "motion", "x,y", own},
      {"motion", "vector", "x,y", renderer, nothing, -1},
      {"motion", "motion", "r,g", renderer, unsure_motion},
      {"motion", "motionvector", "x,y|r,g|u,v", renderer, unsure_motion},
      {"motion", "motionvectors", "x,y|r,g|u,v", renderer, unsure_motion},
      {"motion", "velocity", "x,y|r,g|u,v", generic, unsure_motion},

      // Results.
      {"ao", "*", "ao", own},
      {"ao", "ao", "r|v|x|y|z", renderer},
      {"ao", "occlusion", "r|v|x|y|z", generic},
      {"ao", "ambientocclusion", "r|v|x|y|z", generic},
      {"ao", "*", "occlusion|ambientocclusion|ambient_occlusion", generic},
      {"ao_raw", "*", "ao_raw", own},
      {"ao_noise", "*", "ao_noise", own},
      {"bent_normal", "bent", "x,y,z", own},
      {"bent_normal", "bentnormal", xyz, generic},
      {"cone", "*", "cone", own},
      {"reflection", "reflection", "r,g,b,a", own},
      {"reflection_raw", "reflectionraw", "r,g,b,a", own},
      {"frames", "", "frames", own},
      {"history", "history", "r,g,b,a", own},
      {"history_depth", "history", "z", own},
      {"history_frames", "history", "frames", own},
      {"reflection_noise", "*", "reflection_noise", own},
      {"hit", "hit", "z", own},
  };
  return table;
}

/// Those of a plane, in the order of the table.
const std::vector<Spelling>& spellings_of(const std::string& plane) {
  static const std::map<std::string, std::vector<Spelling>> by_plane = [] {
    std::map<std::string, std::vector<Spelling>> sorted;
    for (const Spelling& spelling : spellings()) sorted[spelling.plane].push_back(spelling);
    return sorted;
  }();
  static const std::vector<Spelling> none;
  const auto found = by_plane.find(plane);
  return found == by_plane.end() ? none : found->second;
}

/// Layers whose channels are never taken for something else by their component alone, as when the part is named so.
bool is_other_data(const std::string& layer) {
  static const std::set<std::string> known = {"mist",      "uv",          "indexob",    "indexma",
                                              "disparity", "disparityl",  "disparityr", "volumez",
                                              "vector",    "cryptomatte", "id"};
  return known.contains(layer);
}

// --- From channels to layers
// ------------------------------------------------------------------------------------------

/// A channel with its view taken out of its name.
struct Entry {
  const FileChannel* file;
  std::string view;   ///< "" = named by no view
  bool named;         ///< the file says the view (part, or the name itself)
  std::string layer;  ///< dotted path without view and component
  std::string component;
  std::string plain() const { return layer.empty() ? component : layer + "." + component; }
};

/// OpenEXR's rule (layer.view.channel; no dot: the default view), Blender's names, which follow it, and
/// view.layer.channel.
Entry entry_of(const FileChannel& channel, const std::vector<std::string>& multi_view) {
  std::vector<std::string> pieces = split(channel.name, '.');
  const std::string component = pieces.back();
  pieces.pop_back();
  Entry entry{&channel, channel.part_view, !channel.part_view.empty(), "", component};
  if (entry.named && !pieces.empty() && pieces.back() == entry.view) pieces.pop_back();
  if (!entry.named && !multi_view.empty()) {
    entry.view = multi_view.front();
    // The longest first, as a view's name may have dots, and end as another's does.
    std::vector<std::string> views = multi_view;
    std::stable_sort(views.begin(), views.end(),
                     [](const std::string& a, const std::string& b) { return a.size() > b.size(); });
    for (const bool at_end : {true, false}) {
      for (const std::string& view : views) {
        const std::vector<std::string> words = split(view, '.');
        if (entry.named || words.size() > pieces.size()) continue;
        const auto from = at_end ? pieces.end() - std::ptrdiff_t(words.size()) : pieces.begin();
        if (!std::equal(words.begin(), words.end(), from)) continue;
        entry.view = view;
        entry.named = true;
        pieces.erase(from, from + std::ptrdiff_t(words.size()));
      }
    }
  }
  entry.layer = join(pieces);
  return entry;
}

std::vector<Entry> entries_of(const std::vector<FileChannel>& channels, const std::vector<std::string>& multi_view) {
  std::vector<Entry> entries;
  for (const FileChannel& channel : channels) entries.push_back(entry_of(channel, multi_view));
  return entries;
}

/// Views in file order; one empty name where the file names none.
std::vector<std::string> views_of(const std::vector<Entry>& entries, const std::vector<std::string>& multi_view) {
  std::vector<std::string> views = multi_view;
  for (const Entry& entry : entries)
    if (!entry.view.empty() && std::find(views.begin(), views.end(), entry.view) == views.end())
      views.push_back(entry.view);
  if (views.empty()) views.push_back("");
  return views;
}

/// Channels of one layer of one part.
struct Layer {
  int part;
  bool shared;         ///< belongs to a part that names no view, while the file has views
  std::string path;    ///< as the file has it
  std::string name;    ///< canonical form of its last piece, or of the part's name where the path is empty
  std::string prefix;  ///< path without its last piece: Blender's view layer
  std::map<std::string, const FileChannel*> components;  ///< by lower-case name
};

/// "depth_left", "left.depth" -> "depth".
std::string without_view(const std::string& name, const std::string& view) {
  if (view.empty()) return name;
  for (char separator : {'_', '.', '-'}) {
    if (name.ends_with(separator + view)) return name.substr(0, name.size() - view.size() - 1);
    if (name.starts_with(view + separator)) return name.substr(view.size() + 1);
  }
  return name;
}

Layer layer_of(const Entry& entry, const std::string& view) {
  Layer layer{entry.file->part, entry.view.empty() && !view.empty(), entry.layer, "", "", {}};
  if (entry.layer.empty()) {
    layer.name = canonical(without_view(entry.file->part_name, view));
    return layer;
  }
  const size_t dot = entry.layer.rfind('.');
  layer.name = canonical(dot == std::string::npos ? entry.layer : entry.layer.substr(dot + 1));
  layer.prefix = dot == std::string::npos ? "" : entry.layer.substr(0, dot);
  return layer;
}

/// Layers of a view, in file order.
std::vector<Layer> layers_of(const std::vector<Entry>& entries, const std::string& view) {
  std::vector<Layer> layers;
  for (const Entry& entry : entries) {
    if (entry.view != view && !entry.view.empty()) continue;
    auto same = [&](const Layer& l) { return l.part == entry.file->part && l.path == entry.layer; };
    auto found = std::find_if(layers.begin(), layers.end(), same);
    if (found == layers.end()) found = layers.insert(layers.end(), layer_of(entry, view));
    found->components.emplace(lower(entry.component), entry.file);
  }
  return layers;
}

// --- From layers to planes
// --------------------------------------------------------------------------------------------

/// One way to fill a plane.
struct Candidate {
  const Layer* layer;
  std::vector<const FileChannel*> channels;
  int rank;
  Said said;
  float y_scale;
};

std::vector<const FileChannel*> pick(const Layer& layer, const std::string& alternatives) {
  for (const std::string& alternative : split(alternatives, '|')) {
    const std::vector<std::string> components = split(alternative, ',');
    std::vector<const FileChannel*> channels;
    for (const std::string& component : components) {
      const auto found = layer.components.find(component);
      if (found != layer.components.end()) channels.push_back(found->second);
    }
    if (channels.size() == components.size()) return channels;
  }
  return {};
}

/// How well a spelling fits a layer, as a rank; nothing where it does not.
std::optional<int> fit(const Spelling& spelling, const Layer& layer) {
  const std::string_view wanted = spelling.layer;
  const int shared = layer.shared ? 100 : 0;  // a view's own channels come before what all views share
  if (wanted == "*") {
    if (layer.path.empty()) return spelling.rank + shared;
    return is_other_data(layer.name) ? std::nullopt : std::optional(10 + spelling.rank + shared);
  }
  if (wanted == "") {
    if (!layer.path.empty() || is_other_data(layer.name)) return {};
    return spelling.rank + shared;  // candidates_of weighs the name of the part
  }
  if (layer.name != wanted) return {};
  return spelling.rank + shared;
}

/// In a part named "albedo" a plain R G B is the albedo, not the finished picture: channels that the part's name speaks
/// for, by the plane that it says.
std::map<const FileChannel*, std::string> claimed_by_part_name(const Layer& layer) {
  std::map<const FileChannel*, std::string> claimed;
  if (!layer.path.empty() || layer.name.empty()) return claimed;
  for (const Spelling& spelling : spellings()) {
    if (layer.name != spelling.layer) continue;
    for (const FileChannel* channel : pick(layer, spelling.components)) claimed.emplace(channel, spelling.plane);
  }
  return claimed;
}

bool claimed_by_other(const std::map<const FileChannel*, std::string>& claimed,
                      const std::vector<const FileChannel*>& channels, const std::string& plane) {
  return std::any_of(channels.begin(), channels.end(), [&](const FileChannel* channel) {
    const auto found = claimed.find(channel);
    return found != claimed.end() && found->second != plane;
  });
}

std::vector<Candidate> candidates_of(const std::string& plane, const std::vector<Layer>& layers) {
  std::vector<Candidate> candidates;
  for (const Layer& layer : layers) {
    const auto claimed = claimed_by_part_name(layer);
    for (const Spelling& spelling : spellings_of(plane)) {
      const std::optional<int> rank = fit(spelling, layer);
      if (!rank) continue;
      const std::string_view wanted = spelling.layer;
      if (wanted == "*" && spelling.rank == last_resort && layer.components.size() > 1) continue;  // "st.t" is no depth
      auto channels = pick(layer, spelling.components);
      if (channels.empty() || (wanted.empty() && claimed_by_other(claimed, channels, plane))) continue;
      // A part with a strange name, "diffuse_direct", comes after one named "beauty".
      const int strange = wanted.empty() && !layer.name.empty() && claimed.empty() ? 5 : 0;
      candidates.push_back({&layer, channels, *rank + strange, spelling.said, spelling.y_scale});
    }
  }
  return candidates;
}

std::string shown(const Candidate& candidate) {
  const std::string& name = candidate.channels.front()->name;
  if (candidate.channels.size() == 1) return name;
  const size_t dot = name.rfind('.');
  return dot == std::string::npos ? name : name.substr(0, dot);
}

/// "Z" or "R,G,B"
std::string names_of(const Candidate& candidate) {
  std::string names;
  for (const FileChannel* channel : candidate.channels) names += (names.empty() ? "" : ",") + channel->name;
  return names;
}

std::string part_of(const Candidate& candidate) {
  const FileChannel& channel = *candidate.channels.front();
  return channel.part_name.empty() ? fmt::format("part {}", channel.part) : fmt::format("part '{}'", channel.part_name);
}

PlaneSource source_of(const std::string& plane, const std::string& view, const Candidate& candidate) {
  PlaneSource source{plane, view, {}, candidate.said};
  for (const FileChannel* channel : candidate.channels)
    source.channels.push_back({channel->part, channel->name, channel->type, 1});
  if (source.channels.size() == 2) source.channels[1].scale = candidate.y_scale;
  return source;
}

void note(NamedPlanes& named, const std::string& plane, const std::string& sentence) {
  std::vector<std::string>& notes = named.assumed[plane];
  if (std::find(notes.begin(), notes.end(), sentence) == notes.end()) notes.push_back(sentence);
}

/// The best candidate: rank, then the view layer that the depth came from, then file order.
const Candidate* best_of(const std::vector<Candidate>& candidates, const std::optional<std::string>& prefix) {
  auto key = [&](const Candidate& c) { return std::pair(c.rank, prefix && c.layer->prefix != *prefix); };
  const Candidate* best = nullptr;
  for (const Candidate& candidate : candidates)
    if (!best || key(candidate) < key(*best)) best = &candidate;
  return best;
}

void note_tie(NamedPlanes& named, const std::string& plane, const std::vector<Candidate>& candidates,
              const Candidate& best) {
  for (const Candidate& other : candidates)
    if (other.rank == best.rank && other.layer != best.layer && other.channels != best.channels) {
      std::string taken = fmt::format("'{}'", shown(best)), left = fmt::format("'{}'", shown(other));
      std::string name = shown(other);  // what --plane knows the other by
      if (taken == left) {
        const FileChannel& channel = *other.channels.front();
        const std::string part = channel.part_name.empty() ? std::to_string(channel.part) : channel.part_name;
        const bool is_whole = other.layer->path.empty();
        name = is_whole && !channel.part_name.empty() ? part : part + ":" + (is_whole ? names_of(other) : name);
        taken += " of " + part_of(best);
        left += " of " + part_of(other);
      }
      const std::string chooses = name.empty() ? "" : fmt::format(" (--plane {}={} chooses)", plane, name);
      note(named, plane, fmt::format("{}: {} taken, not {}{}", plane, taken, left, chooses));
      return;
    }
}

/// Depth layers of a gloam file: peel.00.Z, stochastic.00.Z.
void add_depth_layers(NamedPlanes& named, const std::vector<Layer>& layers, const std::string& view) {
  std::set<std::string> seen;
  for (const Layer& layer : layers) {
    const std::string name = lower(layer.path);
    const auto z = layer.components.find("z");
    if (!stack_layer(name) || z == layer.components.end() || !seen.insert(name).second) continue;
    named.planes.push_back(source_of(name, view, {&layer, {z->second}, own, Said::nothing, 1}));
  }
}

/// Mitsuba names the beauty after its nested integrator, whatever that is called: the only RGBA layer left over.
void add_unnamed_beauty(std::vector<Candidate>& candidates, const std::vector<Layer>& layers, const char* components) {
  std::vector<Candidate> found;
  for (const Layer& layer : layers) {
    const bool known = std::any_of(spellings().begin(), spellings().end(),
                                   [&](const Spelling& spelling) { return layer.name == spelling.layer; });
    if (known || layer.path.empty() || !layer.prefix.empty() || is_other_data(layer.name)) continue;
    if (layer.name.starts_with("crypto")) continue;
    if (layer.components.size() != 4 || pick(layer, "r,g,b,a").empty()) continue;
    found.push_back({&layer, pick(layer, components), only_rgba, Said::nothing, 1});
  }
  if (found.size() == 1) candidates.push_back(found.front());
}

// --- --plane
// ----------------------------------------------------------------------------------------------------------

/// Said in place of channels: the file's own are not used, as if it had none.
constexpr const char* left_out = "none";

void check_plane_name(const std::string& plane) {
  std::vector<std::string> names;
  for (const PlaneKind& kind : plane_kinds()) names.push_back(kind.name);
  if (std::find(names.begin(), names.end(), plane) != names.end()) return;
  throw UsageError("--plane {}: no plane is called so{}; there are {}", plane, suggestion(plane, names),
                   enumerate(names));
}

std::string alternatives_for(const PlaneKind& kind) {
  switch (kind.components.size()) {
    case 1:
      return "z|v|r|y|x|a|t";
    case 2:
      return "x,y|r,g|u,v";
    case 3:
      return "x,y,z|r,g,b|u,v,w";
    default:
      return "r,g,b,a|x,y,z,w";
  }
}

/// A channel by its full name or its name without the view; exact spelling before any other case.
const FileChannel* find_channel(const std::vector<Entry>& entries, const std::string& view, const std::string& name) {
  for (const bool exact : {true, false})
    for (const Entry& entry : entries) {
      if (entry.view != view && !entry.view.empty()) continue;
      for (const std::string& spelled : {entry.file->name, entry.plain()})
        if (exact ? spelled == name : lower(spelled) == lower(name)) return entry.file;
    }
  return nullptr;
}

/// Channels of a layer, named with or without the view, or by the name of a part.
std::vector<const FileChannel*> find_layer(const std::vector<Layer>& layers, const PlaneKind& kind,
                                           const std::string& view, const std::string& name) {
  for (const Layer& layer : layers) {
    const FileChannel* first = layer.components.begin()->second;
    const size_t dot = first->name.rfind('.');
    const std::string full = dot == std::string::npos ? "" : first->name.substr(0, dot);
    const bool by_part = layer.path.empty() && !first->part_name.empty() &&
                         (first->part_name == name || without_view(first->part_name, view) == name);
    if (!by_part && (layer.path.empty() || (lower(layer.path) != lower(name) && lower(full) != lower(name)))) continue;
    if (auto channels = pick(layer, alternatives_for(kind)); !channels.empty()) return channels;
    if (layer.components.size() == kind.components.size() && kind.components.size() == 1) return {first};
    std::vector<std::string> held;
    for (const auto& [component, channel] : layer.components) held.push_back(channel->name);
    throw Error("--plane {}={}: the layer has {}; name {} of them, separated by commas", kind.name, name,
                enumerate(held), kind.components.size());
  }
  return {};
}

/// The part that "PART:CHANNEL" names, by its name or its number, and the rest; none where it names no part. Channels have colons
/// in their names too.
std::optional<std::pair<int, std::string>> part_in(const std::vector<Entry>& entries, const std::string& text) {
  for (const Entry& entry : entries) {
    for (const std::string& part : {entry.file->part_name, std::to_string(entry.file->part)}) {
      if (!part.empty() && text.starts_with(part + ":"))
        return std::pair(entry.file->part, text.substr(part.size() + 1));
    }
  }
  return {};
}

/// What the user named for a plane, in one view; empty where this view has no such channel.
std::vector<const FileChannel*> chosen(const std::vector<Layer>& layers, const std::vector<Entry>& entries,
                                       const PlaneKind& kind, const std::string& view, const std::string& text) {
  if (const auto part = part_in(entries, text)) {
    std::vector<Entry> its_entries;
    std::vector<Layer> its_layers;
    for (const Entry& entry : entries)
      if (entry.file->part == part->first) its_entries.push_back(entry);
    for (const Layer& layer : layers)
      if (layer.part == part->first) its_layers.push_back(layer);
    return chosen(its_layers, its_entries, kind, view, part->second);
  }
  const std::vector<std::string> names = split(text, ',');
  std::vector<const FileChannel*> channels;
  for (const std::string& name : names)
    if (const FileChannel* channel = find_channel(entries, view, name)) channels.push_back(channel);
  if (channels.size() == names.size() && names.size() == kind.components.size()) return channels;
  if (names.size() == 1 && channels.empty()) return find_layer(layers, kind, view, text);
  if (channels.size() == names.size())
    throw Error("--plane {}={}: {} channel(s) given, and '{}' has {} component(s)", kind.name, text, names.size(),
                kind.name, kind.components.size());
  return {};
}

/// No view has it: say which of the names is unknown.
[[noreturn]] void no_such_channel(const std::vector<Entry>& entries, const std::string& plane,
                                  const std::string& text) {
  std::vector<std::string> known;
  for (const Entry& entry : entries) {
    known.push_back(entry.file->name);
    if (!entry.layer.empty()) known.push_back(entry.layer);
  }
  std::string wrong = text;
  for (const std::string& name : split(text, ','))
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      wrong = name;
      break;
    }
  std::string hint = suggestion(wrong, known);
  if (hint.empty()) {
    std::vector<std::string> all;
    for (const Entry& entry : entries) all.push_back(entry.file->name);
    const size_t shown_at_most = 24;
    const bool cut = all.size() > shown_at_most;
    if (cut) all.resize(shown_at_most);
    hint = "; it has " + enumerate(all) + (cut ? ", ..." : "");
  }
  throw Error("--plane {}={}: the file has no channel or layer '{}'{}", plane, text, wrong, hint);
}

/// Views to use: those asked for, in that order, else all, in file order.
std::vector<std::string> selected_views(const std::vector<std::string>& in_file,
                                        const std::vector<std::string>& asked) {
  std::vector<std::string> quoted;
  for (const std::string& view : in_file) quoted.push_back("'" + view + "'");
  for (const std::string& view : asked)
    if (std::find(in_file.begin(), in_file.end(), view) == in_file.end()) {
      if (in_file == std::vector<std::string>{""}) throw Error("--view {}: the file names no views", view);
      throw Error("--view {}: no such view{}; the file has {}", view, suggestion(view, in_file), enumerate(quoted));
    }
  if (asked.empty()) return in_file;
  std::vector<std::string> views;
  for (const std::string& view : asked) add_new(views, view);
  return views;
}

/// A file that lists views and names none of them in its channels means one picture; which view it shows, the user
/// says, else it is the first.
void apply_unnamed_view(std::vector<Entry>& entries, NamedPlanes& named, const std::vector<std::string>& multi_view,
                        const std::vector<std::string>& asked) {
  const bool unnamed = std::none_of(entries.begin(), entries.end(), [](const Entry& e) { return e.named; });
  if (!unnamed || multi_view.size() < 2 || entries.empty()) return;
  const std::string view = asked.size() == 1 ? asked.front() : multi_view.front();
  for (Entry& entry : entries) entry.view = view;
  named.view_is_assumed = asked.size() != 1;
  note(named, "",
       fmt::format("no channel names a view: all are taken for '{}'{}", view,
                   named.view_is_assumed ? ", the first that the file lists (--view says otherwise)" : ""));
}

void name_view(NamedPlanes& named, const std::vector<Entry>& entries, const std::string& view,
               const NameOptions& options, std::set<std::string>& overridden) {
  const std::vector<Layer> layers = layers_of(entries, view);
  std::optional<std::string> prefix;
  for (const PlaneKind& kind : plane_kinds()) {
    if (const auto choice = options.channels.find(kind.name); choice != options.channels.end()) {
      if (choice->second == left_out) {
        overridden.insert(kind.name);
        continue;
      }
      const auto channels = chosen(layers, entries, kind, view, choice->second);
      if (channels.empty()) continue;
      overridden.insert(kind.name);
      named.planes.push_back(source_of(kind.name, view, {nullptr, channels, own, Said::nothing, 1}));
      continue;
    }
    std::vector<Candidate> candidates = candidates_of(kind.name, layers);
    if (kind.name == "color") add_unnamed_beauty(candidates, layers, "r,g,b");
    if (kind.name == "alpha") add_unnamed_beauty(candidates, layers, "a");
    const Candidate* best = best_of(candidates, prefix);
    if (!best) continue;
    if (!prefix) prefix = best->layer->prefix;
    note_tie(named, kind.name, candidates, *best);
    if (best->rank == only_rgba)
      note(
          named, kind.name,
          fmt::format("{}: from '{}', the only RGBA layer whose name says nothing else", kind.name, best->layer->path));
    if (best->said == Said::unsure_motion)
      note(named, kind.name,
           fmt::format("motion: '{}' taken as pixels, current to previous frame, y down", shown(*best)));
    named.planes.push_back(source_of(kind.name, view, *best));
  }
  add_depth_layers(named, layers, view);
}

}  // namespace

std::string eye_in_name(const std::string& part_name) {
  std::string words = lower(part_name);
  std::replace_if(
      words.begin(), words.end(), [](char c) { return c == '_' || c == '-' || c == ' '; }, '.');
  const std::vector<std::string> pieces = split(words, '.');
  for (const auto& [eye, letter] : {std::pair("left", "l"), std::pair("right", "r")}) {
    for (const std::string& piece : {pieces.front(), pieces.back()})
      if (piece == eye || (pieces.size() > 1 && piece == letter)) return eye;
  }
  return "";
}

NamedPlanes name_planes(const std::vector<FileChannel>& channels, const std::vector<std::string>& multi_view,
                        const NameOptions& options) {
  for (const auto& [plane, text] : options.channels) check_plane_name(plane);
  NamedPlanes named;
  std::vector<Entry> entries = entries_of(channels, multi_view);
  const std::vector<std::string> views = selected_views(views_of(entries, multi_view), options.views);
  apply_unnamed_view(entries, named, multi_view, options.views);
  std::set<std::string> overridden;
  for (const std::string& view : views) {
    const size_t before = named.planes.size();
    name_view(named, entries, view, options, overridden);
    // A view that is only listed, as in a reference rendered eye by eye, is no view of this file.
    if (named.planes.size() > before || !options.views.empty()) named.views.push_back(view);
  }
  if (named.views.empty()) named.views.push_back(views.front());
  for (const auto& [plane, text] : options.channels)
    if (!overridden.contains(plane)) no_such_channel(entries, plane, text);
  return named;
}

}  // namespace gloam
