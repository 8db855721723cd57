#include "exr/channel_choice.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "base/words.h"
#include "exr/channel_candidates.h"
#include "exr/channel_text.h"
#include "gloam/error.h"
#include "gloam/option.h"

namespace gloam::channel_names {
namespace {

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

}  // namespace

void check_plane_name(const std::string& plane) {
  std::vector<std::string> names;
  for (const PlaneKind& kind : plane_kinds()) names.push_back(kind.name);
  if (std::find(names.begin(), names.end(), plane) != names.end()) return;
  throw UsageError("{}: no plane has this name{}; there are {}", option("plane", plane), suggestion(plane, names),
                   enumerate(names));
}

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

}  // namespace gloam::channel_names
