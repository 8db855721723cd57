#include "cli/typed.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "base/lists.h"
#include "gloam/error.h"
#include "gloam/exr.h"

namespace gloam::cli {
namespace {

/// The whole text as a number; none if it is not a number.
template <typename Number>
std::optional<Number> number_in(const std::string& text) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end) return {};
  return value;
}

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

double parse_time(const std::string& text, const std::string& flag) {
  double seconds = 0;
  std::string rest = text;
  for (const auto& [unit, factor] : {std::pair{'h', 3600.0}, {'m', 60.0}, {'s', 1.0}}) {
    const size_t end = rest.find(unit);
    if (end == std::string::npos) continue;
    try {
      seconds += factor * parse_number(rest.substr(0, end), flag, Range<double>{0, 1e6});
    } catch (const UsageError&) {
      seconds = -1;
      break;
    }
    rest.erase(0, end + 1);
  }
  try {
    if (seconds >= 0 && !rest.empty() && rest == text)
      seconds = parse_number(rest, flag, Range<double>{0, 1e6}), rest.clear();
  } catch (const UsageError&) {
  }
  if (seconds <= 0 || !rest.empty())
    throw UsageError("{} {} is not allowed; a time above 0 such as 90s, 1m, 2m30s or 1h is", flag, text);
  return seconds;
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
