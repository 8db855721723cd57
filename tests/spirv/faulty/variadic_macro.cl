#define FIRST(a, ...) a
kernel void first(global int* plane) { plane[get_global_id(0)] = FIRST(1, 2); }
