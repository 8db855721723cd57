#include "exr/normals_beside.h"

#include <algorithm>

#include "exr/decode_planes.h"
#include "exr/memory.h"
#include "exr/normals.h"

namespace gloam {

namespace {

/// Decoded row by row where the view is without them.
NormalSamples sampled_normals(const ExrFile& file, const FileCameras& cameras, const View& view) {
  const Window& all = file.window;
  NormalSamples samples(Layout(all.width(), all.height()));
  if (const Plane* normal = view.find("normal")) {
    samples.take(*normal, 0);
    return samples;
  }
  const int step = rows_at_once(file, {"normal"});
  for (int first = 0; first < all.height(); first += step) {
    const int last = std::min(first + step, all.height());
    Frame rows = allocate_planes(file, cameras, {"normal"}, {all.x0, all.y0 + first, all.x1, all.y0 + last});
    std::erase_if(rows.views, [&](const View& other) { return other.name != view.name; });
    decode_planes(file, rows);
    samples.take(*rows.views.front().find("normal"), first);
  }
  return samples;
}

}  // namespace

std::optional<NormalsBeside> normals_beside(const ExrFile& file, const FileCameras& cameras, const View& view) {
  const PlaneSource* const source = file.source("normal", view.name);
  if (!source) return {};
  return NormalsBeside{sampled_normals(file, cameras, view), stated_normals(file, *source)};
}

}  // namespace gloam
