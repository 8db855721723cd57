// Declared, defined nowhere: only linking would show that.
float elsewhere(float x);
kernel void call(global float* plane) { plane[get_global_id(0)] = elsewhere(plane[get_global_id(0)]); }
