#include "score/stored_image.h"

#include <algorithm>
#include <cmath>

#include "base/lists.h"
#include "base/words.h"
#include "gloam/error.h"
#include "gloam/option.h"
#include "gloam/planes.h"
#include "image/png_values.h"

namespace gloam::score {
namespace {

constexpr size_t colours = 3;

std::string ending_of(const std::filesystem::path& file) { return lower(file.extension().string()); }

/// Number of values that count; a confidence beside red, green and blue does not.
size_t components_of(const std::string& effect) { return std::min(plane_kind(effect).components.size(), colours); }

/// Brings grey or colours to the number of values that an effect has. `most`: differences that are still grey.
void fit_components(Plane& plane, const ImageRequest& request, double most) {
  const size_t wanted = components_of(request.effect);
  plane.name = request.effect;
  if (plane.channels.size() > wanted && wanted == colours) plane.channels.resize(colours);
  const bool is_grey = plane.channels.size() == 1;
  while (is_grey && plane.channels.size() < wanted) plane.channels.push_back(plane.channels[0].clone());
  if (plane.channels.size() == wanted) return;
  const Layout& layout = plane.channels[0].layout();
  for (int y = 0; y < layout.height; ++y) {
    for (int x = 0; x < layout.width; ++x) {
      const float red = plane.channels[0].at(x, y);
      for (size_t c = 1; c < std::min(plane.channels.size(), colours); ++c) {
        const float other = plane.channels[c].at(x, y);
        if (std::abs(double(red) - double(other)) <= most || (!std::isfinite(red) && !std::isfinite(other))) continue;
        throw Error(
            "{}: is coloured, {:g} and {:g} at pixel ({}, {}), and {} is one value; store it as grey, or name a "
            "channel of an EXR ({})",
            request.file.string(), red, other, x, y, request.effect, channels_option(request.effect, "R"));
      }
    }
  }
  plane.channels.resize(wanted);
}

StoredImage read_png_image(const ImageRequest& request) {
  PngValues values =
      read_png_values(request.file, [&](const PngSize& size) { request.check(size.width, size.height, size.bytes); });
  if (request.views.size() > 1)
    throw Error("{}: is one image, and the frame has the views {}; name one file for each, such as NAME_{}.png",
                request.file.string(), enumerate(request.views), request.views.front());
  StoredImage stored;
  stored.width = values.channels[0].layout().width;
  stored.height = values.channels[0].layout().height;
  stored.largest = values.largest;
  Plane plane{request.effect, std::move(values.channels)};
  fit_components(plane, request, 0.01 * stored.largest);
  stored.image.emplace(request.views.front(), std::move(plane));
  return stored;
}

/// The plane of the file that holds the effect; its channels are chosen in `options` where their names do not tell.
std::string choose_plane(const ImageRequest& request, ReadOptions& options) {
  const FrameFile file(request.file, options);
  const std::vector<std::string> planes = file.common_planes();
  if (contains(planes, request.effect)) return request.effect;
  if (contains(planes, "color")) return "color";
  const std::vector<std::string> channels = file.all_channels();
  const auto base_of = [](const std::string& channel) { return channel.substr(channel.rfind('.') + 1); };
  std::vector<std::string> names;
  for (const std::string& channel : channels) add_new(names, base_of(channel));
  const auto luminance = std::find_if(names.begin(), names.end(), [](const auto& name) { return name == "Y"; });
  const std::string only = luminance != names.end() ? *luminance : names.size() == 1 ? names.front() : "";
  if (only.empty())
    throw Error("{}: has no plane '{}', no colours and no single channel; it has {}; {} names it",
                request.file.string(), request.effect, enumerate(channels), channels_option(request.effect, "CHANNEL"));
  // a plane of one value, whatever the effect: `fit_components` repeats it
  options.channels["ao"] = channels.size() == 1 ? channels.front() : only;
  return "ao";
}

StoredImage read_exr_image(const ImageRequest& request) {
  ReadOptions options = request.reading;
  options.as_stored = true;
  const std::string plane = choose_plane(request, options);
  FrameFile file(request.file, options);
  request.check(file.window().width(), file.window().height(), file.bytes_to_read({plane}));
  Frame frame = file.read({plane});
  StoredImage stored;
  stored.width = frame.width();
  stored.height = frame.height();
  const bool is_only = frame.views.size() == 1 && request.views.size() == 1;
  for (const std::string& name : request.views) {
    const auto found = std::find_if(frame.views.begin(), frame.views.end(),
                                    [&](const View& view) { return is_only || view.name == name; });
    if (found == frame.views.end())
      throw Error("{}: has no view '{}', which the frame has; it has {}", request.file.string(), name,
                  file.views().front().empty() ? "one without a name" : enumerate(file.views()));
    if (!found->planes.count(plane))
      throw Error("{}: '{}' cannot be used: {}", request.file.string(), plane, fmt::join(frame.assumed, "; "));
    Plane& image = stored.image.emplace(name, std::move(found->planes.at(plane))).first->second;
    fit_components(image, request, 0.01);
  }
  return stored;
}

}  // namespace

bool is_image_name(const std::filesystem::path& file) {
  const std::string ending = ending_of(file);
  return ending == ".exr" || ending == ".png";
}

StoredImage read_stored(const ImageRequest& request) {
  return ending_of(request.file) == ".png" ? read_png_image(request) : read_exr_image(request);
}

}  // namespace gloam::score
