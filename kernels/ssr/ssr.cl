// Stochastic screen-space reflections (Stachowiak and Uludag 2015): rays chosen by what the surface reflects, followed through
// the depth; each pixel then weighs its neighbours' rays by BRDF / pdf.
//
// Stereo-consistent (Wu, Xu, Wang 2024, section 4): rays go on in the other eye's image where this one's ends or is behind
// something (TRAVERSAL), hits fade by the image that shows them nearer to its middle (FADE), and the other eye's rays towards the
// same virtual image count too (REPROJECTION).
//
// in : depth        view-space z, scene units, +inf = background
//      normal       unit, view space
//      color        radiance, the same in every direction; of background too, where rays that meet nothing end
//      roughness    perceptual
//      reflectance  at normal incidence
//      back_depth   of the back of what is seen (TRAVERSAL); instance (REPROJECTION); other_...  of the other eye
// out: reflection   radiance towards the eye; a = share of it that was found in the image
//      hit          length of the (first) reflected ray, scene units; 0 where nothing was met, and of background
//      frames       how many frames reflection is the mean of (TEMPORAL, which reads motion and history... of the frame before)
// between: list    rays that are followed: layer * floats per layer + pixel (pixel_list.h)
//      met      what each met (keep_met); left_at, met_in_other  where it left this image, and what it met in the other's
//      nearness, farness  hierarchy (screen_ray.h)
//      ray_x, _y, _z  direction, unit, view space; ray_length scene units, +inf towards background, 0 of a miss
//      ray_r, _g, _b  what it sees; ray_density  per solid angle, 0 where there is no ray, +inf of a mirror
//      ray_confidence  0 of a miss .. 1
//      RAYS layers of each.
// -D LEVELS, BOTH_DEPTHS, LEVEL (ssr_level), RAYS, NEIGHBOURS, JITTER, STEREO, TRAVERSAL, FADE, REPROJECTION, OTHER_NEIGHBOURS,
//    IN_OTHER (ssr_march), TEMPORAL, MASKED, MASK_ALONE (reflection-mask: mirrors for all surfaces, and ssr_found)
#include "shared/lanes/pixel_list.h"
#include "shared/lanes/wanted.h"
#include "shared/rays/ggx.h"
#include "shared/rays/screen_ray.h"
#include "shared/sampling/sample.h"
#include "ssr/params.h"
#if STEREO || TEMPORAL
#include "shared/frame/neighbour.h"
#endif
#if TEMPORAL
#include "shared/frame/history.h"
#endif

// --- Hierarchy

kernel void ssr_nearness(Frame frame, Params params, PLANE depth,
#if TRAVERSAL
                         PLANE back_depth,
#endif
                         global float* nearness, PIXEL_LIST_OUT list
#if TRAVERSAL
                         ,
                         global float* farness, PIXEL_LIST_OUT others
#endif
) {
  const int here = index_of(frame, FIRST_X, ROW_Y), cell = index_of_tile_row(frame, FIRST_X, ROW_Y);
  const real z = load(depth, here), least = (real)(nearness_of_background(frame));
  const mask is_inside = to_mask(FIRST_X + IOTA < frame.width) & !is_background(z);
  const real nearest = choose(is_inside, nearness_of(frame, choose(is_inside, z, (real)(1))), least);
  store(nearest, nearness, cell);
  if (FIRST_X == 0 && ROW_Y == 0) empty_list(list);
#if TRAVERSAL
  // As far as a surface reaches: to its back, where that is known.
  const real back = load(back_depth, here);
  const mask has_back = is_inside & !is_background(back);
  store(choose(has_back, smaller(nearness_of(frame, choose(has_back, back, (real)(1))), nearest), nearest), farness,
        cell);
  if (FIRST_X == 0 && ROW_Y == 0) empty_list(others);
#endif
}

#ifdef LEVEL
// Of each two cells that follow one another in row y, the first and the second; for the row of cells above them.
static inline void load_pairs(PLANE level, Frame image, int y, real* first, real* second) {
#if LANES == 1
  *first = load(level, index_of_tile_row(image, 2 * FIRST_X, y));
  *second = load(level, index_of_tile_row(image, 2 * FIRST_X + 1, y));
#else
  const stored a = JOIN(vload, LANES)(0, level + index_of_tile_row(image, 2 * FIRST_X, y));
  // Beyond the last tile there is nothing, and nothing is made of it.
  const int next = min(2 * FIRST_X + LANES, image.pitch - LANES);
  const stored b = JOIN(vload, LANES)(0, level + index_of_tile_row(image, next, y));
  stored even, odd;
  even.lo = a.even;
  even.hi = b.even;
  odd.lo = a.odd;
  odd.hi = b.odd;
  *first = to_real(even);
  *second = to_real(odd);
#endif
}

// Rows `y` and `next` of the level below.
static inline real larger_of_four(PLANE level, Frame image, int y, int next) {
  real a, b, c, d;
  load_pairs(level, image, y, &a, &b);
  load_pairs(level, image, next, &c, &d);
  return larger(larger(a, b), larger(c, d));
}

// Columns beyond `columns` do not count.
static inline real smaller_of_four(PLANE level, Frame image, int y, int next, int columns) {
  real a, b, c, d;
  load_pairs(level, image, y, &a, &b);
  load_pairs(level, image, next, &c, &d);
  const mask has_second = to_mask(2 * (FIRST_X + IOTA) + 1 < columns);
  return choose(has_second, smaller(smaller(a, b), smaller(c, d)), smaller(a, c));
}

// `frame` is the level, `other` the image.
kernel void ssr_level(Frame frame, Frame other, Params params, global float* nearness, global float* farness) {
  const int below = LEVEL - 1, columns = (other.width + (1 << below) - 1) >> below;
  const int rows = (other.height + (1 << below) - 1) >> below, y = 2 * ROW_Y, next = min(y + 1, rows - 1);
  const int layer = floats_of_layer(other), here = index_of_tile_row(other, FIRST_X, ROW_Y);
  global const float* near_below = nearness + (size_t)LAYER_OF(below) * layer;
  const mask is_inside = to_mask(FIRST_X + IOTA < frame.width);
  const real nearest = larger_of_four(near_below, other, y, next);
  store(choose(is_inside, nearest, (real)(nearness_of_background(other))), nearness + (size_t)LAYER_OF(LEVEL) * layer,
        here);
#if LEVEL == 1 && !TRAVERSAL
  // Of single pixels the nearest is the farthest too.
  global const float* far_below = near_below;
#else
  global const float* far_below = farness + (size_t)LAYER_OF(below) * layer;
#endif
  store(smaller_of_four(far_below, other, y, next, columns), farness + (size_t)LAYER_OF(LEVEL) * layer, here);
}
#else

// --- The surface at hand

typedef struct {
  Anchor point;
  real depth;
  real3 normal, first, second;  // view space: the surface's frame
  real3 to_eye;                 // in that frame
  real roughness, alpha;
  mask reflects, is_mirror;
} Reflector;

static inline real3 into_frame(Reflector s, real3 v) {
  return make3(dot3(v, s.first), dot3(v, s.second), dot3(v, s.normal));
}

static inline real3 out_of_frame(Reflector s, real3 v) {
  return make3(s.first.x * v.x + s.second.x * v.y + s.normal.x * v.z,
               s.first.y * v.x + s.second.y * v.y + s.normal.y * v.z,
               s.first.z * v.x + s.second.z * v.y + s.normal.z * v.z);
}

