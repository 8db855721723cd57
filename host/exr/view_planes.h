// Which planes the views of a frame have, by what its files list.
#pragma once

#include <string>
#include <vector>

#include "gloam/exr.h"

namespace gloam {

/// What serves as a plane of a view; nullptr where nothing does.
const PlaneSource* find_source(const std::vector<PlaneSource>& sources, const std::string& plane,
                               const std::string& view);

/// Whether a view has a plane. A layer beyond the end of its stack (planes.h) counts as there where another view's stack
/// reaches that far: nothing is seen in it.
bool has_plane(const std::vector<PlaneSource>& sources, const std::string& plane, const std::string& view);

/// Planes that every view has, in the order of the sources.
std::vector<std::string> common_planes(const std::vector<PlaneSource>& sources, const std::vector<std::string>& views);

/// "view 'right' has no depth", where another view has it; else empty.
std::string why_missing(const std::vector<PlaneSource>& sources, const std::vector<std::string>& views,
                        const std::string& plane);

/// A sentence for depth, normals and each of `planes` that some views have and others lack, with what can be done.
std::vector<std::string> unused_planes(const std::vector<PlaneSource>& sources, const std::vector<std::string>& views,
                                       const std::vector<std::string>& planes, const std::string& remedy);

/// "64x36 pixels from (0, 0)"
std::string in_words(const Window& window);

}  // namespace gloam
