// HBAO+ with the samples, noise and result of kernels/hbao_plus. Compiled after naive.cl.

float obscurance(float3 v, float3 n, float bias, float inverse_square) {
  const float vv = dot(v, v);
  const float cosine = dot(n, v) * native_rsqrt(fmax(vv, 1e-30f));
  return fmax(cosine - bias, 0.0f) * fmax(1 - vv * inverse_square, 0.0f);
}

kernel void naive_hbao_plus(Camera camera, Settings settings, global const float* restrict depth,
                            global const float* restrict normal_x, global const float* restrict normal_y,
                            global const float* restrict normal_z, global float* restrict ao) {
  const int directions = DIRECTIONS, steps = STEPS;
  const int x = get_global_id(0), y = get_global_id(1), here = index_of(camera, x, y);
  const float z = depth[here];
  if (isinf(z)) {
    ao[here] = 1;
    return;
  }
  const float3 p = position(camera, x, y, z), n = (float3)(normal_x[here], normal_y[here], normal_z[here]);

  const float turn = turn_at(camera, x, y) / directions, shift = shift_at(camera, x, y);
  const float reach_x = fmin(settings.radius / (z * camera.scale_x), settings.max_pixels);
  const float reach_y = fmin(settings.radius / (z * camera.scale_y), settings.max_pixels);
  const float stride_x = fmax(reach_x - 1, 0.0f) / steps, stride_y = fmax(reach_y - 1, 0.0f) / steps;
  const float inverse_square = 1 / (settings.radius * settings.radius);

  float sum = 0;
#ifdef UNROLLED
#pragma unroll
#endif
  for (int d = 0; d < directions; ++d) {
    const float angle = 2 * M_PI_F * (turn + (float)d / directions);
    const float c = native_cos(angle), s = native_sin(angle);
#ifdef UNROLLED
#pragma unroll
#endif
    for (int k = 0; k < steps; ++k) {
      const int sx = clamp((int)(x + 0.5f + c * (1 + (shift + k) * stride_x)), 0, camera.width - 1);
      const int sy = clamp((int)(y + 0.5f + s * (1 + (shift + k) * stride_y)), 0, camera.height - 1);
      const float3 v = position(camera, sx, sy, depth[index_of(camera, sx, sy)]) - p;
      sum += obscurance(v, n, settings.bias, inverse_square);
    }
  }
  ao[here] = clamp(1 - 2 * settings.strength * sum / (directions * steps), 0.0f, 1.0f);
}
