#include "flags/typed.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/lists.h"
#include "base/numbers.h"
#include "gloam/error.h"
#include "gloam/frame.h"

namespace gloam::cli {
namespace {

bool is_within(double value, const Range<double>& range) {
  if (range.or_infinite && std::isinf(value)) return value > 0 || range.least < 0;
  return value >= range.least && value <= range.most;  // false for NaN
}

[[noreturn]] void refuse_number(const std::string& text, const std::string& flag, const Range<int>& range) {
  throw UsageError("{} {} is not allowed; a whole number from {} to {} is", flag, text, range.least, range.most);
}

bool is_within(int value, const Range<int>& range) { return value >= range.least && value <= range.most; }

}  // namespace

double parse_number(const std::string& text, const std::string& flag, const Range<double>& range) {
  const std::optional<double> value = number_in<double>(text);
  if (value && is_within(*value, range)) return *value;
  const char* infinite = !range.or_infinite ? "" : range.least < 0 ? ", or inf or -inf," : ", or inf,";
  throw UsageError("{} {} is not allowed; a number from {:g} to {:g}{} is", flag, text, range.least, range.most,
                   infinite);
}

int parse_number(const std::string& text, const std::string& flag, const Range<int>& range) {
  const std::optional<int> value = number_in<int>(text);
  if (value && is_within(*value, range)) return *value;
  refuse_number(text, flag, range);
}

void check_number(int value, const std::string& flag, const Range<int>& range) {
  if (!is_within(value, range)) refuse_number(std::to_string(value), flag, range);
}

Size parse_size(const std::string& text, const std::string& flag) {
  const size_t cross = text.find('x');
  if (cross == std::string::npos || cross == 0 || cross + 1 == text.size())
    throw UsageError("{} {} is not WIDTHxHEIGHT; write 1920x1080", flag, text);
  const Range<int> pixels = {1, 65536};
  const int width = parse_number(text.substr(0, cross), flag + " " + text + ": width", pixels);
  const int height = parse_number(text.substr(cross + 1), flag + " " + text + ": height", pixels);
  if ((long long)width * height > max_pixels)
    throw UsageError("{} {} has more than {} pixels; take a smaller one", flag, text, max_pixels);
  return {width, height};
}

Size Overscan::around(const Size& image) const {
  const auto of = [&](int side) { return pixels + int(std::lround(share * side)); };
  return {of(image.first), of(image.second)};
}

Overscan parse_overscan(const std::string& text, const std::string& flag) {
  const std::string what = flag + " " + text + ": margin";
  if (text.ends_with("%"))
    return {.share = parse_number(text.substr(0, text.size() - 1), what, Range<double>{0, 500}) / 100};
  if (text.ends_with("px"))
    return {.pixels = parse_number(text.substr(0, text.size() - 2), what, Range<int>{0, 65536})};
  throw UsageError("{} {} has no unit; write 10% of the size on each side, or 64px", flag, text);
}

double parse_time(const std::string& text, const std::string& flag) {
  if (const std::optional<double> seconds = seconds_in(text)) return *seconds;
  throw UsageError("{} {} is not allowed; {}", flag, text, allowed_times);
}

std::vector<std::string> split_list(const std::string& text, const std::string& flag) {
  std::vector<std::string> items;
  std::istringstream stream(text);
  for (std::string item; std::getline(stream, item, ',');) items.push_back(item);
  if (items.empty() || std::find(items.begin(), items.end(), "") != items.end() || text.back() == ',') {
    throw UsageError("{} '{}' has an empty item; write a,b", flag, text);
  }
  return items;
}

std::string type_of_words(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, "|")); }

CLI::Option* add_word(CLI::App& app, const std::string& flag, std::string& target,
                      const std::vector<std::string>& words, const std::string& help) {
  const auto check = [words](const std::string& word, const std::string& name) {
    if (!contains(words, word)) refuse_word(word, name, words);
  };
  return app.add_option(flag, target, help)->check(accepted_by(check, flag))->type_name(type_of_words(words));
}

}  // namespace gloam::cli
