#include "normalise/depth_encoding.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/srgb.h"
#include "gloam/error.h"
#include "normalise/background.h"
#include "normalise/each_row.h"

namespace gloam {
namespace {

/// Neighbours this far apart have wrapped, or lie on either side of an edge.
constexpr double least_jump = 0.75 * range_of_16_bits;
/// How evenly a surface goes on where it wraps: what is left of a jump beside the step before, and a share of that step. Of jumps at
/// edges about one in fifty does so by chance.
constexpr double most_left = 128, most_change = 0.5;
constexpr double least_wraps_of_pixels = 1 / 4000.0;
constexpr long long fewest_wraps = 24, enough_wraps = 64;
constexpr double least_share_of_wraps = 0.15, least_share_of_doubt = 0.06;

bool is_whole(float value) { return value == std::floor(value); }

float most_of(const Channel& depth) {
  float most = 0;
  for (int y = 0; y < depth.layout().height; ++y)
    for (int x = 0; x < depth.layout().width; ++x)
      if (const float value = depth.row(y)[x]; is_no_mark(value)) most = std::max(most, value);
  return most;
}

bool are_whole(const Channel& depth) {
  for (int y = 0; y < depth.layout().height; ++y) {
    const float* row = depth.row(y);
    if (!std::all_of(row, row + depth.layout().width, [](float v) { return !is_no_mark(v) || is_whole(v); }))
      return false;
  }
  return true;
}

/// The value of white.
float white_of(const Channel& depth) {
  const float most = most_of(depth);
  return most <= 1 ? 1.0f : most <= 255 ? 255.0f : 65535.0f;
}

void linearise(Channel& depth) {
  const auto linear = without_curve(depth);
  for_each_row(depth.layout(), [&](int y) {
    float* row = depth.row(y);
    std::transform(row, row + depth.layout().width, row, linear);
  });
}

void turn_over(Channel& depth) {
  const Layout& layout = depth.layout();
  for (int y = 0; y < layout.height / 2; ++y)
    std::swap_ranges(depth.row(y), depth.row(y) + layout.width, depth.row(layout.height - 1 - y));
}

}  // namespace

std::string in_words(const DepthEncoding& encoding) {
  std::vector<std::string> words;
  if (encoding.wrapped) words.emplace_back("wrapped");
  if (encoding.srgb) words.emplace_back("srgb");
  if (encoding.bottom_up) words.emplace_back("bottom-up");
  return words.empty() ? "plain" : fmt::format("{}", fmt::join(words, ","));
}

std::optional<DepthEncoding> parse_depth_encoding(const std::string& text, const std::string& flag) {
  if (text == "auto") return {};
  DepthEncoding encoding;
  if (text == "plain") return encoding;
  if (text.empty())
    throw UsageError("{} is empty; auto and plain are allowed, or some of srgb, bottom-up and wrapped", flag);
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    if (word == "srgb")
      encoding.srgb = true;
    else if (word == "bottom-up")
      encoding.bottom_up = true;
    else if (word == "wrapped")
      encoding.wrapped = true;
    else
      throw UsageError("{} {}: '{}' is not allowed{}; auto and plain are, or some of srgb, bottom-up and wrapped", flag,
                       text, word, suggestion(word, {"auto", "plain", "srgb", "bottom-up", "wrapped"}));
  }
  return encoding;
}

void check(const DepthEncoding& encoding, const Channel& depth, const std::string& flag) {
  if (!encoding.srgb && !encoding.wrapped) return;
  const bool whole = are_whole(depth);
  const float most = most_of(depth);
  if (encoding.wrapped && !whole)
    throw UsageError("{}: 'wrapped' is for whole numbers of 16 bits, and the depth has others; leave it out", flag);
  if (encoding.srgb && !(whole && most <= 65535) && !(most <= 1))
    throw UsageError(
        "{}: 'srgb' is for shares of white, from 0 to 1 or whole numbers to 65535, and the depth goes to {:g}; leave "
        "it out",
        flag, most);
}

void undo(const DepthEncoding& encoding, Channel& depth, const VoteOnTurns& vote) {
  if (encoding.wrapped) unwrap(depth, vote);
  if (encoding.srgb) linearise(depth);
  if (encoding.bottom_up) turn_over(depth);
}

std::function<float(float value)> without_curve(const Channel& depth) {
  return [white = double(white_of(depth))](float value) {
    return value > 0 && is_no_mark(value) ? float(linear_of_srgb(double(value) / white)) : value;
  };
}

bool may_have_curve(const Channel& depth) {
  const float most = most_of(depth);
  return most <= 1 || (most <= 65535 && are_whole(depth));
}

bool may_wrap(const Channel& depth) {
  constexpr double least_share = 0.9;
  const double most = double(most_of(depth));
  return most >= least_share * range_of_16_bits && most < range_of_16_bits && are_whole(depth);
}

Wraps count_wraps(const Channel& depth) {
  const Layout& layout = depth.layout();
  long long wraps = 0, jumps = 0;
  const auto look = [&](double before, double here, double next) {
    const double step = here - before, jump = next - here;
    if (here == 0 || next == 0 || !(std::abs(jump) > least_jump) || !(std::abs(jump) < range_of_16_bits) ||
        !(std::abs(step) < least_jump))
      return;
    ++jumps;
    wraps += std::abs(modulo_16_bits(jump) - step) < most_left + most_change * std::abs(step);
  };
  for (int y = 0; y < layout.height; ++y) {
    const float* row = depth.row(y);
    for (int x = 0; x < layout.width; ++x) {
      if (is_no_mark(row[x]) && (!is_whole(row[x]) || row[x] > 65535 || row[x] < -32768)) return {};
      if (x > 0 && x + 1 < layout.width) look(double(row[x - 1]), double(row[x]), double(row[x + 1]));
      if (y > 0 && y + 1 < layout.height)
        look(double(depth.row(y - 1)[x]), double(row[x]), double(depth.row(y + 1)[x]));
    }
  }
  const double share = jumps == 0 ? 0 : double(wraps) / double(jumps);
  if (wraps < fewest_wraps || share < least_share_of_doubt) return {};
  const double fewest = std::min(least_wraps_of_pixels * layout.width * layout.height, double(enough_wraps));
  return {wraps, share >= least_share_of_wraps && double(wraps) >= fewest};
}

}  // namespace gloam
