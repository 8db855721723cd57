// A literal without a suffix is a double.
kernel void half_of(global float* plane) { plane[get_global_id(0)] = 0.5 * plane[get_global_id(0)]; }
