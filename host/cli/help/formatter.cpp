#include "cli/help/formatter.h"

#include <algorithm>
#include <map>
#include <sstream>

#include "base/lists.h"
#include "cli/flags/wrap.h"
#include "cli/help/commands.h"
#include "gloam/error.h"
#include "technique/default_technique.h"

namespace gloam::cli {
namespace {

/// The flags that nine of ten calls of a command need, for commands that have many: --help shows these alone.
const std::map<std::string, std::vector<std::string>> needed_by_most = {
    {"run", {"--output", "--radius", "--preset", "--picture", "--camera", "--fov", "--depth", "--frames"}},
    {"auto", {"--output", "--radius", "--budget", "--error", "--explain", "--composite", "--camera", "--frames"}},
    {"bench", {"--output", "--frame", "--truth", "--scenes", "--techniques", "--radius", "--time", "--all"}}};

/// A row of two columns: "  --fov DEG    horizontal field of view".
std::string row_of_help(const std::string& name, const std::string& help, size_t column) {
  std::string row = "  " + name;
  if (row.size() + 2 > column && !help.empty()) {
    row += "\n" + std::string(column, ' ');
  } else {
    row.resize(std::max(row.size(), help.empty() ? 0 : column), ' ');
  }
  return row + wrapped(help, column, column) + "\n";
}

std::vector<std::string> names_in_order(const std::set<CLI::Option*>& options) {
  std::vector<std::string> names;
  for (const CLI::Option* option : options) names.push_back(option->get_name());
  std::sort(names.begin(), names.end());
  return names;
}

/// " (needs --chunks)", " (not with --half)". Where a flag goes with few others, the error says so better than a list would.
std::string company_of(const CLI::Option& option) {
  constexpr size_t few = 3;
  std::vector<std::string> parts;
  if (!option.get_needs().empty())
    parts.push_back("needs " + fmt::format("{}", fmt::join(names_in_order(option.get_needs()), ", ")));
  if (!option.get_excludes().empty() && option.get_excludes().size() <= few)
    parts.push_back("not with " + fmt::format("{}", fmt::join(names_in_order(option.get_excludes()), ", ")));
  return parts.empty() ? "" : fmt::format(" ({})", fmt::join(parts, "; "));
}

/// A parameter of the default technique, which its command takes as a flag.
std::string row_of_parameter(const std::string& flag, size_t column) {
  for (const Parameter& p : find_technique(technique_for("ao")).parameters)
    if ("--" + p.name == flag)
      return row_of_help(flag + " R", p.help + ", in the frame's unit; default: made from the frame", column);
  throw Error("{}: neither a flag nor a parameter", flag);
}

/// The same of a parameter of techniques, with the techniques that have it.
std::string help_of_parameter(const std::string& flag) {
  std::map<std::string, std::vector<std::string>> techniques;
  for (const Technique& t : registry()) {
    if (!t.variant.of.empty()) continue;
    for (const Parameter& p : t.parameters) {
      std::string name = "--" + p.name;
      std::replace(name.begin(), name.end(), '_', '-');
      if (name == flag || "--" + p.name == flag) techniques[p.help].push_back(t.name);
    }
  }
  std::string text;
  for (const auto& [help, names] : techniques) {
    const std::string with = fmt::format("gloam run with {}", fmt::join(names, ", "));
    text += wrapped(with, 0, 2) + "\n" + row_of_help(flag, help, HelpFormatter().get_column_width());
  }
  return text;
}

bool is_line_of_its_own(const std::string& line) { return line.empty() || line.starts_with("  "); }

/// A command of a shell in several lines, where it is longer than one, as the shell takes it.
std::string wrapped_command(const std::string& line) {
  constexpr size_t indent = 6;
  const std::optional<size_t> width = line_width();
  if (!width) return line;
  std::string result;
  size_t column = 0, last_break = 0;  // of the result; 0: none on this line
  bool is_quoted = false;
  for (size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '\'') is_quoted = !is_quoted;
    const bool ends_word = line[i] == ' ' && !is_quoted && column > indent;
    // A flag stays beside its value.
    if (ends_word && (last_break == 0 || line.find_first_of("-|", i) == i + 1)) last_break = result.size();
    result += line[i];
    if (++column + 2 <= *width || last_break == 0) continue;
    column = indent + result.size() - last_break - 1;
    result.replace(last_break, 1, " \\\n" + std::string(indent, ' '));
    last_break = 0;
  }
  return result;
}

/// A line of a footer: an example, or a name and what it is.
std::string line_of_footer(const std::string& line) {
  if (line.starts_with("  gloam ")) return wrapped_command(line);
  const size_t name = line.find_first_not_of(' '), gap = line.find("  ", std::min(name, line.size())),
               text = gap == std::string::npos ? gap : line.find_first_not_of(' ', gap);
  return text == std::string::npos ? line : line.substr(0, text) + wrapped(line.substr(text), text, text);
}

}  // namespace

