#include "camera/camera_range.h"

namespace gloam {

bool is_sensible_scale(double pixels, bool orthographic) {
  return orthographic ? pixels >= 1e-12 && pixels <= 1e12 : pixels >= 1e-6 && pixels <= 1e7;
}

const char* sensible_scale(bool orthographic) {
  return orthographic ? "1e-12 to 1e12 pixels per unit" : "1e-6 to 1e7 pixels";
}

}  // namespace gloam
