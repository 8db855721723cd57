#include <map>

#include "base/lists.h"
#include "cli/completion/completion.h"
#include "gloam/error.h"

namespace gloam::cli {
namespace {

std::string joined(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, " ")); }

/// The call that completes a value; empty if its values are not known.
std::string call_for(const Completion& value) {
  std::string calls;
  if (!value.words.empty())
    calls = fmt::format("_gloam_{} '{}'", value.is_list ? "list" : "words", joined(value.words));
  if (value.has_files) calls += fmt::format("{}_gloam_files '{}'", calls.empty() ? "" : "; ", value.ending);
  return calls;
}

/// "run:--filter|run:-f) call ;;"
void add_flag_value(const std::string& command, const CompletedFlag& flag, std::string& text) {
  std::vector<std::string> patterns;
  for (const std::string& name : flag.names) patterns.push_back(command + ":" + name);
  const std::string call = call_for(flag.value);
  text += fmt::format("    {}) {} ;;\n", fmt::join(patterns, "|"), call.empty() ? ":" : call);
}

/// Cases for the value after a flag. Parameters of one name complete the values of all of them.
std::string value_cases(const std::vector<CompletedCommand>& commands) {
  std::string text;
  for (const CompletedCommand& command : commands) {
    for (const CompletedFlag& flag : command.flags) {
      if (!flag.type.empty()) add_flag_value(command.name, flag, text);
    }
    std::map<std::string, CompletedFlag> parameters;
    for (const auto& [owner, flags] : command.parameters) {
      for (const CompletedFlag& flag : flags) {
        CompletedFlag& all = parameters.emplace(flag.names.front(), flag).first->second;
        for (const std::string& word : flag.value.words) add_new(all.value.words, word);
      }
    }
    for (const auto& [name, flag] : parameters) add_flag_value(command.name, flag, text);
  }
  return text;
}

std::string argument_cases(const std::vector<CompletedCommand>& commands) {
  std::string text;
  for (const CompletedCommand& command : commands) {
    for (size_t i = 0; i < command.arguments.size(); ++i) {
      if (const std::string call = call_for(command.arguments[i].value); !call.empty())
        text += fmt::format("    {}:{}) {} ;;\n", command.name, i, call);
    }
  }
  return text;
}

/// Flags of each command, those that take no value, and those of parameters by their owner.
std::string flag_cases(const std::vector<CompletedCommand>& commands) {
  std::string flags, switches, parameters;
  for (const CompletedCommand& command : commands) {
    std::vector<std::string> names, without_value;
    for (const CompletedFlag& flag : command.flags) {
      names.insert(names.end(), flag.names.begin(), flag.names.end());
      if (flag.type.empty()) without_value.insert(without_value.end(), flag.names.begin(), flag.names.end());
    }
    flags += fmt::format("    {}) echo '{}' ;;\n", command.name, joined(names));
    switches += fmt::format("    {}) echo '{}' ;;\n", command.name, joined(without_value));
    for (const auto& [owner, list] : command.parameters) {
      std::vector<std::string> own;
      for (const CompletedFlag& flag : list) own.push_back(flag.names.front());
      parameters += fmt::format("    {}:{}) echo '{}' ;;\n", command.name, owner, joined(own));
    }
  }
  const auto function = [](const std::string& name, const std::string& cases) {
    return fmt::format("{}() {{\n  case $1 in\n{}  esac\n}}\n\n", name, cases);
  };
  return function("_gloam_flags", flags) + function("_gloam_switches", switches) +
         function("_gloam_parameters", parameters);
}

constexpr const char* helpers = R"bash(# Completes the last word from a list of words.
_gloam_words() { mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -W "$1" -- "$cur"); }

# The same after the last comma.
_gloam_list() {
  local before=
  [[ $cur == *,* ]] && before=${cur%,*},
  mapfile -t COMPREPLY < <(compgen -P "$before" -W "$1" -- "${cur##*,}")
}

# Folders, and files of an ending.
_gloam_files() {
  local filter=()
  [[ -n $1 ]] && filter=(-X "!*$1")
  compopt -o filenames 2>/dev/null
  mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -d -- "$cur"; compgen -f "${filter[@]}" -- "$cur" | while IFS= read -r file; do
    [[ -d $file ]] || printf '%s\n' "$file"; done)
}

)bash";

constexpr const char* main_function = R"bash(_gloam() {
  local words=("${COMP_WORDS[@]}") at=$COMP_CWORD
  # A technique for a command is `run` with it.
  if ((at > 1)) && [[ " $_gloam_techniques " == *" ${words[1]} "* ]]; then
    words=("${words[0]}" run "${words[@]:1}")
    ((++at))
  fi
  local cur=${words[at]} previous=${words[at-1]} command=${words[1]}
  COMPREPLY=()
  # bash takes --flag=value for three words.
  if [[ $cur == '=' ]]; then
    cur=
  elif [[ $previous == '=' ]] && ((at > 2)); then
    previous=${words[at-2]}
  fi
  if ((at == 1)); then
    _gloam_words "$_gloam_commands $_gloam_techniques help --help --help-all --version"
    return
  fi
  if [[ $command == help ]]; then
    _gloam_words "$_gloam_commands $_gloam_techniques"
    return
  fi
  if [[ $previous == -* && " $(_gloam_switches "$command") " != *" $previous "* ]]; then
    _gloam_value "$command:$previous"
    return
  fi
  local i arguments=0 parameters=
  for ((i = 2; i < at; ++i)); do
    local word=${words[i]}
    if [[ $word == -* ]]; then
      [[ " $(_gloam_switches "$command") " == *" $word "* ]] || ((++i))
      [[ ${words[i]} == '=' ]] && ((++i))
    else
      parameters+=" $(_gloam_parameters "$command:$word")"
      ((++arguments))
    fi
  done
  if [[ $cur == -* ]]; then
    _gloam_words "$(_gloam_flags "$command") $parameters"
  else
    _gloam_argument "$command:$arguments"
  fi
}
complete -F _gloam gloam
)bash";

}  // namespace

std::string bash_completion(const CompletedWords& first) {
  const std::vector<CompletedCommand>& commands = first.commands;
  std::vector<std::string> names;
  for (const CompletedCommand& command : commands) names.push_back(command.name);
  return fmt::format(
             "# bash completion for gloam, written by `gloam completion bash`.\n"
             "_gloam_commands='{}'\n"
             "_gloam_techniques='{}'\n\n",
             joined(names), joined(first.techniques)) +
         helpers + flag_cases(commands) + "_gloam_value() {\n  case $1 in\n" + value_cases(commands) + "  esac\n}\n\n" +
         "_gloam_argument() {\n  case $1 in\n" + argument_cases(commands) + "  esac\n}\n\n" + main_function;
}

}  // namespace gloam::cli
