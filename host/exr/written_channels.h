// The channels of a frame in an EXR file.
#pragma once

#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfPixelType.h>

#include <cstdint>
#include <glm/vec3.hpp>
#include <list>
#include <string>
#include <vector>

#include "gloam/exr.h"
#include "gloam/frame.h"

namespace gloam {

/// A channel on its way into the file: straight from the frame, or from a copy in another type.
struct WrittenChannel {
  std::string name;
  Imf::PixelType type;
  const Channel* channel;
  double shift = 0;  ///< added to each value: positions become relative to the written origin
};

/// The result that programs show which know no channel of gloam's: it is written as luminance, Y, too. Null where the view has colour,
/// or no result of one value.
const Plane* shown_plane(const View& view);

/// gloam's channel names, in OpenEXR's multi-view form, and Y where asked for.
std::vector<WrittenChannel> written_channels(const Frame& frame, const WriteOptions& options);

/// Those of one view, without its name. `shift`: added to positions.
std::vector<WrittenChannel> channels_of_view(const View& view, const glm::dvec3& shift, const WriteOptions& options);

/// Copies of channels; they must live until the file is written.
using ChannelCopies = std::list<std::vector<uint32_t>>;

/// The place of a channel's values in memory, which cover `window`, for OpenEXR, which takes those of the data window; converted into `copies` if their type differs.
Imf::Slice slice_for(ChannelCopies& copies, const WrittenChannel& written, const Window& window);

}  // namespace gloam
