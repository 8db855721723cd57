// Reads one channel of an EXR with OpenEXR itself, so that a test of one part of gloam needs no other part.
#pragma once

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>

#include <stdexcept>
#include <string>

#include "gloam/frame.h"

namespace gloam::test {

/// The channel as floats, over the data window; that of the captures is at (0, 0).
inline Channel read_channel(const std::string& path, const std::string& name) {
  Imf::InputFile file(path.c_str());
  if (!file.header().channels().findChannel(name)) throw std::runtime_error(path + " has no channel " + name);
  const Imath::Box2i box = file.header().dataWindow();
  Channel channel(Layout(box.max.x - box.min.x + 1, box.max.y - box.min.y + 1), 0.0f);
  const size_t pitch = size_t(channel.layout().pitch) * sizeof(float);
  char* base = reinterpret_cast<char*>(channel.row(0)) - box.min.x * long(sizeof(float)) - box.min.y * long(pitch);
  Imf::FrameBuffer buffer;
  buffer.insert(name, Imf::Slice(Imf::FLOAT, base, sizeof(float), pitch));
  file.setFrameBuffer(buffer);
  file.readPixels(box.min.y, box.max.y);
  return channel;
}

/// X, Y and Z of a layer ("ViewLayer.Normal").
inline Plane read_vector(const std::string& path, const std::string& layer, const std::string& plane) {
  Plane result{plane, {}};
  for (const char* component : {".X", ".Y", ".Z"}) result.channels.push_back(read_channel(path, layer + component));
  return result;
}

}  // namespace gloam::test
