// The planes of one view on the device.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gloam/frame.h"
#include "run/device_impl.h"

namespace gloam {

/// The planes of one view on the device. A device that shares memory uses the host's own pages.
class Buffers {
 public:
  explicit Buffers(Device::Impl& device) : device_(device) {}

  void upload(const Plane& plane);
  /// One buffer with the layers one after another, each laid out like a plane.
  void upload_stack(const std::string& name, const std::vector<const Plane*>& layers);
  void allocate(const std::string& name, const Layout& layout);
  /// Allocates a stack that is computed, filled with the value outside the image, which stays where nothing is computed.
  void allocate_stack(const std::string& name, const Layout& layout, size_t layers);

  /// Lays a plane, which is never moved to the host, into the memory of an allocated one that no pass reads any more when it is written.
  void share(const std::string& name, const std::string& memory) { buffers_[name] = buffers_.at(memory); }

  std::vector<cl::Buffer>& of(const std::string& name) { return buffers_.at(name); }

  /// Moves a computed plane back to the host.
  Plane download(const std::string& name, const Layout& layout);
  /// Layers of a computed stack, as planes of their own.
  std::vector<Plane> download_stack(const std::string& name, const Layout& layout, size_t layers);
  /// Bits of the wanted pixels (shared/lanes/wanted.h), in a plane's memory.
  Channel download_bits(const std::string& name, const Layout& layout);
  /// Number of pixels on a list (shared/lanes/pixel_list.h): the first number of the plane's memory.
  int length_of_list(const std::string& name);

 private:
  Device::Impl& device_;
  std::map<std::string, std::vector<Channel>> host_;  // outlives the buffers that use its pages
  std::map<std::string, std::vector<cl::Buffer>> buffers_;
};

}  // namespace gloam
