#include "run/missed.h"

#include <algorithm>
#include <cmath>

#include "base/lists.h"

namespace gloam {
namespace {

const char* const tiles_plane = "tiles";  // not a name that a technique or a file has
constexpr int tile_side = 16;

/// One in so many tiles of a row is measured, and each row of tiles begins elsewhere; all of few tiles.
int tiles_per_measured(const Frame& frame) {
  constexpr int most = 16, fewest_measured = 256;
  const int tiles = (frame.width() / tile_side) * (frame.height() / tile_side);
  int step = 1;
  while (step < most && tiles / (2 * step) >= fewest_measured) step *= 2;
  return step;
}

class Tiles {
 public:
  explicit Tiles(const Frame& frame) : step_(tiles_per_measured(frame)) {}
  /// The steps are powers of 2, so that 5 has no factor in common with them: tiles of neighbouring rows lie far from one another.
  bool has(int x, int y) const { return (x / tile_side + 5 * (y / tile_side)) % step_ == 0; }

 private:
  int step_;
};

void add_tiles(Frame& frame, const Tiles& tiles) {
  for (View& view : frame.views) {
    Plane plane{tiles_plane, {}};
    Channel& channel = plane.channels.emplace_back(Layout(frame.width(), frame.height()));
    for (int y = 0; y < frame.height(); ++y) {
      for (int x = 0; x < frame.width(); ++x) channel.at(x, y) = tiles.has(x, y);
    }
    channel.fill_padding(0);
    view.planes[tiles_plane] = std::move(plane);
  }
}

const Technique* maker_of_mask(const Plan& plan) {
  for (const PlannedPass& planned : plan.passes)
    if (contains(planned.technique->writes, plan.mask)) return planned.technique;
  return nullptr;
}

/// Whether a setting is for no technique of the plan but this one.
bool is_for_alone(const Technique& technique, const Plan& plan, const std::string& setting) {
  if (setting.starts_with(technique.name + ".")) return true;
  return std::none_of(plan.passes.begin(), plan.passes.end(), [&](const PlannedPass& planned) {
    const ParameterList& parameters = planned.technique->parameters;
    const auto is_meant = [&](const Parameter& p) {
      return setting == p.name || setting == planned.technique->name + "." + p.name;
    };
    return planned.technique != &technique && std::any_of(parameters.begin(), parameters.end(), is_meant);
  });
}

bool differ(const Plane& whole, const Plane& masked, int x, int y) {
  for (size_t i = 0; i < whole.channels.size(); ++i)
    if (std::abs(whole.channels[i].at(x, y) - masked.channels[i].at(x, y)) > least_missed) return true;
  return false;
}

/// Takes the plane out of the frame again, whatever happens.
class TilesInFrame {
 public:
  TilesInFrame(Frame& frame, const Tiles& tiles) : frame_(frame) { add_tiles(frame, tiles); }
  ~TilesInFrame() {
    for (View& view : frame_.views) view.planes.erase(tiles_plane);
  }
  TilesInFrame(const TilesInFrame&) = delete;
  TilesInFrame& operator=(const TilesInFrame&) = delete;

 private:
  Frame& frame_;
};

}  // namespace

std::optional<double> missed_share(PlanRequest request, const Plan& plan, Frame& frame, const Frame& result,
                                   Device& device, RunOptions options) {
  const Technique* maker = plan.wanted.empty() ? nullptr : maker_of_mask(plan);
  if (!maker || contains(maker->reads, "depth")) return {};
  const Tiles tiles(frame);
  const TilesInFrame added(frame, tiles);
  std::erase_if(request.settings, [&](const auto& setting) { return is_for_alone(*maker, plan, setting.first); });
  request.only = tiles_plane;
  request.only_outputs = {plan.outputs.front()};
  request.with = {};
  options.repeat = 1;
  options.progress = {};
  const Frame whole = run(make_plan(request, common_planes(frame), "the frame"), frame, device, options).frame;
  double missed = 0, pixels = 0;
  for (size_t v = 0; v < frame.views.size(); ++v) {
    const Plane &with = *whole.views[v].find(request.only_outputs.front()), &without = *result.views[v].find(with.name);
    for (int y = 0; y < frame.height(); ++y) {
      for (int x = 0; x < frame.width(); ++x) {
        if (!tiles.has(x, y)) continue;
        ++pixels;
        missed += differ(with, without, x, y);
      }
    }
  }
  return pixels > 0 ? missed / pixels : 0;
}

}  // namespace gloam
