#pragma OPENCL EXTENSION cl_khr_fp16 : enable
kernel void narrow(global float* plane) { plane[get_global_id(0)] = (half)plane[get_global_id(0)]; }
