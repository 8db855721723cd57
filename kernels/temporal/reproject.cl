// What the frames before knew of the AO, or of the light, of the surfaces that this frame shows (temporal reprojection: Yang, Liu, Salvi 2020, "A Survey
// of Temporal Antialiasing Techniques", section 3), and where something moves by itself.
//
// in : depth, normal  view-space z, scene units, +inf = background; unit, view space
//      motion         pixels, from this frame to the one before, y down (WITH_MOTION); without it, nothing moves but the camera
//      history, history_depth, history_frames  of the frame before, which `neighbour` shows
// out: before         mean of `history` over earlier frames; 0 where nothing is known
//      before_frames  how many frames have shown the surface; 0 where nothing is known
//      before_count   how many frames `before` counts for beside this one; 0 where nothing is known
//      moved          1 where a surface moves by itself, or where one has come or gone; else 0
// -D WITH_MOTION, COMPONENTS (of `history`)
#include "shared/frame/history.h"
#include "shared/frame/neighbour.h"
#include "shared/lanes/components.h"

#ifndef WITH_MOTION
#define WITH_MOTION 0
#endif

// Motion that differs by more pixels from that of a surface at rest is the surface's own.
#define LEAST_OWN_MOTION ((scalar)0.25f)

// Where the frame before showed a surface.
typedef struct {
  real x, y, depth;
  mask is_seen, is_at_rest;
} Before;

// A surface's tangent plane in the frame before's view space.
typedef struct {
  real3 normal;
  real distance;   // of the point from the origin, along the normal
  real tolerance;  // scene units
} PlaneBefore;

static inline PlaneBefore plane_before(Frame frame, Neighbour neighbour, Params params, real3 point, real3 normal,
                                       real z) {
  PlaneBefore plane;
  plane.normal = rotated(neighbour, normal);
  plane.distance = dot3(plane.normal, into_other(neighbour, point));
  const real pixel = fabs((scalar)frame.scale_x) * (frame.perspective * z + frame.parallel);
  plane.tolerance = params.plane_tolerance * smaller((real)((scalar)params.radius), z) + params.pixel_tolerance * pixel;
  return plane;
}

// Which corners show the surface: they lie on the tangent plane of one at rest, or at about the depth of one that moves by itself.
static inline void find_same(Neighbour neighbour, Params params, Before before, PlaneBefore plane, Corners corners,
                             PLANE history_depth, mask* is_same, mask* is_all_behind) {
  *is_all_behind = before.is_seen;
#pragma unroll
  for (int k = 0; k < 4; ++k) {
    const real z = past_value(corners.past, history_depth, k);
    const mask is_surface = before.is_seen & !is_background(z);
    const real3 there = position_at(neighbour.frame, to_real(corners.column[k]), to_real(corners.row[k]),
                                    choose(is_surface, z, before.depth));
    const mask is_in_plane = fabs(dot3(plane.normal, there) - plane.distance) <= plane.tolerance;
    const mask is_as_deep = fabs(z - before.depth) <= params.depth_change * before.depth;
    is_same[k] = is_surface & ((before.is_at_rest & is_in_plane) | (!before.is_at_rest & is_as_deep));
    *is_all_behind &= corners.is_inside[k] & (z > before.depth * (1 + (scalar)params.depth_change));
  }
}

// Whether the surface that the frame before showed at this pixel has gone: this frame shows what lies behind the surface's place.
static inline mask has_gone(Frame frame, Neighbour neighbour, Params params, PLANE depth, PLANE history_depth,
                            int here) {
  const real z = load(history_depth, here);
  const mask was_there = !is_background(z);
  const real3 there =
      position_at(neighbour.frame, to_real(FIRST_X + IOTA), (real)(ROW_Y), choose(was_there, z, (real)(1)));
  const Projection now = project_onto(frame, back_from_other(neighbour, there), was_there);
  const integer pixel = FRAME_GUARD + nearest(now.y) * frame.pitch + nearest(now.x);
  return now.is_seen & (gather(depth, pixel) > now.depth * (1 + (scalar)params.depth_change));
}

// From a point at rest to the eye, against the view: the point itself, or ahead where rays are parallel.
static inline real3 line_of_sight(Frame f, real3 point) {
  return make3(f.perspective * point.x, f.perspective * point.y, f.perspective * point.z - f.parallel);
}

