#include "exr/channel_names.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/lists.h"
#include "base/words.h"
#include "exr/channel_candidates.h"
#include "exr/channel_layers.h"
#include "exr/channel_sums.h"
#include "exr/channel_text.h"
#include "gloam/error.h"
#include "gloam/option.h"
#include "gloam/planes.h"

namespace gloam {
namespace {

using namespace channel_names;

/// The word in place of channels that hides a plane of the file.
constexpr const char* left_out = "none";

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

/// A channel by its full name or its name without the view. The exact case wins over other cases.
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
    throw Error("{}: the layer has {}; name {} of them, separated by commas", channels_option(kind.name, name),
                enumerate(held), kind.components.size());
  }
  return {};
}

/// The part that "PART:CHANNEL" names, by name or number, and the text after the colon; none if it names no part. Names of channels
/// may contain colons too.
std::optional<std::pair<int, std::string>> part_in(const std::vector<Entry>& entries, const std::string& text) {
  for (const Entry& entry : entries) {
    for (const std::string& part : {entry.file->part_name, std::to_string(entry.file->part)}) {
      if (!part.empty() && text.starts_with(part + ":"))
        return std::pair(entry.file->part, text.substr(part.size() + 1));
    }
  }
  return {};
}

/// The channels that the user named for a plane, in one view; empty if the view has no such channel.
/// Throws Error for a layer, or a number of channels, that does not fit the plane.
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
    throw Error("{}: {} channel(s) given, and '{}' has {} component(s)", channels_option(kind.name, text), names.size(),
                kind.name, kind.components.size());
  return {};
}

/// Throws Error for names that no view has, and says which of them is unknown.
void no_such_channel(const std::vector<Entry>& entries, const std::string& plane, const std::string& text) {
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
  throw Error("{}: the file has no channel or layer '{}'{}", channels_option(plane, text), wrong, hint);
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

/// Adds the layers of a gloam file: peel.00.Z, stochastic.00.Z, peel_color.00.R.
void add_stack_layers(NamedPlanes& named, const std::vector<Layer>& layers, const std::string& view) {
  std::set<std::string> seen;
  for (const Layer& layer : layers) {
    for (const auto& [component, channel] : layer.components) {
      const std::string plane = plane_of_layer(lower(layer.path), component);
      if (plane.empty() || !seen.insert(plane).second) continue;
      named.planes.push_back(source_of(plane, view, {&layer, {channel}, own, DeclaredConvention::nothing, 1}));
    }
  }
}

/// Views to use: those asked for, in that order, else all, in file order.
std::vector<std::string> selected_views(const std::vector<std::string>& in_file,
                                        const std::vector<std::string>& asked) {
  std::vector<std::string> quoted;
  for (const std::string& view : in_file) quoted.push_back("'" + view + "'");
  for (const std::string& view : asked)
    if (std::find(in_file.begin(), in_file.end(), view) == in_file.end()) {
      if (in_file == std::vector<std::string>{""}) throw Error("{}: the file names no views", option("view", view));
      throw Error("{}: no such view{}; the file has {}", option("view", view), suggestion(view, in_file),
                  enumerate(quoted));
    }
  if (asked.empty()) return in_file;
  std::vector<std::string> views;
  add_new(views, asked);
  return views;
}

/// A file that lists views but names none of them in its channels holds one picture. It shows the view that the user names, else
/// the first.
void apply_unnamed_view(std::vector<Entry>& entries, NamedPlanes& named, const std::vector<std::string>& multi_view,
                        const std::vector<std::string>& asked) {
  const bool unnamed = std::none_of(entries.begin(), entries.end(), [](const Entry& e) { return e.named; });
  if (!unnamed || multi_view.size() < 2 || entries.empty()) return;
  const std::string view = asked.size() == 1 ? asked.front() : multi_view.front();
  for (Entry& entry : entries) entry.view = view;
  named.view_is_assumed = asked.size() != 1;
  note(named, "",
       fmt::format("no channel names a view: all are taken for '{}'{}", view,
                   named.view_is_assumed
                       ? fmt::format(", the first that the file lists ({} says otherwise)", option("view"))
                       : ""));
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
      named.planes.push_back(source_of(kind.name, view, {nullptr, channels, own, DeclaredConvention::nothing, 1}));
      continue;
    }
    std::vector<Candidate> candidates = candidates_of(kind.name, layers);
    add_sums(candidates, kind.name, layers);
    if (kind.name == "color") add_unnamed_beauty(candidates, layers, "r,g,b");
    if (kind.name == "alpha") add_unnamed_beauty(candidates, layers, "a");
    const Candidate* best = best_of(candidates, prefix);
    if (!best) continue;
    if (!prefix) prefix = best->layer->prefix;
    if (const std::string tie = tie_in_words(kind.name, candidates, *best); !tie.empty()) note(named, kind.name, tie);
    if (best->rank == only_rgba)
      note(named, kind.name,
           fmt::format("{}: from '{}', the only RGBA layer whose name means no other plane", kind.name,
                       best->layer->path));
    if (best->said == DeclaredConvention::unsure_motion)
      note(named, kind.name,
           fmt::format("motion: '{}' taken as pixels, current to previous frame, y down", shown(*best)));
    named.planes.push_back(source_of(kind.name, view, *best));
  }
  add_stack_layers(named, layers, view);
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
  for (const auto& [plane, text] : options.channels) check_plane_name(plane, "plane");
  NamedPlanes named;
  std::vector<Entry> entries = entries_of(channels, multi_view);
  const std::vector<std::string> views = selected_views(views_of(entries, multi_view), options.views);
  apply_unnamed_view(entries, named, multi_view, options.views);
  std::set<std::string> overridden;
  for (const std::string& view : views) {
    const size_t before = named.planes.size();
    name_view(named, entries, view, options, overridden);
    // A view that is listed but has no planes, as in a reference rendered eye by eye, is not a view of this file.
    if (named.planes.size() > before || !options.views.empty()) named.views.push_back(view);
  }
  if (named.views.empty()) named.views.push_back(views.front());
  for (const auto& [plane, text] : options.channels)
    if (!overridden.contains(plane)) no_such_channel(entries, plane, text);
  return named;
}

void check_plane_name(const std::string& plane, const char* flag) {
  std::vector<std::string> names;
  for (const PlaneKind& kind : plane_kinds()) names.push_back(kind.name);
  if (std::find(names.begin(), names.end(), plane) != names.end()) return;
  throw UsageError("{}: no plane has this name{}; there are {}", option(flag, plane), suggestion(plane, names),
                   enumerate(names));
}

}  // namespace gloam
