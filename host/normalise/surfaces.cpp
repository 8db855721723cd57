#include "normalise/surfaces.h"

#include <optional>

#include "base/lists.h"
#include "gloam/error.h"
#include "gloam/option.h"
#include "normalise/depth.h"
#include "normalise/normals.h"
#include "normalise/told_depth.h"

namespace gloam {

StoredSurfaces look_at_surfaces(const DepthRows& depth, const NormalSamples* normals, const Window& window,
                                const Camera& camera, const StatedSurfaces& stated) {
  StoredSurfaces found{.depth = look_at_depth(depth, background_of(stated.depth.background, camera.far),
                                              stated.depth.background.has_value(),
                                              "; " + option("background") + " says otherwise")};
  found.normals = plain_form(stated.normals);
  if (normals && found.normals.space == NormalSpace::world && !camera.pose)
    throw Error("normals in world space need a camera with a pose; give one, or normals in view space");
  found.notes = found.depth.notes;
  if (stated.depth.convention == DepthConvention::automatic && found.depth.is_in_unit_interval)
    found.notes.push_back(note_on_planar_depth(true));
  if (!found.depth.is_usable) {
    found.notes.emplace_back("depth: no pixel has a usable depth; all of it is background");
    return found;
  }
  const auto depth_at = [&](int x, int y) {
    float z = depth.row(y)[x];
    clean_depth_row(&z, 1, found.depth.sign, found.depth.background);
    return z;
  };
  const std::string steps = note_on_steps(depth_at, Layout(depth.width, depth.height), camera, false);
  if (!steps.empty()) found.notes.push_back(steps);
  if (!normals) return found;
  const std::vector<NormalPair> pairs = normals->pairs(depth_at, window, camera);
  found.normals = find_form(pairs, camera.pose, {stated.normals, "what is stated of them", true}, found.notes);
  found.are_normals_used = states_anything(stated.normals) || !fit_no_convention(pairs, found.normals, camera.pose);
  if (!found.are_normals_used) found.notes.back() += "; they are not used, and made from the depth";
  // A second look takes a twentieth of a second; whoever states the depth does without.
  constexpr double good_agreement = 0.99;
  const bool is_settled = pairs.empty() || agreement_of(pairs, found.normals, camera.pose) >= good_agreement;
  if (stated.depth.convention == DepthConvention::automatic && !is_settled) {
    const std::string note =
        note_on_contradicted_planar(depth, found.depth, window, camera, {*normals, stated.normals});
    if (!note.empty()) add_new(found.notes, note);
  }
  return found;
}

namespace {

/// Brings the depth of a view to a distance along the viewing axis, where anything is stated of it.
void settle_depth(View& view, Channel& depth, const Window& window, StatedDepth stated,
                  std::vector<std::string>& assumed) {
  if (!states_anything(stated)) return;
  if (stated.convention == DepthConvention::automatic)
    stated.convention = DepthConvention::z;  // as arrays are asked for
  const Plane* alpha = view.find("alpha");
  std::vector<std::string> notes;
  to_view_depth(depth, alpha ? &alpha->channels.front() : nullptr, window, *view.camera, stated, notes);
  add_new(assumed, notes);
}

}  // namespace

void settle_surfaces(Frame& frame, const NewSurfaces& given, const StatedSurfaces& stated) {
  const StatedSurfaces of_new{given.normals ? stated.normals : convention_of({}),
                              given.depth ? stated.depth : StatedDepth{.convention = DepthConvention::z}};
  for (View& view : frame.views) {
    const auto depth = view.planes.find("depth"), normal = view.planes.find("normal");
    if (depth == view.planes.end() || !view.camera) continue;
    std::optional<NormalSamples> samples;
    Channel& values = depth->second.channels.front();
    if (given.depth) settle_depth(view, values, frame.window, stated.depth, frame.assumed);
    if (normal != view.planes.end()) samples.emplace(values.layout()).take(normal->second, 0);
    const StoredSurfaces found =
        look_at_surfaces(rows_of(values), samples ? &*samples : nullptr, frame.window, *view.camera, of_new);
    clean_depth(values, found.depth.sign, found.depth.background);
    add_new(frame.assumed, found.notes);
    if (normal == view.planes.end()) continue;
    if (!found.are_normals_used) {
      view.planes.erase(normal);
      continue;
    }
    bring_to_view_space(normal->second, found.normals, *view.camera);
    if (const std::string missing = note_on_missing_normals(count_missing_normals(normal->second, values));
        !missing.empty())
      add_new(frame.assumed, missing);
  }
}

std::vector<std::string> notes_on_agreement(const View& view, const Window& window) {
  const Plane *depth = view.find("depth"), *normal = view.find("normal");
  std::vector<std::string> notes;
  if (!depth || !normal || !view.camera) return notes;
  NormalSamples samples(depth->channels.front().layout());
  samples.take(*normal, 0);
  find_form(samples.pairs(depth->channels.front(), window, *view.camera), view.camera->pose,
            {convention_of({}), "gloam's convention", true}, notes);
  return notes;
}

}  // namespace gloam
