// Parameters of a technique: the table that describes them, and their values as kernels get them.
#pragma once

#include <cstddef>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace gloam {

/// Names for the defaults of bool parameters in parameter lists.
inline constexpr int off = 0, on = 1;

/// Parameter values as a user writes them, by name: {"radius", "0.5"}.
using Settings = std::vector<std::pair<std::string, std::string>>;

/// One parameter. Its index in the table is its position in the kernel's struct.
struct Parameter {
  enum class Type { floating, integer, boolean, choice, file };
  std::string name;
  Type type;
  double initial, min, max;          ///< bool: 0 or 1; choice: index
  std::vector<std::string> choices;  ///< choice only
  std::string unit, help;
};

/// The parameters of a technique, in the order of its kernels' struct.
using ParameterList = std::vector<Parameter>;

/// The parameters of two lists, of which a technique reads one struct each (`ParameterValues::as`).
ParameterList operator+(ParameterList first, const ParameterList& second);

Parameter float_parameter(const char* name, double initial, double min, double max, const char* unit, const char* help);
Parameter int_parameter(const char* name, int initial, int min, int max, const char* unit, const char* help);
Parameter bool_parameter(const char* name, int initial, const char* help);
/// `choices`: text of the form "(a, b, c)".
Parameter choice_parameter(const char* name, const char* initial, const char* choices, const char* help);

/// A file that the host reads, or none, the default.
Parameter file_parameter(const char* name, const char* help);
/// The file that a value stands for; empty for none. Values of the same name are alike.
std::string file_name(int value);

/// "float", "int", "bool", "choice" or "file".
std::string type_name(const Parameter& parameter);
/// "0 to 32", "on or off", "a, b, c".
std::string allowed_values(const Parameter& parameter);

/// Values for a table of parameters, laid out as the kernel's struct.
class ParameterValues {
 public:
  ParameterValues() = default;
  explicit ParameterValues(ParameterList table);

  const ParameterList& table() const { return table_; }
  bool has(const std::string& name) const;
  /// Sets a value from text; throws UsageError with the range ("hbao+: radius = '-1' is not allowed; 0 to inf scene units is").
  void set(const std::string& name, const std::string& value, const std::string& technique);
  double number(const std::string& name) const;
  /// A value as a user would write it: "0.5", "on", "quadratic".
  std::string text(const std::string& name) const;

  const void* bytes() const { return bytes_.data(); }
  size_t size() const { return bytes_.size(); }
  /// The values of one of the lists that the table was put together from.
  template <typename Params>
  Params as() const {
    Params params;
    std::memcpy(&params, &bytes_.at(4 * index_of(Params::table().front().name)), sizeof params);
    return params;
  }

 private:
  size_t index_of(const std::string& name) const;
  ParameterList table_;
  std::vector<std::byte> bytes_;
};

}  // namespace gloam