// The sine of the angle by which the line of sight to a point at rest has turned since the frame before.
static inline real turn_of(Frame frame, Neighbour neighbour, real3 point) {
  const real3 a = line_of_sight(frame, point);
  const real3 b = rotated_back(neighbour, line_of_sight(neighbour.frame, into_other(neighbour, point)));
  const real3 across = make3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
  return sqrt(quotient(dot3(across, across), dot3(a, a) * dot3(b, b)));
}

// How much the history counts for, as 1 / frames: what is seen under another angle has other samples behind and beside it.
static inline real forgotten(Params params, real count, real share, real lag, mask moves_by_itself) {
  const real settled = larger(count - 1, (real)(1e-3f));
  const real turned = (scalar)params.turn_loss + quotient((real)((scalar)params.new_loss), settled);
  const real loss = quotient((real)(1), larger(count, (real)(1))) + params.edge_loss * (1 - share) + lag * turned;
  return choose(moves_by_itself, larger(loss, (real)((scalar)params.motion_loss)), loss);
}

static inline void store_nothing(Results before, PLANE_OUT before_frames, PLANE_OUT before_count, PLANE_OUT moved,
                                 int here) {
  store_all((real)(0), before, here);
  store((real)(0), before_frames, here);
  store((real)(0), before_count, here);
  store((real)(0), moved, here);
}

// in : depth, normal, history, history_depth, history_frames; motion
// out: before, before_frames, before_count, moved
kernel void temporal_reproject(ARGUMENTS) {
  const Sources histories = SOURCE_PLANES(history);
  const Results befores = RESULT_PLANES(before);
  const int here = index_of(frame, FIRST_X, ROW_Y);
  const real z = load(depth, here);
  const mask is_surface = !is_background(z);
  if (!ANY(is_surface)) {
    store_nothing(befores, before_frames, before_count, moved, here);
    return;
  }
  const real depth_here = choose(is_surface, z, (real)(1));
  const real x = to_real(FIRST_X + IOTA), y = (real)(ROW_Y);
  const real3 point = position_at(frame, x, y, depth_here);
  const Projection at_rest = project_into(neighbour, point, is_surface);
  Before past = {at_rest.x, at_rest.y, at_rest.depth, at_rest.is_seen, at_rest.is_seen};
#if WITH_MOTION
  const real moved_x = x + load(motion_x, here), moved_y = y + load(motion_y, here);
  past.is_at_rest &= (fabs(moved_x - past.x) <= LEAST_OWN_MOTION) & (fabs(moved_y - past.y) <= LEAST_OWN_MOTION);
  past.x = choose(past.is_at_rest, past.x, moved_x);
  past.y = choose(past.is_at_rest, past.y, moved_y);
  past.depth = choose(past.is_at_rest, past.depth, depth_here);
  past.is_seen = is_surface;
#endif
  const PlaneBefore plane =
      plane_before(frame, neighbour, params, point, load3(normal_x, normal_y, normal_z, here), depth_here);
  const Corners corners = corners_at(frame, past.x, past.y);
  mask is_same[4], is_all_behind;
  find_same(neighbour, params, past, plane, corners, history_depth, is_same, &is_all_behind);
  real share;
  const Past same = past_of_same(corners, history_frames, is_same, &share);
  const real count = smaller(share * same.frames, (real)((scalar)params.most_frames - 1));
  const mask is_known = same.is_known & is_surface & (count > 0);
#pragma unroll
  for (int c = 0; c < COMPONENTS; ++c)
    store(choose(is_known, value_of(same, histories.planes[c]), (real)(0)), befores.planes[c], here);
  store(choose(is_known, count, (real)(0)), before_frames, here);
  // Without both poses (frame.h), nothing tells what moves by itself: all may.
  const int has_poses = neighbour.translation[0] == neighbour.translation[0];
  const real change = has_poses ? turn_of(frame, neighbour, point) * (scalar)(1 / params.turn)
                                : larger(fabs(past.x - x), fabs(past.y - y));
  const mask moves_by_itself = has_poses ? !past.is_at_rest : (mask)(0);
  const real lag = choose(moves_by_itself, (real)(1), smaller(change, (real)(1)));
  const real loss = forgotten(params, count, share, lag, moves_by_itself);
  store(choose(is_known, quotient((real)(1), loss), (real)(0)), before_count, here);
  mask has_moved = has_poses ? at_rest.is_seen & !past.is_at_rest : EVERY_LANE;
  if (ANY(is_surface & !is_known))
    has_moved |=
        (!is_known & is_all_behind) | (!is_known & has_gone(frame, neighbour, params, depth, history_depth, here));
  store(choose(has_moved & is_surface, (real)(1), (real)(0)), moved, here);
}
