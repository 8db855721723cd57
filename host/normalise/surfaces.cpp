#include "normalise/surfaces.h"

#include <optional>

#include "base/lists.h"
#include "gloam/error.h"
#include "normalise/normals.h"

namespace gloam {

StoredSurfaces look_at_surfaces(const DepthRows& depth, const NormalSamples* normals, const Window& window,
                                const Camera& camera, const NormalConvention& stated) {
  StoredSurfaces found{.depth = look_at_depth(depth, background_of({}, camera.far), false, "")};
  found.normals = plain_form(stated);
  if (normals && found.normals.space == NormalSpace::world && !camera.pose)
    throw Error("normals in world space need a camera with a pose; give one, or normals in view space");
  found.notes = found.depth.notes;
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
  found.normals = find_form(pairs, camera.pose, {stated, "what is stated of them", true}, found.notes);
  found.are_normals_used = states_anything(stated) || !fit_no_convention(pairs, found.normals, camera.pose);
  if (!found.are_normals_used) found.notes.back() += "; they are not used, and made from the depth";
  return found;
}

void settle_surfaces(Frame& frame, bool has_new_normals, const NormalConvention& stated) {
  for (View& view : frame.views) {
    const auto depth = view.planes.find("depth"), normal = view.planes.find("normal");
    if (depth == view.planes.end() || !view.camera) continue;
    std::optional<NormalSamples> samples;
    Channel& values = depth->second.channels.front();
    if (normal != view.planes.end()) samples.emplace(values.layout()).take(normal->second, 0);
    const StoredSurfaces found = look_at_surfaces(rows_of(values), samples ? &*samples : nullptr, frame.window,
                                                  *view.camera, has_new_normals ? stated : convention_of({}));
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
