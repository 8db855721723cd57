#include "exr/channel_candidates.h"

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

#include "exr/channel_text.h"
#include "gloam/error.h"
#include "gloam/option.h"

namespace gloam::channel_names {
namespace {

/// Rank of a spelling for a layer; none if it does not fit.
std::optional<int> fit(const Spelling& spelling, const Layer& layer) {
  const std::string_view wanted = spelling.layer;
  const int shared = layer.shared ? 100 : 0;  // a view's own channels come before shared ones
  if (wanted == "*") {
    if (layer.path.empty()) return spelling.rank + shared;
    return is_other_data(layer.name) ? std::nullopt : std::optional(10 + spelling.rank + shared);
  }
  if (wanted == "") {
    if (!layer.path.empty() || is_other_data(layer.name)) return {};
    return spelling.rank + shared;  // candidates_of takes the part's name into account
  }
  if (layer.name != wanted) return {};
  return spelling.rank + shared;
}

/// Channels whose plane the part's name tells, with that plane: in a part named "albedo" a plain R G B is the albedo, not the
/// finished picture.
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

}  // namespace

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

std::vector<Candidate> candidates_of(const std::string& plane, const std::vector<Layer>& layers) {
  std::vector<Candidate> candidates;
  for (const Layer& layer : layers) {
    const auto claimed = claimed_by_part_name(layer);
    for (const Spelling& spelling : spellings_of(plane)) {
      const std::optional<int> rank = fit(spelling, layer);
      if (!rank) continue;
      const std::string_view wanted = spelling.layer;
      if (wanted == "*" && spelling.rank == last_resort && layer.components.size() > 1) continue;  // "st.t": no depth
      auto channels = pick(layer, spelling.components);
      if (channels.empty() || (wanted.empty() && claimed_by_other(claimed, channels, plane))) continue;
      // A part with a strange name, "diffuse_direct", comes after one named "beauty".
      const int strange = wanted.empty() && !layer.name.empty() && claimed.empty() ? 5 : 0;
      candidates.push_back({&layer, channels, *rank + strange, spelling.said, spelling.y_scale});
    }
  }
  return candidates;
}

void add_unnamed_beauty(std::vector<Candidate>& candidates, const std::vector<Layer>& layers, const char* components) {
  std::vector<Candidate> found;
  for (const Layer& layer : layers) {
    const bool known = std::any_of(spellings().begin(), spellings().end(),
                                   [&](const Spelling& spelling) { return layer.name == spelling.layer; });
    if (known || layer.path.empty() || !layer.prefix.empty() || is_other_data(layer.name)) continue;
    if (layer.components.size() != 4 || pick(layer, "r,g,b,a").empty()) continue;
    found.push_back({&layer, pick(layer, components), only_rgba, DeclaredConvention::nothing, 1});
  }
  if (found.size() == 1) candidates.push_back(found.front());
}

const Candidate* best_of(const std::vector<Candidate>& candidates, const std::optional<std::string>& prefix) {
  auto key = [&](const Candidate& c) { return std::pair(c.rank, prefix && c.layer->prefix != *prefix); };
  const Candidate* best = nullptr;
  for (const Candidate& candidate : candidates)
    if (!best || key(candidate) < key(*best)) best = &candidate;
  return best;
}

std::string shown(const Candidate& candidate) {
  const std::string& name = candidate.channels.front()->name;
  if (candidate.channels.size() == 1) return name;
  const size_t dot = name.rfind('.');
  return dot == std::string::npos ? name : name.substr(0, dot);
}

std::string tie_in_words(const std::string& plane, const std::vector<Candidate>& candidates, const Candidate& best) {
  for (const Candidate& other : candidates)
    if (other.rank == best.rank && other.layer != best.layer && other.channels != best.channels) {
      std::string taken = fmt::format("'{}'", shown(best)), left = fmt::format("'{}'", shown(other));
      std::string name = shown(other);  // the name of the other for --plane
      if (taken == left) {
        const FileChannel& channel = *other.channels.front();
        const std::string part = channel.part_name.empty() ? std::to_string(channel.part) : channel.part_name;
        const bool is_whole = other.layer->path.empty();
        name = is_whole && !channel.part_name.empty() ? part : part + ":" + (is_whole ? names_of(other) : name);
        taken += " of " + part_of(best);
        left += " of " + part_of(other);
      }
      const std::string chooses = name.empty() ? "" : fmt::format(" ({} chooses)", channels_option(plane, name));
      return fmt::format("{}: {} taken, not {}{}", plane, taken, left, chooses);
    }
  return "";
}

}  // namespace gloam::channel_names
