#include "exr/written_channels.h"

#include <Imath/half.h>

#include <algorithm>
#include <cmath>

#include "base/lists.h"
#include "camera/matrices.h"
#include "gloam/error.h"
#include "gloam/planes.h"

namespace gloam {
namespace {

/// OpenEXR's multi-view form: "right.Z", "N.right.X"; the first view is the default view and needs no name.
std::string channel_name(const std::string& channel, const std::string& view, bool first) {
  if (first || view.empty()) return channel;
  const size_t dot = channel.rfind('.');
  return dot == std::string::npos ? view + "." + channel : channel.substr(0, dot) + "." + view + channel.substr(dot);
}

Imf::PixelType type_of(const PlaneKind& kind, const WriteOptions& options) {
  if (kind.name == "instance") return Imf::UINT;
  if (contains(options.half_planes, kind.name)) return Imf::HALF;
  return options.half && kind.meaning == PlaneKind::unit_interval ? Imf::HALF : Imf::FLOAT;
}

/// The point that a view's positions and matrices are written relative to: the camera's position, so that matrices in float keep
/// their digits.
glm::dvec3 written_origin(const View& view, const Window& display) {
  return view.camera ? matrices_of(*view.camera, display).origin : view.origin;
}

Imf::Slice slice_of(Imf::PixelType type, const void* first, const Window& window, size_t pitch) {
  const size_t bytes = type == Imf::HALF ? 2 : 4;
  return Imf::Slice::Make(type, first, Imath::V2i(window.x0, window.y0), window.width(), window.height(), bytes,
                          bytes * pitch);
}

/// A copy of a channel without padding, with each value converted.
template <typename To, typename Convert>
Imf::Slice converted(ChannelCopies& copies, const WrittenChannel& written, const Window& window, Convert convert) {
  const size_t width = size_t(window.width()), height = size_t(window.height());
  std::vector<uint32_t>& memory = copies.emplace_back((width * height * sizeof(To) + 3) / 4);
  To* to = reinterpret_cast<To*>(memory.data());
  for (size_t y = 0; y < height; ++y)
    for (size_t x = 0; x < width; ++x) *to++ = convert(written.channel->row(int(y))[x]);
  return slice_of(written.type, memory.data(), window, width);
}

uint32_t to_identity(float value) {
  return std::isfinite(value) && value > 0 ? uint32_t(std::min(value, 4294967040.0f)) : 0u;
}

}  // namespace

std::vector<WrittenChannel> channels_of_view(const View& view, const glm::dvec3& shift, const WriteOptions& options) {
  std::vector<WrittenChannel> channels;
  for (const auto& [name, plane] : view.planes) {
    const PlaneKind kind = plane_kind(name);
    for (size_t i = 0; i < plane.channels.size(); ++i) {
      const std::string own = i < kind.channels.size() ? kind.channels[i] : fmt::format("{}.{}", name, i);
      channels.push_back(
          {own, type_of(kind, options), &plane.channels[i], name == "position" && i < 3 ? shift[int(i)] : 0.0});
    }
  }
  return channels;
}

const Plane* shown_plane(const View& view) {
  static const std::vector<std::string> results = {"ao", "ao_raw", "specular_occlusion", "contact", "mask"};
  if (view.find("color")) return nullptr;
  for (const std::string& name : results)
    if (const Plane* plane = view.find(name)) return plane;
  return nullptr;
}

std::vector<WrittenChannel> written_channels(const Frame& frame, const WriteOptions& options) {
  std::vector<WrittenChannel> channels;
  for (const View& view : frame.views) {
    const bool first = &view == &frame.views.front();
    const glm::dvec3 shift = view.origin - written_origin(view, frame.display);
    for (WrittenChannel& channel : channels_of_view(view, shift, options)) {
      channel.name = channel_name(channel.name, view.name, first);
      channels.push_back(std::move(channel));
    }
    if (const Plane* plane = options.shows_result ? shown_plane(view) : nullptr)
      channels.push_back(
          {channel_name("Y", view.name, first), type_of(plane_kind(plane->name), options), &plane->channels.front()});
  }
  return channels;
}

Imf::Slice slice_for(ChannelCopies& copies, const WrittenChannel& written, const Window& window) {
  if (written.type == Imf::UINT) return converted<uint32_t>(copies, written, window, to_identity);
  if (written.type == Imf::HALF) return converted<half>(copies, written, window, [](float v) { return half(v); });
  if (written.shift != 0)
    return converted<float>(copies, written, window, [&](float v) { return float(double(v) + written.shift); });
  return slice_of(Imf::FLOAT, written.channel->row(0), window, size_t(written.channel->layout().pitch));
}

}  // namespace gloam
