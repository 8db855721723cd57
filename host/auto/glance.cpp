#include "auto/glance.h"

#include <algorithm>
#include <cmath>

#include "auto/changes.h"
#include "base/lists.h"
#include "base/statistics.h"
#include "frame/subsample.h"
#include "gloam/planes.h"

namespace gloam {
namespace {

/// On fewer pixels than these along a side, a glance tells little.
constexpr int least_side = 48;
constexpr int most_scale = 4;  // a power of two, as tiles of pictures are

/// A side of the tiles of a glance, pixels: 16 of the frame, as masks have them.
constexpr int side_of_tile = 4;
/// A value that is nearer to where nothing is does not count.
constexpr float least_value = 0.01f;

/// Whether any pixel of a tile is not as where nothing is.
bool shows(const Plane& plane, int left, int top) {
  const float outside = plane_kind(plane.name).outside;
  const Layout& layout = plane.channels.front().layout();
  // Of a reflection the light, not the share that was found.
  for (size_t c = 0; c < std::min<size_t>(plane.channels.size(), 3); ++c) {
    for (int y = top; y < std::min(top + side_of_tile, layout.height); ++y)
      for (int x = left; x < std::min(left + side_of_tile, layout.width); ++x)
        if (std::fabs(plane.channels[c].at(x, y) - outside) > least_value) return true;
  }
  return false;
}

}  // namespace

int scale_of_glance(const Frame& frame) {
  int scale = most_scale;
  while (scale > 1 && std::min(frame.width(), frame.height()) / scale < least_side) scale /= 2;
  return scale;
}

Glance::Glance(const Frame& frame, ComposeOptions how)
    : how_(std::move(how)),
      small_(every_nth_pixel(frame, scale_of_glance(frame), common_planes(frame))),
      parts_(without_planes(small_)),
      whole_(without_planes(small_)) {}

void Glance::look(const std::vector<Plan>& plans, Device& device, const RunOptions& options) {
  for (const Plan& plan : plans) take_planes_of(plan, device, options);
  std::sort(planes_.begin(), planes_.end());
  whole_ = picture_of(planes_);
  rms_ = std::sqrt(mean_square(whole_));
  seen_ = seen_in(changes_of(small_, parts_, planes_, how_), small_);
  model_ = model_of(seen_, [this](const auto& planes) { return used(planes).size() == planes.size(); });
}

void Glance::take_planes_of(const Plan& plan, Device& device, const RunOptions& options) {
  RunOptions thrice = options;
  thrice.repeat = 3;
  RunResult result = run(plan, small_, device, thrice);
  ms_ += median(result.total_ms);
  for (View& view : result.frame.views) {
    for (auto& [name, plane] : view.planes) {
      parts_.view(view.name).planes[name] = std::move(plane);
      if (contains(part_planes(), name)) add_new(planes_, name);
    }
  }
}

Frame Glance::picture_of(const std::vector<std::string>& planes) const {
  return composed(small_, parts_, planes, how_);
}

double Glance::change_by(const std::vector<std::string>& planes) const {
  std::vector<UsedPlane> best;
  for (const std::string& plane : used(planes_))
    if (contains(planes, plane)) best.push_back({plane});
  return std::sqrt(mean_square_change(model_, best));
}

Plane Glance::changes_by(const std::vector<std::string>& planes, const std::string& view) const {
  std::vector<std::string> others = planes_;
  std::erase_if(others, [&](const std::string& plane) { return contains(planes, plane); });
  const Frame picture = picture_of(others);
  const Plane &with = *whole_.view(view).find("color"), &left = *picture.view(view).find("color");
  const double unit = std::max(rms_, 1e-30);
  Channel change(with.channels.front().layout(), 0);
  for (int y = 0; y < change.layout().height; ++y) {
    for (int x = 0; x < change.layout().width; ++x) {
      double squares = 0;
      for (size_t c = 0; c < with.channels.size(); ++c)
        squares += std::pow(double(with.channels[c].at(x, y)) - left.channels[c].at(x, y), 2);
      change.at(x, y) = float(std::sqrt(squares / double(with.channels.size())) / unit);
    }
  }
  Plane result{"change", {}};
  result.channels.push_back(std::move(change));
  return result;
}

const std::vector<std::string>& Glance::used(const std::vector<std::string>& made) const {
  const auto known = used_.find(made);
  if (known != used_.end()) return known->second;
  const Composition composition = composition_of(common_planes(small_), made, how_);
  std::vector<std::string> planes;
  for (const ComposedPart& part : composition.parts)
    if (part.is_used) planes.push_back(part.plane);
  return used_[made] = planes;
}

double Glance::share_of(const std::string& plane) const {
  double showing = 0, all = 0;
  for (const View& view : parts_.views) {
    const Plane* found = view.find(plane);
    if (!found) continue;
    for (int y = 0; y < parts_.height(); y += side_of_tile) {
      for (int x = 0; x < parts_.width(); x += side_of_tile, ++all) showing += shows(*found, x, y);
    }
  }
  return all > 0 ? showing / all : 0;
}

}  // namespace gloam
