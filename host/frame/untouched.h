// The light in a frame's colour that ambient occlusion leaves as it is, and the light that it darkens.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gloam/frame.h"

namespace gloam {

/// Planes of light that is part of `color` and that no occlusion darkens: emission, backdrop, volume, transmission.
const std::vector<std::string>& untouched_planes();
/// Those of a frame's planes.
std::vector<std::string> untouched_of(const std::vector<std::string>& frame);
/// Whether the frame tells its diffuse light by `illumination` times `albedo`, which occlusion then darkens and nothing else.
bool has_illumination(const std::vector<std::string>& frame);
/// All planes of a frame that tell what of its colour is darkened.
const std::vector<std::string>& planes_of_darkened_light();

/// "emission (ViewLayer.Emit)"; where the file has no other name for it, "emission".
std::string called_in_file(const std::string& plane, const std::map<std::string, std::string>& names);

/// "emission (ViewLayer.Emit) and volume: not darkened, ...". `names`: what the file calls planes; may lack some.
std::string note_on_untouched(const std::vector<std::string>& planes, const std::map<std::string, std::string>& names);
std::string note_on_illumination(const std::map<std::string, std::string>& names);

/// Leaves out planes that are dark; a backdrop that is more than the colour where it is anything, as of a film that does not show it; and
/// where another plane is more than the colour, all of them and the illumination: the colour is then a pass itself. Appends sentences.
void leave_out_other_light(Frame& colour, std::vector<std::string>& notes);

/// The channel of a plane for a component of colour; planes of one component have it for all. Null without the plane. Throws Error for
/// another size.
const Channel* channel_for(const Plane* plane, size_t component, const Layout& layout);

/// One component of a view's light.
class DarkenedLight {
 public:
  DarkenedLight(const View& view, size_t component);
  /// Whether all of the colour is darkened.
  bool is_all() const { return untouched_.empty() && !illumination_; }
  /// The sum of the untouched planes, from 0.
  void untouched(int y, float* to) const;
  /// Illumination times albedo; only where the view has both.
  void illuminated(int y, float* to) const;
  /// What is darkened of a row of colour: illumination times albedo, or all of it; at most colour less the untouched light.
  void darkened(int y, const float* colour, float* to) const;

 private:
  Layout layout_;
  std::vector<const Channel*> untouched_;
  const Channel *illumination_ = nullptr, *albedo_ = nullptr;
};

}  // namespace gloam
