// Frames to measure on: of built-in scenes, and the user's own.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gloam/exr.h"
#include "gloam/variants.h"
#include "measure/measurement.h"
#include "scene/names.h"

namespace gloam::bench {

/// Techniques that make one of these effects (effects.h), without filters.
std::vector<std::string> techniques_making(const std::vector<std::string>& effects);
/// Why a technique is not among `techniques_making`; else empty.
std::string why_not_measured(const Technique& technique, const std::vector<std::string>& effects);

/// Why a technique is left out unless the user names it; empty for most.
std::string needs_naming(const Technique& technique);
/// The same where variants are chosen: that of two eyes names techniques of two views.
std::string needs_naming(const Technique& technique, const VariantChoice& choice);

/// Throws UsageError where the choice of variants has left no technique of those that make the effects.
void check_any_fits(const std::vector<const Technique*>& left, const VariantChoice& choice,
                    const std::vector<std::string>& effects);

/// A built-in scene seen by its first camera, with the truth of an effect. `techniques`: of all effects that are measured on the scene.
Subject builtin_subject(const SceneRecipe& recipe, const std::string& effect,
                        const std::vector<const Technique*>& techniques, const SceneOptions& options,
                        const TellNotes& tell);

/// The same of a scene at hand. `name`: of the kept files.
Subject scene_subject(const std::string& name, const std::string& scene_class, Scene scene, const std::string& effect,
                      const std::vector<const Technique*>& techniques, const SceneOptions& options,
                      const TellNotes& tell);

/// A frame in a file, and its truths: files, one for all views or one each, or none; those of other effects do not count.
struct OwnFrame {
  std::string file;
  ReadOptions reading;
  std::vector<std::string> truths;
  /// Called before anything is decoded, with the name of the file and the bytes that measuring takes beside the process itself: gives
  /// back what is planned for in all, or throws.
  std::function<unsigned long long(const std::string& name, unsigned long long bytes)> afford;
};

/// The user's frame, with the planes that the techniques read. Its scene is known if the header names a built-in one. The radius is
/// that of the options, else the truth's, else the scene's own, else derived from the frame.
Subject own_subject(const OwnFrame& own, const std::string& effect, const std::vector<const Technique*>& techniques,
                    const SceneOptions& options, const TellNotes& tell);

}  // namespace gloam::bench
