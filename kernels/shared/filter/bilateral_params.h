// Parameters of the filters that use bilateral.h.
#ifndef GLOAM_BILATERAL_PARAMS_H
#define GLOAM_BILATERAL_PARAMS_H

#define BILATERAL_PARAMS(P)                                                                   \
  P(int, half_width, 4, 0, 32, "pixels", "taps on either side of the pixel, along each axis") \
  P(float, depth_tolerance, 0.05f, 0, INFINITY, "radii",                                      \
    "distance from the tangent plane at which a tap no longer counts")                        \
  P(float, normal_tolerance, 0.5f, 0, 3.14159265f, "radians", "angle between normals at which a tap no longer counts")

#endif
