// Images as planes of a frame: which components they give, and what whole numbers stand for.
#pragma once

#include <string>
#include <vector>

#include "gloam/exr.h"
#include "image/image_values.h"

namespace gloam {

/// Channels with their names in an EXR file.
struct NamedChannel {
  std::string name;
  Channel channel;
};

/// What messages call an image: errors by its path, notes by its name.
struct ImageWords {
  std::string path, name;
};

/// The channels of a plane, from an image of it: as many as the plane has components, and alpha where a colour has it. Throws Error for an image of another number of components.
std::vector<NamedChannel> channels_of_plane(const std::string& plane, ImageValues image, const ImageWords& file,
                                            const ReadOptions& options, std::vector<std::string>& notes);

/// The channels of an array with a name, for a layer of that name; the array is used up.
std::vector<NamedChannel> channels_of_layer(ImageValues& image, const ImageWords& file, const ReadOptions& options,
                                            std::vector<std::string>& notes);

}  // namespace gloam
