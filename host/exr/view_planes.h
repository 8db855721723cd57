// The planes that the views of a frame have, according to the headers of its files.
#pragma once

#include <string>
#include <vector>

#include "gloam/exr.h"

namespace gloam {

/// The source of a view's plane; nullptr if there is none.
const PlaneSource* find_source(const std::vector<PlaneSource>& sources, const std::string& plane,
                               const std::string& view);

/// Whether a view has a plane. A layer beyond the end of its stack (planes.h) counts as present if another view's stack
/// has it: it shows nothing.
bool has_plane(const std::vector<PlaneSource>& sources, const std::string& plane, const std::string& view);

/// Planes that every view has, in the order of the sources.
std::vector<std::string> common_planes(const std::vector<PlaneSource>& sources, const std::vector<std::string>& views);

/// "view 'right' has no depth", if another view has it; else empty.
std::string why_missing(const std::vector<PlaneSource>& sources, const std::vector<std::string>& views,
                        const std::string& plane);

/// A sentence for depth, normals and each of `planes` that only some views have, with the `remedy`.
std::vector<std::string> unused_planes(const std::vector<PlaneSource>& sources, const std::vector<std::string>& views,
                                       const std::vector<std::string>& planes, const std::string& remedy);

/// "64x36 pixels from (0, 0)"
std::string in_words(const Window& window);

}  // namespace gloam
