// A view whose planes are on the device, and the passes that run on it.
#pragma once

#include <CL/opencl.hpp>
#include <set>
#include <string>
#include <vector>

#include "gloam/run.h"
#include "run/buffers.h"
#include "plan/layouts.h"

namespace gloam {

/// One view: its image, and its planes on the device.
struct ViewOnDevice {
  const Frame& frame;
  const View& view;
  Layout layout;
  Layouts layouts;
  Buffers buffers;
  bool is_key_view = true;               // whether others look into it, or it into others
  std::set<std::string> planes = {};     // at hand: inputs, and what passes make here
  std::vector<cl::Kernel> kernels = {};  // of the passes that run here
  std::vector<cl::Buffer> numbers = {};  // projections and tables that they read
  std::vector<size_t> passes = {};       // which these are
  std::vector<PassTime> times = {};      // of each
};

/// The views that a view's passes may look into; null where there is none.
struct OtherViews {
  ViewOnDevice* other = nullptr;                    // of two
  ViewOnDevice *nearest = nullptr, *far = nullptr;  // key views
  double share_of_far = 0;                          // where both show a point
  /// The view that a binding's plane is of; null: the view itself.
  ViewOnDevice* of(const Binding& binding) const {
    if (binding.from == From::other_view) return other;
    if (binding.from == From::nearest_key_view) return nearest;
    return binding.from == From::further_key_view ? far : nullptr;
  }
};

/// Brings a view's inputs to the device, and makes room for what is computed.
ViewOnDevice view_on_device(const Plan& plan, const Frame& frame, const View& view, Device::Impl& device);

/// The outputs that the view has, computed or inputs, go to `out`. A plane that the view came with and no pass makes here is
/// no result of it.
void download(const Plan& plan, ViewOnDevice& on_device, View& out);

}  // namespace gloam
