// What a run gives back to Python.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "gloam/compute.h"
#include "gloam/history.h"
#include "python/bindings.h"
#include "python/interrupts.h"
#include "python/planes.h"
#include "sequence/history_chain.h"

namespace gloam::python {

/// The planes of one view.
struct ViewValues {
  std::string view;
  std::vector<std::pair<std::string, Values>> planes;
};

struct Outcome {
  std::vector<ViewValues> views;
  std::string technique, device;
  int lanes = 1;
  std::vector<PassTime> passes;
  std::vector<double> total_ms;
  std::optional<Radius> radius;
  std::vector<std::string> notes;
  std::map<std::string, std::string> attributes;  ///< for a header
  double skipped_share = 0;
  unsigned long long device_bytes = 0;
  SharedFrame source;  ///< the depth, and of two views the normals, and the cameras: what results are written with
  std::optional<int> number;  ///< of a frame of a sequence
};

/// What a frame of a sequence takes over from the one before, and leaves for the next.
struct Chained {
  HistoryChain& history;
  std::vector<std::string> written;  ///< planes wanted; empty: the technique's outputs
  std::string name;                  ///< of the frame, for messages
};

/// What a result is written with: `gloam compare` knows the background by the depth, and the edges of two views by the normals.
/// `is_own`: nobody else holds the frame, and it loses its other planes.
SharedFrame carried(SharedFrame frame, bool is_own);

/// Takes these planes, as far as the result has them.
void take_results(Frame&& result, const std::vector<std::string>& planes, Outcome& outcome);

/// Computes. `strips`: how many the frame is divided into (strips.h), 0 for as few as fit; none: it is computed whole. `is_own`: nobody
/// else holds the frame, so that its planes may be taken. `chained`: where the request is temporal; the frame is
/// the caller's own then, too. Needs no interpreter lock.
Outcome compute_outcome(const PlanRequest& request, SharedFrame frame, bool is_own, Device& device, RunOptions options,
                        Interrupts& interrupts, Chained* chained = nullptr, std::optional<int> strips = {});

}  // namespace gloam::python
