// Follows rays through the hierarchy until they meet a surface (Stachowiak and Uludag 2015). With TRAVERSAL, a ray that leaves this
// eye's image or passes behind a surface goes on in the other eye's image (IN_OTHER; Wu, Xu, Wang 2024, section 4).
//
// in : depth, normal     of the surfaces that rays start from; view-space z, scene units; unit, view space
//      nearness, farness hierarchy.cl; of the image that is traversed
//      list, ray_x, _y, _z, left_at  ray.h
//      back_depth        of the back of what is seen (TRAVERSAL); other_normal (IN_OTHER)
// out: met               ray.h
//      left_at, others   of rays that go on in the other eye's image, and the list of these (TRAVERSAL)
// -D LEVELS, BOTH_DEPTHS, RAYS, STEREO, TRAVERSAL, IN_OTHER
#include "shared/lanes/pixel_list.h"
#include "shared/lanes/wanted.h"
#include "ssr/ray.h"

// Whether what a pixel shows rises over the surface that the ray starts from. If not, it is that surface.
static inline mask rises(Frame frame, Start s, Place p, real nearest) {
  const real e = frame.perspective > 0 ? -nearest / (1 + nearest) : -nearest;
  const real3 u = exactly_towards(frame, s.point, to_real(p.column), to_real(p.row), e);
  const real3 v = make3(u.x + s.from_surface.x, u.y + s.from_surface.y, u.z + s.from_surface.z);
  const real height = dot3(v, s.normal);
  return height > 0 & height * height > s.least_sine * s.least_sine * dot3(v, v);
}

// Relative nearness of the back of what a pixel shows; `nearest` where the back is not known.
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

// Whether rays enter a pixel behind the surface it shows: behind its back, or where that is not known, deeper than the thickness.
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

// The pixel after the one where a ray starts; in the other eye, that pixel itself.
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

// Whether a ray has ended: at the border, at infinity or at its greatest length.
static inline mask ends_at(Frame frame, Start s, Place p) {
  return (p.t >= s.line.end) |
         to_mask((p.column < 0) | (p.column >= frame.width) | (p.row < 0) | (p.row >= frame.height));
}

// Moves `active` rays within the image to the next cell, or into a smaller one. Returns which of them meet a surface where they
// are; `hidden`: which are behind a surface.
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
#define HIERARCHY hierarchy_of(nearness, farness)
#else
#define HIERARCHY hierarchy_of(nearness, nearness)
#endif

// Rays take 10 to 200 steps. Lanes whose ray has ended take the next rays, so that few wait for the longest. On a GPU lanes are the
// work-items of a warp: they take rays in the same rounds, so that all of them wait for a ray's start once in a while, and their rays
// follow one another in the list, where neighbours are. With few rays each item has as many as a pixel, so that there are enough items.
#define MOST_RAYS_PER_ITEM (LANES == 1 ? 8 * RAYS : 32 * LANES)
#define LANES_WORTH_FILLING (LANES == 1 ? 1 : LANES / 2)
#define ROUNDS_TO_A_START (LANES == 1 ? 8 : 1)
#define WORTH_SHARING (1 << 17)

// A work-item's rays: every `stride`-th entry of the list from `next` on.
typedef struct {
  int next, last, stride;
} Turns;

static inline Turns turns_of_item(Frame image, int count) {
  Turns t;
#if LANES == 1
  const int per_item = clamp(count / WORTH_SHARING, RAYS, MOST_RAYS_PER_ITEM);
  t.stride = (count + per_item - 1) / per_item;
  t.next = ROW_Y * image.pitch + FIRST_X;
  t.last = t.next < t.stride ? count : 0;
#else
  // Down the columns of work-items: devices start the image row by row, and the first rows would get all the work.
  const int item = FIRST_X / LANES * image.height + ROW_Y;
  t.stride = 1;
  // Divided rather than multiplied: in a large image the product would overflow an int.
  const int is_beyond = count == 0 || item > (count - 1) / MOST_RAYS_PER_ITEM;
  t.next = is_beyond ? 0 : item * MOST_RAYS_PER_ITEM;
  t.last = is_beyond ? 0 : t.next + min(MOST_RAYS_PER_ITEM, count - t.next);
#endif
  return t;
}

