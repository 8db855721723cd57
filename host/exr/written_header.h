// The header of a frame in an EXR file.
#pragma once

#include <OpenEXR/ImfHeader.h>

#include <string>
#include <vector>

#include "exr/written_channels.h"
#include "gloam/exr.h"
#include "gloam/frame.h"

namespace gloam {

/// Throws UsageError for a compression that is unknown or loses bits.
void check_compression(const std::string& name);

/// The pixels that are written: the data window.
Window written_window(const Frame& frame, const WriteOptions& options);

/// Windows, channels, views, cameras and attributes.
Imf::Header header_of(const Frame& frame, const std::vector<WrittenChannel>& channels, const WriteOptions& options);

/// Of a part beside others that have the cameras: windows, channels of the view, and attributes.
Imf::Header header_of_part(const Frame& frame, const View& view, const std::vector<WrittenChannel>& channels,
                           const WriteOptions& options);

}  // namespace gloam
