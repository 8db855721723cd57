// The normals of a file, as flags, the header, channel names and the normals themselves say what they mean.
#pragma once

#include <functional>
#include <optional>

#include "exr/file.h"
#include "gloam/frame.h"
#include "normalise/normals.h"

namespace gloam {

/// The form in which the file has a view's normals; none, with a note, where they are of no use. `count_missing`: how many pixels of
/// the foreground have no normal, once the normals are read in that form.
std::optional<NormalForm> find_normal_form(const ExrFile& file, const View& view, const NormalSamples& samples,
                                           const std::function<long long(const NormalForm&)>& count_missing,
                                           Frame& frame);

/// Brings a view's normals to view space, or drops normals that are of no use. Returns their form in the file.
std::optional<NormalForm> convert_normals(const ExrFile& file, View& view, Frame& frame);

}  // namespace gloam