HelpFormatter::HelpFormatter() {
  column_width(28);
  label("SUBCOMMAND", "COMMAND");
  label("Positionals", "Arguments");
}

std::string HelpFormatter::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const {
  const bool shortens = mode != CLI::AppFormatMode::All && needed_by_most.count(app->get_name());
  return wrapped(app->get_description(), 0, 2) + "\n" + make_usage(app, name) + make_positionals(app) +
         (shortens ? first_flags(*app) + where_the_rest_is(*app) : all_flags(*app)) + make_subcommands(app, mode) +
         "\n" + make_footer(app);
}

std::string HelpFormatter::first_flags(const CLI::App& command) const {
  std::string text = "\nFlags that most calls need:\n";
  for (const std::string& flag : needed_by_most.at(command.get_name())) {
    const CLI::Option* option = command.get_option_no_throw(flag);
    text += option ? make_option(option, false) : row_of_parameter(flag, get_column_width());
  }
  return text;
}

std::string HelpFormatter::where_the_rest_is(const CLI::App& command) const {
  const size_t count = command.get_options([](const CLI::Option* o) { return o->nonpositional(); }).size();
  return row_of_help("--help-all", fmt::format("all {} flags, in groups", count), get_column_width());
}

std::string HelpFormatter::all_flags(const CLI::App& command) const {
  const auto needed = needed_by_most.find(command.get_name());
  const bool has_first = needed != needed_by_most.end();
  std::string text = has_first ? first_flags(command) : "";
  for (const std::string& group : command.get_groups()) {
    const std::vector<const CLI::Option*> options = command.get_options([&](const CLI::Option* option) {
      const auto is_it = [&](const std::string& flag) { return command.get_option_no_throw(flag) == option; };
      return option->get_group() == group && option->nonpositional() &&
             !(has_first && std::any_of(needed->second.begin(), needed->second.end(), is_it));
    });
    if (!group.empty() && !options.empty()) text += make_group(group, false, options);
  }
  return text;
}

std::string HelpFormatter::make_subcommand(const CLI::App* command) const {
  constexpr size_t column = 15;
  return row_of_help(command->get_name(), command->get_description(), column);
}

std::string HelpFormatter::make_option(const CLI::Option* option, bool is_positional) const {
  std::string name = make_option_name(option, is_positional);
  if (option->get_type_size() != 0 && !option->get_type_name().empty()) name += " " + option->get_type_name();
  const std::string needed = option->get_required() && !is_positional ? " (required)" : "";
  return row_of_help(name, option->get_description() + company_of(*option) + needed, get_column_width());
}

std::string HelpFormatter::make_group(std::string group, bool is_positional,
                                      std::vector<const CLI::Option*> options) const {
  std::string text = "\n" + group + ":\n";
  for (const CLI::Option* option : options) text += make_option(option, is_positional);
  return text;
}

/// Examples keep their lines; sentences become as wide as the terminal.
std::string HelpFormatter::make_footer(const CLI::App* app) const {
  std::istringstream lines(app->get_footer());
  std::string text, sentence;
  const auto end_sentence = [&] {
    if (!sentence.empty()) text += wrapped(sentence, 0, 0) + "\n";
    sentence.clear();
  };
  for (std::string line; std::getline(lines, line);) {
    if (!is_line_of_its_own(line)) {
      sentence += (sentence.empty() ? "" : " ") + line;
      continue;
    }
    end_sentence();
    text += line_of_footer(line) + "\n";
  }
  end_sentence();
  return text;
}

std::string help_of_all_commands(CLI::App& app) {
  std::string text;
  for (const std::string& name : command_names())
    text += "\n" + app.get_subcommand(name)->help(app.get_name(), CLI::AppFormatMode::All);
  return text;
}

std::string help_of_flag(CLI::App& app, const std::string& flag) {
  std::vector<std::pair<std::string, std::vector<std::string>>> said;  // commands by what they say
  const HelpFormatter formatter;
  for (const std::string& name : command_names()) {
    const CLI::Option* option = app.get_subcommand(name)->get_option_no_throw(flag);
    if (!option) continue;
    const std::string row = formatter.make_option(option, false);
    const auto known = std::find_if(said.begin(), said.end(), [&](const auto& each) { return each.first == row; });
    if (known != said.end())
      known->second.push_back(name);
    else
      said.push_back({row, {name}});
  }
  std::string text;
  for (const auto& [row, names] : said) text += fmt::format("gloam {}\n{}", fmt::join(names, ", "), row);
  return text + help_of_parameter(flag);
}

}  // namespace gloam::cli