// At normal incidence; more than all cannot be reflected.
static inline real3 reflectance_at(PLANE r, PLANE g, PLANE b, int here) {
  const real3 f = load3(r, g, b, here);
  return make3(clamp(f.x, (real)(0), (real)(1)), clamp(f.y, (real)(0), (real)(1)), clamp(f.z, (real)(0), (real)(1)));
}

static inline Reflector reflector_of(Frame frame, Params params, int here, PLANE depth, PLANE normal_x, PLANE normal_y,
                                     PLANE normal_z, PLANE roughness, PLANE reflectance_r, PLANE reflectance_g,
                                     PLANE reflectance_b) {
  Reflector s;
  const real z = load(depth, here), x = to_real(FIRST_X + IOTA), y = (real)(ROW_Y);
  const real3 n = load3(normal_x, normal_y, normal_z, here);
  const real3 f0 = reflectance_at(reflectance_r, reflectance_g, reflectance_b, here);
  s.roughness = load(roughness, here);
  s.reflects = !is_background(z) & (dot3(n, n) > (scalar)0.25f) & (f0.x + f0.y + f0.z > 0) &
               to_mask(FIRST_X + IOTA < frame.width);
  s.depth = choose(s.reflects, z, (real)(1));
  s.point = anchor_at(frame, x, y, s.depth);
  s.normal = choose3(s.reflects, n, make3((real)(0), (real)(0), (real)(1)));
  tangents_of(s.normal, &s.first, &s.second);
  s.to_eye = into_frame(s, scale3(exactly_normalised(view_ray(frame, x, y)), (real)(-1)));
  // A shading normal may face away from the eye.
  s.to_eye.z = larger(s.to_eye.z, (real)(1e-3f));
  s.to_eye = exactly_normalised(s.to_eye);
  s.is_mirror = s.roughness < MIRROR_ROUGHNESS;
  s.alpha = choose(s.is_mirror, (real)(MIRROR_ROUGHNESS * MIRROR_ROUGHNESS), s.roughness * s.roughness);
  return s;
}

// --- Rays

// Where a ray starts, and what it is measured against.
typedef struct {
  Anchor point;
  real depth;
  real3 direction;     // unit, view space
  real3 from_surface;  // to here from where the surface reflects, in units of the depth; not 0 in the other eye
  real3 normal;        // of the surface that reflects
  real least_sine;     // to it, of what is not the surface itself
  ScreenRay line;
} Start;

static inline Start start_at(Frame frame, Params params, real column, real row, real depth, real3 normal,
                             real3 direction, real most_length) {
  Start s;
  s.point = anchor_at(frame, column, row, depth);
  s.depth = depth;
  s.direction = direction;
  s.from_surface = make3((real)(0), (real)(0), (real)(0));
  s.normal = normal;
  s.least_sine = smaller((real)(params.bias), (scalar)0.5 * dot3(direction, normal));
  s.line = screen_ray_of(frame, s.point, depth, direction);
  if (!isinf(params.max_distance)) {
    const real longest = steps_to(frame, s.line, most_length / depth);
    s.line.reaches_infinity &= s.line.end <= longest;
    s.line.end = smaller(s.line.end, longest);
  }
  return s;
}

static inline Start start_of(Frame frame, Params params, real column, real row, real depth, real3 normal,
                             real3 direction) {
  return start_at(frame, params, column, row, depth, normal, direction, (real)(params.max_distance));
}

#if STEREO
static inline real3 point_along(Frame frame, Start s, real length) {
  const real3 p = position_at(frame, s.point.x, s.point.y, s.depth);
  return make3(p.x + s.direction.x * length, p.y + s.direction.y * length, p.z + s.direction.z * length);
}

// Where a ray goes on in the other eye, once it has come so many steps in this one's image. `length`: so far, scene units.
// `goes_on`: that is in the other's image.
static inline Start start_in_other(Frame frame, Neighbour n, Params params, Start own, real t, mask* goes_on,
                                   real* length) {
  *length = length_at(frame, own.line, t) * own.depth;
  const real3 at = point_along(frame, own, *length);
  const Projection there = project_into(n, at, *goes_on & (*length < FARTHEST * own.depth));
  // Between centres of pixels: at the border of two images that show the same, rounding would decide.
  *goes_on = there.is_seen & (there.x >= 0) & (there.y >= 0) & (there.x <= n.frame.width - 1) &
             (there.y <= n.frame.height - 1);
  const real3 reflector = into_other(n, position_at(frame, own.point.x, own.point.y, own.depth)),
              here = into_other(n, at);
  Start s = start_at(n.frame, params, there.x, there.y, there.depth, rotated(n, own.normal), rotated(n, own.direction),
                     larger(params.max_distance - *length, (real)(0)));
  const real per_depth = (scalar)1 / there.depth;
  s.from_surface =
      make3((here.x - reflector.x) * per_depth, (here.y - reflector.y) * per_depth, (here.z - reflector.z) * per_depth);
  s.least_sine = own.least_sine;
  return s;
}
#endif

// Whether what a pixel shows rises over the surface that the ray starts from: else it is that surface.
static inline mask rises(Frame frame, Start s, Place p, real nearest) {
  const real e = frame.perspective > 0 ? -nearest / (1 + nearest) : -nearest;
  const real3 u = exactly_towards(frame, s.point, to_real(p.column), to_real(p.row), e);
  const real3 v = make3(u.x + s.from_surface.x, u.y + s.from_surface.y, u.z + s.from_surface.z);
  const real height = dot3(v, s.normal);
  return height > 0 & height * height > s.least_sine * s.least_sine * dot3(v, v);
}

// How far the back of what a pixel shows lies, as the ray has it; `nearest` where that is not known.
static inline real back_of(Frame frame, Start s, Hierarchy cells, global const float* back_depth, Place p, Cell cell,
                           real nearest, mask counts) {
#if BOTH_DEPTHS
  return relative_nearness(s.line, farthest_in(frame, cells, p, cell));
#else
  const real back = gather(back_depth, FRAME_GUARD + p.row * frame.pitch + p.column);
  const mask has_back = counts & !is_background(back);
  return choose(has_back, relative_nearness(s.line, nearness_of(frame, choose(has_back, back, (real)(1)))), nearest);
#endif
}

// Whether rays enter a pixel behind what that shows: its back, where that is known, else farther than surfaces reach.
static inline mask is_behind(Frame frame, Params params, Start s, Hierarchy cells, global const float* back_depth,
                             Place p, Cell cell, real nearest, mask counts) {
  const real entry = smaller(s.line.slope * p.t, nearest);
  const mask behind = counts & is_deeper_by(frame, entry, nearest, params.thickness);
#if TRAVERSAL
  if (!ANY(behind)) return behind;
  const real back = back_of(frame, s, cells, back_depth, p, cell, nearest, behind);
  return behind & !((back < nearest) & (entry >= back));
#else
  return behind;
#endif
}

// The pixel after its own, or in the other eye its own.
static inline Place first_place(Start s) {
  Place p;
  p.t = (real)(0);
  p.column = to_integer(s.line.x);
  p.row = to_integer(s.line.y);
  p.level = (integer)(0);
#if IN_OTHER
  return p;
#else
  return leave_cell(s.line, p, cell_at(s.line, p), 0);
#endif
}

// Whether a ray has come to its end: the border, infinity or its greatest length.
static inline mask ends_at(Frame frame, Start s, Place p) {
  return (p.t >= s.line.end) |
         to_mask((p.column < 0) | (p.column >= frame.width) | (p.row < 0) | (p.row >= frame.height));
}

