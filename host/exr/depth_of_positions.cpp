#include "exr/depth_of_positions.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <limits>

#include "base/lists.h"
#include "gloam/error.h"
#include "gloam/option.h"
#include "normalise/background.h"
#include "normalise/each_row.h"

namespace gloam {
namespace {

/// Turns positions of one row into depths.
class RowOfDepths {
 public:
  RowOfDepths(const PositionFindings& findings, const View& view, const Window& window)
      : camera_(*findings.camera), window_(window), background_(findings.background) {
    // In double, so that a distant origin costs no digits.
    start_ = camera_.pose->world_to_view * (view.origin - camera_.pose->position);
    farthest_ = findings.agrees ? std::max(3.0, 10 * findings.median) : std::numeric_limits<double>::infinity();
  }

  /// Returns how many positions lie elsewhere than at their pixels.
  long long make(Plane& depth, int y) const {
    float* z = depth.channels[0].row(y);
    const float *up = depth.channels[1].row(y), *along = depth.channels[2].row(y);
    long long elsewhere = 0;
    for (int x = 0; x < depth.channels[0].layout().width; ++x) {
      const glm::vec3 stored(z[x], up[x], along[x]);
      z[x] = infinity;
      if (!is_position(stored)) continue;
      const glm::dvec3 v = start_ + camera_.pose->world_to_view * glm::dvec3(stored);
      if (is_at(v, x, y))
        z[x] = float(-v.z);
      else
        ++elsewhere;
    }
    return elsewhere;
  }

 private:
  bool is_position(const glm::vec3& p) const {
    const float largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    return largest > 0 && largest < farthest_depth && p.x == p.x && p.y == p.y && p.z == p.z &&
           !(background_ && p == *background_);
  }

  bool is_at(const glm::dvec3& v, int x, int y) const {
    if (!(-v.z >= nearest_depth)) return false;
    const double along = camera_.orthographic ? 1 : -v.z;
    const double off_x = camera_.cx + camera_.fx * v.x / along - (window_.x0 + x + 0.5);
    const double off_y = camera_.cy - camera_.fy * v.y / along - (window_.y0 + y + 0.5);
    return std::max(std::abs(off_x), std::abs(off_y)) <= farthest_;
  }

  const Camera& camera_;
  Window window_;
  std::optional<glm::vec3> background_;
  glm::dvec3 start_;
  double farthest_;
};

}  // namespace

void add_depth_of_positions(ExrFile& file) {
  const bool measures = file.options.as_stored && !file.options.only_looks;  // sees what was written, and nothing else
  if (measures || file.options.channels.contains("depth")) return;
  std::vector<PlaneSource> made;
  for (const PlaneSource& source : file.names.planes)
    if (source.plane == "position" && source.channels.size() == 3 && !file.source("depth", source.view))
      made.push_back({"depth", source.view, source.channels, DeclaredConvention::made_of_positions});
  file.names.planes.insert(file.names.planes.begin(), made.begin(), made.end());
}

bool is_made_of_positions(const ExrFile& file, const std::string& view) {
  const PlaneSource* depth = file.source("depth", view);
  return depth && depth->said == DeclaredConvention::made_of_positions;
}

void make_depth(const ExrFile& file, const PositionFindings& findings, View& view, Frame& frame) {
  Plane& depth = view.planes.at("depth");
  const RowOfDepths row(findings, view, file.window);
  std::vector<long long> elsewhere(size_t(depth.channels[0].layout().height));
  for_each_row(depth.channels[0].layout(), [&](int y) { elsewhere[size_t(y)] = row.make(depth, y); });
  depth.channels.resize(1);
  long long count = 0;
  for (const long long each : elsewhere) count += each;
  const std::string of_view = view.name.empty() ? "" : fmt::format(" of view '{}'", view.name);
  add_new(frame.assumed, fmt::format("depth{}: made from the positions", of_view));
  if (file.options.depth != DepthConvention::automatic)
    add_new(frame.assumed, "depth: " + option("depth") + " has no effect, as depth is made from the positions");
  if (count > 0)
    add_new(frame.assumed,
            fmt::format("depth{}: {} pixel{} with a position that lies elsewhere in the image taken as background",
                        of_view, count, count == 1 ? "" : "s"));
}

}  // namespace gloam
