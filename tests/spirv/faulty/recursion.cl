int sum_to(int number) { return number == 0 ? 0 : number + sum_to(number - 1); }
kernel void sums(global int* plane) { plane[get_global_id(0)] = sum_to((int)get_global_id(0)); }
