#include "exr/radiance.h"

#include "base/lists.h"
#include "gloam/error.h"

namespace gloam {

void note_light(const ExrFile& file, const LightCounts& counts, Frame& frame) {
  if (counts.color.pixels > 0) {
    for (const View& view : frame.views) {
      const PlaneSource* color = file.source("color", view.name);
      if (!color || color->channels.empty()) continue;
      const std::string space = file.headers.text_for_part(color->channels.front().part, "colorInteropID");
      if (!is_linear(space))
        add_new(
            frame.assumed,
            fmt::format(
                "color: the header's colorInteropID '{}' names no scene-linear light, and the values are taken for it "
                "as they are (--plane color=CHANNELS names another colour)",
                space));
    }
  }
  add_new(frame.assumed, counts.notes());
}

}  // namespace gloam
