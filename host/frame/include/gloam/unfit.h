// Planes whose values are not what their name says. A note tells, and `gloam auto` does without what a note calls unfit.
#pragma once

#include <string>
#include <vector>

namespace gloam {

struct Unfit {
  std::string plane;  ///< "color"
  std::string why;    ///< "it holds the steps of an 8-bit picture"
};

/// The one form of such a note: "color is unfit: WHY; gloam auto does without (--plane color=CHANNELS has it taken)".
std::string note_on(const Unfit& unfit);

/// Such a note of a frame of a shot, where one frame decides for all: gloam auto does without the planes of `left_out` in all frames, and
/// takes any other plane all the same. `decider`: that frame's number. Every other note stays as it is.
std::string note_in_shot(const std::string& note, const std::vector<Unfit>& left_out, int decider);

/// The planes that notes (`Frame::assumed`) call unfit, each once. Those that a shot takes all the same are not among them.
std::vector<Unfit> unfit_planes(const std::vector<std::string>& notes);

/// The names of planes without those that are unfit.
std::vector<std::string> fit_planes(std::vector<std::string> planes, const std::vector<Unfit>& unfit);

}  // namespace gloam
