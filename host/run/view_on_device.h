// A view whose planes are on the device, and the passes that run on it.
#pragma once

#include <CL/opencl.hpp>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "gloam/frame.h"
#include "gloam/run.h"
#include "plan/layouts.h"
#include "run/device_impl.h"

namespace gloam {

/// The planes of one view on the device. With `in_host_pages` planes have the host's own pages, which a device that shares memory uses in
/// place; else memory of the device's pool, to which it goes back.
class Buffers {
 public:
  Buffers(Device::Impl& device, bool in_host_pages) : device_(device), in_host_pages_(in_host_pages) {}
  Buffers(Buffers&&) = default;
  ~Buffers();

  /// The plane has to live until the queue's commands have ended.
  void upload(const Plane& plane);
  /// One buffer with the layers one after another, each laid out like a plane.
  void upload_stack(const std::string& name, const std::vector<const Plane*>& layers);
  void allocate(const std::string& name, const Layout& layout, bool is_list = false);
  /// Allocates a stack that is computed, filled with the value outside the image, which stays where nothing is computed.
  void allocate_stack(const std::string& name, size_t bytes);

  /// A plane in memory of the caller's.
  void adopt(const std::string& name, std::vector<cl::Buffer> buffers) { buffers_[name] = std::move(buffers); }

  bool has(const std::string& name) const { return buffers_.contains(name); }
  /// Of all that was allocated.
  unsigned long long bytes() const { return bytes_; }

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
  struct FromPool {
    cl::Buffer buffer;
    size_t bytes;
    float content;
  };
  BufferPool::Taken take(size_t bytes, float content);

  Device::Impl& device_;
  bool in_host_pages_;
  std::vector<FromPool> from_pool_;
  unsigned long long bytes_ = 0;
  std::map<std::string, std::vector<Channel>> host_;  // outlives the buffers that use its pages
  std::map<std::string, std::vector<cl::Buffer>> buffers_;
};

/// One view: its image, and its planes on the device.
struct ViewOnDevice {
  const Frame& frame;
  const View& view;
  Layout layout;
  Layouts layouts;
  Buffers buffers;
  bool is_key_view = true;               // whether others read it, or it reads others
  std::set<std::string> planes = {};     // available planes: inputs, and results of passes
  std::vector<cl::Kernel> kernels = {};  // kernels of the passes that run here
  std::vector<cl::Buffer> numbers = {};  // projections and tables that they read
  std::vector<size_t> passes = {};       // numbers of these passes
  std::vector<PassTime> times = {};      // times of these passes
};

/// The views that a view's passes may read; null if there is none.
struct OtherViews {
  ViewOnDevice* other = nullptr;                    // the other one of two
  ViewOnDevice *nearest = nullptr, *far = nullptr;  // key views
  double share_of_far = 0;                          // weight of `far` where both show a point
  /// The view of a binding's plane; null: the view itself.
  ViewOnDevice* of(const Binding& binding) const {
    if (binding.from == From::other_view) return other;
    if (binding.from == From::nearest_key_view) return nearest;
    return binding.from == From::further_key_view ? far : nullptr;
  }
};

/// Uploads a view's inputs that are not among `uploads`, and allocates the planes that are computed.
ViewOnDevice view_on_device(const Plan& plan, const Frame& frame, const View& view, Device::Impl& device,
                            Uploads* uploads = nullptr);

/// Allocates the planes that are computed and have no memory yet.
void allocate_computed(const Plan& plan, ViewOnDevice& target);

/// Moves the outputs of the view, computed or inputs, to `out`. A plane that came with the view, and that no pass makes here, is
/// not a result.
void download(const Plan& plan, ViewOnDevice& on_device, View& out);

}  // namespace gloam
