// Flags with a type. Their values are checked while the command line is read, so that errors are reported before a file is opened,
// in one line that names the flag, the value and the allowed values.
#pragma once

#include <CLI/CLI.hpp>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/words.h"

namespace gloam::cli {

/// Allowed values of a number, both ends included.
template <typename Number>
struct Range {
  Number least, most;
  bool or_infinite = false;  ///< infinity is allowed as well; of both signs if `least` is below 0
};

inline constexpr Range<int> allowed_seeds = {0, std::numeric_limits<int>::max()}, allowed_rays = {1, 1 << 24},
                            allowed_rounds = {1, 10000};
inline constexpr Range<double> allowed_radii = {1e-30, 1e30};

/// The type of a flag's value: that of the variable, or of the optional's content.
template <typename Target>
struct ValueIn {
  using type = Target;
};
template <typename Value>
struct ValueIn<std::optional<Value>> {
  using type = Value;
};

// --- Text to values. UsageError names the flag.

double parse_number(const std::string& text, const std::string& flag, const Range<double>& range);
int parse_number(const std::string& text, const std::string& flag, const Range<int>& range);

/// Throws if a parsed number is outside a range that is known only later.
void check_number(int value, const std::string& flag, const Range<int>& range);

/// Width and height in pixels.
using Size = std::pair<int, int>;

/// "1920x1080": 1 to 65536 each way, and `max_pixels` at most.
Size parse_size(const std::string& text, const std::string& flag);

/// Pixels around an image: of "10%" that share of its width on the left and the right, and of its height at the top and the bottom; of "64px"
/// 64 on each side.
struct Overscan {
  double share = 0;
  int pixels = 0;
  Size around(const Size& image) const;
};
/// Always with a unit, since a bare number could be either: 0 % to 500 %, 0 to 65536 px.
Overscan parse_overscan(const std::string& text, const std::string& flag);

/// Seconds of "90s", "1m", "2m30s", "1h", "20ms" or "500us": above 0, and always with a unit.
double parse_time(const std::string& text, const std::string& flag);

/// "a,b" -> a b; none of them empty.
std::vector<std::string> split_list(const std::string& text, const std::string& flag);

// --- Flags.

/// Refuses text that `parse(text, flag)` refuses. For flags that stay text.
template <typename Parse>
CLI::Validator accepted_by(Parse parse, const std::string& flag) {
  return CLI::Validator([parse, flag](std::string& text) { return parse(text, flag), std::string(); }, "");
}

/// While it lives, flags that are added are listed under a heading of `--help`.
class Heading {
 public:
  Heading(CLI::App& app, const std::string& name) : app_(app), before_(app.option_defaults()->get_group()) {
    app.option_defaults()->group(name);
  }
  ~Heading() { app_.option_defaults()->group(before_); }
  Heading(const Heading&) = delete;

 private:
  CLI::App& app_;
  const std::string before_;
};

/// A flag whose value is the result of `parse(text, flag)`, in a variable or an optional. CLI11's own conversion reads 010 as 8,
/// rounds decimals twice, and knows neither sizes nor units. `type`: what stands for the value in `--help`.
template <typename Target, typename Parse>
CLI::Option* add_parsed(CLI::App& app, const std::string& flag, Target& target, Parse parse, const std::string& help,
                        const std::string& type = {}) {
  const CLI::callback_t take = [&target, parse, flag](const CLI::results_t& texts) {
    target = parse(texts.front(), flag);
    return true;
  };
  return app.add_option(flag, take, help)->type_name(type);
}

/// A flag for a number within a range, in an `int`, a `double` or an optional one.
template <typename Target, typename Number = typename ValueIn<Target>::type>
CLI::Option* add_number(CLI::App& app, const std::string& flag, Target& target, const Range<Number>& range,
                        const std::string& help,
                        const std::string& type = std::is_integral_v<Number> ? "INT" : "FLOAT") {
  const auto parse = [range](const std::string& text, const std::string& name) {
    return parse_number(text, name, range);
  };
  return add_parsed(app, flag, target, parse, help, type);
}

/// A flag or an argument for a text, or for several. `type`: what stands for the value in `--help`.
template <typename Target>
CLI::Option* add_text(CLI::App& app, const std::string& flag, Target& target, const std::string& type,
                      const std::string& help) {
  return app.add_option(flag, target, help)->type_name(type);
}

/// "full|half|quarter": the type of a flag that takes one of a few words. `--help` shows it, and shells complete from it.
std::string type_of_words(const std::vector<std::string>& words);

/// A flag for one of a few words, stored as the value that it stands for, in a variable or an optional.
template <typename Target, typename Value = typename ValueIn<Target>::type>
CLI::Option* add_choice(CLI::App& app, const std::string& flag, Target& target, const Choices<Value>& choices,
                        const std::string& help) {
  const auto parse = [choices](const std::string& word, const std::string& name) {
    return value_of(word, name, choices);
  };
  return add_parsed(app, flag, target, parse, help)->type_name(type_of_words(words_of(choices)));
}

/// A flag for one of a few words, stored as text.
CLI::Option* add_word(CLI::App& app, const std::string& flag, std::string& target,
                      const std::vector<std::string>& words, const std::string& help);

}  // namespace gloam::cli
