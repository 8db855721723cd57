// Ray-traced ambient occlusion of a captured frame: the truth that techniques are measured against.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "gloam/frame.h"
#include "gloam/scene/tracer.h"
#include "gloam/technique.h"

namespace gloam {

struct AoReferenceOptions {
  double radius = 0.5;  ///< scene units; may be infinite
  int samples = 256;    ///< rays per pixel, rounded up to a multiple of 32
  uint32_t seed = 0;
  /// What an occluder at `distance` (in radii, below 1) and at an angle with cosine `cosine` to the normal takes away,
  /// in relation to the cosine-weighted integral: 1 for the plain one. Empty: 1, and only visibility is traced.
  std::function<double(double cosine, double distance)> contribution = {};
  std::string falloff = "none";         ///< its name, for the header
  std::string falloff_parameters = {};  ///< "bias=0.1 ...", for the header; part of what a computation is known by
  /// Where a long computation is kept now and then, to go on after an interruption; empty: nowhere. It stays until the
  /// caller, who has the result in safety then, removes it.
  std::filesystem::path checkpoint = {};
  double checkpoint_seconds = 15;  ///< between two of them, and before the first
  std::function<void(double share_done)> progress = {};
};

/// What was traced, and how well.
struct Reference {
  Frame frame;  ///< a plane of values and one of noise (half the difference of two independent halves) per view, with
                ///< depth and cameras of the frame
  double noise = 0;  ///< estimated RMS error over the foreground, from two independent halves
  double largest_noise = 0;
  long long rays = 0;        ///< traced now
  double seconds = 0;        ///< spent now
  double resumed_share = 0;  ///< of the pixels that a checkpoint already had
  double unlike_share = 0;   ///< of a grid of foreground pixels: the scene's depth differs from the frame's by over 1 %
  std::vector<std::string> notes;  ///< what went wrong without harm, one sentence each
};

/// Planes `ao` and `ao_noise`; background 1 and 0.
using AoReference = Reference;

/// Ambient occlusion AO = 1 - (1/pi) * integral of contribution * cosine over the hemisphere about the frame's normal
/// (the scene's where the frame has none), as the mean over cosine-weighted directions of a randomised low-discrepancy
/// set. Directions that go under the surface are closed. The surface is the scene's at the pixel centre.
///
/// `frame`: planes `depth` and, where the file has it, `normal`, normalised; cameras with poses.
/// Attributes of the result: aoRadius, aoSamples, aoNoise, aoFalloff, aoFalloffParameters, aoDefinition, gloamScene.
/// Throws Error when a view has no pose, and when over a quarter of the foreground is unlike the scene (another scene, unit
/// or camera), naming both depths at one pixel; when the checkpoint's place is taken by a file that is none.
AoReference ao_reference(const Tracer& tracer, const Frame& frame, const AoReferenceOptions& options);

}  // namespace gloam
