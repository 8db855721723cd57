#include "exr/image_planes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/lists.h"
#include "base/srgb.h"
#include "exr/channel_spellings.h"
#include "exr/channel_text.h"
#include "frame/untouched.h"
#include "gloam/error.h"
#include "gloam/option.h"
#include "gloam/planes.h"
#include "normalise/each_row.h"
#include "normalise/stored_depth.h"

namespace gloam {
namespace {

template <typename Function>
void for_each_value(Channel& channel, const Function& function) {
  for_each_row(channel.layout(), [&](int y) {
    float* row = channel.row(y);
    for (int x = 0; x < channel.layout().width; ++x) row[x] = function(row[x]);
  });
}

void divide(Channel& channel, double by) {
  for_each_value(channel, [by](float value) { return float(double(value) / by); });
}

bool is_equal(const Channel& a, const Channel& b) {
  for (int y = 0; y < a.layout().height; ++y)
    if (!std::equal(a.row(y), a.row(y) + a.layout().width, b.row(y))) return false;
  return true;
}

/// Planes that are light, whose whole numbers are those of pictures.
bool is_light(const std::string& plane) {
  return plane == "color" || plane == "ambient" || contains(planes_of_darkened_light(), plane);
}

/// How many neighbours lie far apart, of values of 8 bits.
long long jumps_of(const Channel& channel) {
  constexpr float far_apart = 32;
  long long jumps = 0;
  const int width = channel.layout().width, height = channel.layout().height;
  for (int y = 0; y < height; ++y) {
    const float *row = channel.row(y), *next = channel.row(std::min(y + 1, height - 1));
    for (int x = 0; x < width; ++x) {
      jumps += std::abs(row[std::min(x + 1, width - 1)] - row[x]) >= far_apart;
      jumps += std::abs(next[x] - row[x]) >= far_apart;
    }
  }
  return jumps;
}

/// Whether red is the lowest byte: it wraps from pixel to pixel as noise does, and the highest hardly changes. Throws Error for a picture,
/// which has no such components.
bool has_red_lowest(const ImageValues& image, const ImageWords& file) {
  constexpr long long least_ratio = 3, fewest = 64;
  const long long red = jumps_of(image.channels[0]), blue = jumps_of(image.channels[2]);
  if (std::max(red, blue) >= fewest && std::max(red, blue) >= least_ratio * std::min(red, blue)) return red >= blue;
  throw Error(
      "{}: has three components that vary alike, as a picture's do, and depth of 24 bits has one byte that hardly "
      "varies; name a file of depth, or say {} or high-first",
      file.path, option("depth-bytes", "low-first"));
}

/// Depth in three bytes of 8 bits, as a share of 2^24 - 1.
Channel packed_depth(const ImageValues& image, const ImageWords& file, const ReadOptions& options,
                     std::vector<std::string>& notes) {
  const Channel &red = image.channels[0], &green = image.channels[1], &blue = image.channels[2];
  const bool is_stated = options.depth_bytes != DepthBytes::automatic;
  const bool is_red_lowest = is_stated ? options.depth_bytes == DepthBytes::low_first : has_red_lowest(image, file);
  const Channel &low = is_red_lowest ? red : blue, &high = is_red_lowest ? blue : red;
  constexpr double most = (1 << 24) - 1;
  Channel depth(image.layout(), 0.0f);
  for_each_row(depth.layout(), [&](int y) {
    for (int x = 0; x < depth.layout().width; ++x)
      depth.row(y)[x] =
          float((double(low.row(y)[x]) + 256 * double(green.row(y)[x]) + 65536 * double(high.row(y)[x])) / most);
  });
  notes.push_back(fmt::format(
      "depth: {} holds 24 bits in three bytes, {} the lowest, taken as a share of 2^24 - 1{}; {}", file.name,
      is_red_lowest ? "red" : "blue",
      options.depth_scale ? "" : fmt::format("; {} gives lengths in metres of CARLA's", option("depth-scale", "1000")),
      is_stated ? "as stated" : option("depth-bytes", is_red_lowest ? "high-first" : "low-first") + " says otherwise"));
  return depth;
}

std::string note_on_bytes() {
  return fmt::format("depth: {} has no effect: depth is no picture of three bytes", option("depth-bytes"));
}

/// What whole numbers of a depth range from and to.
std::pair<float, float> extent(const Channel& channel) {
  float least = infinity, most = -infinity;
  for (int y = 0; y < channel.layout().height; ++y) {
    const auto [low, high] = std::minmax_element(channel.row(y), channel.row(y) + channel.layout().width);
    least = std::min(least, *low), most = std::max(most, *high);
  }
  return {least, most};
}

/// The largest whole number in a share of the pixels is what lies beyond the range: a sky.
void mark_largest(Channel& depth, double largest, const ImageWords& file, const ReadOptions& options,
                  std::vector<std::string>& notes) {
  if (options.background || options.depth == DepthConvention::inverse || options.depth_scale.value_or(1) < 0) return;
  if (const double share = mark_share(depth, float(largest)); share > 0)
    notes.push_back(fmt::format(
        "depth: {:.1f} % of the pixels of {} are {:g}, the largest value, and taken as background; {} says otherwise",
        100 * share, file.name, largest, option("background")));
}

Channel depth_of(ImageValues image, const ImageWords& file, const ReadOptions& options,
                 std::vector<std::string>& notes) {
  std::vector<Channel>& channels = image.channels;
  const bool is_grey =
      channels.size() < 3 || (is_equal(channels[0], channels[1]) && is_equal(channels[0], channels[2]));
  if (!is_grey && image.type != "uint8")
    throw Error("{}: has {} components, and depth has one; name a file of one, or of three bytes of 8 bits", file.path,
                channels.size());
  if (!is_grey) {
    Channel packed = packed_depth(image, file, options, notes);
    if (!is_window_depth(options.depth)) mark_largest(packed, 1, file, options, notes);
    return packed;
  }
  Channel depth = std::move(channels.front());
  if (options.depth_bytes != DepthBytes::automatic) notes.push_back(note_on_bytes());
  if (image.largest == 0) return depth;
  if (is_window_depth(options.depth)) {
    divide(depth, image.largest);
    return depth;
  }
  const auto [least, most] = extent(depth);
  mark_largest(depth, image.largest, file, options, notes);
  notes.push_back(fmt::format(
      "depth: {} holds whole numbers of {} bits, {:g} to {:g}{}{}", file.name, image.largest > 255 ? 16 : 8, least,
      most,
      options.depth_scale || options.depth_offset || options.depth == DepthConvention::inverse
          ? ""
          : fmt::format(", taken for scene units; {} makes metres of millimetres", option("depth-scale", "0.001")),
      image.largest > 255 ? "" : ": 256 steps are too few for smooth surfaces; store 16 bits, or floats"));
  return depth;
}

void decode_light(const std::string& plane, const ImageWords& file, ImageValues& image, size_t colours,
                  std::vector<std::string>& notes) {
  for (size_t c = 0; c < std::min(colours, image.channels.size()); ++c)
    for_each_value(image.channels[c],
                   [&](float value) { return float(linear_of_srgb(double(value) / image.largest)); });
  notes.push_back(
      fmt::format("{}: {} holds whole numbers, decoded from sRGB; light above 1 is missing", plane, file.name));
}

/// Brings whole numbers to the range of the plane.
void decode_whole_numbers(const std::string& plane, const ImageWords& file, ImageValues& image,
                          std::vector<std::string>& notes) {
  if (image.largest == 0) return;
  const PlaneKind kind = plane_kind(plane);
  if (is_light(plane)) {
    const bool has_alpha = image.channels.size() == 2 || image.channels.size() == 4;
    decode_light(plane, file, image, image.channels.size() - has_alpha, notes);
    if (has_alpha) divide(image.channels.back(), image.largest);
  } else if (kind.meaning == PlaneKind::unit_interval || kind.meaning == PlaneKind::unit_vector) {
    for (Channel& channel : image.channels) divide(channel, image.largest);
  }
}

/// An array's name as one of channels: what stands in no channel's name is replaced.
std::string layer_named(std::string name) {
  constexpr size_t longest = 200;
  for (char& c : name) {
    const bool is_usual =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '-';
    if (!is_usual) c = c == '/' ? '.' : '_';
  }
  return name.empty() ? "array" : name.substr(0, longest);
}

/// The plane whose spellings have this name.
std::string plane_of_array(const std::string& name) {
  const std::string wanted = channel_names::canonical(name);
  for (const channel_names::Spelling& spelling : channel_names::spellings())
    if (spelling.layer == wanted) return spelling.plane;
  return "";
}

}  // namespace

std::vector<NamedChannel> channels_of_plane(const std::string& plane, ImageValues image, const ImageWords& file,
                                            const ReadOptions& options, std::vector<std::string>& notes) {
  const PlaneKind kind = plane_kind(plane);
  std::vector<NamedChannel> named;
  if (plane == "depth") {
    named.push_back({kind.channels.front(), depth_of(std::move(image), file, options, notes)});
    return named;
  }
  const size_t wanted = kind.channels.size(), there = image.channels.size();
  decode_whole_numbers(plane, file, image, notes);
  const bool is_light_of_grey = is_light(plane) && there <= 2;
  if (there < wanted && !is_light_of_grey)
    throw Error("{}: has {} component{}, and {} has {}", file.path, there, there == 1 ? "" : "s", plane, wanted);
  for (size_t c = 0; c < wanted; ++c)
    named.push_back({kind.channels[c], image.channels[is_light_of_grey ? 0 : c].clone()});
  if (plane == "color" && (there == 2 || there == 4) && !options.plane_files.contains("alpha"))
    named.push_back({plane_kind("alpha").channels.front(), std::move(image.channels.back())});
  return named;
}

std::vector<NamedChannel> channels_of_layer(ImageValues& image, const ImageWords& file, const ReadOptions& options,
                                            std::vector<std::string>& notes) {
  static const std::array<std::vector<std::string>, 4> components = {
      std::vector<std::string>{"V"}, {"X", "Y"}, {"R", "G", "B"}, {"R", "G", "B", "A"}};
  const std::string layer = layer_named(image.name);
  const std::string plane = plane_of_array(layer.substr(layer.rfind('.') + 1));
  const std::string array = fmt::format(" '{}'", printable(image.name));
  const ImageWords what = {file.path + array, file.name + array};
  std::vector<NamedChannel> named;
  if (plane == "depth") {
    named.push_back({layer + ".V", depth_of(std::move(image), what, options, notes)});
    return named;
  }
  if (!plane.empty()) decode_whole_numbers(plane, what, image, notes);
  const std::vector<std::string>& names = components[image.channels.size() - 1];
  for (size_t c = 0; c < image.channels.size(); ++c)
    named.push_back({layer + "." + names[c], std::move(image.channels[c])});
  return named;
}

}  // namespace gloam
