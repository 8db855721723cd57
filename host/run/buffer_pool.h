// Device memory that is kept from run to run: allocating it anew costs a GPU's driver more than many a kernel.
#pragma once

#include <CL/opencl.hpp>
#include <limits>
#include <vector>

namespace gloam {

/// The content of a buffer of which nothing is known: no plane has it outside of the image.
constexpr float anything = std::numeric_limits<float>::quiet_NaN();

/// Buffers of one device that no run uses. Those of a queue that keeps the order of commands can be taken again before the commands
/// that used them have ended.
class BufferPool {
 public:
  struct Taken {
    cl::Buffer buffer;
    bool is_new;  ///< nothing is known of what is in it
  };

  /// A buffer of this size that was last given back with this `content`, such as the value around its image; else a new one. Where there
  /// is no memory for that, what is kept goes first. Throws cl::Error.
  Taken take(const cl::Context& context, size_t bytes, float content);
  void give(cl::Buffer buffer, size_t bytes, float content);

  /// Lets go of what the last few runs did not use, and of everything if a run needs so much that not all fits in `memory`.
  void begin_run(unsigned long long needed, unsigned long long memory);

  /// Of what is kept.
  unsigned long long bytes() const;

 private:
  struct Kept {
    cl::Buffer buffer;
    size_t bytes;
    float content;
    long long run;  ///< that used it last
  };
  std::vector<Kept> kept_;
  long long run_ = 0;
};

}  // namespace gloam
