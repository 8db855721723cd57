#include "auto/glance.h"

#include <algorithm>
#include <cmath>

#include "base/lists.h"
#include "base/statistics.h"
#include "frame/subsample.h"
#include "gloam/planes.h"

namespace gloam {
namespace {

/// On fewer pixels than these along a side, a glance tells little.
constexpr int least_side = 48;
constexpr int most_scale = 4;  // a power of two, as tiles of pictures are

/// The planes of a frame that composing reads, as a frame of their own.
Frame with_planes(const Frame& frame, const std::vector<std::string>& planes) {
  Frame copy = without_planes(frame);
  for (size_t i = 0; i < frame.views.size(); ++i) {
    for (const std::string& name : planes)
      if (const Plane* plane = frame.views[i].find(name)) copy.views[i].planes[name] = plane->clone();
  }
  return copy;
}

/// A plane that changes the picture so many times as much. None becomes negative.
Plane scaled(const Plane& plane, double factor) {
  const float unchanged = plane_kind(plane.name).outside;
  Plane result = plane.clone();
  for (Channel& channel : result.channels) {
    for (int y = 0; y < channel.layout().height; ++y) {
      float* row = channel.row(y);
      for (int x = 0; x < channel.layout().width; ++x)
        row[x] = std::max(0.0f, unchanged + float(factor) * (row[x] - unchanged));
    }
  }
  return result;
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
      expected_(without_planes(small_)),
      whole_(with_planes(small_, planes_to_compose())) {}

void Glance::look(const Plan& plan, double true_per_seen, Device& device, const RunOptions& options) {
  RunOptions thrice = options;
  thrice.repeat = 3;
  RunResult result = run(plan, small_, device, thrice);
  ms_ += median(result.total_ms);
  for (View& view : result.frame.views) {
    for (const std::string& name : part_planes()) {
      const auto found = view.planes.find(name);
      if (found == view.planes.end()) continue;
      expected_.view(view.name).planes[name] = scaled(found->second, true_per_seen);
      parts_.view(view.name).planes[name] = std::move(found->second);
      add_new(planes_, name);
    }
  }
  std::sort(planes_.begin(), planes_.end());
  whole_ = picture_of(expected_, planes_);
  losses_.clear();
}

Frame Glance::picture_of(const Frame& parts, const std::vector<std::string>& planes) const {
  Frame colour = with_planes(small_, planes_to_compose());
  if (!planes.empty()) compose(colour, with_planes(parts, planes), how_);
  return colour;
}

double Glance::rms_between(const Frame& a, const Frame* b) const {
  double squares = 0, count = 0;
  for (size_t v = 0; v < a.views.size(); ++v) {
    const Channel& depth = small_.views[v].find("depth")->channels.front();
    const Plane& color = *a.views[v].find("color");
    const Plane* other = b ? b->views[v].find("color") : nullptr;
    for (size_t c = 0; c < color.channels.size(); ++c) {
      for (int y = 0; y < a.height(); ++y) {
        const float* row = color.channels[c].row(y);
        const float* other_row = other ? other->channels[c].row(y) : nullptr;
        for (int x = 0; x < a.width(); ++x) {
          const double difference = row[x] - (other_row ? other_row[x] : 0);
          if (is_background(depth.at(x, y)) || !std::isfinite(difference)) continue;
          squares += difference * difference;
          ++count;
        }
      }
    }
  }
  return count > 0 ? std::sqrt(squares / count) : 0;
}

double Glance::rms() const { return rms_between(whole_, nullptr); }

double Glance::loss_with(const std::vector<std::string>& planes) const {
  const auto known = losses_.find(planes);
  if (known != losses_.end()) return known->second;
  const Frame picture = picture_of(parts_, planes);
  return losses_[planes] = rms_between(picture, &whole_);
}

std::vector<std::string> Glance::without(const std::vector<std::string>& planes) const {
  std::vector<std::string> others = planes_;
  std::erase_if(others, [&](const std::string& plane) { return contains(planes, plane); });
  return others;
}

double Glance::change_by(const std::vector<std::string>& planes) const {
  const Frame picture = picture_of(expected_, without(planes));
  return rms_between(picture, &whole_);
}

Plane Glance::changes_by(const std::vector<std::string>& planes, const std::string& view) const {
  const Frame picture = picture_of(expected_, without(planes));
  const Plane &with = *whole_.view(view).find("color"), &left = *picture.view(view).find("color");
  const double unit = std::max(rms(), 1e-30);
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

}  // namespace gloam
