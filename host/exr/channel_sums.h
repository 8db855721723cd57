// Planes that renderers write as several layers, to be added, and multiplied by the layer of a colour.
#pragma once

#include <string>
#include <vector>

#include "exr/channel_candidates.h"
#include "gloam/frame.h"

namespace gloam {

namespace channel_names {

/// Adds those of a plane's spellings that are sums of layers ("volumedir+volumeind", "transdir+transind*transcol") where all their layers
/// are there, below one path.
void add_sums(std::vector<Candidate>& candidates, const std::string& plane, const std::vector<Layer>& layers);

}  // namespace channel_names

/// Whether a plane is made of several layers.
bool is_sum(const PlaneSource& source);

/// Makes one plane of the layers that were decoded for it; does nothing to others.
void add_up(const PlaneSource& source, Plane& plane);

/// "ViewLayer.VolumeDir + ViewLayer.VolumeInd", "(TransDir + TransInd) x TransCol", "ViewLayer.Emit", "Z".
std::string layers_in_words(const PlaneSource& source);

}  // namespace gloam
