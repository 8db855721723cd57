#include "exr/write.h"

#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfOutputFile.h>

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

}  // namespace

void write_exr(NewFile& new_file, const std::string& name, const Frame& frame, const WriteOptions& options) {
  check_frame(frame);
  const std::vector<WrittenChannel> channels = written_channels(frame, options);
  if (channels.empty()) throw Error("the frame has no plane");
  ChannelCopies copies;
  Imf::FrameBuffer buffer;
  for (const WrittenChannel& channel : channels) buffer.insert(channel.name, slice_for(copies, channel, frame.window));
  ExrOutput stream(new_file.descriptor(), name);
  {
    Imf::OutputFile file(stream, header_of(frame, channels, options));
    file.setFrameBuffer(buffer);
    file.writePixels(frame.height());
  }
  stream.finish();
}

}  // namespace gloam
