#include "exr/normals.h"

#include "base/lists.h"
#include "exr/errors.h"
#include "gloam/error.h"
#include "gloam/option.h"

namespace gloam {
namespace {

/// The space that the header or the channels' names state, and what states it.
NormalSpace named_space(const ExrFile& file, const PlaneSource& normal, std::string& by) {
  const ChannelSource& first = normal.channels.front();
  const bool is_named = normal.said == DeclaredConvention::view_space || normal.said == DeclaredConvention::world_space;
  if (is_named) {
    by = fmt::format("the name '{}'", first.name);
    return normal.said == DeclaredConvention::view_space ? NormalSpace::view : NormalSpace::world;
  }
  by = "the header of Blender (BlenderMultiChannel)";
  return file.headers.text("BlenderMultiChannel").empty() ? NormalSpace::automatic : NormalSpace::world;
}

/// What the file states: all of the convention by gloam's own attribute, the space by a name.
StatedNormals stated_by_file(const ExrFile& file, const PlaneSource& normal) {
  if (file.options.plane_files.contains("normal")) return {};  // of which the frame's header says nothing
  const std::string written = file.headers.text_for_part(normal.channels.front().part, "gloamNormalSpace");
  if (written == "view" || written == "world")
    return {{written == "view" ? NormalSpace::view : NormalSpace::world, NormalRange::signed_values, plain_axes},
            "gloamNormalSpace in the header"};
  StatedNormals stated;
  stated.convention.space = named_space(file, normal, stated.by);
  return stated;
}

/// What flags state, then the file, then the shot that its frame belongs to.
StatedNormals stated_with_shot(const ExrFile& file, const PlaneSource& normal, bool& is_of_shot,
                               std::vector<std::string>& notes) {
  const NormalConvention& flags = file.options.normals;
  StatedNormals stated = stated_by_file(file, normal);
  std::vector<std::string> by;
  if (flags.space != NormalSpace::automatic) by.push_back(option("normal-space"));
  if (flags.range != NormalRange::automatic) by.push_back(option("normal-range"));
  if (flags.axes) by.push_back(option("normal-axes"));
  if (flags.space == NormalSpace::automatic && stated.convention.space != NormalSpace::automatic)
    by.push_back(stated.by);
  stated.by = enumerate(by);
  stated.convention = with_unstated(flags, stated.convention);
  if (file.options.shot_normals && !is_whole(stated.convention)) {
    const FoundNormals shot = file.options.shot_normals(file.path);
    is_of_shot = is_whole(shot.convention);
    stated.convention = with_unstated(stated.convention, shot.convention);
    add_new(notes, shot.notes);
  }
  return stated;
}

/// Whether the user says which channels are the normals, or anything of what they hold.
bool are_chosen(const ExrFile& file) {
  return file.options.channels.contains("normal") || states_anything(file.options.normals);
}

/// The form that is stated of the normals, or that they show; none where they fit none, and nobody has chosen them.
std::optional<NormalForm> form_of(const ExrFile& file, const View& view, const NormalSamples& samples, Frame& frame,
                                  FoundNormals& found) {
  const Plane* depth = view.find("depth");
  std::vector<std::string> notes, of_frame;
  bool is_of_shot = false;
  const StatedNormals stated = stated_with_shot(file, *file.source("normal", view.name), is_of_shot, notes);
  if (!depth && stated.convention.space == NormalSpace::automatic)
    notes.push_back(fmt::format("normal: taken as view space, since there is no depth to compare with ({})",
                                option("normal-space")));
  std::vector<NormalPair> pairs;
  if (depth)
    pairs = named(file.path, [&] { return samples.pairs(depth->channels.front(), frame.window, *view.camera); });
  const NormalForm form = find_form(pairs, view.camera->pose, stated, of_frame);
  const bool is_used = are_chosen(file) || of_frame.empty() || !fit_no_convention(pairs, form, view.camera->pose);
  if (!is_used)
    of_frame.back() += fmt::format("; they are not used ({} has them taken)", channels_option("normal", "CHANNELS"));
  else if (is_of_shot && !of_frame.empty())
    of_frame = {
        fmt::format("normals: not all frames of the shot agree best with the convention that was found for it ({}, {} "
                    "and {} state one)",
                    option("normal-space"), option("normal-range"), option("normal-axes"))};
  if (depth) add_new(notes, of_frame);
  add_new(frame.assumed, notes);
  if (!pairs.empty() && !is_whole(found.convention)) found = {convention_of(form), notes};
  return is_used ? std::optional(form) : std::nullopt;
}

}  // namespace

NormalConvention stated_normals(const ExrFile& file, const PlaneSource& normal) {
  return with_unstated(file.options.normals, stated_by_file(file, normal).convention);
}

std::optional<NormalForm> find_normal_form(const ExrFile& file, const View& view, const NormalSamples& samples,
                                           const std::function<long long(const NormalForm&)>& count_missing,
                                           Frame& frame, FoundNormals& found) {
  const std::optional<NormalForm> form = form_of(file, view, samples, frame, found);
  if (!form) return {};
  if (form->space == NormalSpace::world && !view.camera->pose) {
    add_new(frame.assumed, "normals: not used, since the camera's pose is unknown (" + option("camera") + " gives it)");
    return {};
  }
  if (!view.find("depth")) return form;
  if (const std::string note = note_on_missing_normals(count_missing(*form)); !note.empty())
    add_new(frame.assumed, note);
  return form;
}

std::optional<NormalForm> convert_normals(const ExrFile& file, View& view, Frame& frame, FoundNormals& found) {
  const auto plane = view.planes.find("normal");
  if (plane == view.planes.end()) return {};
  Plane& normal = plane->second;
  NormalSamples samples(normal.channels.front().layout());
  samples.take(normal, 0);
  bool is_converted = false;
  const auto convert = [&](const NormalForm& form) {
    if (!is_converted) bring_to_view_space(normal, form, *view.camera);
    is_converted = true;
  };
  const auto count_missing = [&](const NormalForm& form) {
    convert(form);
    return count_missing_normals(normal, view.find("depth")->channels.front());
  };
  const std::optional<NormalForm> form = find_normal_form(file, view, samples, count_missing, frame, found);
  if (form)
    convert(*form);
  else
    view.planes.erase(plane);
  return form;
}

}  // namespace gloam
