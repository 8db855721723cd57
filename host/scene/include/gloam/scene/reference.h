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
  /// Weight of an occluder at `distance` (in radii, below 1) whose direction has the given `cosine` to the normal, relative to the
  /// cosine-weighted integral: 1 for the plain one. Empty: 1, and only visibility is traced.
  std::function<double(double cosine, double distance)> contribution = {};
  std::string falloff = "none";         ///< its name, for the header
  std::string falloff_parameters = {};  ///< "bias=0.1 ...", for the header; part of a checkpoint's identity
  /// File in which a long computation is saved now and then, to resume after an interruption; empty: not saved. The caller
  /// removes it once the result is safe.
  std::filesystem::path checkpoint = {};
  double checkpoint_seconds = 15;  ///< between two saves, and before the first
  std::function<void(double share_done)> progress = {};
  std::function<void()> poll = {};  ///< called after each pixel, from any thread; what it throws ends the work
};

/// What references without a falloff are traced with.
struct ReferenceOptions {
  double radius = 0.5;  ///< reach of rays, scene units; may be infinite
  int samples = 256;    ///< rays (of `bounces`: paths) per pixel, rounded up to a multiple of 32
  uint32_t seed = 0;
  std::filesystem::path checkpoint = {};  ///< as in `AoReferenceOptions`, like what follows
  double checkpoint_seconds = 15;
  std::function<void(double share_done)> progress = {};
  std::function<void()> poll = {};
};

/// A traced reference, and figures on its quality.
struct Reference {
  Frame frame;  ///< per view a plane of values and one of noise (half the difference of two independent halves), with
                ///< depth and cameras of the frame
  double noise = 0;  ///< estimated RMS error over the foreground, from two independent halves
  double largest_noise = 0;
  long long rays = 0;        ///< traced in this run
  double seconds = 0;        ///< spent in this run
  double resumed_share = 0;  ///< share of the pixels that a checkpoint already held
  double unlike_share = 0;   ///< share of a grid of foreground pixels whose depth in the scene differs by over 1 %
  std::vector<std::string> notes;  ///< harmless problems, one sentence each
};

/// Planes `ao` and `ao_noise`; background is 1 and 0.
using AoReference = Reference;

/// Ambient occlusion AO = 1 - (1/pi) * integral of contribution * cosine over the hemisphere about the frame's normal (the
/// scene's if the frame has none), as the mean over cosine-weighted directions of a randomised low-discrepancy set. Directions
/// below the surface are closed. The surface is the scene's at the pixel centre.
///
/// `frame`: planes `depth` and, if the file has it, `normal`, normalised; cameras with poses.
/// Attributes of the result: aoRadius, aoSamples, aoNoise, aoFalloff, aoFalloffParameters, aoDefinition, gloamScene.
/// Throws Error if a view has no pose, if over a quarter of the foreground is unlike the scene (another scene, unit or camera;
/// names both depths at one pixel), and if another file lies in the checkpoint's place.
AoReference ao_reference(const Tracer& tracer, const Frame& frame, const AoReferenceOptions& options);

}  // namespace gloam
