// Specular occlusion: the share of a glossy surface's lobe that is open, a factor on what it reflects of the environment. The lobe is
// GGX, alpha = roughness^2. With A the AO, n.v the cosine of the normal to the eye, and r the eye's mirror direction:
//   lagarde  saturate((n.v + A)^(2^(-16 alpha - 1)) - 1 + A)  (Lagarde, de Rousiers 2014, section 4.10.2)
//   cone     of the cap about r that half of the microfacets reflect into, the part within the hemisphere about the normal: its share
//            within the open cone about the bent normal (Jimenez, Wu, Pesce, Jarabo 2016, section 7)
//   sectors  the mean of what slices find closed of the lobe (estimators/glossy_lobe.h), filtered over neighbours on the same surface
//
// in : depth      view-space z, +inf = background
//      normal     unit, view space
//      roughness  perceptual
//      ao | bent_normal, cone | specular_occlusion_raw (`open`), lobe_weight
// out: specular_occlusion  1 = open .. 0 = closed; 1 on background
// -D COLUMNS, ROWS, WEIGHTED
#include "shared/filter/bilateral.h"
#include "shared/rays/ggx.h"
#include "specular_occlusion/caps.h"
#include "specular_occlusion/powers.h"

// A pixel's surface, and how the eye sees it.
typedef struct {
  mask background;
  real3 normal, to_eye;
  real facing, roughness, alpha;
} Glossy;

static inline Glossy glossy_at(Frame frame, int here, PLANE depth, PLANE normal_x, PLANE normal_y, PLANE normal_z,
                               PLANE roughness) {
  Glossy g;
  g.background = is_background(load(depth, here));
  g.normal = load3(normal_x, normal_y, normal_z, here);
  g.to_eye = scale3(exactly_normalised(view_ray(frame, to_real(FIRST_X + IOTA), (real)(ROW_Y))), (real)(-1));
  g.facing = clamp(dot3(g.normal, g.to_eye), (real)(0), (real)(1));
  g.roughness = clamp(load(roughness, here), (real)(0), (real)(1));
  g.alpha = g.roughness * g.roughness;
  return g;
}

static inline void store_share(Glossy g, real open, PLANE_OUT result, int here) {
  store(choose(g.background, (real)(1), smaller(larger(open, (real)(0)), (real)(1))), result, here);
}

// in : depth, normal, roughness, ao
// out: result
kernel void specular_occlusion_from_ao(ARGUMENTS) {
  const int here = index_of(frame, FIRST_X, ROW_Y);
  const Glossy g = glossy_at(frame, here, depth, normal_x, normal_y, normal_z, roughness);
  const real open = clamp(load(ao, here), (real)(0), (real)(1));
  store_share(g, power(g.facing + open, binary_power((scalar)-16 * g.alpha - 1)) - 1 + open, result, here);
}

// The narrowest lobe whose cap float can tell from a point.
#define NARROWEST ((scalar)0.03f)

// in : depth, normal, roughness, bent_normal, cone
// out: result
kernel void specular_occlusion_from_cone(ARGUMENTS) {
  const int here = index_of(frame, FIRST_X, ROW_Y);
  const Glossy g = glossy_at(frame, here, depth, normal_x, normal_y, normal_z, roughness);
  const real3 bent = load3(bent_normal_x, bent_normal_y, bent_normal_z, here);
  const real twice = 2 * dot3(g.normal, g.to_eye);
  const real3 mirrored =
      make3(twice * g.normal.x - g.to_eye.x, twice * g.normal.y - g.to_eye.y, twice * g.normal.z - g.to_eye.z);
  // GGX has half of its microfacets within tan = alpha of the normal; their directions are turned twice as far.
  const real alpha = larger(g.alpha, (real)(NARROWEST)), square = alpha * alpha;
  const Cap lobe = cap_of((1 - square) / (1 + square));
  const real narrowed = clamp(load(cone, here), (real)(0), (real)(1));
  const Cap open = cap_of(narrowed), hemisphere = cap_of((real)(0));
  const real all = common_share(lobe, hemisphere, clamp(dot3(mirrored, g.normal), (real)(-1), (real)(1)));
  const real seen = common_share(lobe, open, clamp(dot3(mirrored, bent), (real)(-1), (real)(1)));
  // A cone that is the surface's hemisphere to rounding is open: seen edge-on, narrow lobes would magnify the last bits of the bent
  // normal.
  const mask is_hemisphere = (narrowed <= (scalar)1e-6f) & (dot3(g.normal, bent) > (scalar)(1 - 5e-7f));
  const mask is_there = (all > (scalar)1e-6f) & !is_hemisphere;
  store_share(g, choose(is_there, quotient(seen, choose(is_there, all, (real)(1))), (real)(1)), result, here);
}

