// The normals of a file, with the meaning that flags, the header, channel names and the normals themselves give them.
#pragma once

#include <functional>
#include <optional>

#include "exr/file.h"
#include "gloam/frame.h"
#include "normalise/normal_samples.h"
#include "normalise/normals.h"

namespace gloam {

/// What flags and the file state of normals.
NormalConvention stated_normals(const ExrFile& file, const PlaneSource& normal);

/// The form of a view's normals in the file; none, with a note, if the normals are unusable. `count_missing`: number of foreground
/// pixels without a normal, if the normals are read in that form. `found`: set, unless a view before has set it.
std::optional<NormalForm> find_normal_form(const ExrFile& file, const View& view, const NormalSamples& samples,
                                           const std::function<long long(const NormalForm&)>& count_missing,
                                           Frame& frame, FoundNormals& found);

/// Brings a view's normals to view space, or drops unusable normals. Returns their form in the file.
std::optional<NormalForm> convert_normals(const ExrFile& file, View& view, Frame& frame, FoundNormals& found);

}  // namespace gloam
