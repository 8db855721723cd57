#include "planner/speeds.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/files.h"
#include "base/json_text.h"
#include "gloam/error.h"
#include "run/device_record.h"
#include "run/kept_folders.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Of the time on the largest image, the least share that is its pixels'.
constexpr double least_share_of_pixels = 0.1;

/// Pixels of a frame per pixel of the largest measured image, at most: those of a glance.
constexpr double most_times_larger = 16;

fs::path path_of(const DeviceInfo& info) { return path_in_cache("speeds", info); }

/// Images of about one size have one place.
int place_of(double pixels) { return int(std::floor(std::log2(pixels))); }

bool is_usable(const MeasuredTime& time) {
  return time.pixels >= 1 && time.ms > 0 && std::isfinite(time.pixels) && std::isfinite(time.ms);
}

/// Sums over times, each divided by itself, so that short ones count as long ones do.
struct Sums {
  double of_one = 0, of_pixels = 0, of_one_one = 0, of_one_pixels = 0, of_pixels_pixels = 0;
};

Sums sums_of(const std::vector<MeasuredTime>& times) {
  Sums sums;
  for (const MeasuredTime& time : times) {
    const double one = 1 / time.ms, pixels = time.pixels / time.ms;
    sums.of_one += one;
    sums.of_pixels += pixels;
    sums.of_one_one += one * one;
    sums.of_one_pixels += one * pixels;
    sums.of_pixels_pixels += pixels * pixels;
  }
  return sums;
}

}  // namespace

FrameSize size_of(const Frame& frame) {
  return {double(frame.width()) * frame.height(), double(std::max<size_t>(frame.views.size(), 1))};
}

TimeParts parts_of(const std::vector<MeasuredTime>& times) {
  if (times.empty()) return {};
  const Sums s = sums_of(times);
  const double determinant = s.of_one_one * s.of_pixels_pixels - s.of_one_pixels * s.of_one_pixels;
  const bool is_one_size = determinant <= 1e-9 * s.of_one_one * s.of_pixels_pixels;
  const double fixed = is_one_size ? 0 : (s.of_one * s.of_pixels_pixels - s.of_pixels * s.of_one_pixels) / determinant;
  if (fixed <= 0) return {0, 1e6 * s.of_pixels / s.of_pixels_pixels};
  const MeasuredTime& largest = *std::max_element(
      times.begin(), times.end(), [](const MeasuredTime& a, const MeasuredTime& b) { return a.pixels < b.pixels; });
  const double of_pixel = std::max((s.of_one_one * s.of_pixels - s.of_one_pixels * s.of_one) / determinant,
                                   least_share_of_pixels * largest.ms / largest.pixels);
  return {std::max(0.0, (s.of_one - of_pixel * s.of_one_pixels) / s.of_one_one), 1e6 * of_pixel};
}

OptionSpeeds::OptionSpeeds(const DeviceInfo& info) : info_(info) {
  const fs::path path = path_of(info);
  if (path.empty()) return;
  const std::optional<std::string> text = kept_text(path);
  if (!text) return;
  try {
    const Json document = ordered_json_of_text(*text, path.string());
    if (document.at("device") != key_of(info) || document.at("kernels") != hash_of_kernels()) return;
    for (const auto& [label, times] : document.at("times").items()) {
      for (const Json& each : times) {
        const MeasuredTime time{each.at(0).get<double>(), each.at(1).get<double>()};
        if (is_usable(time)) times_[label][place_of(time.pixels)] = time;
      }
    }
  } catch (const Json::exception&) {
    times_.clear();
  } catch (const Error&) {
    times_.clear();
  }
}

bool OptionSpeeds::knows(const std::string& label, const FrameSize& size) const {
  const auto found = times_.find(label);
  if (found == times_.end() || found->second.size() < 2) return false;
  return most_times_larger * found->second.rbegin()->second.pixels >= size.pixels;
}

double OptionSpeeds::expected_ms(const std::string& label, const FrameSize& size) const {
  const auto found = times_.find(label);
  if (found == times_.end()) return 0;
  std::vector<MeasuredTime> times;
  for (const auto& [place, time] : found->second) times.push_back(time);
  return parts_of(times).ms(size);
}

void OptionSpeeds::add(const std::string& label, const FrameSize& size, double ms) {
  const MeasuredTime time{size.pixels, ms / size.views};
  if (!is_usable(time)) return;
  times_[label][place_of(time.pixels)] = time;
  is_changed_ = true;
}

void OptionSpeeds::keep() const {
  const fs::path path = path_of(info_);
  if (!is_changed_ || path.empty()) return;
  Json all = Json::object();
  for (const auto& [label, times] : times_) {
    for (const auto& [place, time] : times) all[label].push_back({time.pixels, time.ms});
  }
  const Json document = {{"device", key_of(info_)}, {"kernels", hash_of_kernels()}, {"times", all}};
  const std::string text = document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  std::error_code failed;
  fs::create_directories(path.parent_path(), failed);
  make_way(path);
  try {
    write_atomically(
        path, [&](NewFile& file) { file.append(text); }, FileFor::cache);
  } catch (const Error&) {
    return;
  }
}

}  // namespace gloam
