#include "exr/reflectance.h"

#include "base/lists.h"
#include "gloam/error.h"
#include "normalise/reflectance.h"

namespace gloam {

bool may_be_white_by_default(const ExrFile& file, const View& view) {
  const PlaneSource* reflectance = file.source("reflectance", view.name);
  return reflectance && view.find("depth") && !file.options.channels.contains("reflectance") &&
         reflectance->channels.front().name.find("GlossCol") != std::string::npos;
}

void note_white_reflectance(double share, Frame& frame) {
  if (share < 0.5) return;
  add_new(frame.assumed,
          fmt::format("reflectance: GlossCol is 1 on {:.0f} % of the surfaces, as a Principled BSDF writes it for "
                      "any material: reflections will be far too bright (--plane reflectance=none takes 0.04)",
                      100 * share));
}

void check_reflectance(const ExrFile& file, const View& view, Frame& frame) {
  const Plane* reflectance = view.find("reflectance");
  if (!reflectance || !may_be_white_by_default(file, view)) return;
  WhitePixels white;
  white.add(*reflectance, view.find("depth")->channels.front(), 0);
  note_white_reflectance(white.share(), frame);
}

}  // namespace gloam
