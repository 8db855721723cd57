#include "exr/decode_planes.h"

#include <algorithm>

#include "exr/attributes.h"
#include "exr/channel_sums.h"
#include "exr/decode.h"
#include "exr/errors.h"
#include "exr/validation.h"
#include "gloam/planes.h"

namespace gloam {
namespace {

View view_of(const ExrFile& file, const FileCameras& cameras, const std::string& name) {
  View view;
  view.name = name;
  const auto camera = cameras.cameras.find(name);
  if (camera != cameras.cameras.end()) view.camera = camera->second;
  const Imf::Header& header = file.headers.of_view(name);
  std::optional<glm::dvec3> origin;
  if (!name.empty()) origin = origin_attribute(header, name + ".");
  if (!origin) origin = origin_attribute(header, "");
  view.origin = origin.value_or(glm::dvec3(0.0));
  view.light = light_attribute(header);
  return view;
}

void allocate(const ExrFile& file, const std::string& plane, const Layout& layout, View& view) {
  Plane& to = view.planes[plane];
  to.name = plane;
  if (const PlaneSource* from = file.source(plane, view.name))
    for (size_t i = 0; i < from->channels.size(); ++i) to.channels.emplace_back(layout);
  else
    to.channels.emplace_back(layout, plane_kind(plane).outside);
}

/// Calls `work(source, plane)` for each plane that the file has. `AnyFrame`: Frame, const or not.
template <typename AnyFrame, typename Work>
void for_each_plane(const ExrFile& file, AnyFrame& frame, const Work& work) {
  for (auto& view : frame.views)
    for (auto& [name, plane] : view.planes)
      if (const PlaneSource* from = file.source(name, view.name)) work(*from, plane);
}

/// Calls `work(source, channel, plane)` for each channel that the file has. Of layers that were added up, those of the first.
template <typename AnyFrame, typename Work>
void for_each_channel(const ExrFile& file, AnyFrame& frame, const Work& work) {
  for_each_plane(file, frame, [&](const PlaneSource& from, auto& plane) {
    const size_t channels = std::min(from.channels.size(), plane.channels.size());
    for (size_t i = 0; i < channels; ++i) work(from.channels[i], plane.channels[i], from);
  });
}

/// The channels to decode, by part.
std::map<int, PartDecoding> decodings_of(const ExrFile& file, Frame& frame) {
  std::map<int, PartDecoding> parts;
  for_each_channel(file, frame, [&](const ChannelSource& source, Channel& channel, const PlaneSource& plane) {
    Decoding& decoding = parts[source.part][source.name];
    decoding.targets.push_back(&channel);
    if (decoding.targets.size() == 1) decoding.outside = plane_kind(plane.plane).outside;
  });
  return parts;
}

void scale_image(Channel& channel, float scale) {
  for (int y = 0; y < channel.layout().height; ++y)
    for (float* p = channel.row(y); p != channel.row(y) + channel.layout().width; ++p) *p *= scale;
}

}  // namespace

Frame allocate_planes(const ExrFile& file, const FileCameras& cameras, const std::vector<std::string>& planes,
                      const Window& window) {
  return guarded(file.path, [&] {
    Frame frame;
    frame.display = file.display;
    frame.window = window;
    frame.pixel_aspect = file.pixel_aspect;
    const Layout layout(window.width(), window.height());
    for (const std::string& name : file.names.views) {
      View& view = frame.views.emplace_back(view_of(file, cameras, name));
      for (const std::string& plane : planes)
        if (file.has(plane, name)) allocate(file, plane, layout, view);
    }
    return frame;
  });
}

void decode_planes(const ExrFile& file, Frame& frame) {
  std::map<int, PartDecoding> parts = decodings_of(file, frame);
  for (auto& [part, decoding] : parts) {
    const Imf::Header& header = file.headers.of_part(part);
    named(file.path, [&, &decoding = decoding] { check_sampling(header, decoding); });
    check_plausible(file.path, header, file.stream->size());
    guarded(file.path, [&, part = part, &decoding = decoding] { decode_part(file, part, decoding, frame.window); });
  }
  for_each_channel(file, frame, [&](const ChannelSource& source, Channel& channel, const PlaneSource&) {
    if (source.scale != 1 && !file.options.unconverted) scale_image(channel, source.scale);
  });
  for_each_plane(file, frame, [](const PlaneSource& source, Plane& plane) { add_up(source, plane); });
}

void add_nonfinite(const ExrFile& file, const Frame& frame, NonfiniteCounts& counts) {
  for_each_channel(file, frame, [&](const ChannelSource& source, const Channel& channel, const PlaneSource& plane) {
    const Box data = box_of(file.headers.of_part(source.part).dataWindow());
    counts[{plane.plane, plane.view}] += count_nonfinite(channel, data, frame.window);
  });
}

}  // namespace gloam
