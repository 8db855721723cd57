// The section `sequence` of bench.json (docs/benchmarking.md).
#pragma once

#include "measure/document.h"
#include "measure/sequence.h"
#include "measure/tables.h"

namespace gloam::bench {

/// A whole document: no results of single frames, but `sequence`.
Json document_of(const MeasuredSequence& sequence, const SequenceMeasurement& measurement, const DeviceInfo& device);

/// A line for each setting, in the order of time.
Table table_of_sequence(const MeasuredSequence& sequence, const SequenceMeasurement& measurement);

}  // namespace gloam::bench