// Writes one value per lane to one index each in a plane's memory, where a mask holds.
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
// Rays that a work-item adds to another list, appended together so that work-items seldom wait for one another.
typedef struct {
  int rays[MOST_RAYS_PER_ITEM + 1], count;  // one more, since what does not count is written too
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

// Gives idle lanes the next rays of a list. Returns which lanes have a ray.
static inline mask fill_lanes(global const int* rays, Turns* turns, integer* ray, mask active) {
#if LANES == 1
  if (active || turns->next >= turns->last) return active;
  *ray = rays[turns->next];
  turns->next += turns->stride;
  return EVERY_LANE;
#else
  integer busy = integer_of(active);
  int *lanes = (int*)ray, *is_busy = (int*)&busy;
  for (int i = 0; i < LANES && turns->next < turns->last; ++i) {
    if (is_busy[i]) continue;
    lanes[i] = rays[turns->next++];
    is_busy[i] = -1;
  }
  return to_mask(busy);
#endif
}

// Whether rays meet the front of the surface at their pixel. A surface without a normal has no back.
static inline mask is_front(Frame frame, Place p, Start s, PLANE normal_x, PLANE normal_y, PLANE normal_z,
                            mask counts) {
  if (!ANY(counts)) return counts;
  const integer column = clamp(p.column, (integer)(0), (integer)(frame.width - 1));
  const integer row = clamp(p.row, (integer)(0), (integer)(frame.height - 1));
  return dot3(s.direction, gather3(normal_x, normal_y, normal_z, FRAME_GUARD + row * frame.pitch + column)) <= 0;
}

// The planes in which a list's rays start.
typedef struct {
  global const float *depth, *normal_x, *normal_y, *normal_z, *ray_x, *ray_y, *ray_z;
} Rays;

static inline Start start_of_ray(Frame frame, Params params, Rays rays, integer ray) {
  const integer pixel = ray % floats_of_layer(frame);
  return start_of(frame, params, to_real(column_of(frame, pixel)), to_real(row_of(frame, pixel)),
                  gather(rays.depth, pixel), gather3(rays.normal_x, rays.normal_y, rays.normal_z, pixel),
                  gather3(rays.ray_x, rays.ray_y, rays.ray_z, ray));
}

// Follows this eye's rays through its own image or, IN_OTHER, through the other's. `met`: what they meet there. `left_at`: steps
// after which a ray is hidden from this eye, or beyond its image; `others`: the list of these rays.
// in : depth, normal, nearness, list, ray_x, ray_y, ray_z; farness, back_depth, left_at, other_normal
// out: met; left_at, others
kernel void ssr_march(ARGUMENTS) {
#if IN_OTHER
  const Frame image = neighbour.frame;
#else
  const Frame image = frame;
#endif
#if !TRAVERSAL
  global const float* back_depth = 0;
#endif
  global const int* entries = (global const int*)list;
  Turns turns = turns_of_item(image, entries[0]);
  if (turns.next >= turns.last) return;
  const Rays rays = {depth, normal_x, normal_y, normal_z, ray_x, ray_y, ray_z};
  integer ray = (integer)(entries[FRAME_GUARD + turns.next]), steps = (integer)(0);
  mask active = (mask)(0);
  Start start;
  Place place;
#if GOES_ON_IN_OTHER
  real left = 0;
  Batch further;
  further.count = 0;
#endif
  for (int round = 0;; ++round) {
    const int idle = LANES - popcount(bit_of_each_lane(active));
    if (idle == LANES && turns.next >= turns.last) break;
    if (idle >= LANES_WORTH_FILLING && turns.next < turns.last && round % ROUNDS_TO_A_START == 0) {
      const mask before = active;
      active = fill_lanes(entries + FRAME_GUARD, &turns, &ray, active);
      // A ray's start depends on nothing but its pixel: recomputing it for all lanes changes none.
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
