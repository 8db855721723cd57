// From the whole image to every `scale`-th pixel each way, and back by joint bilateral upsampling (Kopf, Cohen,
// Lischinski, Uyttendaele 2007).
//
// subsample: `frame` is the reduced one, `other` the whole. Pixel (x, y) is pixel (x, y) * SCALE of the whole.
// joint_upsample (OpenCL has an `upsample` of its own): `frame` is the whole, `other` the reduced one. Of the four reduced pixels around each pixel those count that
//            show the same surface, by bilinear weights; where none does, the one nearest to the pixel's tangent plane.
// -D SCALE, SOURCE_LAYERS (subsample_stack)
#include "resample/params.h"
#include "shared/surface.h"

kernel void subsample(Frame frame, Frame other, ResampleParams params, PLANE source, PLANE_OUT result) {
  const int from = index_of(other, FIRST_X * SCALE, ROW_Y * SCALE), to = index_of(frame, FIRST_X, ROW_Y);
  store(gather(source + from, IOTA * (integer)(SCALE)), result, to);
}

kernel void subsample_vector(Frame frame, Frame other, ResampleParams params, PLANE source_x, PLANE source_y,
                             PLANE source_z, PLANE_OUT result_x, PLANE_OUT result_y, PLANE_OUT result_z) {
  const int from = index_of(other, FIRST_X * SCALE, ROW_Y * SCALE), to = index_of(frame, FIRST_X, ROW_Y);
  const integer step = IOTA * (integer)(SCALE);
  store(gather(source_x + from, step), result_x, to);
  store(gather(source_y + from, step), result_y, to);
  store(gather(source_z + from, step), result_z, to);
}

#ifdef SOURCE_LAYERS
kernel void subsample_stack(Frame frame, Frame other, ResampleParams params, PLANE source, PLANE_OUT result) {
  const int from = index_of(other, FIRST_X * SCALE, ROW_Y * SCALE), to = index_of(frame, FIRST_X, ROW_Y);
  for (int k = 0; k < SOURCE_LAYERS; ++k) {
    const real depth = gather(layer_of(source, other, k) + from, IOTA * (integer)(SCALE));
    store(depth, layer_of_out(result, frame, k), to);
  }
}
#endif

// A row of reduced pixels, each SCALE times.
#if LANES == 1
static inline real spread(real v) { return v; }
#else
#ifdef REAL_DOUBLE
#define SPREAD_INDEX JOIN(convert_, N_LANES(ulong))
#else
#define SPREAD_INDEX JOIN(convert_, N_LANES(uint))
#endif
static inline real spread(real v) { return shuffle(v, SPREAD_INDEX(IOTA / SCALE)); }
#endif

// What the four reduced pixels around a pixel have found so far.
typedef struct {
  real weights;  // of those on the same surface
  real nearest;  // least distance from the tangent plane
} Found;

// One of the four, (i, j) reduced pixels right of and below the one at or left above; `share`: its bilinear weight.
// Returns its weight; `is_nearest` tells whether it is the nearest one to the tangent plane so far.
static inline real weigh(Frame frame, Frame other, Anchor p, real z, real3 n, Tolerance tolerance, real share, int i,
                         int j, int there, PLANE depth, PLANE normal_x, PLANE normal_y, PLANE normal_z, Found* found,
                         mask* is_nearest) {
  const int column = FIRST_X / SCALE, row = ROW_Y / SCALE + j;
  const integer x = (FIRST_X + IOTA) / SCALE + i;
  const mask inside = to_mask((x < other.width) & (integer)(row < other.height ? -1 : 0));
  const real3 v =
      towards(frame, p, to_real(x * SCALE), (real)(row * SCALE), relative_depth(p, z, spread(load(depth, there))));
  const real3 normal =
      make3(spread(load(normal_x, there)), spread(load(normal_y, there)), spread(load(normal_z, there)));
  const real weight = choose(inside, share * same_surface(tolerance, v, n, normal), (real)(0));
  const real distance = choose(inside & (share > 0), fabs(dot3(n, v)), (real)(FARTHEST));
  *is_nearest = distance < found->nearest;
  found->nearest = smaller(distance, found->nearest);
  found->weights += weight;
  return weight;
}

