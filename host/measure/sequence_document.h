// The section `sequence` of bench.json (docs/benchmarking.md).
#pragma once

#include "measure/document.h"
#include "measure/sequence.h"
#include "measure/tables.h"

namespace gloam::bench {

/// No rows of single frames, but `sequence`.
report::Measurements results_of(const MeasuredSequence& sequence, const SequenceMeasurement& measurement,
                                const DeviceInfo& device);

/// A line for each setting, in the order of time.
Table table_of_sequence(const MeasuredSequence& sequence, const SequenceMeasurement& measurement);

}  // namespace gloam::bench
