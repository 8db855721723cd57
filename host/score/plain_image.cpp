#include "score/plain_image.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gloam/error.h"

namespace gloam::score {
namespace {

/// Beyond 0 to 1 by this much is rounding, or the ringing of a filter.
constexpr double little = 0.01;
/// Up to this share of pixels outside is clamped.
constexpr double few = 0.005;

template <typename Function>
void for_each_value(bench::Image& image, const Function& function) {
  for (auto& [view, plane] : image) {
    for (Channel& channel : plane.channels) {
      const Layout& layout = channel.layout();
      for (int y = 0; y < layout.height; ++y) {
        for (int x = 0; x < layout.width; ++x) channel.at(x, y) = float(function(double(channel.at(x, y))));
      }
    }
  }
}

/// The stored values of 0 and 1. A range up to 1 counts in shares of a PNG's largest value.
std::pair<double, double> stored_range(const Convention& convention, double largest) {
  const double unit = largest > 0 ? largest : 1;
  if (!convention.range) return {0, unit};
  const bool is_share = convention.range->second <= 1;
  return {convention.range->first * (is_share ? unit : 1), convention.range->second * (is_share ? unit : 1)};
}

/// Whether a pixel of a lower resolution covers a surface.
bool covers_surface(const Mask& mask, const Layout& frame, int scale, int x, int y) {
  for (int v = y * scale; v < std::min((y + 1) * scale, frame.height); ++v) {
    for (int u = x * scale; u < std::min((x + 1) * scale, frame.width); ++u)
      if (mask[size_t(v) * size_t(frame.width) + size_t(u)]) return true;
  }
  return false;
}

Mask covered(const Mask& mask, const Layout& frame, int scale, const Layout& small) {
  Mask found;
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) found.push_back(covers_surface(mask, frame, scale, x, y));
  }
  return found;
}

Channel enlarged_channel(const Channel& small, int scale, const Layout& frame, const Mask& counts) {
  Channel out(frame, 0);
  const Layout& from = small.layout();
  for (int y = 0; y < frame.height; ++y) {
    const double sy = (y + 0.5) / scale - 0.5;
    const int y0 = int(std::floor(sy));
    for (int x = 0; x < frame.width; ++x) {
      const double sx = (x + 0.5) / scale - 0.5;
      const int x0 = int(std::floor(sx));
      double sum = 0, weights = 0;
      for (int v = y0; v <= y0 + 1; ++v) {
        for (int u = x0; u <= x0 + 1; ++u) {
          const int cx = std::clamp(u, 0, from.width - 1), cy = std::clamp(v, 0, from.height - 1);
          const float value = small.at(cx, cy);
          if (!std::isfinite(value) || !counts[size_t(cy) * size_t(from.width) + size_t(cx)]) continue;
          const double weight = (1 - std::abs(sx - u)) * (1 - std::abs(sy - v));
          sum += weight * double(value);
          weights += weight;
        }
      }
      out.at(x, y) = weights > 0 ? float(sum / weights) : std::numeric_limits<float>::quiet_NaN();
    }
  }
  return out;
}

}  // namespace

void undo(const Convention& c, const std::string& effect, StoredImage& stored) {
  const auto [low, high] = stored_range(c, stored.largest);
  const bool is_of_shares = is_share(effect);
  for_each_value(stored.image, [&, low = low, high = high](double value) {
    if (!std::isfinite(value)) return value;
    double v = (value - low) / (high - low);
    if (c.inverted) v = 1 - v;
    if (c.strength != 1) v = 1 - (1 - v) / c.strength;
    if (c.exponent != 1) v = std::pow(std::max(v, 0.0), 1 / c.exponent);
    return c.strength != 1 && is_of_shares ? std::max(v, 0.0) : v;
  });
}

