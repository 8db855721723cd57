// Radiance that rays see (Stachowiak and Uludag 2015), with a confidence that fades towards the border of the image. With FADE, of
// the two images the one counts that shows the hit farther from its border (Wu, Xu, Wang 2024, section 4).
//
// in : depth, normal, color    of this eye and, with TRAVERSAL or FADE, of the other; color: radiance, the same in every direction;
//                              the color of background is what rays see that meet nothing
//      ray_x, _y, _z, ray_density, met, met_in_other, left_at  ray.h
//      specular_occlusion           open share of the pixel's lobe, a factor on the environment (WITH_SPECULAR_OCCLUSION)
//      environment_light            of a map (environment.h); without ENVIRONMENT_SIZE, params.environment_r, _g, _b
// out: hit_length       of the first reflected ray, scene units; 0 for a miss and for background
//      ray_r, _g, _b    what the ray sees
//      ray_length       scene units, +inf towards background, 0 for a miss
//      ray_confidence   0 for a miss .. 1
// -D RAYS, STEREO, TRAVERSAL, FADE
#include "shared/lanes/pixel_list.h"
#include "ssr/environment.h"
#include "ssr/ray.h"

static inline real3 gather_radiance(PLANE r, PLANE g, PLANE b, integer i) {
  const real3 c = gather3(r, g, b, i);
  return make3(kept_radiance(c.x), kept_radiance(c.y), kept_radiance(c.z));
}

// The planes of an eye's image.
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

// What the image shows of what a ray meets.
typedef struct {
  mask is_known;
  real x, y;    // where in the image, pixels
  real length;  // of the ray, scene units; +inf towards background
  real3 color;
} Sight;

// Colour at a point of the image, from those of its four pixels that lie on the plane of the pixel that was met.
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
  const real scale = quotient((real)(1), choose(is_known, weights, (real)(1)));
  return choose3(is_known, scale3(sum, scale), gather_radiance(image.color_r, image.color_g, image.color_b, here));
}

// Steps after which a ray passes the middle of a pixel.
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
  // Where the ray crosses the plane of the pixel that it meets, if that is near the pixel.
  const real to_plane = quotient(dot3(met, n), smaller(facing, (real)(-1e-3f)));
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

// in : depth, normal, color, ray_x, ray_y, ray_z, ray_density, met; met_in_other, left_at, other_depth, other_normal,
//      other_color
// out: hit_length, ray_r, ray_g, ray_b, ray_length, ray_confidence
kernel void ssr_see(ARGUMENTS) {
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
#if WITH_SPECULAR_OCCLUSION
    const real missing = (1 - confidence) * clamp(load(specular_occlusion, here), (real)(0), (real)(1));
#else
    const real missing = 1 - confidence;
#endif
#ifdef ENVIRONMENT_SIZE
    const real3 environment =
        seen_by_ray(environment_light, direction, load(layer_of(ray_density, frame, k), here), missing > 0);
#else
    const real3 environment = even_environment(params);
#endif
    const real3 color = choose3(sight.is_known, sight.color, make3((real)(0), (real)(0), (real)(0)));
    sight.length = choose(sight.is_known, sight.length, (real)(0));
    if (k == 0) store(choose(isinf(sight.length), (real)(0), sight.length), hit_length, here);
    store(confidence * color.x + missing * environment.x, layer_of_out(ray_r, frame, k), here);
    store(confidence * color.y + missing * environment.y, layer_of_out(ray_g, frame, k), here);
    store(confidence * color.z + missing * environment.z, layer_of_out(ray_b, frame, k), here);
    store(sight.length, layer_of_out(ray_length, frame, k), here);
    store(confidence, layer_of_out(ray_confidence, frame, k), here);
  }
}
