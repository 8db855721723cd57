#include "exr/radiance.h"

#include "base/lists.h"
#include "gloam/error.h"
#include "gloam/unfit.h"

namespace gloam {

void note_light(const ExrFile& file, const LightCounts& counts, Frame& frame) {
  std::vector<std::string> judged;  // a user who names a channel means it
  for (const char* plane : {"color", "albedo"})
    if (!file.options.channels.contains(plane)) judged.emplace_back(plane);
  if (counts.color.pixels > 0) {
    for (const View& view : frame.views) {
      const PlaneSource* color = file.source("color", view.name);
      if (!color || color->channels.empty()) continue;
      const std::string space = file.headers.text_for_part(color->channels.front().part, "colorInteropID");
      if (is_linear(space)) continue;
      const std::string why = fmt::format(
          "the header's colorInteropID '{}' names no scene-linear light, and the values are taken for it as they are",
          space);
      add_new(frame.assumed, contains(judged, "color") ? note_on({"color", why}) : "color: " + why);
    }
  }
  add_new(frame.assumed, counts.notes(judged));
}

}  // namespace gloam