void check_size(int width, int height, int scale, const Layout& frame, const std::string& file) {
  const auto fits = [scale](int size, int whole) {
    return size == whole / scale || size == (whole + scale - 1) / scale;
  };
  if (fits(width, frame.width) && fits(height, frame.height)) return;
  std::string hint;
  for (const auto& [word, other] : {std::pair("full", 1), {"half", 2}, {"quarter", 4}}) {
    if (width == (frame.width + other - 1) / other && height == (frame.height + other - 1) / other)
      hint = fmt::format("; \"resolution\": \"{}\" in the entry's convention says so", word);
  }
  throw Error("{}: is {}x{}, and {}x{} is needed for a frame of {}x{}{}", file, width, height,
              (frame.width + scale - 1) / scale, (frame.height + scale - 1) / scale, frame.width, frame.height, hint);
}

bench::Image enlarged(const bench::Image& image, int scale, const Layout& frame, const bench::Foreground& foreground) {
  bench::Image out;
  for (const auto& [view, plane] : image) {
    const auto mask = foreground.find(view);
    if (mask == foreground.end()) continue;
    Plane& large = out.emplace(view, Plane{plane.name, {}}).first->second;
    const Mask counts = covered(mask->second, frame, scale, plane.channels[0].layout());
    for (const Channel& channel : plane.channels)
      large.channels.push_back(enlarged_channel(channel, scale, frame, counts));
  }
  return out;
}

Reduced reduced_truth(const bench::Image& truth, const bench::Foreground& foreground, int scale, const Layout& small) {
  Reduced out;
  for (const auto& [view, plane] : truth) {
    const auto mask = foreground.find(view);
    if (mask == foreground.end()) continue;
    const Layout& frame = plane.channels[0].layout();
    out.foreground.emplace(view, covered(mask->second, frame, scale, small));
    Plane& means = out.image.emplace(view, Plane{plane.name, {}}).first->second;
    for (const Channel& channel : plane.channels) {
      Channel& mean = means.channels.emplace_back(small, 0);
      for (int y = 0; y < small.height; ++y) {
        for (int x = 0; x < small.width; ++x) {
          double sum = 0;
          int count = 0;
          for (int v = y * scale; v < std::min((y + 1) * scale, frame.height); ++v) {
            for (int u = x * scale; u < std::min((x + 1) * scale, frame.width); ++u) {
              if (!mask->second[size_t(v) * size_t(frame.width) + size_t(u)]) continue;
              sum += channel.at(u, v);
              ++count;
            }
          }
          mean.at(x, y) = float(sum / std::max(count, 1));
        }
      }
    }
  }
  return out;
}

long long clamp_shares(bench::Image& image, const bench::Foreground& foreground, const std::string& file) {
  long long outside = 0, count = 0;
  double least = 0, most = 1;
  const auto each = [&](const auto& function) {
    for (auto& [view, plane] : image) {
      const auto mask = foreground.find(view);
      if (mask == foreground.end()) continue;
      for (Channel& channel : plane.channels) {
        const Layout& layout = channel.layout();
        for (int y = 0; y < layout.height; ++y) {
          for (int x = 0; x < layout.width; ++x)
            if (mask->second[size_t(y) * size_t(layout.width) + size_t(x)]) function(channel.at(x, y));
        }
      }
    }
  };
  each([&](float& value) {
    ++count;
    if (std::isnan(value) || (double(value) >= -little && double(value) <= 1 + little)) return;
    ++outside;
    least = std::min(least, double(value));
    most = std::max(most, double(value));
  });
  if (double(outside) > few * double(count)) {
    const std::string meant = most <= 1 + little ? "[-1, 1]"
                              : most <= 255.5    ? "[0, 255]"
                              : most <= 65535.5  ? "[0, 65535]"
                                                 : fmt::format("[0, {:g}]", most);
    throw Error(
        "{}: is {:g} to {:g} on {:.1f} % of the surfaces, and 0 to 1 is allowed; the entry's convention says which "
        "values stand "
        "for 0 and 1, such as \"range\": {}",
        file, least, most, 100 * double(outside) / double(count), meant);
  }
  each([](float& value) {
    if (!std::isnan(value)) value = std::clamp(value, 0.0f, 1.0f);
  });
  return outside;
}

}  // namespace gloam::score
