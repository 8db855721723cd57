#include "frame/subsample.h"

#include "gloam/planes.h"

namespace gloam {
namespace {

Channel every_nth(const Channel& from, const Layout& layout, int scale, float outside) {
  Channel to(layout);
  for (int y = 0; y < layout.height; ++y) {
    const float* source = from.row(y * scale);
    float* target = to.row(y);
    for (int x = 0; x < layout.width; ++x) target[x] = source[size_t(x) * size_t(scale)];
  }
  to.fill_padding(outside);
  return to;
}

/// The center of the first pixel stays where it is.
double reduced_center(double center, int start, int scale) { return 0.5 + (center - start - 0.5) / scale; }

Camera reduced_camera(Camera camera, const Window& window, int scale) {
  camera.fx /= scale;
  camera.fy /= scale;
  camera.cx = reduced_center(camera.cx, window.x0, scale);
  camera.cy = reduced_center(camera.cy, window.y0, scale);
  return camera;
}

}  // namespace

Frame every_nth_pixel(const Frame& frame, int scale, const std::vector<std::string>& planes) {
  const Layout layout = reduced(Layout(frame.width(), frame.height()), scale);
  Frame small = without_planes(frame);
  small.window = small.display = {0, 0, layout.width, layout.height};
  for (size_t i = 0; i < frame.views.size(); ++i) {
    const View& from = frame.views[i];
    View& view = small.views[i];
    if (view.camera) view.camera = reduced_camera(*view.camera, frame.window, scale);
    view.camera_before.reset();
    for (const std::string& name : planes) {
      const Plane* plane = from.find(name);
      if (!plane) continue;
      Plane reduced_plane{name, {}};
      for (const Channel& channel : plane->channels)
        reduced_plane.channels.push_back(every_nth(channel, layout, scale, plane_kind(name).outside));
      view.planes[name] = std::move(reduced_plane);
    }
  }
  return small;
}

}  // namespace gloam
