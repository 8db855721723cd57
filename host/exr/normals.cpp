#include "exr/normals.h"

#include "base/lists.h"
#include "exr/errors.h"
#include "gloam/error.h"

namespace gloam {
namespace {

/// The space that flags, the header and channel names declare.
NormalSpace declared_space(const ExrFile& file, const PlaneSource& normal) {
  if (file.options.normal_space != NormalSpace::automatic) return file.options.normal_space;
  const std::string written = file.headers.text_for_part(normal.channels.front().part, "gloamNormalSpace");
  if (written == "view") return NormalSpace::view;
  if (written == "world") return NormalSpace::world;
  if (normal.said == DeclaredConvention::view_space) return NormalSpace::view;
  if (normal.said == DeclaredConvention::world_space) return NormalSpace::world;
  return file.headers.text("BlenderMultiChannel").empty() ? NormalSpace::automatic : NormalSpace::world;
}

/// The form found from the normals themselves, for normals of undeclared space.
NormalForm detected_form(const ExrFile& file, const View& view, const NormalSamples& samples, Frame& frame) {
  const Plane* depth = view.find("depth");
  if (!depth) {
    add_new(frame.assumed, "normal: taken as view space, since there is no depth to compare with (--normal-space)");
    return {NormalSpace::view};
  }
  std::vector<std::string> notes;
  const NormalForm form =
      named(file.path, [&] { return samples.form(depth->channels.front(), frame.window, *view.camera, notes); });
  add_new(frame.assumed, notes);
  return form;
}

void note_missing(long long missing, Frame& frame) {
  if (missing <= 0) return;
  add_new(frame.assumed,
          fmt::format("normals: {} pixel{} of the foreground {} none (zero or not finite) and read{} open", missing,
                      missing == 1 ? "" : "s", missing == 1 ? "has" : "have", missing == 1 ? "s" : ""));
}

}  // namespace

std::optional<NormalForm> find_normal_form(const ExrFile& file, const View& view, const NormalSamples& samples,
                                           const std::function<long long(const NormalForm&)>& count_missing,
                                           Frame& frame) {
  NormalForm form{declared_space(file, *file.source("normal", view.name))};
  if (form.space == NormalSpace::automatic) form = detected_form(file, view, samples, frame);
  if (form.space == NormalSpace::world && !view.camera->pose) {
    add_new(frame.assumed, "normals: not used, since the camera's pose is unknown (--camera gives it)");
    return {};
  }
  if (view.find("depth")) note_missing(count_missing(form), frame);
  return form;
}

std::optional<NormalForm> convert_normals(const ExrFile& file, View& view, Frame& frame) {
  const auto found = view.planes.find("normal");
  if (found == view.planes.end()) return {};
  Plane& normal = found->second;
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
  const std::optional<NormalForm> form = find_normal_form(file, view, samples, count_missing, frame);
  if (form)
    convert(*form);
  else
    view.planes.erase(found);
  return form;
}

}  // namespace gloam
