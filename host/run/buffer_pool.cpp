#include "run/buffer_pool.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <utility>

namespace gloam {
namespace {

constexpr int runs_kept = 8;  ///< as many effects as one frame may call for

bool is_same(float a, float b) { return std::bit_cast<uint32_t>(a) == std::bit_cast<uint32_t>(b); }

}  // namespace

BufferPool::Taken BufferPool::take(const cl::Context& context, size_t bytes, float content) {
  // The last one given back, so that what is too many stays unused and goes.
  const auto found = std::find_if(kept_.rbegin(), kept_.rend(), [&](const Kept& kept) {
    return kept.bytes == bytes && is_same(kept.content, content);
  });
  if (found != kept_.rend()) {
    Taken taken{std::move(found->buffer), false};
    kept_.erase(std::next(found).base());
    return taken;
  }
  try {
    return {cl::Buffer(context, CL_MEM_READ_WRITE, bytes), true};
  } catch (const cl::Error&) {
    if (kept_.empty()) throw;
    kept_.clear();
    return {cl::Buffer(context, CL_MEM_READ_WRITE, bytes), true};
  }
}

void BufferPool::give(cl::Buffer buffer, size_t bytes, float content) {
  kept_.push_back({std::move(buffer), bytes, content, run_});
}

void BufferPool::begin_run(unsigned long long needed, unsigned long long memory) {
  ++run_;
  std::erase_if(kept_, [&](const Kept& kept) { return kept.run + runs_kept < run_; });
  if (bytes() + needed > memory) kept_.clear();
}

unsigned long long BufferPool::bytes() const {
  return std::accumulate(kept_.begin(), kept_.end(), 0ull,
                         [](unsigned long long sum, const Kept& kept) { return sum + kept.bytes; });
}

}  // namespace gloam
