#include "cli/completion/completion.h"
#include "gloam/error.h"

namespace gloam::cli {
namespace {

/// Text escaped for a specification in single quotes.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\'')
      out += "'\\''";
    else if (c == ':' || c == '[' || c == ']' || c == '\\')
      out += std::string("\\") + c;
    else
      out += c;
  }
  return out;
}

/// The action of _arguments that completes a value.
std::string action_for(const Completion& value) {
  const std::string words = fmt::format("{}", fmt::join(value.words, " "));
  const std::string files = value.ending.empty() ? "_files" : fmt::format("_files -g \"*{}(-.)\"", value.ending);
  if (value.is_list && !value.words.empty()) return fmt::format("_sequence compadd - {}", words);
  if (value.words.empty()) return value.has_files ? files : "";
  if (!value.has_files) return fmt::format("({})", words);
  return fmt::format("_alternative \"words\\:name\\:({})\" \"files\\:file\\:_files\"", words);
}

/// '(-o --output)'{-o,--output}'[EXR file to write]:OUT.exr:_files'
std::string specification(const CompletedFlag& flag) {
  std::string names = flag.names.front();
  std::string value = fmt::format("[{}]", escaped(flag.help));
  if (!flag.type.empty()) value += fmt::format(":{}:{}", escaped(flag.type), action_for(flag.value));
  // "--flag=" takes its value after an equals sign or as the next word.
  std::vector<std::string> spellings;
  for (const std::string& name : flag.names)
    spellings.push_back(!flag.type.empty() && name.rfind("--", 0) == 0 ? name + "=" : name);
  if (flag.names.size() == 1) return fmt::format("'{}{}'", spellings.front(), value);
  return fmt::format("'({})'{{{}}}'{}'", fmt::join(flag.names, " "), fmt::join(spellings, ","), value);
}

std::string specifications(const CompletedCommand& command) {
  std::string text;
  for (const CompletedFlag& flag : command.flags) text += fmt::format("        {}\n", specification(flag));
  for (size_t i = 0; i < command.arguments.size(); ++i) {
    const CompletedArgument& argument = command.arguments[i];
    const bool is_last = i + 1 == command.arguments.size();
    const std::string action = action_for(argument.value);
    text += fmt::format("        '{}:{}:{}'\n", is_last ? "*" : std::to_string(i + 1), escaped(argument.name),
                        action.empty() ? " " : action);
  }
  return text;
}

std::string parameter_cases(const CompletedCommand& command) {
  std::string text;
  for (const auto& [owner, flags] : command.parameters) {
    text += fmt::format("      {}:{}) specs+=(\n", command.name, owner);
    for (const CompletedFlag& flag : flags) text += fmt::format("        {}\n", specification(flag));
    text += "      ) ;;\n";
  }
  return text;
}

}  // namespace

std::string zsh_completion(const CompletedWords& first) {
  std::string names, cases, parameters;
  for (const CompletedCommand& command : first.commands) {
    names += fmt::format("    '{}:{}'\n", command.name, escaped(command.help));
    cases += fmt::format("    {})\n      specs=(\n{}      ) ;;\n", command.name, specifications(command));
    parameters += parameter_cases(command);
  }
  return fmt::format(
      "#compdef gloam\n"
      "# zsh completion for gloam, written by `gloam completion zsh`.\n"
      "_gloam() {{\n"
      "  local -a commands=(\n{}  )\n"
      "  local -a techniques=({})\n"
      "  if (( CURRENT == 2 )); then\n"
      "    _describe -t commands command commands\n"
      "    _describe -t techniques technique techniques\n"
      "    _arguments '--help[what there is]' '--version[which version this is]'\n"
      "    return\n"
      "  fi\n"
      "  # A technique for a command is `run` with it.\n"
      "  if (( ${{techniques[(Ie)$words[2]]}} )); then\n"
      "    words=(\"$words[1]\" run \"${{(@)words[2,-1]}}\")\n"
      "    (( CURRENT++ ))\n"
      "  fi\n"
      "  local command=$words[2] word\n"
      "  local -a specs\n"
      "  shift words\n"
      "  (( CURRENT-- ))\n"
      "  case $command in\n{}  esac\n"
      "  for word in $words; do\n"
      "    case $command:$word in\n{}    esac\n"
      "  done\n"
      "  _arguments -s $specs\n"
      "}}\n"
      "_gloam \"$@\"\n",
      names, fmt::join(first.techniques, " "), cases, parameters);
}

}  // namespace gloam::cli
