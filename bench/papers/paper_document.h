// What a reproduced paper leaves in bench.json (docs/benchmarking.md).
#pragma once

#include "measure/document.h"
#include "papers/paper.h"

namespace gloam::bench {

/// The document of a reproduced paper: no results, but `paper`, `facts` and `pictures`.
Json document_of(const PaperResult& result, const PaperOptions& options, const DeviceInfo& device);

}  // namespace gloam::bench
