// The results of gloam capture, for programs and for people.
#pragma once

#include "cli/capture/command.h"

namespace gloam::cli {

Json capture_document(const Scene& scene, const CaptureOptions& options, const CaptureFigures& figures);
void print_capture(const Scene& scene, const CaptureOptions& options, const CaptureFigures& figures);

}  // namespace gloam::cli
