#include "auto/changes.h"

#include <algorithm>
#include <cmath>

#include "base/lists.h"
#include "gloam/planes.h"

namespace gloam {
namespace {

/// Pixels around one that light comes from, on either side.
constexpr int reach_of_light = 4;

const Channel& depth_of(const View& view) { return view.find("depth")->channels.front(); }

/// Images of 0, for each view and channel of the frame's colour.
std::vector<Channel> nothing(const Frame& frame) {
  std::vector<Channel> channels;
  for (const View& view : frame.views)
    for (const Channel& colour : view.find("color")->channels) channels.emplace_back(colour.layout(), 0);
  return channels;
}

/// Calls `at(channel number, view, component, x, y)` for each surface's channels.
template <class At>
void for_surfaces(const Frame& frame, At at) {
  size_t number = 0;
  for (const View& view : frame.views) {
    const Channel& depth = depth_of(view);
    const size_t components = view.find("color")->channels.size();
    for (size_t c = 0; c < components; ++c, ++number) {
      for (int y = 0; y < frame.height(); ++y)
        for (int x = 0; x < frame.width(); ++x)
          if (!is_background(depth.at(x, y))) at(number, view, c, x, y);
    }
  }
}

Change difference_of(const std::string& name, const Frame& with, const Frame& without, const Frame& frame) {
  Change change{name, nothing(frame)};
  size_t view_number = 0;
  const View* last = nullptr;
  for_surfaces(frame, [&](size_t number, const View& view, size_t c, int x, int y) {
    if (last && last != &view) ++view_number;
    last = &view;
    const float difference = with.views[view_number].find("color")->channels[c].at(x, y) -
                             without.views[view_number].find("color")->channels[c].at(x, y);
    change.channels[number].at(x, y) = std::isfinite(difference) ? difference : 0;
  });
  return change;
}

/// The mean of a channel over surfaces around each pixel, by sums along rows, then columns.
Channel mean_around(const Channel& channel, const Channel& depth) {
  const Layout& layout = channel.layout();
  Channel sums(layout, 0), counts(layout, 0), mean(layout, 0);
  for (int y = 0; y < layout.height; ++y) {
    double sum = 0, count = 0;
    const auto add = [&](int x, double sign) {
      if (x < 0 || x >= layout.width || is_background(depth.at(x, y)) || !std::isfinite(channel.at(x, y))) return;
      sum += sign * channel.at(x, y);
      count += sign;
    };
    for (int x = 0; x < reach_of_light; ++x) add(x, 1);
    for (int x = 0; x < layout.width; ++x) {
      add(x + reach_of_light, 1);
      sums.at(x, y) = float(sum);
      counts.at(x, y) = float(count);
      add(x - reach_of_light, -1);
    }
  }
  for (int x = 0; x < layout.width; ++x) {
    double sum = 0, count = 0;
    const auto add = [&](int y, double sign) {
      if (y < 0 || y >= layout.height) return;
      sum += sign * sums.at(x, y);
      count += sign * counts.at(x, y);
    };
    for (int y = 0; y < reach_of_light; ++y) add(y, 1);
    for (int y = 0; y < layout.height; ++y) {
      add(y + reach_of_light, 1);
      mean.at(x, y) = count > 0.5 ? float(sum / count) : 0;
      add(y - reach_of_light, -1);
    }
  }
  return mean;
}

/// The light around each pixel, for each view and channel of colour.
std::vector<Channel> light_around(const Frame& frame) {
  std::vector<Channel> light;
  for (const View& view : frame.views)
    for (const Channel& colour : view.find("color")->channels) light.push_back(mean_around(colour, depth_of(view)));
  return light;
}

/// A plane's component, or the only one it has; null where the view lacks the plane.
const Channel* component_of(const View& view, const char* plane, size_t component) {
  const Plane* found = view.find(plane);
  return found ? &found->channels[std::min(component, found->channels.size() - 1)] : nullptr;
}

bool every_view_has(const Frame& frame, const char* plane) {
  return std::all_of(frame.views.begin(), frame.views.end(), [&](const View& view) { return view.find(plane); });
}

/// A share of each pixel times the light around it.
template <class Share>
Change of_light_around(const char* name, const Frame& frame, const std::vector<Channel>& light, Share share) {
  Change change{name, nothing(frame)};
  for_surfaces(frame, [&](size_t number, const View& view, size_t c, int x, int y) {
    const float value = share(view, c, x, y) * light[number].at(x, y);
    change.channels[number].at(x, y) = std::isfinite(value) ? value : 0;
  });
  return change;
}

/// The mean light of all surfaces, for each view and channel of colour.
std::vector<Channel> even_light(const Frame& frame) {
  std::vector<Channel> light = nothing(frame);
  std::vector<double> sums(light.size()), counts(light.size());
  for_surfaces(frame, [&](size_t number, const View& view, size_t c, int x, int y) {
    const double value = view.find("color")->channels[c].at(x, y);
    if (!std::isfinite(value)) return;
    sums[number] += value;
    ++counts[number];
  });
  for (size_t i = 0; i < light.size(); ++i)
    light[i] = Channel(light[i].layout(), counts[i] > 0 ? float(sums[i] / counts[i]) : 0);
  return light;
}

/// What was seen of hidden occluders is where they take ambient light away.
void add_hidden(const Frame& frame, const Frame& parts, const std::vector<Channel>& light,
                std::vector<Change>& changes) {
  if (!every_view_has(frame, "albedo") || !every_view_has(parts, "ao")) return;
  const auto diffuse_and_closed = [&](const View& view, size_t c, int x, int y) {
    const Channel* metallic = component_of(view, "metallic", 0);
    const float diffuse = component_of(view, "albedo", c)->at(x, y) * (metallic ? 1 - metallic->at(x, y) : 1);
    return diffuse * (1 - component_of(parts.view(view.name), "ao", 0)->at(x, y));
  };
  changes.push_back(of_light_around(hidden_light, frame, light, diffuse_and_closed));
  changes.push_back(of_light_around(hidden_even_light, frame, even_light(frame), diffuse_and_closed));
}

void add_not_found(const Frame& frame, const Frame& parts, const std::vector<Channel>& light,
                   std::vector<Change>& changes) {
  const auto tells_what_it_found = [](const View& view) {
    const Plane* reflection = view.find("reflection");
    return reflection && reflection->channels.size() == 4;
  };
  if (!every_view_has(frame, "reflectance") ||
      !std::all_of(parts.views.begin(), parts.views.end(), tells_what_it_found))
    return;
  changes.push_back(of_light_around(light_not_found, frame, light, [&](const View& view, size_t c, int x, int y) {
    const float found = parts.view(view.name).find("reflection")->channels[3].at(x, y);
    return component_of(view, "reflectance", c)->at(x, y) * (1 - found);
  }));
}

/// Between every second pixel of every second row: the mean of the nearest of them that are surfaces.
SeenChanges::Coarser when_coarser(const Change& change, const Frame& frame) {
  double own = 0, common = 0, other = 0;
  for_surfaces(frame, [&](size_t number, const View& view, size_t, int x, int y) {
    if (x % 2 == 0 && y % 2 == 0) return;
    const Channel &depth = depth_of(view), &values = change.channels[number];
    double sum = 0, count = 0;
    for (int v = y - y % 2; v <= std::min(y + y % 2, frame.height() - 1); v += 2)
      for (int u = x - x % 2; u <= std::min(x + x % 2, frame.width() - 1); u += 2)
        if (!is_background(depth.at(u, v))) sum += values.at(u, v), ++count;
    if (count == 0) return;
    const double filled = sum / count, value = values.at(x, y);
    own += value * value;
    common += value * filled;
    other += filled * filled;
  });
  if (own <= 0) return {};
  const double kept = common / own;
  return {kept, std::max(0.0, other / own - kept * kept)};
}

double mean_product(const Change& a, const Change& b, const Frame& frame) {
  double sum = 0, count = 0;
  for_surfaces(frame, [&](size_t number, const View&, size_t, int x, int y) {
    sum += double(a.channels[number].at(x, y)) * b.channels[number].at(x, y);
    ++count;
  });
  return count > 0 ? sum / count : 0;
}

}  // namespace

Frame with_planes(const Frame& frame, const std::vector<std::string>& planes) {
  Frame copy = without_planes(frame);
  for (size_t i = 0; i < frame.views.size(); ++i) {
    for (const std::string& name : planes)
      if (const Plane* plane = frame.views[i].find(name)) copy.views[i].planes[name] = plane->clone();
  }
  return copy;
}

Frame composed(const Frame& frame, const Frame& parts, const std::vector<std::string>& planes,
               const ComposeOptions& how) {
  Frame colour = with_planes(frame, planes_to_compose());
  compose(colour, with_planes(parts, planes), how);
  return colour;
}

std::vector<Change> changes_of(const Frame& frame, const Frame& parts, const std::vector<std::string>& planes,
                               const ComposeOptions& how) {
  std::vector<Change> changes;
  const Frame without = composed(frame, parts, {}, how);
  for (const std::string& plane : planes)
    changes.push_back(difference_of(plane, composed(frame, parts, {plane}, how), without, frame));
  const std::vector<Channel> light = light_around(frame);
  add_hidden(frame, parts, light, changes);
  add_not_found(frame, parts, light, changes);
  return changes;
}

SeenChanges seen_in(const std::vector<Change>& changes, const Frame& frame) {
  SeenChanges seen;
  for (const Change& change : changes) {
    seen.names.push_back(change.name);
    seen.products.emplace_back();
    for (const Change& other : changes) seen.products.back().push_back(mean_product(change, other, frame));
    seen.coarser[change.name] = when_coarser(change, frame);
  }
  return seen;
}

}  // namespace gloam
