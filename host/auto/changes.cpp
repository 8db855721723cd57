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

/// For each channel of colour, `of_channel(its number among all, view number, component)` gives what is called for each surface's pixel.
template <class OfChannel>
void for_surfaces(const Frame& frame, OfChannel of_channel) {
  size_t number = 0;
  for (size_t v = 0; v < frame.views.size(); ++v) {
    const Channel& depth = depth_of(frame.views[v]);
    const size_t components = frame.views[v].find("color")->channels.size();
    for (size_t c = 0; c < components; ++c, ++number) {
      auto at = of_channel(number, v, c);
      for (int y = 0; y < frame.height(); ++y)
        for (int x = 0; x < frame.width(); ++x)
          if (!is_background(depth.at(x, y))) at(x, y);
    }
  }
}

Change difference_of(const std::string& name, const Frame& with, const Frame& without, const Frame& frame) {
  Change change{name, nothing(frame)};
  for_surfaces(frame, [&](size_t number, size_t v, size_t c) {
    const Channel& a = with.views[v].find("color")->channels[c];
    const Channel& b = without.views[v].find("color")->channels[c];
    return [&a, &b, &to = change.channels[number]](int x, int y) {
      const float difference = a.at(x, y) - b.at(x, y);
      to.at(x, y) = std::isfinite(difference) ? difference : 0;
    };
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

/// A share of each pixel times light. `share_of(view number, component)` gives what is called for a pixel's share.
template <class ShareOf>
Change of_light(const char* name, const Frame& frame, const std::vector<Channel>& light, ShareOf share_of) {
  Change change{name, nothing(frame)};
  for_surfaces(frame, [&](size_t number, size_t v, size_t c) {
    return [share = share_of(v, c), &from = light[number], &to = change.channels[number]](int x, int y) {
      const float value = share(x, y) * from.at(x, y);
      to.at(x, y) = std::isfinite(value) ? value : 0;
    };
  });
  return change;
}

/// The mean light of all surfaces, for each view and channel of colour.
std::vector<Channel> even_light(const Frame& frame) {
  std::vector<Channel> light = nothing(frame);
  std::vector<double> sums(light.size()), counts(light.size());
  for_surfaces(frame, [&](size_t number, size_t v, size_t c) {
    return [&colour = frame.views[v].find("color")->channels[c], &sum = sums[number], &count = counts[number]](int x,
                                                                                                               int y) {
      const double value = colour.at(x, y);
      if (!std::isfinite(value)) return;
      sum += value;
      ++count;
    };
  });
  for (size_t i = 0; i < light.size(); ++i)
    light[i] = Channel(light[i].layout(), counts[i] > 0 ? float(sums[i] / counts[i]) : 0);
  return light;
}

/// What was seen of hidden occluders is where they take ambient light away.
void add_hidden(const Frame& frame, const Frame& parts, const std::vector<Channel>& light,
                std::vector<Change>& changes) {
  if (!every_view_has(frame, "albedo") || !every_view_has(parts, "ao")) return;
  const auto diffuse_and_closed = [&](size_t v, size_t c) {
    const Channel *albedo = component_of(frame.views[v], "albedo", c),
                  *metallic = component_of(frame.views[v], "metallic", 0), *ao = component_of(parts.views[v], "ao", 0);
    return [=](int x, int y) {
      const float diffuse = albedo->at(x, y) * (metallic ? 1 - metallic->at(x, y) : 1);
      return diffuse * (1 - ao->at(x, y));
    };
  };
  changes.push_back(of_light(hidden_light, frame, light, diffuse_and_closed));
  changes.push_back(of_light(hidden_even_light, frame, even_light(frame), diffuse_and_closed));
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
  changes.push_back(of_light(light_not_found, frame, light, [&](size_t v, size_t c) {
    const Channel *reflectance = component_of(frame.views[v], "reflectance", c),
                  *found = component_of(parts.views[v], "reflection", 3);
    return [=](int x, int y) { return reflectance->at(x, y) * (1 - found->at(x, y)); };
  }));
}

/// What the mean of the nearest surfaces among every second pixel of every second row keeps of the pixels between.
double kept_when_coarser(const Change& change, const Frame& frame) {
  double own = 0, common = 0;
  for_surfaces(frame, [&](size_t number, size_t v, size_t) {
    return [&, &depth = depth_of(frame.views[v]), &values = change.channels[number]](int x, int y) {
      if (x % 2 == 0 && y % 2 == 0) return;
      double sum = 0, count = 0;
      for (int down = y - y % 2; down <= std::min(y + y % 2, frame.height() - 1); down += 2)
        for (int right = x - x % 2; right <= std::min(x + x % 2, frame.width() - 1); right += 2)
          if (!is_background(depth.at(right, down))) sum += values.at(right, down), ++count;
      if (count == 0) return;
      const double value = values.at(x, y);
      own += value * value;
      common += value * sum / count;
    };
  });
  return own > 0 ? common / own : 1;
}

double mean_product(const Change& a, const Change& b, const Frame& frame) {
  double sum = 0, count = 0;
  for_surfaces(frame, [&](size_t number, size_t, size_t) {
    return [&, &of_a = a.channels[number], &of_b = b.channels[number]](int x, int y) {
      sum += double(of_a.at(x, y)) * of_b.at(x, y);
      ++count;
    };
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
  const size_t count = changes.size();
  seen.products.assign(count, std::vector<double>(count));
  for (size_t i = 0; i < count; ++i) {
    seen.names.push_back(changes[i].name);
    seen.kept_when_coarser[changes[i].name] = kept_when_coarser(changes[i], frame);
    for (size_t j = 0; j <= i; ++j)
      seen.products[i][j] = seen.products[j][i] = mean_product(changes[i], changes[j], frame);
  }
  return seen;
}

double mean_square(const Frame& picture) {
  double sum = 0, count = 0;
  for_surfaces(picture, [&](size_t, size_t v, size_t c) {
    return [&, &colour = picture.views[v].find("color")->channels[c]](int x, int y) {
      const double value = colour.at(x, y);
      if (!std::isfinite(value)) return;
      sum += value * value;
      ++count;
    };
  });
  return count > 0 ? sum / count : 0;
}

}  // namespace gloam
