#include "papers/pop_in.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "gloam/scene/capture.h"

namespace gloam::bench {
namespace {

constexpr int positions = 61, width = 480, height = 270;
constexpr float unseen = std::numeric_limits<float>::quiet_NaN();

/// Points of the wall near the part that the pillar always hides.
std::vector<glm::dvec3> points_of_the_wall() {
  std::vector<glm::dvec3> points;
  for (double x = -1.2; x <= 1.2; x += 0.05) {
    for (double y = -0.8; y <= 0.8; y += 0.2) {
      if (std::abs(x) > 0.57) points.push_back({x, y, 0});
    }
  }
  return points;
}

Frame seen_from(const Stage& s, double x) {
  CaptureOptions capture{.width = width, .height = height, .planes = {"depth", "normal"}, .peel = 8};
  capture.views = {{"", camera_for(looking_at("moved", {x, 0, 12}, {x, 0, 0}, 24), width, height), {}}};
  return gloam::capture(*s.tracer, capture).frame;
}

struct Pixel {
  int x, y;
};

/// The pixel of a world point in a frame; none outside the image, or if another surface is seen there.
std::optional<Pixel> seen_at(const Frame& frame, const glm::dvec3& point) {
  const Camera& c = *frame.views[0].camera;
  const glm::dvec3 p = c.pose->world_to_view * (point - c.pose->position);
  const int x = int(std::floor(c.cx + c.fx * p.x / -p.z)), y = int(std::floor(c.cy - c.fy * p.y / -p.z));
  if (x < 0 || y < 0 || x >= frame.width() || y >= frame.height()) return {};
  const double depth = frame.views[0].planes.at("depth").channels[0].at(x, y);
  return std::abs(depth + p.z) < 0.01 * depth ? std::optional<Pixel>({x, y}) : std::nullopt;
}

/// The changes of one technique's AO at the points.
class Jumps {
 public:
  explicit Jumps(size_t points) : before_(points, unseen) {}

  void step(const std::vector<float>& now) {
    for (size_t p = 0; p < now.size(); ++p) {
      if (!std::isnan(now[p]) && !std::isnan(before_[p])) {
        const double jump = std::abs(double(now[p]) - before_[p]);
        largest = std::max(largest, jump);
        sum_ += jump;
        ++count_;
      }
    }
    before_ = now;
  }

  double largest = 0;
  double mean() const { return sum_ / std::max(count_, 1.0); }

 private:
  std::vector<float> before_;
  double sum_ = 0, count_ = 0;
};

std::vector<float> values_at(const std::vector<glm::dvec3>& points, const Frame& frame, const Plane& ao) {
  std::vector<float> values;
  for (const glm::dvec3& point : points) {
    const std::optional<Pixel> at = seen_at(frame, point);
    values.push_back(at ? ao.channels[0].at(at->x, at->y) : unseen);
  }
  return values;
}

}  // namespace

void pop_in(Study& study, const std::vector<std::pair<std::string, Asked>>& techniques) {
  const std::string figure = "Pop-in: 60 steps past a pillar (AO at fixed points of the wall, filtered)",
                    unit = "change of AO from step to step";
  const std::vector<glm::dvec3> points = points_of_the_wall();
  Stage s;
  s.scene = load_scene("pillar", {});
  s.tracer = std::make_unique<Tracer>(s.scene);
  s.radius = s.scene.ao_radius;
  std::vector<Jumps> jumps(techniques.size(), Jumps(points.size()));
  for (int i = 0; i < positions; ++i) {
    study.tell("pop-in", double(i) / positions);
    s.frame = seen_from(s, -2 + 4.0 * i / (positions - 1));
    for (size_t t = 0; t < techniques.size(); ++t)
      jumps[t].step(values_at(points, s.frame, study.image(s, filtered(techniques[t].second))));
  }
  for (size_t t = 0; t < techniques.size(); ++t) {
    study.fact(figure, techniques[t].first, "largest", jumps[t].largest, unit);
    study.fact(figure, techniques[t].first, "mean", jumps[t].mean(), unit);
  }
}

}  // namespace gloam::bench
