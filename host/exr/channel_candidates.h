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

/// The layer's channels for the first of the alternatives (`Spelling::components`) that it has all components of; else none.
std::vector<const FileChannel*> pick(const Layer& layer, const std::string& alternatives);

/// All ways to fill a plane, in file order.
std::vector<Candidate> candidates_of(const std::string& plane, const std::vector<Layer>& layers);

/// Mitsuba names the beauty after its nested integrator, whatever that is called: the only RGBA layer left over.
void add_unnamed_beauty(std::vector<Candidate>& candidates, const std::vector<Layer>& layers, const char* components);

/// The best candidate: rank, then the view layer that the depth came from, then file order.
const Candidate* best_of(const std::vector<Candidate>& candidates, const std::optional<std::string>& prefix);

/// The candidate's channel or layer, as the file names it.
std::string shown(const Candidate& candidate);

/// That `best` is taken and not another that is as good, with what chooses the other; empty where none is.
std::string tie_in_words(const std::string& plane, const std::vector<Candidate>& candidates, const Candidate& best);

}  // namespace gloam::channel_names
