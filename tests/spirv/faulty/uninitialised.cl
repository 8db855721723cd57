kernel void fill(global float* plane) {
  float value;
  if (plane[get_global_id(0)] > 0) value = 1;
  plane[get_global_id(0)] = value;
}
