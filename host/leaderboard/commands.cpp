#include "leaderboard/commands.h"

#include "base/command_line.h"

namespace gloam::leaderboard {
namespace {

using report::Json;

std::string value_text(const Json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

/// As files of a set are named; of other frames the name stands for the file.
std::string frame_name(const Item& item, const report::SetFacts& set) {
  const std::string number = item.kind == "sequence" ? ".####" : "";
  return (set.name.empty() ? "" : set.name + "/frames/") + item.name + number + ".exr";
}

/// "gtao_courtyard.exr": of letters that a file's name can hold everywhere.
std::string output_name(const Row& row, const Item& item) {
  std::string name = row.technique + "_" + item.name;
  for (char& c : name) {
    if (c == '/' || c == ' ' || c == ':') c = '-';
  }
  return name + (item.kind == "sequence" ? ".####.exr" : ".exr");
}

/// Flags that a variant stands for. False for one that `gloam run` does not have.
bool add_variant(const Row& row, std::vector<std::string>& words) {
  if (row.variant == "half storage") return false;
  if (row.variant == "temporal") words.push_back("--temporal");
  if (!row.resolution.empty() && row.resolution != "full") words.insert(words.end(), {"--resolution", row.resolution});
  if (row.math == "precise") words.insert(words.end(), {"--math", "precise"});
  if (row.real == "double") words.insert(words.end(), {"--real", "double"});
  return true;
}

}  // namespace

std::string run_command(const Row& row, const Item& item, const report::SetFacts& set) {
  if (!row.submitted.is_null()) return "";
  std::vector<std::string> words{"gloam", "run", row.technique, frame_name(item, set), "-o", output_name(row, item)};
  if (!row.preset.empty() && row.preset != "none") words.insert(words.end(), {"--preset", row.preset});
  if (!add_variant(row, words)) return "";
  for (const auto& [name, value] : row.settings.items())
    words.insert(words.end(), {"--set", name + "=" + value_text(value)});
  return shell_line(words);
}

std::string measuring_command(const Row& row, const report::Measurements& file) {
  if (row.submitted.is_null()) return shell_line(file.command);
  std::vector<std::string> words;
  if (const auto by = row.submitted.find("scored_by"); by != row.submitted.end() && by->is_array()) {
    for (const Json& word : *by) {
      if (word.is_string()) words.push_back(word);
    }
  }
  return shell_line(words);
}

}  // namespace gloam::leaderboard