#define FOR_FOUR(BODY)                                                                                         \
  for (int j = 0; j < 2; ++j) {                                                                                \
    for (int i = 0; i < 2; ++i) {                                                                              \
      const int there = index_of(other, FIRST_X / SCALE + i, min(ROW_Y / SCALE + j, other.height - 1));        \
      const real share = (i == 0 ? 1 - right : right) * (j == 0 ? 1 - below : below);                          \
      mask is_nearest;                                                                                         \
      const real weight = weigh(frame, other, p, z, n, tolerance, share, i, j, there, low_depth, low_normal_x, \
                                low_normal_y, low_normal_z, &found, &is_nearest);                              \
      BODY                                                                                                     \
    }                                                                                                          \
  }

// Where the four are, and the pixel itself.
#define AT_HAND                                                                                                 \
  const int x0 = FIRST_X, y = ROW_Y, here = index_of(frame, x0, y);                                             \
  const integer x = x0 + IOTA;                                                                                  \
  const real z = load(depth, here);                                                                             \
  const real3 n = load3(normal_x, normal_y, normal_z, here);                                                    \
  const Anchor p = anchor_at(frame, to_real(x), (real)(y), z);                                                  \
  const Tolerance tolerance = tolerance_of(p, params.depth_tolerance * params.radius, params.normal_tolerance); \
  const real right = to_real(x % SCALE) * (scalar)(1.0f / SCALE);                                               \
  const scalar below = (scalar)(y % SCALE) * (scalar)(1.0f / SCALE);                                            \
  Found found;                                                                                                  \
  found.weights = 0;                                                                                            \
  found.nearest = (real)(FARTHEST);

kernel void joint_upsample(Frame frame, Frame other, ResampleParams params, PLANE source, PLANE low_depth, PLANE low_normal_x,
                     PLANE low_normal_y, PLANE low_normal_z, PLANE depth, PLANE normal_x, PLANE normal_y,
                     PLANE normal_z, PLANE_OUT result) {
  AT_HAND
  real sum = 0, single = 1;
  FOR_FOUR({
    const real value = spread(load(source, there));
    sum += weight * value;
    single = choose(is_nearest, value, single);
  })
  const real open = choose(found.weights > (scalar)1e-3f, sum / larger(found.weights, (real)(1e-3f)), single);
  store(choose(p.background, (real)(1), open), result, here);
}

kernel void joint_upsample_vector(Frame frame, Frame other, ResampleParams params, PLANE source_x, PLANE source_y,
                            PLANE source_z, PLANE low_depth, PLANE low_normal_x, PLANE low_normal_y, PLANE low_normal_z,
                            PLANE depth, PLANE normal_x, PLANE normal_y, PLANE normal_z, PLANE_OUT result_x,
                            PLANE_OUT result_y, PLANE_OUT result_z) {
  AT_HAND
  real3 sum = make3((real)(0), (real)(0), (real)(0)), single = n;
  FOR_FOUR({
    const real3 v = make3(spread(load(source_x, there)), spread(load(source_y, there)), spread(load(source_z, there)));
    sum = make3(sum.x + weight * v.x, sum.y + weight * v.y, sum.z + weight * v.z);
    single = choose3(is_nearest, v, single);
  })
  const real square = dot3(sum, sum);
  const mask usable = square > (scalar)1e-6f;
  const real3 unit = scale3(sum, inverse_sqrt(choose(usable, square, (real)(1))));
  const real3 direction = choose3(usable, unit, single);
  const real sign = choose(p.background, (real)(0), (real)(1));
  store(direction.x * sign, result_x, here);
  store(direction.y * sign, result_y, here);
  store(direction.z * sign, result_z, here);
}
