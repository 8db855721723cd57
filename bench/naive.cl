// HBAO+ as one would port a GPU's pixel shader: one pixel per work-item, float3 positions, native functions, an early
// return on background. Samples, noise and result are those of kernels/hbao_plus.
//
// -D DIRECTIONS, STEPS: loop counts known to the compiler; without them they are arguments.
#define GUARD 64

typedef struct {
  int width, height, pitch, seed;
  float scale_x, scale_y, centre_x, centre_y;
} Camera;

typedef struct {
  float radius, bias, strength;
  float max_pixels;
  int directions, steps;
} Settings;

float unit_random(uint h) { return (h >> 8) * 0x1p-24f; }

float3 position(Camera c, int x, int y, float z) {
  return (float3)((x + 0.5f - c.centre_x) * c.scale_x * z, (c.centre_y - y - 0.5f) * c.scale_y * z, -z);
}

float obscurance(float3 v, float3 n, float bias, float inverse_square) {
  const float vv = dot(v, v);
  const float cosine = dot(n, v) * native_rsqrt(fmax(vv, 1e-30f));
  return fmax(cosine - bias, 0.0f) * fmax(1 - vv * inverse_square, 0.0f);
}

kernel void naive_hbao_plus(Camera camera, Settings settings, global const float* restrict depth,
                            global const float* restrict normal_x, global const float* restrict normal_y,
                            global const float* restrict normal_z, global float* restrict ao) {
#ifdef DIRECTIONS
  const int directions = DIRECTIONS, steps = STEPS;
#else
  const int directions = settings.directions, steps = settings.steps;
#endif
  const int x = get_global_id(0), y = get_global_id(1), here = GUARD + y * camera.pitch + x;
  const float z = depth[here];
  if (isinf(z)) {
    ao[here] = 1;
    return;
  }
  const float3 p = position(camera, x, y, z), n = (float3)(normal_x[here], normal_y[here], normal_z[here]);

  const float turn = unit_random(x * 0x8e42b7fdu + y * 0x4f2cbe3cu + camera.seed * 0x9e3779b9u) / directions;
  const float shift = unit_random(x * 0xc13fa9a9u + y * 0x91e10da6u + camera.seed * 0x6a09e667u);
  const float reach_x = fmin(settings.radius / (z * camera.scale_x), settings.max_pixels);
  const float reach_y = fmin(settings.radius / (z * camera.scale_y), settings.max_pixels);
  const float stride_x = fmax(reach_x - 1, 0.0f) / steps, stride_y = fmax(reach_y - 1, 0.0f) / steps;
  const float inverse_square = 1 / (settings.radius * settings.radius);

  float sum = 0;
#ifdef DIRECTIONS
#pragma unroll
#endif
  for (int d = 0; d < directions; ++d) {
    const float angle = 2 * M_PI_F * (turn + (float)d / directions);
    const float c = native_cos(angle), s = native_sin(angle);
#ifdef DIRECTIONS
#pragma unroll
#endif
    for (int k = 0; k < steps; ++k) {
      const int sx = clamp((int)(x + 0.5f + c * (1 + (shift + k) * stride_x)), 0, camera.width - 1);
      const int sy = clamp((int)(y + 0.5f + s * (1 + (shift + k) * stride_y)), 0, camera.height - 1);
      const float3 v = position(camera, sx, sy, depth[GUARD + sy * camera.pitch + sx]) - p;
      sum += obscurance(v, n, settings.bias, inverse_square);
    }
  }
  ao[here] = clamp(1 - 2 * settings.strength * sum / (directions * steps), 0.0f, 1.0f);
}
