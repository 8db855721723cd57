// Frames to measure on, for the commands that measure.
#pragma once

#include <string>
#include <vector>

#include "cli/flags/radius.h"
#include "cli/flags/scene_flags.h"
#include "measure/measurement.h"

namespace gloam::cli {

/// Shows the current work on a terminal, in a line that the next one overwrites.
void show_status(const std::string& what, double share);
void erase_status();

/// Throws Error if the folder of -o cannot be made.
void make_output_folder(const std::filesystem::path& folder);

/// Techniques that make one of these effects (host/measure/effects.h), without filters.
std::vector<std::string> techniques_making(const std::vector<std::string>& effects);
/// Why a technique is not among `techniques_making`; else empty.
std::string why_not_measured(const Technique& technique, const std::vector<std::string>& effects);

/// Throws UsageError for a list of effects with another name; "all" stands for all. In the order of `measured_effects`.
std::vector<std::string> parse_effects(const std::string& list);

/// Why a technique is left out unless the user names it; empty for most.
std::string needs_naming(const Technique& technique);

/// The radius that techniques are measured with on a frame.
RadiusReport report_of(const bench::Subject& subject, const std::vector<const Technique*>& techniques);

/// A built-in scene seen by its first camera, with the truth of an effect. `techniques`: of all effects that are measured on the scene.
bench::Subject builtin_subject(const SceneRecipe& recipe, const std::string& effect,
                               const std::vector<const Technique*>& techniques, const bench::SceneOptions& options);

/// The same of a scene at hand. `name`: of the kept files.
bench::Subject scene_subject(const std::string& name, const std::string& scene_class, Scene scene,
                             const std::string& effect, const std::vector<const Technique*>& techniques,
                             const bench::SceneOptions& options);

/// The user's frame, with the planes that the techniques read. Its scene is known if the header names a built-in one. The radius is
/// that of the options, else the truth's, else the scene's own, else derived from the frame. `truths`: files, one for all views or
/// one each, or none; those of other effects do not count.
bench::Subject own_subject(const std::string& frame, const FrameFlags& flags, const std::vector<std::string>& truths,
                           const std::string& effect, const std::vector<const Technique*>& techniques,
                           const bench::SceneOptions& options);

}  // namespace gloam::cli
