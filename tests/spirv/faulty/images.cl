kernel void copy(read_only image2d_t image, global float* plane) {
  const sampler_t nearest = CLK_NORMALIZED_COORDS_FALSE | CLK_ADDRESS_CLAMP | CLK_FILTER_NEAREST;
  plane[get_global_id(0)] = read_imagef(image, nearest, (int2)((int)get_global_id(0), 0)).x;
}
