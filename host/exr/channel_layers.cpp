#include "exr/channel_layers.h"

#include <algorithm>
#include <cstddef>

#include "base/words.h"
#include "exr/channel_text.h"

namespace gloam::channel_names {
namespace {

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
    // The longest name first: a view's name may have dots, and end with another view's name.
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

}  // namespace

std::vector<Entry> entries_of(const std::vector<FileChannel>& channels, const std::vector<std::string>& multi_view) {
  std::vector<Entry> entries;
  for (const FileChannel& channel : channels) entries.push_back(entry_of(channel, multi_view));
  return entries;
}

std::vector<std::string> views_of(const std::vector<Entry>& entries, const std::vector<std::string>& multi_view) {
  std::vector<std::string> views = multi_view;
  for (const Entry& entry : entries)
    if (!entry.view.empty() && std::find(views.begin(), views.end(), entry.view) == views.end())
      views.push_back(entry.view);
  if (views.empty()) views.push_back("");
  return views;
}

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

}  // namespace gloam::channel_names
