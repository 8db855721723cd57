#include "sequence/pipeline.h"

#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <set>
#include <thread>
#include <utility>
#include <vector>

namespace gloam {

struct Pipeline::Impl {
  Impl(size_t frames, const PipelineSize& size, PipelineSteps steps)
      : frames(frames), size(size), steps(std::move(steps)) {}

  void decode_frames() {
    for (std::unique_lock lock(mutex);;) {
      changed.wait(lock, [&] { return has_begun_all() || in_flight < size.in_flight; });
      if (has_begun_all()) return;
      const size_t frame = begun++;
      ++in_flight;
      const bool goes_on = run_step(lock, steps.decode, frame);
      (goes_on ? decoded : ended_early).insert(frame);
      in_flight -= !goes_on;
      changed.notify_all();
    }
  }

  void compute_frames() {
    std::unique_lock lock(mutex);
    for (size_t frame = 0;; ++frame) {
      changed.wait(lock, [&] {
        return decoded.contains(frame) || ended_early.contains(frame) || (has_begun_all() && frame >= begun);
      });
      if (ended_early.erase(frame) > 0) continue;
      if (decoded.erase(frame) == 0) break;
      if (run_step(lock, steps.compute, frame))
        computed.push_back(frame);
      else
        --in_flight;
      changed.notify_all();
    }
    has_computed_all = true;
    changed.notify_all();
  }

  void write_frames() {
    for (std::unique_lock lock(mutex);;) {
      changed.wait(lock, [&] { return !computed.empty() || has_computed_all; });
      if (computed.empty()) return;
      const size_t frame = computed.front();
      computed.pop_front();
      run_step(lock, steps.write, frame);
      --in_flight;
      changed.notify_all();
    }
  }

  /// Runs a step without the lock. A step that throws ends its frame and begins no other.
  bool run_step(std::unique_lock<std::mutex>& lock, const std::function<bool(size_t)>& step, size_t frame) {
    lock.unlock();
    bool goes_on = false;
    std::exception_ptr thrown;
    try {
      goes_on = step(frame);
    } catch (...) {
      thrown = std::current_exception();
    }
    lock.lock();
    if (thrown) {
      if (!error) error = thrown;
      is_stopped = true;
    }
    return goes_on;
  }

  bool has_begun_all() const { return is_stopped || begun == frames; }

  const size_t frames;
  const PipelineSize size;
  const PipelineSteps steps;
  std::mutex mutex;
  std::condition_variable changed;
  size_t begun = 0, in_flight = 0;
  std::set<size_t> decoded, ended_early;  ///< those that `compute` has not come to
  std::deque<size_t> computed;
  bool is_stopped = false, has_computed_all = false;
  std::exception_ptr error;
};

Pipeline::Pipeline(size_t frames, const PipelineSize& size, PipelineSteps steps)
    : impl_(std::make_unique<Impl>(frames, size, std::move(steps))) {}

Pipeline::~Pipeline() = default;

void Pipeline::run() {
  std::vector<std::thread> threads;
  for (size_t i = 0; i < impl_->size.decoders; ++i) threads.emplace_back([this] { impl_->decode_frames(); });
  for (size_t i = 0; i < impl_->size.writers; ++i) threads.emplace_back([this] { impl_->write_frames(); });
  impl_->compute_frames();
  for (std::thread& thread : threads) thread.join();
  if (impl_->error) std::rethrow_exception(impl_->error);
}

void Pipeline::stop() {
  const std::lock_guard lock(impl_->mutex);
  impl_->is_stopped = true;
  impl_->changed.notify_all();
}

}  // namespace gloam
