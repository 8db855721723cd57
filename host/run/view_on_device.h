// A view whose planes are on the device, and the passes that run on it.
#pragma once

#include <CL/opencl.hpp>
#include <set>
#include <string>
#include <vector>

#include "gloam/run.h"
#include "plan/layouts.h"
#include "run/buffers.h"

namespace gloam {

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

/// Uploads a view's inputs, and allocates the planes that are computed.
ViewOnDevice view_on_device(const Plan& plan, const Frame& frame, const View& view, Device::Impl& device);

/// Moves the outputs of the view, computed or inputs, to `out`. A plane that came with the view, and that no pass makes here, is
/// not a result.
void download(const Plan& plan, ViewOnDevice& on_device, View& out);

}  // namespace gloam
