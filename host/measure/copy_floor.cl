// Copies one plane, a row of lanes per work-item. Compiled after shared/lanes/load.h.
kernel void copy_floor(Frame frame, PLANE source, PLANE_OUT result) {
  const int here = index_of(frame, FIRST_X, ROW_Y);
  store(load(source, here), result, here);
}
