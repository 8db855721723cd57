// Numbers and times in text.
#pragma once

#include <charconv>
#include <optional>
#include <string>

namespace gloam {

/// The whole text as a number; none if it is none.
template <typename Number>
std::optional<Number> number_in(const std::string& text) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end) return {};
  return value;
}

/// Seconds of "90s", "1m", "2m30s", "1h", "20ms" or "500us"; none for another form, for 0, and for more than 1e6.
std::optional<double> seconds_in(const std::string& text);

/// What such a text may be, for messages.
extern const char* const allowed_times;

}  // namespace gloam
