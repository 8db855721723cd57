// The effects of light that techniques are measured on, each by its plane.
#pragma once

#include <string>
#include <vector>

#include "gloam/technique.h"

namespace gloam::bench {

/// A plane that `gloam reference` traces and techniques make.
struct MeasuredEffect {
  std::string plane;  ///< "indirect"
  std::string base;   ///< what there is without a technique: "white", all is open, or "black", no light
  float base_value;
  bool is_of_scene;  ///< traced from the scene alone; the light of an environment needs a file
};

/// In the order of `reference_kinds`; `ao` is the first. Not `reflection`: it is judged by how it looks, not by its RMSE.
const std::vector<MeasuredEffect>& measured_effects();
std::vector<std::string> effect_names();

/// Throws std::out_of_range for another plane.
const MeasuredEffect& effect_of(const std::string& plane);

/// The plane of the effect that a technique makes; empty if there is none.
std::string measured_plane(const Technique& technique);

/// The technique whose presets and converged settings count: itself, or if it has none the one that makes what it reads by default
/// (`evidence` for `multi-bounce`).
const Technique& source_of(const Technique& technique);

/// `Technique::converged` of the source, as settings of a plan.
Settings converged_settings(const Technique& technique);

}  // namespace gloam::bench
