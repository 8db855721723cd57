// Decoding, computing and writing of neighbouring frames at the same time.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace gloam {

/// The work on one frame, by its place in the list of frames. Each step returns whether the next one is wanted; a frame ends
/// with the step that returns false, and else with `write`. Whoever calls keeps what the steps hand on.
struct PipelineSteps {
  std::function<bool(size_t)> decode;   ///< several frames at once, begun in order
  std::function<bool(size_t)> compute;  ///< one frame after another, in order
  std::function<bool(size_t)> write;    ///< several frames at once
};

struct PipelineSize {
  size_t in_flight = 1;  ///< frames between the start of `decode` and the end of their last step: a bound
  size_t decoders = 1, writers = 1;
};

/// The threads of a pipeline. `compute` runs on the thread that calls `run`.
class Pipeline {
 public:
  Pipeline(size_t frames, const PipelineSize& size, PipelineSteps steps);
  ~Pipeline();

  /// Returns when every frame has ended, or after `stop` when those begun have. Throws what a step throws; the frames begun end
  /// first.
  void run();
  /// From a step: begins no further frame.
  void stop();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gloam
