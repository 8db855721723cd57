// The virtual image: to an eye, what a mirror shows seems to lie behind the mirror.
#ifndef GLOAM_SSR_VIRTUAL_IMAGE_H
#define GLOAM_SSR_VIRTUAL_IMAGE_H

#include "shared/frame/neighbour.h"
#include "ssr/reflector.h"

// Where the other eye, or the eye of the frame before, sees the virtual image of what the pixel's rays meet at this distance: on
// the plane of the surface, on the line from the virtual image to that eye.
static inline Projection same_virtual_image(Frame frame, Neighbour n, Reflector s, real length, mask counts) {
  const real3 p = position_at(frame, s.point.x, s.point.y, s.depth);
  const real3 away = out_of_frame(s, scale3(s.to_eye, (real)(-1)));
  const real3 zero = make3((real)(0), (real)(0), (real)(0)), eye = back_from_other(n, zero);
  const real3 image = make3(p.x + away.x * length, p.y + away.y * length, p.z + away.z * length);
  const real3 beyond = back_from_other(n, make3((real)(0), (real)(0), (real)(1)));
  const real3 to_eye = n.frame.perspective > 0 ? make3(eye.x - image.x, eye.y - image.y, eye.z - image.z)
                                               : make3(beyond.x - eye.x, beyond.y - eye.y, beyond.z - eye.z);
  const real rise = dot3(to_eye, s.normal), behind = dot3(scale3(away, length), s.normal);
  const mask meets = counts & (rise > 0) & (behind < 0);
  const real share = -behind / choose(meets, rise, (real)(1));
  return project_into(n, make3(image.x + to_eye.x * share, image.y + to_eye.y * share, image.z + to_eye.z * share),
                      meets);
}

#endif
