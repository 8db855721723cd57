// The channels that could serve as a plane, and how well.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "exr/channel_layers.h"
#include "exr/channel_spellings.h"

namespace gloam::channel_names {

/// One way to fill a plane.
struct Candidate {
  const Layer* layer;
  std::vector<const FileChannel*> channels;
  int rank;
  DeclaredConvention said;
  float y_scale;
};

/// The layer's channels for the first alternative (`Spelling::components`) of which the layer has every component; else none.
std::vector<const FileChannel*> pick(const Layer& layer, const std::string& alternatives);

/// All ways to fill a plane, in file order.
std::vector<Candidate> candidates_of(const std::string& plane, const std::vector<Layer>& layers);

/// Adds the beauty of Mitsuba, which has the name of the nested integrator, any text: it is the only RGBA layer left over.
void add_unnamed_beauty(std::vector<Candidate>& candidates, const std::vector<Layer>& layers, const char* components);

/// The best candidate: by rank, then in the depth's view layer, then by file order.
const Candidate* best_of(const std::vector<Candidate>& candidates, const std::optional<std::string>& prefix);

/// The name of the candidate's channel or layer in the file.
std::string shown(const Candidate& candidate);

/// A sentence that `best` is taken instead of an equally good candidate, with the flag that chooses the other; empty if there is
/// none.
std::string tie_in_words(const std::string& plane, const std::vector<Candidate>& candidates, const Candidate& best);

}  // namespace gloam::channel_names
