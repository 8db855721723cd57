// A frame's planes on their way to a device's memory, beside what the device computes.
#pragma once

#include <CL/opencl.hpp>
#include <map>
#include <mutex>
#include <vector>

#include "gloam/frame.h"
#include "run/buffer_pool.h"

namespace gloam {

/// The queue of a device for planes that no run waits for yet, and the memory for them. Threads may share it.
class Transfers {
 public:
  /// A plane's buffers, and what tells that the plane has arrived.
  struct UnderWay {
    std::vector<cl::Buffer> buffers;
    std::vector<cl::Event> arrived;
    size_t bytes = 0;  ///< of each
  };

  /// Whether one more frame may be on its way.
  bool begin();
  /// Throws cl::Error.
  UnderWay send(const cl::Context& context, const cl::Device& device, const Plane& plane);
  /// Waits for all that was sent.
  void finish();
  /// Takes back the memory of what has arrived and is read no more. Ends a frame.
  void end(std::vector<UnderWay> planes);

 private:
  std::mutex busy_;
  cl::CommandQueue queue_;  ///< made when it is first needed
  BufferPool pool_;
  int frames_ = 0;
};

/// See gloam/run.h.
struct Uploads {
  explicit Uploads(Transfers& transfers) : transfers(transfers) {}
  Uploads(const Uploads&) = delete;
  ~Uploads();

  /// The buffers of a plane, once a queue's next commands wait for it; none where it was not sent.
  std::vector<cl::Buffer> take(const Plane& plane, cl::CommandQueue& queue);

  Transfers& transfers;
  std::map<const Plane*, Transfers::UnderWay> planes;
};

}  // namespace gloam