// How far a lobe of another roughness is another lobe.
#define SAME_ROUGHNESS ((scalar)0.2f)

typedef struct {
  real sum, weight;
} Sums;

// Adds a pixel (i, j) away. `open` and `weight`: of that pixel.
static inline void add_neighbour(Sums* sums, Frame frame, TangentPlane plane, Glossy g, integer x, int i, int j,
                                 int there, PLANE depth, PLANE normal_x, PLANE normal_y, PLANE normal_z,
                                 PLANE roughness, real sum, real weight) {
  const real step = (scalar)i * plane.per_column + (scalar)j * plane.per_row;
  const real alike = larger(1 - fabs(load(roughness, there) - g.roughness) * (1 / SAME_ROUGHNESS), (real)(0));
  const real w = window_at(i, COLUMNS) * window_at(j, ROWS) * alike *
                 same_surface(plane, frame, step, load(depth, there), load3(normal_x, normal_y, normal_z, there));
  const mask counts = to_mask(to_natural(x + i) < (natural)((uint)frame.width));
  const real counted = choose(EVERY_LANE_IF(i == 0 && j == 0), (real)(1), choose(counts, w, (real)(0)));
  // What lies beside the image may be NaN.
  sums->sum += counted * choose(counts, sum, (real)(0));
  sums->weight += counted * choose(counts, weight, (real)(0));
}

#define FOR_NEIGHBOURS(i, j)                        \
  for (int j = -ROWS; j <= ROWS; ++j)               \
    if (ROW_Y + j >= 0 && ROW_Y + j < frame.height) \
      for (int i = -COLUMNS; i <= COLUMNS; ++i)

static inline TangentPlane plane_at(Frame frame, Params params, Glossy g, int here, PLANE depth) {
  return tangent_plane_at(frame, to_real(FIRST_X + IOTA), (real)(ROW_Y), load(depth, here), g.normal,
                          params.depth_tolerance * params.radius, params.normal_tolerance);
}

// in : depth, normal, roughness, open; lobe_weight
// out: sum, weight
kernel void specular_occlusion_rows(ARGUMENTS) {
  const int here = index_of(frame, FIRST_X, ROW_Y);
  const Glossy g = glossy_at(frame, here, depth, normal_x, normal_y, normal_z, roughness);
  const TangentPlane plane = plane_at(frame, params, g, here, depth);
  Sums sums = {(real)(0), (real)(0)};
  FOR_NEIGHBOURS(i, j) {
    const int there = here + j * frame.pitch + i;
#if WEIGHTED
    const real known = load(lobe_weight, there);
#else
    const real known = 1;
#endif
    add_neighbour(&sums, frame, plane, g, FIRST_X + IOTA, i, j, there, depth, normal_x, normal_y, normal_z, roughness,
                  known * load(open, there), known);
  }
  store(sums.sum, sum, here);
  store(sums.weight, weight, here);
}

// in : depth, normal, roughness, sum, weight
// out: result
kernel void specular_occlusion_columns(ARGUMENTS) {
  const int here = index_of(frame, FIRST_X, ROW_Y);
  const Glossy g = glossy_at(frame, here, depth, normal_x, normal_y, normal_z, roughness);
  const TangentPlane plane = plane_at(frame, params, g, here, depth);
  Sums sums = {(real)(0), (real)(0)};
  FOR_NEIGHBOURS(i, j) {
    const int there = here + j * frame.pitch + i;
    add_neighbour(&sums, frame, plane, g, FIRST_X + IOTA, i, j, there, depth, normal_x, normal_y, normal_z, roughness,
                  load(sum, there), load(weight, there));
  }
  const mask is_known = sums.weight > 0;
  store_share(g, mean_up_to_one(choose(is_known, sums.sum, (real)(1)), choose(is_known, sums.weight, (real)(1))), result, here);
}
