#include "exr/write.h"

#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfOutputFile.h>

#include "base/lists.h"
#include "exr/cryptomatte.h"
#include "exr/stream.h"
#include "exr/written_channels.h"
#include "exr/written_header.h"
#include "gloam/error.h"

namespace gloam {
namespace {

/// Throws Error for frames that OpenEXR would write but no reader would understand.
void check_frame(const Frame& frame) {
  if (frame.views.empty()) throw Error("the frame has no view");
  if (frame.width() <= 0 || frame.height() <= 0) throw Error("the frame is empty");
  const Layout layout(frame.width(), frame.height());
  for (const View& view : frame.views) {
    if (view.name.empty() && frame.views.size() > 1) throw Error("a frame of several views has a view without a name");
    for (const auto& [name, plane] : view.planes)
      for (const Channel& channel : plane.channels)
        if (channel.layout() != layout)
          throw Error("plane '{}' is {} x {}, and the frame is {} x {}", name, channel.layout().width,
                      channel.layout().height, layout.width, layout.height);
  }
}

/// Attributes that tell how the pixels of a part are stored, or which part it is. Those of a Cryptomatte tell of channels that a copy lacks.
const std::vector<std::string> of_storage = {
    "tiles",   "type",      "name", "chunkCount",          "version",
    "preview", "multiView", "view", "dwaCompressionLevel", "maxSamplesPerPixel"};

void take_attributes(const Imf::Header& from, Imf::Header& to) {
  for (auto attribute = from.begin(); attribute != from.end(); ++attribute) {
    const std::string name = attribute.name();
    const bool is_default = name.starts_with("screenWindow");
    if (contains(of_storage, name) || is_of_cryptomatte(name) || (to.find(name) != to.end() && !is_default)) continue;
    to.insert(name, attribute.attribute());
  }
}

}  // namespace

void write_exr(NewFile& new_file, const std::string& name, const Frame& frame, const WriteOptions& options,
               const Imf::Header* like) {
  check_frame(frame);
  const std::vector<WrittenChannel> channels = written_channels(frame, options);
  if (channels.empty()) throw Error("the frame has no plane");
  ChannelCopies copies;
  Imf::FrameBuffer buffer;
  for (const WrittenChannel& channel : channels) buffer.insert(channel.name, slice_for(copies, channel, frame.window));
  ExrOutput stream(new_file.descriptor(), name);
  {
    Imf::Header header = header_of(frame, channels, options);
    if (like) take_attributes(*like, header);
    Imf::OutputFile file(stream, header);
    file.setFrameBuffer(buffer);
    file.writePixels(written_window(frame, options).height());
  }
  stream.finish();
}

}  // namespace gloam
