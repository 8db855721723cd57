#include "cli/info/light.h"

#include "base/lists.h"
#include "exr/channel_sums.h"
#include "frame/untouched.h"
#include "gloam/error.h"

namespace gloam::cli {
namespace {

/// "emission (ViewLayer.Emit)"
std::string plane_with_layers(const FrameFile& file, const std::string& plane) {
  for (const PlaneSource& source : file.planes())
    if (source.plane == plane) return called_in_file(plane, {{plane, layers_in_words(source)}});
  return plane;
}

}  // namespace

std::vector<std::string> light_in_words(const FrameFile& file) {
  const std::vector<std::string> planes = file.common_planes();
  std::vector<std::string> called, lines;
  for (const std::string& plane : untouched_of(planes)) called.push_back(plane_with_layers(file, plane));
  if (!called.empty())
    lines.push_back(
        fmt::format("light  {}: part of the colour that occlusion does not darken in a composite", enumerate(called)));
  if (has_illumination(planes))
    lines.push_back(fmt::format("light  {} times {}: the part of the colour that occlusion darkens in a composite",
                                plane_with_layers(file, "illumination"), plane_with_layers(file, "albedo")));
  return lines;
}

std::vector<std::string> lines_on(const std::vector<Cryptomatte>& cryptomattes) {
  std::vector<std::string> lines;
  for (const Cryptomatte& each : cryptomattes)
    lines.push_back(fmt::format("Cryptomatte {}: {}", each.name,
                                each.channels.empty() ? "its channels are missing, and the header alone names it"
                                : each.is_whole
                                    ? fmt::format("{} channels, which --into copies as they are", each.channels.size())
                                    : "its IDs are lost, as its channels are no 32-bit floats"));
  return lines;
}

std::vector<std::string> names_of(const std::vector<Cryptomatte>& cryptomattes) {
  std::vector<std::string> names;
  for (const Cryptomatte& each : cryptomattes) names.push_back(each.name);
  return names;
}

std::vector<std::string> without_channels_of(const std::vector<Cryptomatte>& cryptomattes,
                                             std::vector<std::string> channels) {
  for (const Cryptomatte& each : cryptomattes)
    std::erase_if(channels, [&](const std::string& channel) { return contains(each.channels, channel); });
  return channels;
}

}  // namespace gloam::cli
