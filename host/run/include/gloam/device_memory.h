// Planes that are in a device's memory already, and results that stay there: with the caller's context, queue and buffers, nothing goes
// through the host.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gloam/run.h"

// As in CL/cl.h, which only the caller needs.
typedef struct _cl_command_queue* cl_command_queue;
typedef struct _cl_mem* cl_mem;
typedef struct _cl_event* cl_event;

namespace gloam {

/// The device of the caller's queue, with the queue's context. What gloam computes on it is enqueued there, in order. Queue and context are
/// retained as long as the device lives. Throws Error for a queue that runs commands out of order. Without
/// CL_QUEUE_PROFILING_ENABLE, `run` tells times by the wall clock.
Device device_of(cl_command_queue queue);

/// One component of a plane: floats in a buffer of the device's context.
struct DeviceChannel {
  cl_mem memory = nullptr;
  size_t offset = 0;  ///< bytes from the beginning of the buffer to pixel (0, 0)
  size_t step = 4;    ///< bytes from one pixel to the next: 16 for one component of four side by side
};

/// A plane (planes.h), one channel for each component: three for `normal`.
struct DevicePlane {
  std::string name = {};
  std::vector<DeviceChannel> channels = {};
  size_t pitch = 0;  ///< bytes from one row to the next; 0: the width, tight
  /// The caller answers for every pixel: depth from 1e-30 to 1e10 or +inf, no NaN, normals of unit length or zero. Such a plane is read in
  /// place; other values in it can make kernels read outside of the buffers. Any other plane is copied on the device: depth out of that
  /// range becomes +inf, and elsewhere NaN and components out of the plane's range become 0, or what background has. Of results it says
  /// nothing.
  bool is_clean = false;
};

struct DeviceView {
  std::string name = {};
  std::optional<Camera> camera = {};
  std::optional<Camera> camera_before = {};  ///< as `View::camera_before`
  std::vector<DevicePlane> planes = {};      ///< read: the plan's inputs
  std::vector<DevicePlane> results = {};     ///< written: those of the plan's outputs that are wanted
};

struct DeviceFrame {
  int width = 0, height = 0;
  std::vector<DeviceView> views = {};
};

/// Where planes of a size lie best: used in place, without a copy.
struct DeviceLayout {
  size_t pitch, offset, bytes;  ///< of rows; of pixel (0, 0); of the whole buffer
};

/// A plane in a buffer of its own of this layout is used in place. So is any other of the same pitch, where that is a multiple of 64 bytes and
/// at most twice the one here, with a step of 4 and 256 bytes of the buffer before the first row and after the last, where the first of these
/// is aligned as CL_DEVICE_MEM_BASE_ADDR_ALIGN says. Kernels read these bytes, which must not be NaN, and use nothing of them; they write the
/// whole pitch of a result's rows.
DeviceLayout device_layout(int width, int height);

/// What has been enqueued.
struct Enqueued {
  std::shared_ptr<std::remove_pointer_t<cl_event>> done;  ///< `done.get()`: the event of the last command
  std::vector<std::string> copied;      ///< planes that are not used in place, and are copied on the device
  unsigned long long device_bytes = 0;  ///< of what is allocated besides the caller's buffers
};

/// Enqueues a plan's passes and returns, without waiting for them. Buffers must live until then; results are whole once `done` is. The planes
/// are as kernels expect them: depth in scene units along the viewing axis, +inf on the background; normals of unit length in view
/// space. Pixels are not looked at, so a plan with a radius needs one in its request. `wait_for`: events before which nothing begins.
/// `RunOptions::repeat` has to be 1, and `progress` is not called. Throws as `run` does, and Error for planes that are missing, unknown, given
/// twice, too large for their buffer, or of another context, for results that no pass makes, and for plans over the key views of a light-field display. What was enqueued before an
/// error still runs: clFinish waits for it.
Enqueued enqueue(const Plan& plan, const DeviceFrame& frame, Device& device, const RunOptions& options = {},
                 const std::vector<cl_event>& wait_for = {});

}  // namespace gloam