// One cell further, or into smaller ones, for rays that are `active` and within the image. Returns which of them meet a surface
// where they are; `hidden`: which are behind one.
static inline mask step_on(Frame frame, Params params, Start s, Hierarchy cells, global const float* back_depth,
                           mask active, Place* place, mask* hidden) {
  const int top = LEVELS - 1;
  Place p = *place;
  p.column = clamp(p.column, (integer)(0), (integer)(frame.width - 1));
  p.row = clamp(p.row, (integer)(0), (integer)(frame.height - 1));
  const Cell cell = cell_at(s.line, p);
  const real least = (real)(nearness_of_background(frame)), stored_nearest = nearest_in(frame, cells, p, cell);
  const mask is_surface = stored_nearest > least;
  const real nearest = relative_nearness(s.line, stored_nearest);
  const real now = s.line.slope * p.t, then = s.line.slope * smaller(cell.out, s.line.end);
  const mask is_pixel = to_mask(p.level == 0);
  mask may_meet = active & is_surface & (smaller(now, then) < nearest), met = (mask)(0);
  *hidden = (mask)(0);
#if BOTH_DEPTHS
  const mask asks_for_farthest = may_meet & !is_pixel;
  if (ANY(asks_for_farthest)) {
    const real farthest = relative_nearness(s.line, farthest_in(frame, cells, p, cell));
    *hidden = asks_for_farthest & is_deeper_by(frame, larger(now, then), farthest, params.thickness);
    may_meet &= !*hidden;
  }
#endif
  const mask asks = may_meet & is_pixel;
  if (ANY(asks)) {
    const mask counts = asks & rises(frame, s, p, nearest);
    const mask behind = is_behind(frame, params, s, cells, back_depth, p, cell, nearest, counts);
    met = counts & !behind;
    *hidden |= behind;
  }
  const Place left = leave_cell(s.line, p, cell, top), entered = enter_cell(s.line, p, cell, nearest);
  const mask enters = may_meet & !is_pixel, leaves = active & !enters & !met;
  const integer enters_too = integer_of(enters), leaves_too = integer_of(leaves);
  place->t = choose(enters, entered.t, choose(leaves, left.t, place->t));
  place->column = enters_too ? entered.column : leaves_too ? left.column : place->column;
  place->row = enters_too ? entered.row : leaves_too ? left.row : place->row;
  place->level = enters_too ? entered.level : leaves_too ? left.level : place->level;
  return met;
}

#if BOTH_DEPTHS
#define HIERARCHY_ARGUMENT PLANE nearness, PLANE farness,
#define HIERARCHY hierarchy_of(nearness, farness)
#else
#define HIERARCHY_ARGUMENT PLANE nearness,
#define HIERARCHY hierarchy_of(nearness, nearness)
#endif

// Rays that one work-item follows. Where a pixel is a lane, lanes whose ray has come to its end take the next ones, so that few
// wait for the longest: rays take 10 to 200 steps.
#define RAYS_PER_ITEM (LANES == 1 ? RAYS : 32 * LANES)
#define LANES_WORTH_FILLING (LANES == 1 ? 1 : LANES / 2)

// What a ray met, in the memory of a plane: the index of the pixel, or one of these.
#define MET_NOTHING 0
#define MET_BACKGROUND -1

// One value per lane to one place each in a plane's memory, where a mask holds.
static inline void scatter_where(mask counts, integer value, global float* plane, integer place) {
  global int* values = (global int*)plane;
#if LANES == 1
  if (counts) values[place] = value;
#else
  const integer which = integer_of(counts);
  const int *of_lane = (const int*)&value, *places = (const int*)&place, *is_one = (const int*)&which;
  for (int i = 0; i < LANES; ++i) {
    if (is_one[i]) values[places[i]] = of_lane[i];
  }
#endif
}

static inline void keep_met(global float* met, Frame frame, Place p, integer ray, mask is_done, mask is_surface,
                            mask is_background) {
  const integer pixel = FRAME_GUARD + p.row * frame.pitch + p.column;
  const integer background = integer_of(is_background) ? (integer)(MET_BACKGROUND) : (integer)(MET_NOTHING);
  scatter_where(is_done, integer_of(is_surface) ? pixel : background, met, ray);
}

#if TRAVERSAL && !IN_OTHER
#define GOES_ON_IN_OTHER 1
// Rays that a work-item has for another list: put there together, so that work-items seldom wait for one another.
typedef struct {
  int rays[RAYS_PER_ITEM + 1], count;  // one more, since what does not count is written too
} Batch;

static inline void add_rays(Batch* batch, integer ray, mask which) {
  if (!ANY(which)) return;
#if LANES == 1
  batch->rays[batch->count++] = ray;
#else
  const integer counts = integer_of(which);
  const int *rays = (const int*)&ray, *is_one = (const int*)&counts;
  for (int i = 0; i < LANES; ++i) {
    batch->rays[batch->count] = rays[i];
    batch->count += is_one[i] != 0;
  }
#endif
}

static inline void put_rays(const Batch* batch, PIXEL_LIST_OUT list) {
  if (batch->count == 0) return;
  global int* entries = (global int*)list;
  const int first = FRAME_GUARD + atomic_add(entries, batch->count);
  for (int i = 0; i < batch->count; ++i) entries[first + i] = batch->rays[i];
}
#endif

// Of the rays of a row.
static inline integer met_in_row(global const float* met, int here) {
#if LANES == 1
  return ((global const int*)met)[here];
#else
  return JOIN(vload, LANES)(0, (global const int*)met + here);
#endif
}

// Gives the lanes that are idle the next rays of a list, and says which have one.
static inline mask fill_lanes(global const int* rays, int* next, int last, integer* ray, mask active) {
#if LANES == 1
  if (active || *next == last) return active;
  *ray = rays[(*next)++];
  return EVERY_LANE;
#else
  integer busy = integer_of(active);
  int *lanes = (int*)ray, *is_busy = (int*)&busy;
  for (int i = 0; i < LANES && *next < last; ++i) {
    if (is_busy[i]) continue;
    lanes[i] = rays[(*next)++];
    is_busy[i] = -1;
  }
  return to_mask(busy);
#endif
}

// Whether rays meet the front of what the pixels show that they are at; what has no normal has no back.
static inline mask is_front(Frame frame, Place p, Start s, PLANE normal_x, PLANE normal_y, PLANE normal_z,
                            mask counts) {
  if (!ANY(counts)) return counts;
  const integer column = clamp(p.column, (integer)(0), (integer)(frame.width - 1));
  const integer row = clamp(p.row, (integer)(0), (integer)(frame.height - 1));
  return dot3(s.direction, gather3(normal_x, normal_y, normal_z, FRAME_GUARD + row * frame.pitch + column)) <= 0;
}

// Where the rays of a list start.
typedef struct {
  global const float *depth, *normal_x, *normal_y, *normal_z, *ray_x, *ray_y, *ray_z;
} Rays;

static inline Start start_of_ray(Frame frame, Params params, Rays rays, integer ray) {
  const integer pixel = ray % floats_of_layer(frame);
  return start_of(frame, params, to_real(column_of(frame, pixel)), to_real(row_of(frame, pixel)),
                  gather(rays.depth, pixel), gather3(rays.normal_x, rays.normal_y, rays.normal_z, pixel),
                  gather3(rays.ray_x, rays.ray_y, rays.ray_z, ray));
}

