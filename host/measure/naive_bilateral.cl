// The cross-bilateral filter of kernels/bilateral, over `columns` to the left and right and `rows` above and below. Compiled
// after naive.cl.

// Biweight: 0 one pixel beyond the last tap.
float window_at(int k, int taps) {
  const float t = (float)k / (taps + 1);
  return (1 - t * t) * (1 - t * t);
}

kernel void naive_bilateral(Camera camera, Settings settings, global const float* restrict depth,
                            global const float* restrict normal_x, global const float* restrict normal_y,
                            global const float* restrict normal_z, global float* restrict result,
                            global const float* restrict source) {
  const int columns = COLUMNS, rows = ROWS;
  const int x = get_global_id(0), y = get_global_id(1), here = index_of(camera, x, y);
  const float z = depth[here];
  if (isinf(z)) {
    result[here] = 1;
    return;
  }
  const float3 p = position(camera, x, y, z), n = (float3)(normal_x[here], normal_y[here], normal_z[here]);
  // The pixel itself always counts.
  float sum = source[here], weights = 1;
#ifdef UNROLLED
#pragma unroll
#endif
  for (int j = -rows; j <= rows; ++j) {
#ifdef UNROLLED
#pragma unroll
#endif
    for (int i = -columns; i <= columns; ++i) {
      const int sx = x + i, sy = y + j, there = index_of(camera, sx, sy);
      if ((i == 0 && j == 0) || sx < 0 || sy < 0 || sx >= camera.width || sy >= camera.height) continue;
      const float3 other = (float3)(normal_x[there], normal_y[there], normal_z[there]);
      const float distance = fabs(dot(n, position(camera, sx, sy, depth[there]) - p));
      const float on_plane = fmax(1 - distance / settings.distance, 0.0f);
      const float alike = fmax(1 - (1 - dot(n, other)) / settings.one_minus_cosine, 0.0f);
      const float weight = window_at(i, columns) * window_at(j, rows) * on_plane * alike;
      sum += weight * source[there];
      weights += weight;
    }
  }
  result[here] = sum / weights;
}
