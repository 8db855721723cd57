#include "exr/channel_sums.h"

#include <algorithm>

#include "base/lists.h"
#include "exr/channel_text.h"
#include "gloam/error.h"

namespace gloam {

namespace channel_names {
namespace {

/// The layers of a sum, in its order, and with a product its factor behind them.
struct LayerSum {
  std::vector<std::string> layers;
  bool has_factor = false;
};

LayerSum sum_of(const std::string& spelled) {
  const std::vector<std::string> halves = split(spelled, '*');
  LayerSum sum{split(halves.front(), '+'), halves.size() > 1};
  if (sum.has_factor) sum.layers.push_back(halves.back());
  return sum;
}

/// The layer of this name below a path: of one part, or of several with a layer each.
const Layer* layer_below(const std::vector<Layer>& layers, const std::string& prefix, const std::string& name) {
  const auto found = std::find_if(layers.begin(), layers.end(),
                                  [&](const Layer& layer) { return layer.name == name && layer.prefix == prefix; });
  return found == layers.end() ? nullptr : &*found;
}

/// The channels of all layers, one after another; empty if one is missing.
std::vector<const FileChannel*> channels_of_sum(const LayerSum& sum, const std::vector<Layer>& layers,
                                                const std::string& prefix, const std::string& components) {
  std::vector<const FileChannel*> all;
  for (const std::string& name : sum.layers) {
    const Layer* layer = layer_below(layers, prefix, name);
    const std::vector<const FileChannel*> channels =
        layer ? pick(*layer, components) : std::vector<const FileChannel*>();
    if (channels.empty()) return {};
    all.insert(all.end(), channels.begin(), channels.end());
  }
  return all;
}

}  // namespace

void add_sums(std::vector<Candidate>& candidates, const std::string& plane, const std::vector<Layer>& layers) {
  for (const Spelling& spelling : spellings_of(plane)) {
    if (spelling.layer.find('+') == std::string::npos) continue;
    const LayerSum sum = sum_of(spelling.layer);
    for (const Layer& first : layers) {
      if (first.name != sum.layers.front()) continue;
      const auto channels = channels_of_sum(sum, layers, first.prefix, spelling.components);
      const DeclaredConvention said =
          sum.has_factor ? DeclaredConvention::sum_times_last : DeclaredConvention::sum_of_layers;
      if (!channels.empty()) candidates.push_back({&first, channels, spelling.rank, said, 1});
    }
  }
}

}  // namespace channel_names

namespace {

constexpr size_t components_of_layer = 3;  // red, green and blue

/// Applies `change(value, other)` to each pixel.
template <typename Change>
void change_each(Channel& channel, const Channel& other, const Change& change) {
  const Layout& layout = channel.layout();
  for (int y = 0; y < layout.height; ++y)
    std::transform(channel.row(y), channel.row(y) + layout.width, other.row(y), channel.row(y), change);
}

/// "ViewLayer.Emit" of "ViewLayer.Emit.R"; a channel without a layer as it is.
std::string layer_of_channel(const std::string& channel) {
  const size_t dot = channel.rfind('.');
  return dot == std::string::npos ? channel : channel.substr(0, dot);
}

}  // namespace

bool is_sum(const PlaneSource& source) {
  return source.said == DeclaredConvention::sum_of_layers || source.said == DeclaredConvention::sum_times_last;
}

void add_up(const PlaneSource& source, Plane& plane) {
  if (!is_sum(source)) return;
  std::vector<Channel>& channels = plane.channels;
  const bool has_factor = source.said == DeclaredConvention::sum_times_last;
  const size_t end_of_sum = channels.size() - (has_factor ? components_of_layer : 0);
  for (size_t i = components_of_layer; i < end_of_sum; ++i)
    change_each(channels[i % components_of_layer], channels[i], std::plus<>());
  for (size_t i = end_of_sum; i < channels.size(); ++i)
    change_each(channels[i % components_of_layer], channels[i], std::multiplies<>());
  channels.resize(components_of_layer);
}

std::string layers_in_words(const PlaneSource& source) {
  std::vector<std::string> layers;
  for (const ChannelSource& channel : source.channels) add_new(layers, layer_of_channel(channel.name));
  if (!is_sum(source)) return fmt::format("{}", fmt::join(layers, " "));
  if (source.said == DeclaredConvention::sum_of_layers) return fmt::format("{}", fmt::join(layers, " + "));
  const std::string factor = layers.back();
  layers.pop_back();
  return fmt::format("({}) x {}", fmt::join(layers, " + "), factor);
}

}  // namespace gloam
