// GTAO (Jimenez, Wu, Pesce, Jarabo 2016, Algorithm 1 and equations 7 to 10): two horizons per slice as angles from the line to
// the eye, and the cosine-weighted integral between them in closed form. Compiled after naive.cl.
//
// As in kernels/gtao, and unlike the paper: the positions of slices and samples; no falloff up to the radius and nothing beyond;
// samples are moved into the slice along the surface's tangent plane; slices are drawn in proportion to their weight.

// One side of equation 7 without the 1/4, from the line to the eye to the horizon h; n: the projected normal's angle.
float inner_integral(float h, float n, float cosine_n, float sine_n) {
  return -native_cos(2 * h - n) + cosine_n + 2 * h * sine_n;
}

kernel void naive_gtao(Camera camera, Settings settings, global const float* restrict depth,
                       global const float* restrict normal_x, global const float* restrict normal_y,
                       global const float* restrict normal_z, global float* restrict ao) {
  const int slices = DIRECTIONS, steps = STEPS;
  const int x = get_global_id(0), y = get_global_id(1), here = index_of(camera, x, y);
  const float z = depth[here];
  if (isinf(z)) {
    ao[here] = 1;
    return;
  }
  const float3 p = position(camera, x, y, z), to_eye = normalize(-p);
  float3 normal = (float3)(normal_x[here], normal_y[here], normal_z[here]);
  normal += fmax(1e-4f - dot(normal, to_eye), 0.0f) * to_eye;  // turned towards the eye at least a little
  const float3 right = normalize(cross((float3)(0, 1, 0), to_eye)), up = cross(to_eye, right);

  const float turn = turn_at(camera, x, y), shift = shift_at(camera, x, y);
  const float reach_x = fmin(settings.radius / (z * camera.scale_x), settings.max_pixels);
  const float reach_y = fmin(settings.radius / (z * camera.scale_y), settings.max_pixels);
  const float radius_square = settings.radius * settings.radius;

  // kernels/shared/sampling/slice_angle.h: the normal's own slice, and the polynomials for its sine_square.
  const float across_right = dot(normal, right), across_up = dot(normal, up);
  const float own_angle = atan2(across_up, across_right);
  const float sine_square = fmin(across_right * across_right + across_up * across_up, 1.0f);
  const float p0 = sine_square * (0.224f + sine_square * (0.17208f - 0.17788f * sine_square)),
              p1 = sine_square * (0.06328f - sine_square * (0.44239f - 0.25163f * sine_square)),
              p2 = sine_square * (-0.08113f + sine_square * (0.35633f - 0.1916f * sine_square));

  float closed = 0;
#ifdef UNROLLED
#pragma unroll
#endif
  for (int d = 0; d < slices; ++d) {
    const float even_angle = M_PI_F * (d + turn) / slices, twice = 2 * (even_angle - own_angle);
    const float c = native_cos(twice), s = native_sin(twice), shape = p0 + c * (p1 + c * p2);
    const float angle = even_angle - s * shape, width = 1 - 2 * (c * shape - s * s * (p1 + 2 * c * p2));
    const float3 tangent = native_cos(angle) * right + native_sin(angle) * up;
    // The slice's direction on the screen: the tangent moved along the line to the eye into the image plane.
    const float3 screen = tangent - tangent.z / to_eye.z * to_eye;
    const float per_screen = 1 / dot(screen, screen);

    // The normal's projection onto the slice: its length, and its angle from the line to the eye.
    const float facing = dot(normal, to_eye), across = dot(normal, tangent);
    const float length = sqrt(facing * facing + across * across), cosine = facing / length, sine = across / length;
    const float inverse_cosine = 1 / cosine;
    const float3 upright = normal / length;
    const float n = copysign(acos(fmin(cosine, 1.0f)), sine);

    float horizon[2];
#ifdef UNROLLED
#pragma unroll
#endif
    for (int side = 0; side < 2; ++side) {
      const float sign = side == 0 ? -1 : 1;
      float highest = -1;  // cosine
#ifdef UNROLLED
#pragma unroll
#endif
      for (int k = 0; k < steps; ++k) {
        const float even = (k + shift) / steps, t = sign * even * (0.4f + 0.6f * even);
        const int wanted_x = (int)(x + 0.5f + screen.x * reach_x * t),
                  wanted_y = (int)(y + 0.5f - screen.y * reach_y * t);
        const int sx = clamp(wanted_x, 0, camera.width - 1), sy = clamp(wanted_y, 0, camera.height - 1);
        const float there = depth[index_of(camera, sx, sy)];
        const float3 v = position(camera, sx, sy, there) - p;
        // The sample moved into the slice at the same height above the surface's tangent plane: along the slice's tangent, and
        // towards the eye.
        const float along =
            ((sx - x) * camera.scale_x * screen.x - (sy - y) * camera.scale_y * screen.y) * per_screen * there;
        const float height = dot(upright, v), towards = (height - sine * along) * inverse_cosine;
        const float square = along * along + towards * towards;
        const float place =
            ((wanted_x - x) * camera.scale_x * screen.x - (wanted_y - y) * camera.scale_y * screen.y) * per_screen * z;
        if (height > settings.bias * sign * place * inverse_cosine && square < radius_square)
          highest = fmax(highest, towards * native_rsqrt(square));
      }
      horizon[side] = sign * acos(fmin(highest, 1.0f));
    }
    const float h1 = n + fmax(horizon[0] - n, -M_PI_2_F), h2 = n + fmin(horizon[1] - n, M_PI_2_F);
    const float open = 0.25f * (inner_integral(h1, n, cosine, sine) + inner_integral(h2, n, cosine, sine));
    closed += width * length * (cosine + n * sine - open);  // less what is open without occluders
  }
  ao[here] = clamp(1 - closed / slices, 0.0f, 1.0f);
}
