// Copies pixels between images of different layouts, and keeps values within bounds (device_memory.h). Launched for each pixel, and for
// those of the row padding of `to`.
//
// in : from  pixel (0, 0) at from_index, pixels from_step apart, rows from_pitch apart; `width` pixels
// out: to    the same with to_index, to_step, to_pitch; `below` for values below `low`, `above` for those above `high`, `otherwise` for NaN,
//            `outside` from column `width` on
kernel void copy_pixels(ARGUMENTS) {
  const size_t x = get_global_id(0), y = get_global_id(1);
  const float value = x < width ? from[from_index + x * from_step + y * from_pitch] : outside;
  to[to_index + x * to_step + y * to_pitch] = x >= width     ? outside
                                              : value < low  ? below
                                              : value > high ? above
                                              : isnan(value) ? otherwise
                                                             : value;
}
