// A product of doubles, rounded once; on a device without double a product of floats.
kernel void scale(global float* plane) { plane[get_global_id(0)] *= (float)(3.14159265358979 * 3.14159265358979 / 32); }
