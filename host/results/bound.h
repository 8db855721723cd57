// What limits a pass: the device's instructions, its reads around a pixel, or its planes' way to and from memory.
#pragma once

#include <optional>

#include "results/measurements.h"

namespace gloam::report {

/// Of the times that a pass's instructions, its reads around each pixel and its planes take at a device's peaks, the longest. Reads and copies
/// that take longer than the pass are left aside: their peak is none for this pass. Instructions that do are all of its time: a device may
/// start others beside a multiply-add. None for a pass that was not counted, for counts
/// without instructions, and where a peak that is needed was not measured. `pixels`: of the frame. `lanes`: pixels per work-item; of
/// several, addresses are computed together, and only the instructions of floats count.
std::optional<Bound> bound_of(const Pass& pass, const Peaks& peaks, double pixels, int lanes);

}  // namespace gloam::report
