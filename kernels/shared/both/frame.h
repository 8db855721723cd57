// The frame as kernels see it: its size in memory, its camera, the seed. Kernels and host share this text; the host includes
// it once with FRAME_SCALAR float and once with double.
//
// The camera (camera.h): x = (px - centre_x) * scale_x * (perspective * z + parallel), y upwards likewise, with
// (perspective, parallel) = (1, 0), or (0, 1) for an orthographic camera.

// Floats before the first and after the last row of every plane.
#define FRAME_GUARD 64

#ifdef __OPENCL_C_VERSION__
#include "shared/lanes/lanes.h"
#define FRAME_SCALAR scalar
#define FRAME_NAME Frame
#define NEIGHBOUR_NAME Neighbour
#endif

typedef struct {
  int width, height, pitch;  // pixels; rows are `pitch` floats apart
  int seed;
  FRAME_SCALAR scale_x, scale_y;       // scene units per pixel at depth 1 (perspective) or anywhere (orthographic); > 0
  FRAME_SCALAR centre_x, centre_y;     // principal point, pixels from the left top corner
  FRAME_SCALAR perspective, parallel;  // (1, 0) or (0, 1)
} FRAME_NAME;

// The other view, or this view in the frame before. A point p in this view's space (scene units) is rotation * p + translation in
// the other's.
typedef struct {
  FRAME_NAME frame;
  FRAME_SCALAR rotation[9];  // by rows
  FRAME_SCALAR translation[3];
} NEIGHBOUR_NAME;

#ifdef __OPENCL_C_VERSION__
typedef char frame_size_check[sizeof(Frame) == 16 + 6 * sizeof(scalar) ? 1 : -1];
typedef char neighbour_size_check[sizeof(Neighbour) == sizeof(Frame) + 12 * sizeof(scalar) ? 1 : -1];
#endif
