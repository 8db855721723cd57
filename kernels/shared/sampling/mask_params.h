// Parameters of masks that search directions from one pixel of each cell (cells.h, fan.h).
#ifndef GLOAM_MASK_PARAMS_H
#define GLOAM_MASK_PARAMS_H

#define MASK_SEARCH_PARAMS(P)                                                                          \
  P(int, search_directions, 8, 1, 32, "", "directions searched from the pixel that stands for a cell") \
  P(int, search_steps, 3, 1, 32, "", "samples along each direction")                                   \
  P(float, least_sine, 0.02f, 0.001f, 1, "",                                                           \
    "something occludes if the sine of its elevation over the tangent plane is at least this")

#define MASK_CELL(P) P(int, cell, 4, 2, 16, "pixels", "width and height of a cell of the mask")

#endif
