// What takes part in a race beside the techniques: floors and peaks of the device, and a native loop.
#pragma once

#include <string>
#include <vector>

#include "measure/floors.h"
#include "measure/native.h"
#include "measure/timing.h"

namespace gloam::bench {

/// One view's depth and normals on the device; missing normals are computed.
struct PlainFrame {
  PlainFrame(const Frame& given, Device& device);
  Frame frame;
  DevicePlanes planes;
};

/// "the native loop differs from hbao+ by 0.01 on average: no ratio to it"
std::string differs(const char* baseline, const std::string& technique, double difference);

/// The baselines of HBAO+ with 8 x 4 samples, and floors of the device.
class Baselines {
 public:
  /// `estimate`: gloam's result; a loop with another result takes no part.
  Baselines(Device& device, PlainFrame& plain, const HbaoPlusParams& params, const std::string& reference,
            const Channel& estimate, std::vector<std::string>& notes);

  std::vector<Contender> floors() {
    return {{"gather floor", [this] { return gathers_.run(); }, [this] { return gathers_.cpu_ms(); }},
            {"copy floor", [this] { return copy_.run(); }, [this] { return copy_.cpu_ms(); }},
            {"fma peak", [this] { return fma_.run(); }, [this] { return fma_.cpu_ms(); }}};
  }

  double fma_operations() const { return fma_.operations(); }

  std::vector<Contender> loops() {
    if (!has_native_) return {};
    return {{"native", [this] { return native_.run(); }}};
  }

 private:
  GatherFloor gathers_;
  CopyFloor copy_;
  FmaPeak fma_;
  Native native_;
  bool has_native_ = false;
};

}  // namespace gloam::bench
