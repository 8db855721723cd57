#pragma OPENCL EXTENSION cl_khr_int64_base_atomics : enable
kernel void count(volatile global long* counter) { atom_inc(counter); }