// Rays of this eye, through its own image or, IN_OTHER, through the other's, as far as that sees them. `met`: what they meet there.
// `left_at`: steps after which a ray is hidden from this eye, or beyond its image; `others` lists these.
#if IN_OTHER
kernel void ssr_march(Frame frame, Neighbour neighbour, Params params, PLANE depth, PLANE normal_x, PLANE normal_y,
                      PLANE normal_z, HIERARCHY_ARGUMENT PIXEL_LIST list, PLANE ray_x, PLANE ray_y, PLANE ray_z,
                      PLANE left_at, PLANE other_normal_x, PLANE other_normal_y, PLANE other_normal_z, PLANE back_depth,
                      global float* met) {
  const Frame image = neighbour.frame;
#elif TRAVERSAL
kernel void ssr_march(Frame frame, Params params, PLANE depth, PLANE normal_x, PLANE normal_y, PLANE normal_z,
                      HIERARCHY_ARGUMENT PIXEL_LIST list, PLANE ray_x, PLANE ray_y, PLANE ray_z, PLANE back_depth,
                      global float* met, global float* left_at, PIXEL_LIST_OUT others) {
  const Frame image = frame;
#else
kernel void ssr_march(Frame frame, Params params, PLANE depth, PLANE normal_x, PLANE normal_y, PLANE normal_z,
                      HIERARCHY_ARGUMENT PIXEL_LIST list, PLANE ray_x, PLANE ray_y, PLANE ray_z, global float* met) {
  const Frame image = frame;
  global const float* back_depth = 0;
#endif
  global const int* entries = (global const int*)list;
  // Down the columns of items: devices hand out the image row by row, and the first rows would get all there is to do.
  const int item = (int)(get_global_id(0) * get_global_size(1) + get_global_id(1)), count = entries[0];
  // Divided rather than multiplied: of a large image most items are beyond what an int counts.
  if (count == 0 || item > (count - 1) / RAYS_PER_ITEM) return;
  int next = item * RAYS_PER_ITEM;
  const int last = next + min(RAYS_PER_ITEM, count - next);
  const Rays rays = {depth, normal_x, normal_y, normal_z, ray_x, ray_y, ray_z};
  integer ray = (integer)(entries[FRAME_GUARD + next]), steps = (integer)(0);
  mask active = (mask)(0);
  Start start;
  Place place;
#if GOES_ON_IN_OTHER
  real left = 0;
  Batch further;
  further.count = 0;
#endif
  for (;;) {
    const int idle = LANES - popcount(bit_of_each_lane(active));
    if (idle == LANES && next == last) break;
    if (idle >= LANES_WORTH_FILLING && next < last) {
      const mask before = active;
      active = fill_lanes(entries + FRAME_GUARD, &next, last, &ray, active);
      // What a ray starts from depends on nothing but its pixel: it is made anew for all.
      start = start_of_ray(frame, params, rays, ray);
#if IN_OTHER
      mask goes_on = active;
      real length;
      start = start_in_other(frame, neighbour, params, start, gather(left_at, ray), &goes_on, &length);
      active &= before | goes_on;
#endif
      const Place first = first_place(start);
      const integer is_old = integer_of(before);
      place.t = choose(before, place.t, first.t);
      place.column = is_old ? place.column : first.column;
      place.row = is_old ? place.row : first.row;
      place.level = is_old ? place.level : first.level;
      steps = is_old ? steps : (integer)(0);
    }
    const mask ends = active & ends_at(image, start, place);
    const mask goes_on = active & !ends & to_mask(steps < params.max_steps);
    mask hidden;
#if GOES_ON_IN_OTHER
    const real before_step = place.t;
#endif
    mask met_now = step_on(image, params, start, HIERARCHY, back_depth, goes_on, &place, &hidden);
    steps += 1;
#if IN_OTHER
    const mask is_done = active & (met_now | hidden | !goes_on);
#else
    const mask is_done = active & (met_now | !goes_on);
#endif
#if GOES_ON_IN_OTHER
    left = choose(hidden & (left == 0), before_step, left);
#endif
    if (!ANY(is_done)) continue;
#if IN_OTHER
    met_now &= is_front(image, place, start, other_normal_x, other_normal_y, other_normal_z, met_now);
#endif
#if GOES_ON_IN_OTHER
    left = choose((left == 0) & ends & !start.line.reaches_infinity, place.t, left);
    const mask goes_on_there = is_done & (left > 0);
    scatter_where(goes_on_there, as_integer(to_stored(left)), left_at, ray);
    add_rays(&further, ray, goes_on_there);
    left = choose(is_done, (real)(0), left);
#endif
    keep_met(met, image, place, ray, is_done, met_now, ends & start.line.reaches_infinity);
    active &= !is_done;
  }
#if GOES_ON_IN_OTHER
  put_rays(&further, others);
#endif
}

// Where ray k of a pixel goes, and its density; 0 where it would go under the surface.
static inline real3 ray_of(Reflector s, Noise noise, int k, real* density) {
  // Further rays of a pixel along the R2 sequence (Roberts 2018).
  const real u = noise.shift + k * (scalar)0.7548776662, turn = noise.turn + k * (scalar)0.5698402910;
  real3 h = visible_normal(s.to_eye, s.alpha, u - floor(u), turn - floor(turn));
  const mask is_mirror = s.is_mirror | (MASK_ALONE ? EVERY_LANE : (mask)(0));
  h = choose3(is_mirror, make3((real)(0), (real)(0), (real)(1)), h);
  const real vh = 2 * dot3(s.to_eye, h);
  const real3 l = make3(vh * h.x - s.to_eye.x, vh * h.y - s.to_eye.y, vh * h.z - s.to_eye.z);
  const real per_angle = reflected_density(s.alpha, s.to_eye, h, hidden_per_seen(s.alpha, s.to_eye));
  *density = choose(is_mirror, choose(s.reflects & (mask)(k == 0 ? EVERY_LANE : (mask)(0)), REAL_INFINITY, (real)(0)),
                    choose(s.reflects & (l.z > (scalar)1e-4f), per_angle, (real)(0)));
  return exactly_normalised(out_of_frame(s, l));
}

kernel void ssr_rays(Frame frame, Params params, PLANE depth, PLANE normal_x, PLANE normal_y, PLANE normal_z,
                     PLANE roughness, PLANE reflectance_r, PLANE reflectance_g, PLANE reflectance_b,
                     WANTED_ARGUMENT PIXEL_LIST_OUT list, PLANE_OUT ray_x, PLANE_OUT ray_y, PLANE_OUT ray_z,
                     PLANE_OUT ray_density, PLANE_OUT met
#if TRAVERSAL
                     ,
                     PLANE_OUT met_in_other
#endif
) {
  const int here = index_of(frame, FIRST_X, ROW_Y);
  const Reflector s = reflector_of(frame, params, here, depth, normal_x, normal_y, normal_z, roughness, reflectance_r,
                                   reflectance_g, reflectance_b);
  const Noise noise = noise_at(FIRST_X + IOTA, ROW_Y, frame.seed);
#if MASKED
  const int is_skipped = !ANY(wanted_in_row(wanted, frame));
#else
  const int is_skipped = 0;
#endif
  for (int k = 0; k < RAYS; ++k) {
    real density = 0;
    if (!is_skipped && ANY(s.reflects)) {
      const real3 direction = ray_of(s, noise, k, &density);
      store(direction.x, layer_of_out(ray_x, frame, k), here);
      store(direction.y, layer_of_out(ray_y, frame, k), here);
      store(direction.z, layer_of_out(ray_z, frame, k), here);
      density = choose(s.roughness <= params.max_roughness, density, (real)(0));
      append_pixels(list, here + k * floats_of_layer(frame), density > 0);
    }
    store(density, layer_of_out(ray_density, frame, k), here);
    store((real)(0), layer_of_out(met, frame, k), here);
#if TRAVERSAL
    store((real)(0), layer_of_out(met_in_other, frame, k), here);
#endif
  }
}

#if MASK_ALONE
// 1 where a surface reflects something that the image shows: its mirror's ray meets something, or it is so rough that this one does
// not tell.
kernel void ssr_found(Frame frame, Params params, PLANE roughness, PLANE ray_density, PLANE met, PLANE_OUT found) {
  const int here = index_of(frame, FIRST_X, ROW_Y);
  const real rough = load(roughness, here);
  const mask reflects = load(ray_density, here) > 0;
  const mask meets = to_mask(met_in_row(met, here) != MET_NOTHING);
  store(choose(reflects & (meets | (rough > params.blurred)), (real)(1), (real)(0)), found, here);
}
#else

// Light is what a surface can send out: neither less than nothing nor more than sums can hold.
static inline real radiance_of(real color) { return clamp(color, (real)(0), (real)(1e20f)); }

static inline real3 gather_radiance(PLANE r, PLANE g, PLANE b, integer i) {
  const real3 c = gather3(r, g, b, i);
  return make3(radiance_of(c.x), radiance_of(c.y), radiance_of(c.z));
}

// What an eye's image holds.
typedef struct {
  global const float *depth, *normal_x, *normal_y, *normal_z, *color_r, *color_g, *color_b;
} Image;

static inline Image image_of(PLANE depth, PLANE normal_x, PLANE normal_y, PLANE normal_z, PLANE color_r, PLANE color_g,
                             PLANE color_b) {
  const Image image = {depth, normal_x, normal_y, normal_z, color_r, color_g, color_b};
  return image;
}

typedef struct {
  mask surface, background;  // what was met, if anything
  integer column, row;       // pixel
} Hit;

static inline Hit hit_of(Frame frame, integer met, mask counts) {
  const integer pixel = max(met, (integer)(FRAME_GUARD));
  Hit hit;
  hit.background = counts & to_mask(met == MET_BACKGROUND);
  hit.surface = counts & to_mask(met > MET_NOTHING);
  hit.column = column_of(frame, pixel);
  hit.row = row_of(frame, pixel);
  return hit;
}

// What is seen of what a ray meets.
typedef struct {
  mask is_known;
  real x, y;    // where in the image, pixels
  real length;  // of the ray, scene units; +inf towards background
  real3 color;
} Sight;

// Colour about a point of the image, from those of the four pixels around it that lie on the plane of the pixel that was met.
static inline real3 color_at(Frame frame, Image image, Start s, Hit hit, real3 met, real3 normal, real x, real y) {
  const real left = floor(x - (scalar)0.5), top = floor(y - (scalar)0.5);
  const real right_share = x - (scalar)0.5 - left, lower_share = y - (scalar)0.5 - top;
  real3 sum = make3((real)(0), (real)(0), (real)(0));
  real weights = 0;
  const real tolerance = (scalar)1e-3f * (1 + fabs(1 - met.z));
  for (int k = 0; k < 4; ++k) {
    const integer column = clamp(to_integer(left) + (k & 1), (integer)(0), (integer)(frame.width - 1));
    const integer row = clamp(to_integer(top) + (k >> 1), (integer)(0), (integer)(frame.height - 1));
    const integer i = FRAME_GUARD + row * frame.pitch + column;
    const real e = relative_depth(s.point, s.depth, gather(image.depth, i));
    const real3 v = exactly_towards(frame, s.point, to_real(column), to_real(row), e);
    const real away = dot3(make3(v.x - met.x, v.y - met.y, v.z - met.z), normal);
    const real share = (k & 1 ? right_share : 1 - right_share) * (k >> 1 ? lower_share : 1 - lower_share);
    const real w = choose(fabs(away) < tolerance, share, (real)(0));
    weights += w;
    const real3 c = gather_radiance(image.color_r, image.color_g, image.color_b, i);
    sum = make3(sum.x + w * c.x, sum.y + w * c.y, sum.z + w * c.z);
  }
  const integer here = FRAME_GUARD + hit.row * frame.pitch + hit.column;
  const mask is_known = weights > (scalar)1e-3f;
  const real scale = (scalar)1 / choose(is_known, weights, (real)(1));
  return choose3(is_known, scale3(sum, scale), gather_radiance(image.color_r, image.color_g, image.color_b, here));
}

// Steps at which a ray passes the middle of a pixel.
static inline real steps_past(ScreenRay r, Hit hit) {
  const real right = (to_real(hit.column) + (scalar)0.5 - r.x) * r.inverse_x;
  const real down = (to_real(hit.row) + (scalar)0.5 - r.y) * r.inverse_y;
  return larger(choose(fabs(r.per_x) > fabs(r.per_y), right, down), (real)(0));
}

static inline Sight sight_of(Frame frame, Image image, Start s, Hit hit) {
  const integer i = FRAME_GUARD + hit.row * frame.pitch + hit.column;
  const real3 n = gather3(image.normal_x, image.normal_y, image.normal_z, i);
  const real e = relative_depth(s.point, s.depth, gather(image.depth, i));
  const real3 met =
      exactly_towards(frame, s.point, to_real(hit.column), to_real(hit.row), choose(hit.surface, e, (real)(0)));
  const real facing = dot3(s.direction, n);
  const mask has_normal = dot3(n, n) > (scalar)0.25f, faces = !has_normal | (facing <= 0);
  // Where the ray crosses the plane of the pixel that it meets, if that is about there.
  const real to_plane = dot3(met, n) / smaller(facing, (real)(-1e-3f));
  const real past = choose(hit.background, s.line.end, steps_past(s.line, hit));
  const real crossing = steps_to(frame, s.line, larger(to_plane, (real)(0)));
  const mask crosses = hit.surface & has_normal & (to_plane > 0) & (fabs(crossing - past) <= 1);
  const real t = choose(crosses, crossing, past);
  Sight sight;
  sight.x = clamp(s.line.x + s.line.per_x * t, (real)(0), (real)((scalar)frame.width));
  sight.y = clamp(s.line.y + s.line.per_y * t, (real)(0), (real)((scalar)frame.height));
  const integer at_end = FRAME_GUARD +
                         clamp(to_integer(sight.y), (integer)(0), (integer)(frame.height - 1)) * frame.pitch +
                         clamp(to_integer(sight.x), (integer)(0), (integer)(frame.width - 1));
  const mask sees_background = hit.background & is_background(gather(image.depth, at_end));
  sight.is_known = (hit.surface & faces) | sees_background;
  sight.length = choose(sees_background, REAL_INFINITY, choose(crosses, to_plane, sqrt(dot3(met, met))) * s.depth);
  sight.color = choose3(sees_background, gather_radiance(image.color_r, image.color_g, image.color_b, at_end),
                        color_at(frame, image, s, hit, met, choose3(has_normal, n, s.direction), sight.x, sight.y));
  return sight;
}

static inline real fade_to(real distance, scalar width) {
  const real t = clamp(distance / (width > (scalar)1e-6f ? width : (scalar)1e-6f), (real)(0), (real)(1));
  return t * t * (3 - 2 * t);
}

// Distance of a point of the image from its border, in sizes of the image.
static inline real to_border(Frame frame, real x, real y) {
  const real u = x * ((scalar)1 / frame.width), v = y * ((scalar)1 / frame.height);
  return smaller(smaller(u, 1 - u), smaller(v, 1 - v));
}

// `from_border`: of what was met.
static inline real confidence_of(Params params, Sight sight, real3 direction, real from_border) {
  real confidence = fade_to(from_border, params.fade_border) * fade_to(1 - direction.z, 1 - params.fade_facing);
  if (!isinf(params.max_distance))
    confidence *= fade_to(params.max_distance - sight.length, (scalar)0.25f * params.max_distance);
  return choose(sight.is_known, confidence, (real)(0));
}

#if STEREO
// Of a place in this eye's space: the larger of that in its image and in the other's, as far as they show it.
static inline real to_border_of_either(Frame frame, Neighbour n, real3 p, mask counts) {
  const Projection own = project_onto(frame, p, counts), other = project_into(n, p, counts);
  const real here = to_border(frame, own.x + (scalar)0.5, own.y + (scalar)0.5);
  const real there = to_border(n.frame, other.x + (scalar)0.5, other.y + (scalar)0.5);
  return larger(choose(own.is_seen, here, (real)(0)), choose(other.is_seen, there, (real)(0)));
}
#endif

#if TRAVERSAL
// What a row's rays that went on in the other eye met there; `length` from their start in this one.
static inline Sight sight_in_other(Frame frame, Neighbour n, Params params, Image other, Start own, real left_at,
                                   integer met, mask counts) {
  real before;
  mask goes_on = counts;
  const Start start = start_in_other(frame, n, params, own, left_at, &goes_on, &before);
  Sight sight = sight_of(n.frame, other, start, hit_of(n.frame, met, counts & goes_on));
  sight.length += before;
  return sight;
}
#endif

kernel void ssr_see(Frame frame,
#if TRAVERSAL || FADE
                    Neighbour neighbour,
#endif
                    Params params, PLANE depth, PLANE normal_x, PLANE normal_y, PLANE normal_z, PLANE color_r,
                    PLANE color_g, PLANE color_b, PLANE ray_x, PLANE ray_y, PLANE ray_z, PLANE ray_density, PLANE met,
#if TRAVERSAL
                    PLANE met_in_other, PLANE left_at,
#endif
#if TRAVERSAL || FADE
                    PLANE other_depth, PLANE other_normal_x, PLANE other_normal_y, PLANE other_normal_z,
                    PLANE other_color_r, PLANE other_color_g, PLANE other_color_b,
#endif
                    PLANE_OUT hit_length, PLANE_OUT ray_r, PLANE_OUT ray_g, PLANE_OUT ray_b, PLANE_OUT ray_length,
                    PLANE_OUT ray_confidence) {
  const int here = index_of(frame, FIRST_X, ROW_Y);
  const Image image = image_of(depth, normal_x, normal_y, normal_z, color_r, color_g, color_b);
  const real3 normal = load3(normal_x, normal_y, normal_z, here), up = make3((real)(0), (real)(0), (real)(1));
  const real z = load(depth, here);
  for (int k = 0; k < RAYS; ++k) {
    const mask has_ray = load(layer_of(ray_density, frame, k), here) > 0;
    if (!ANY(has_ray)) {
      if (k == 0) store((real)(0), hit_length, here);
      continue;
    }
    const real3 direction =
        load3(layer_of(ray_x, frame, k), layer_of(ray_y, frame, k), layer_of(ray_z, frame, k), here);
    const Start start = start_of(frame, params, to_real(FIRST_X + IOTA), (real)(ROW_Y), choose(has_ray, z, (real)(1)),
                                 choose3(has_ray, normal, up), choose3(has_ray, direction, up));
    Sight sight = sight_of(frame, image, start, hit_of(frame, met_in_row(layer_of(met, frame, k), here), has_ray));
    real from_border = to_border(frame, sight.x, sight.y);
#if TRAVERSAL
    const integer there = met_in_row(layer_of(met_in_other, frame, k), here);
    const mask in_other = has_ray & to_mask(there != MET_NOTHING);
    if (ANY(in_other)) {
      const Image other = image_of(other_depth, other_normal_x, other_normal_y, other_normal_z, other_color_r,
                                   other_color_g, other_color_b);
      const Sight further = sight_in_other(frame, neighbour, params, other, start,
                                           load(layer_of(left_at, frame, k), here), there, in_other);
      const mask takes = in_other & further.is_known;
      sight.is_known |= takes;
      sight.length = choose(takes, further.length, sight.length);
      sight.color = choose3(takes, further.color, sight.color);
      from_border = choose(takes, to_border(neighbour.frame, further.x, further.y), from_border);
    }
#endif
#if FADE
    // What is as far as background lies in its direction.
    const real length = smaller(sight.length, start.depth * (scalar)1e6f);
    from_border = to_border_of_either(frame, neighbour, point_along(frame, start, length), sight.is_known);
#endif
    const real confidence = confidence_of(params, sight, direction, from_border);
    const real missing = 1 - confidence;
    const real3 color = choose3(sight.is_known, sight.color, make3((real)(0), (real)(0), (real)(0)));
    sight.length = choose(sight.is_known, sight.length, (real)(0));
    if (k == 0) store(choose(isinf(sight.length), (real)(0), sight.length), hit_length, here);
    store(confidence * color.x + missing * params.environment_r, layer_of_out(ray_r, frame, k), here);
    store(confidence * color.y + missing * params.environment_g, layer_of_out(ray_g, frame, k), here);
    store(confidence * color.z + missing * params.environment_b, layer_of_out(ray_b, frame, k), here);
    store(sight.length, layer_of_out(ray_length, frame, k), here);
    store(confidence, layer_of_out(ray_confidence, frame, k), here);
  }
}

// --- Resolve

// Pixels around one, the nearest first.
constant char2 around[25] = {{0, 0},  {1, 0},   {-1, 0}, {0, 1},  {0, -1},  {1, 1},   {-1, -1}, {1, -1}, {-1, 1},
                             {2, 0},  {-2, 0},  {0, 2},  {0, -2}, {2, 1},   {-2, -1}, {1, -2},  {-1, 2}, {2, -1},
                             {-2, 1}, {-1, -2}, {1, 2},  {2, 2},  {-2, -2}, {2, -2},  {-2, 2}};

// Sums over rays. Fresnel's term is reflectance + (1 - reflectance) * grazing: kept apart, it is taken once.
typedef struct {
  real weights, confidence;
  real3 straight, grazing;  // radiance
  real length, met;         // weights times length, and weights, of rays that met something
} Reflected;

// Lengths in depths from which on it is the direction that matters; background is as far.
#define FAR_ENOUGH ((scalar)1e4)

// What is known of the rays of a pixel (LANES pixels).
typedef struct {
  real3 direction, radiance;
  real length, density, confidence;
} SeenRay;

static inline void take_ray(Reflected* sum, Reflector s, SeenRay ray, mask counts) {
  const real3 light = into_frame(s, ray.direction);
  const real3 h = make3(light.x + s.to_eye.x, light.y + s.to_eye.y, larger(light.z + s.to_eye.z, (real)(1e-6f)));
  const real share = reflected_share(s.alpha, s.to_eye, light, h, hidden_per_seen(s.alpha, s.to_eye));
  counts &= (light.z > 0) & (ray.density > 0);
  const real w = choose(counts, share / choose(counts, ray.density, (real)(1)), (real)(0));
  const real grazing = choose(counts, w * grazing_share(dot3(light, h) * inverse_sqrt(dot3(h, h))), (real)(0)),
             straight = w - grazing;
  const real3 radiance = choose3(counts, ray.radiance, make3((real)(0), (real)(0), (real)(0)));
  sum->weights += w;
  sum->confidence += choose(counts, w * ray.confidence, (real)(0));
  sum->length += choose(counts & (ray.length > 0), w * smaller(ray.length, s.depth * FAR_ENOUGH), (real)(0));
  sum->met += choose(counts & (ray.length > 0), w, (real)(0));
  sum->straight = make3(sum->straight.x + straight * radiance.x, sum->straight.y + straight * radiance.y,
                        sum->straight.z + straight * radiance.z);
  sum->grazing = make3(sum->grazing.x + grazing * radiance.x, sum->grazing.y + grazing * radiance.y,
                       sum->grazing.z + grazing * radiance.z);
}

// The direction from the pixel at hand to what the ray of another one meets: `v` to that pixel, in depths of the pixel at hand.
static inline real3 towards_met(Reflector s, real3 v, real3 direction, real length) {
  const real reach = length / s.depth;
  const mask is_near = (reach > 0) & (reach < FAR_ENOUGH);
  const real3 met = make3(v.x + direction.x * reach, v.y + direction.y * reach, v.z + direction.z * reach);
  return choose3(is_near, exactly_normalised(choose3(is_near, met, s.normal)), direction);
}

// Whether a point beside the pixel at hand lies on its surface: what lies before or behind that is another one.
static inline mask on_surface(Reflector s, real3 v) {
  const real height = dot3(v, s.normal);
  return height * height <= (scalar)0.25f * dot3(v, v) + (scalar)1e-6f;
}

#if REPROJECTION || TEMPORAL
// Where the other eye, or the one of the frame before, sees the virtual image of what the pixel's rays meet at this distance: on the plane of the surface, on
// the way from the image behind it to that eye.
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

#if REPROJECTION
typedef struct {
  global const float *depth, *instance, *x, *y, *z, *r, *g, *b, *length, *density, *confidence;
} OtherRays;

// Each ray is judged by itself: turned from the pixel at hand to what it met, it weighs by the lobe that the surface has there for
// that direction. How long it is does not matter: rays of a rough surface meet things near and far. A miss does not count: it says
// that the images show nothing there, not that nothing is there.
static inline void take_rays_of_other(Frame frame, Neighbour n, Reflector s, OtherRays rays, real instance, mask counts,
                                      Reflected* sum) {
  const mask has_met = counts & (sum->met > 0);
  if (!ANY(has_met)) return;
  const real expected = sum->length / choose(has_met, sum->met, (real)(1));
  const Projection there = same_virtual_image(frame, n, s, expected, has_met);
  const real3 p = position_at(frame, s.point.x, s.point.y, s.depth);
  const real per_depth = (scalar)1 / s.depth;
  const integer column = nearest(there.x), row = nearest(there.y);
  if (!ANY(there.is_seen)) return;
  for (int i = 0; i < OTHER_NEIGHBOURS; ++i) {
    const integer x = column + (int)around[i].x, y = row + (int)around[i].y;
    const integer inside_x = clamp(x, (integer)(0), (integer)(n.frame.width - 1));
    const integer inside_y = clamp(y, (integer)(0), (integer)(n.frame.height - 1));
    const integer place = FRAME_GUARD + inside_y * n.frame.pitch + inside_x;
    const real z = gather(rays.depth, place);
    const mask is_known = there.is_seen & to_mask((x == inside_x) & (y == inside_y)) & !is_background(z) &
                          (gather(rays.instance, place) == instance);
    if (!ANY(is_known)) continue;
    const real3 q = back_from_other(n, position_at(n.frame, to_real(x), to_real(y), choose(is_known, z, (real)(1))));
    const real3 v = make3((q.x - p.x) * per_depth, (q.y - p.y) * per_depth, (q.z - p.z) * per_depth);
    const mask is_alike = is_known & on_surface(s, v);
    for (int k = 0; k < RAYS; ++k) {
      const integer ray = place + k * floats_of_layer(n.frame);
      SeenRay seen;
      seen.length = gather(rays.length, ray);
      seen.density = gather(rays.density, ray);
      const mask has_hit = is_alike & (seen.length > 0) & !isinf(seen.density);
      if (!ANY(has_hit)) continue;
      const real3 d = gather3(rays.x, rays.y, rays.z, ray);
      const real3 direction = rotated_back(n, d);
      seen.direction = towards_met(s, v, direction, seen.length);
      seen.radiance = gather3(rays.r, rays.g, rays.b, ray);
      seen.confidence = gather(rays.confidence, ray);
      take_ray(sum, s, seen, has_hit);
    }
  }
}
#endif

static inline void no_reflection(PLANE_OUT r, PLANE_OUT g, PLANE_OUT b, PLANE_OUT a, int here) {
  store((real)(0), r, here);
  store((real)(0), g, here);
  store((real)(0), b, here);
  store((real)(0), a, here);
}

kernel void ssr_resolve(Frame frame,
#if REPROJECTION
                        Neighbour neighbour,
#endif
                        Params params, PLANE depth, PLANE normal_x, PLANE normal_y, PLANE normal_z, PLANE roughness,
                        PLANE reflectance_r, PLANE reflectance_g, PLANE reflectance_b, PLANE ray_x, PLANE ray_y,
                        PLANE ray_z, PLANE ray_density, PLANE ray_r, PLANE ray_g, PLANE ray_b, PLANE ray_length,
                        PLANE ray_confidence,
#if REPROJECTION
                        PLANE instance, PLANE other_depth, PLANE other_instance, PLANE other_ray_x, PLANE other_ray_y,
                        PLANE other_ray_z, PLANE other_ray_density, PLANE other_ray_r, PLANE other_ray_g,
                        PLANE other_ray_b, PLANE other_ray_length, PLANE other_ray_confidence,
#endif
                        WANTED_ARGUMENT PLANE_OUT reflection_r, PLANE_OUT reflection_g, PLANE_OUT reflection_b,
                        PLANE_OUT reflection_a
#if TEMPORAL
                        ,
                        PLANE_OUT reach
#endif
) {
  SKIP_UNWANTED(frame, no_reflection(reflection_r, reflection_g, reflection_b, reflection_a, here))
  const int here = index_of(frame, FIRST_X, ROW_Y);
  const Reflector s = reflector_of(frame, params, here, depth, normal_x, normal_y, normal_z, roughness, reflectance_r,
                                   reflectance_g, reflectance_b);
  const real3 none = make3((real)(0), (real)(0), (real)(0));
  const mask is_rough = s.reflects & (s.roughness > params.max_roughness);
  if (!ANY(s.reflects)) {
    no_reflection(reflection_r, reflection_g, reflection_b, reflection_a, here);
    return;
  }
  Reflected sum;
  sum.weights = sum.confidence = sum.length = sum.met = 0;
  sum.straight = sum.grazing = none;
  const int column = FIRST_X;
  for (int i = 0; i < NEIGHBOURS; ++i) {
    const int dx = around[i].x, dy = around[i].y;
    if (ROW_Y + dy < 0 || ROW_Y + dy >= frame.height) continue;
    // A mirror has one direction, and its neighbours have others.
    if (i > 0 && !ANY(s.reflects & !s.is_mirror)) break;
    const int there = index_of(frame, column + dx, ROW_Y + dy);
    const integer x = column + dx + IOTA;
    const real z = load(depth, there);
    mask counts = s.reflects & !is_rough & to_mask((x >= 0) & (x < frame.width)) & !is_background(z);
    if (i > 0) counts &= !s.is_mirror;
    const real e = relative_depth(s.point, s.depth, choose(counts, z, s.depth));
    const real3 v = exactly_towards(frame, s.point, s.point.x + dx, s.point.y + dy, e);
    counts &= on_surface(s, v);
    for (int k = 0; k < RAYS; ++k) {
      SeenRay seen;
      seen.density = load(layer_of(ray_density, frame, k), there);
      seen.direction = load3(layer_of(ray_x, frame, k), layer_of(ray_y, frame, k), layer_of(ray_z, frame, k), there);
      seen.length = load(layer_of(ray_length, frame, k), there);
      seen.radiance = load3(layer_of(ray_r, frame, k), layer_of(ray_g, frame, k), layer_of(ray_b, frame, k), there);
      seen.confidence = load(layer_of(ray_confidence, frame, k), there);
      if (i > 0) seen.direction = towards_met(s, v, seen.direction, seen.length);
      // A mirror's own ray has no density: any weight does.
      const mask is_own = s.is_mirror & (i == 0 ? EVERY_LANE : (mask)(0));
      seen.density =
          choose(is_own & (seen.density > 0), (real)(1), choose(isinf(seen.density), (real)(0), seen.density));
      take_ray(&sum, s, seen, counts);
    }
  }
#if REPROJECTION
  const OtherRays others = {other_depth,      other_instance,    other_ray_x,         other_ray_y,
                            other_ray_z,      other_ray_r,       other_ray_g,         other_ray_b,
                            other_ray_length, other_ray_density, other_ray_confidence};
  take_rays_of_other(frame, neighbour, s, others, load(instance, here), s.reflects & !s.is_mirror & !is_rough, &sum);
#endif
#if TEMPORAL
  const mask has_met = sum.met > 0;
  store(choose(has_met, sum.length / choose(has_met, sum.met, (real)(1)), (real)(0)), reach, here);
#endif
  const mask is_known = (sum.weights > (scalar)1e-12f) & is_wanted;
  const real albedo = choose(s.is_mirror, (real)(1), directional_albedo(s.roughness, s.to_eye.z));
  const real scale = choose(is_known, albedo / choose(is_known, sum.weights, (real)(1)), (real)(0));
  const real3 f0 = reflectance_at(reflectance_r, reflectance_g, reflectance_b, here);
  // What is too rough for rays reflects the environment, about as much as its middle direction does.
  const mask has_environment = is_rough & is_wanted;
  const real evenly = choose(has_environment, albedo, (real)(0)), middle = grazing_share(s.to_eye.z);
  // straight + grazing is all; Fresnel's term takes reflectance of the first and all of the second.
  store(choose(is_known, scale * (f0.x * sum.straight.x + sum.grazing.x),
               evenly * (f0.x + (1 - f0.x) * middle) * params.environment_r),
        reflection_r, here);
  store(choose(is_known, scale * (f0.y * sum.straight.y + sum.grazing.y),
               evenly * (f0.y + (1 - f0.y) * middle) * params.environment_g),
        reflection_g, here);
  store(choose(is_known, scale * (f0.z * sum.straight.z + sum.grazing.z),
               evenly * (f0.z + (1 - f0.z) * middle) * params.environment_b),
        reflection_b, here);
  store(choose(is_known, sum.confidence / choose(is_known, sum.weights, (real)(1)), (real)(0)), reflection_a, here);
}

#if TEMPORAL
// Each surface's mean over the frames that showed it. What it reflects moves as its virtual image does, if that stands still; else,
// and where it is rough, as the surface. Of the two places in the frame before, the one counts that is more like the neighbours
// are now. Mirrors have no noise: they are of this frame alone.
kernel void ssr_accumulate(Frame frame, Neighbour neighbour, Params params, PLANE depth, PLANE normal_x, PLANE normal_y,
                           PLANE normal_z, PLANE roughness, PLANE reflectance_r, PLANE reflectance_g,
                           PLANE reflectance_b, PLANE motion_x, PLANE motion_y, PLANE reach, PLANE now_r, PLANE now_g,
                           PLANE now_b, PLANE now_a, PLANE history_r, PLANE history_g, PLANE history_b, PLANE history_a,
                           PLANE history_depth, PLANE history_frames, WANTED_ARGUMENT PLANE_OUT reflection_r,
                           PLANE_OUT reflection_g, PLANE_OUT reflection_b, PLANE_OUT reflection_a, PLANE_OUT frames) {
  SKIP_UNWANTED(frame, no_reflection(reflection_r, reflection_g, reflection_b, reflection_a, here);
                store((real)(0), frames, here))
  const int here = index_of(frame, FIRST_X, ROW_Y);
  const Reflector s = reflector_of(frame, params, here, depth, normal_x, normal_y, normal_z, roughness, reflectance_r,
                                   reflectance_g, reflectance_b);
  const mask counts = s.reflects & !s.is_mirror & is_wanted;
  if (!ANY(s.reflects)) {
    no_reflection(reflection_r, reflection_g, reflection_b, reflection_a, here);
    store((real)(0), frames, here);
    return;
  }
  const Past as_surface = past_at(frame, history_depth, history_frames, s.point.x + load(motion_x, here),
                                  s.point.y + load(motion_y, here), s.depth, params.same_depth, counts);
  const real length = load(reach, here);
  const Projection there = same_virtual_image(frame, neighbour, s, length, counts & (length > 0));
  const Past as_image = past_at(neighbour.frame, history_depth, history_frames, there.x, there.y, there.depth,
                                params.same_depth, there.is_seen);
  PLANE now[4] = {now_r, now_g, now_b, now_a};
  PLANE history[4] = {history_r, history_g, history_b, history_a};
  PLANE_OUT result[4] = {reflection_r, reflection_g, reflection_b, reflection_a};
  const Alike alike = alike_around(frame, depth, s.depth, params.same_depth);
  Around around_here[4];
  real of_surface[4], of_image[4],
      unlike = 0;  // by how much the surface's past is less like the neighbours than the image's
  for (int c = 0; c < 4; ++c) {
    around_here[c] = around_of(frame, alike, now[c]);
    of_surface[c] = value_of(as_surface, history[c]);
    of_image[c] = value_of(as_image, history[c]);
    if (c < 3) unlike += fabs(of_surface[c] - around_here[c].mean) - fabs(of_image[c] - around_here[c].mean);
  }
  const mask takes_image = as_image.is_known & (!as_surface.is_known | (unlike >= 0));
  const mask is_known = as_surface.is_known | as_image.is_known;
  const real before =
      clamp(choose(takes_image, value_of(as_image, history_frames), value_of(as_surface, history_frames)), (real)(0),
            (real)((scalar)params.most_frames - 1));
  const real share = (scalar)1 / (before + 1);
  for (int c = 0; c < 4; ++c) {
    const real own = choose(s.reflects & is_wanted, load(now[c], here), (real)(0));
    const real kept = kept_near(around_here[c], choose(takes_image, of_image[c], of_surface[c]), params.kept_within);
    store(choose(is_known, kept + (own - kept) * share, own), result[c], here);
  }
  store(choose(s.reflects & is_wanted, before + 1, (real)(0)), frames, here);
}
#endif
#endif
#endif
