// The planes of one view on the device.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gloam/frame.h"
#include "run/device_impl.h"

namespace gloam {

/// One view's planes on the device. On a device that shares memory the host's own pages are used.
class Buffers {
 public:
  explicit Buffers(Device::Impl& device) : device_(device) {}

  void upload(const Plane& plane);
  /// One buffer with the layers one after another, each in the layout of any plane.
  void upload_stack(const std::string& name, const std::vector<const Plane*>& layers);
  void allocate(const std::string& name, const Layout& layout);
  /// Room for a stack that is computed. All of it holds what lies outside, as far as nothing is computed there.
  void allocate_stack(const std::string& name, const Layout& layout, size_t layers);

  std::vector<cl::Buffer>& of(const std::string& name) { return buffers_.at(name); }

  /// Takes a computed plane back to the host; it is no longer on the device then.
  Plane download(const std::string& name, const Layout& layout);
  /// Layers of a computed stack, as planes of their own.
  std::vector<Plane> download_stack(const std::string& name, const Layout& layout, size_t layers);
  /// Bits of what is wanted (shared/lanes/wanted.h), in a plane's memory.
  Channel download_bits(const std::string& name, const Layout& layout);
  /// How many pixels a list has (shared/lanes/pixel_list.h): the first number of the plane's memory.
  int length_of_list(const std::string& name);

 private:
  Device::Impl& device_;
  std::map<std::string, std::vector<Channel>> host_;  // outlives the buffers that use its pages
  std::map<std::string, std::vector<cl::Buffer>> buffers_;
};

}  // namespace gloam
