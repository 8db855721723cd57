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

/// The planes that notes (`Frame::assumed`) call unfit, each once.
std::vector<Unfit> unfit_planes(const std::vector<std::string>& notes);

/// The names of planes without those that are unfit.
std::vector<std::string> fit_planes(std::vector<std::string> planes, const std::vector<Unfit>& unfit);

}  // namespace gloam
