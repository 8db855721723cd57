#include "base/numbers.h"

#include <algorithm>
#include <array>

namespace gloam {
namespace {

struct TimeUnit {
  const char* name;
  double seconds;
};

/// The largest first, as the parts of a time follow one another. "m" and "s" stand behind the units that end in them.
constexpr std::array<TimeUnit, 5> time_units = {{{"h", 3600}, {"m", 60}, {"s", 1}, {"ms", 1e-3}, {"us", 1e-6}}};
constexpr double least_seconds = 1e-9, most_seconds = 1e6;

}  // namespace

std::optional<double> seconds_in(const std::string& text) {
  double seconds = 0;
  size_t unit = 0;
  for (size_t at = 0; at < text.size();) {
    const size_t end = std::min(text.find_first_not_of("0123456789.", at), text.size());
    const size_t next = std::min(text.find_first_of("0123456789.", end), text.size());
    const std::string name = text.substr(end, next - end);
    while (unit < time_units.size() && time_units[unit].name != name) ++unit;
    const std::optional<double> value = number_in<double>(text.substr(at, end - at));
    if (!value || unit == time_units.size()) return {};
    seconds += *value * time_units[unit++].seconds;
    at = next;
  }
  return seconds >= least_seconds && seconds <= most_seconds ? std::optional(seconds) : std::nullopt;
}

const char* const allowed_times = "write a number with its unit, such as 30ms, 500us, 90s, 2m30s or 1h, above 0";

}  // namespace gloam
