#include "gloam/parameters.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>
#include <sstream>

#include "base/file_ledger.h"
#include "gloam/error.h"

namespace gloam {
namespace {

/// "(a, b, c)" -> a b c
std::vector<std::string> split_choices(std::string text) {
  text = text.substr(1, text.size() - 2);
  text.erase(std::remove(text.begin(), text.end(), ' '), text.end());
  std::vector<std::string> names;
  std::istringstream stream(text);
  for (std::string name; std::getline(stream, name, ',');) names.push_back(name);
  return names;
}

std::optional<double> parse_number(const std::string& text, Parameter::Type type) {
  const char* end = text.data() + text.size();
  if (type == Parameter::Type::integer) {
    int value = 0;
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || stop != end) return {};
    return value;
  }
  double value = 0;
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || std::isnan(value)) return {};
  return value;
}

/// Choices are C names; users may also write no-back-check.
std::string with_underscores(std::string text) {
  std::replace(text.begin(), text.end(), '-', '_');
  return text;
}

/// Names of files, by value - 1.
struct FileNames {
  std::mutex mutex;
  std::vector<std::string> names;
};

FileNames& file_names() {
  static FileNames names;
  return names;
}

int value_of_file(const std::string& name) {
  if (name == "none") return 0;
  reads_file(name, fmt::format("the file '{}' of a parameter", name));
  FileNames& files = file_names();
  const std::lock_guard lock(files.mutex);
  const auto found = std::find(files.names.begin(), files.names.end(), name);
  if (found != files.names.end()) return int(found - files.names.begin()) + 1;
  files.names.push_back(name);
  return int(files.names.size());
}

std::optional<double> parse(const Parameter& p, const std::string& text) {
  if (p.type == Parameter::Type::file) {
    if (text.empty()) return {};
    return value_of_file(text);
  }
  if (p.type == Parameter::Type::boolean) {
    if (text == "on" || text == "true" || text == "1") return 1;
    if (text == "off" || text == "false" || text == "0") return 0;
    return {};
  }
  if (p.type == Parameter::Type::choice) {
    const auto found = std::find(p.choices.begin(), p.choices.end(), with_underscores(text));
    if (found == p.choices.end()) return {};
    return double(found - p.choices.begin());
  }
  const std::optional<double> value = parse_number(text, p.type);
  if (!value || *value < p.min || *value > p.max) return {};
  return value;
}

/// "a whole number from 1 to 32", "quadratic or none"
std::string allowed_words(const Parameter& p) {
  if (p.type == Parameter::Type::integer) return "a whole number from " + allowed_values(p);
  if (p.type == Parameter::Type::floating) return "a number from " + allowed_values(p);
  return allowed_values(p);
}

}  // namespace

Parameter float_parameter(const char* name, double initial, double min, double max, const char* unit,
                          const char* help) {
  return {name, Parameter::Type::floating, initial, min, max, {}, unit, help};
}

Parameter int_parameter(const char* name, int initial, int min, int max, const char* unit, const char* help) {
  return {name, Parameter::Type::integer, double(initial), double(min), double(max), {}, unit, help};
}

Parameter bool_parameter(const char* name, int initial, const char* help) {
  return {name, Parameter::Type::boolean, double(initial), 0, 1, {}, "", help};
}

Parameter choice_parameter(const char* name, const char* initial, const char* choices, const char* help) {
  Parameter p{name, Parameter::Type::choice, 0, 0, 0, split_choices(choices), "", help};
  p.initial = double(std::find(p.choices.begin(), p.choices.end(), initial) - p.choices.begin());
  p.max = double(p.choices.size()) - 1;
  return p;
}

Parameter file_parameter(const char* name, const char* help) {
  return {name, Parameter::Type::file, 0, 0, 0, {}, "", help};
}

ParameterList operator+(ParameterList first, const ParameterList& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

std::string file_name(int value) {
  FileNames& files = file_names();
  const std::lock_guard lock(files.mutex);
  return value == 0 ? "" : files.names.at(size_t(value) - 1);
}

std::string type_name(const Parameter& p) {
  switch (p.type) {
    case Parameter::Type::floating:
      return "float";
    case Parameter::Type::integer:
      return "int";
    case Parameter::Type::boolean:
      return "bool";
    case Parameter::Type::file:
      return "file";
    default:
      return "choice";
  }
}

std::string allowed_values(const Parameter& p) {
  if (p.type == Parameter::Type::boolean) return "on or off";
  if (p.type == Parameter::Type::choice) return fmt::format("{}", fmt::join(p.choices, ", "));
  if (p.type == Parameter::Type::file) return "a file, or none";
  const std::string range = fmt::format("{:g} to {:g}", p.min, p.max);
  return p.unit.empty() ? range : range + " " + p.unit;
}

ParameterValues::ParameterValues(ParameterList table) : table_(std::move(table)), bytes_(4 * table_.size()) {
  for (const Parameter& p : table_) {
    if (p.type == Parameter::Type::file) continue;  // none is 0
    const bool is_choice = p.type == Parameter::Type::choice;
    const bool is_bool = p.type == Parameter::Type::boolean;
    const std::string text = is_choice ? p.choices.at(size_t(p.initial))
                             : is_bool ? (p.initial != 0 ? "on" : "off")
                                       : fmt::format("{}", p.initial);
    set(p.name, text, "default");
  }
}

bool ParameterValues::has(const std::string& name) const {
  return std::any_of(table_.begin(), table_.end(), [&](const Parameter& p) { return p.name == name; });
}

size_t ParameterValues::index_of(const std::string& name) const {
  for (size_t i = 0; i < table_.size(); ++i) {
    if (table_[i].name == name) return i;
  }
  std::vector<std::string> names;
  for (const Parameter& p : table_) names.push_back(p.name);
  throw UsageError("no parameter '{}'{}; {}", name, suggestion(name, names),
                   names.empty() ? "there is none" : enumerate(names) + " can be set");
}

void ParameterValues::set(const std::string& name, const std::string& value, const std::string& technique) {
  const size_t i = index_of(name);
  const Parameter& p = table_[i];
  const std::optional<double> number = parse(p, value);
  if (!number) throw UsageError("{}: {} = '{}' is not allowed; {} is", technique, name, value, allowed_words(p));
  if (p.type == Parameter::Type::floating) {
    const float as_float = float(*number);
    std::memcpy(&bytes_[4 * i], &as_float, 4);
  } else {
    const int as_int = int(*number);
    std::memcpy(&bytes_[4 * i], &as_int, 4);
  }
}

double ParameterValues::number(const std::string& name) const {
  const size_t i = index_of(name);
  if (table_[i].type == Parameter::Type::floating) {
    float value;
    std::memcpy(&value, &bytes_[4 * i], 4);
    return value;
  }
  int value;
  std::memcpy(&value, &bytes_[4 * i], 4);
  return value;
}

std::string ParameterValues::text(const std::string& name) const {
  const Parameter& p = table_[index_of(name)];
  const double value = number(name);
  if (p.type == Parameter::Type::boolean) return value != 0 ? "on" : "off";
  if (p.type == Parameter::Type::choice) return p.choices.at(size_t(value));
  if (p.type == Parameter::Type::file) return value == 0 ? "none" : file_name(int(value));
  return p.type == Parameter::Type::integer ? fmt::format("{}", int(value)) : fmt::format("{}", float(value));
}

}  // namespace gloam
