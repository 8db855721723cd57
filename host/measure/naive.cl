// Common part of the naive kernels (naive_*.cl). Each computes the same as one of gloam's kernels in the style of a ported GPU
// pixel shader: one pixel per work-item, scalar, float3 positions, native functions, an early return on background.
//
// -D DIRECTIONS, STEPS, COLUMNS, ROWS: loop counts known to the compiler; without them they are settings.
#define GUARD 64

typedef struct {
  int width, height, pitch, seed;
  float scale_x, scale_y, centre_x, centre_y;
} Camera;

// Settings of all kernels; each reads its own.
typedef struct {
  float radius, max_pixels;  // scene units; cap on the radius on the screen
  float bias, strength;
  float distance, one_minus_cosine;  // tolerances of the filter: from the tangent plane, between normals
  int directions, steps, columns, rows;
} Settings;

#ifndef DIRECTIONS
#define DIRECTIONS settings.directions
#define STEPS settings.steps
#endif
#ifndef COLUMNS
#define COLUMNS settings.columns
#define ROWS settings.rows
#endif

int index_of(Camera c, int x, int y) { return GUARD + y * c.pitch + x; }

float3 position(Camera c, int x, int y, float z) {
  return (float3)((x + 0.5f - c.centre_x) * c.scale_x * z, (c.centre_y - y - 0.5f) * c.scale_y * z, -z);
}

// Two numbers per pixel, 0 to 1, the same as in kernels/shared/sampling/sample.h.
float unit_random(uint h) { return (h >> 8) * 0x1p-24f; }
float turn_at(Camera c, int x, int y) { return unit_random(x * 0x8e42b7fdu + y * 0x4f2cbe3cu + c.seed * 0x9e3779b9u); }
float shift_at(Camera c, int x, int y) { return unit_random(x * 0xc13fa9a9u + y * 0x91e10da6u + c.seed * 0x6a09e667u); }
