#include "cli/completion/completion.h"

#include <algorithm>
#include <memory>

#include "base/lists.h"
#include "cli/flags/options.h"
#include "cli/help/commands.h"
#include "cli/process/words.h"
#include "gloam/error.h"
#include "gloam/planes.h"
#include "gloam/scene/scene.h"
#include "technique/default_technique.h"

namespace gloam::cli {
namespace {

using Words = std::vector<std::string>;

Words scene_names() {
  Words names;
  for (const SceneRecipe& recipe : builtin_scenes()) names.push_back(recipe.name);
  return names;
}

Words shot_names() {
  Words names;
  for (const SceneRecipe& recipe : builtin_scenes()) {
    for (const ShotRecipe& shot : recipe.shots) add_new(names, shot.name);
  }
  return names;
}

Words preset_names() {
  Words names;
  for (const Technique& technique : registry()) {
    for (const Preset& preset : technique.presets) add_new(names, preset.name);
  }
  return names;
}

Words extra_names() {
  Words names;
  for (const Technique& technique : registry()) {
    for (const std::string& extra : technique.extras) add_new(names, extra);
  }
  return names;
}

Words planes_and_techniques() {
  Words names = technique_names();
  for (const PlaneKind& kind : plane_kinds()) add_new(names, kind.name);
  return names;
}

/// Techniques, and the planes that stand for their default technique: "ao".
Words technique_words() {
  Words names = technique_names();
  for (const PlaneKind& kind : plane_kinds())
    if (names_technique(kind.name)) add_new(names, kind.name);
  return names;
}

Words with(Words words, const std::string& word) {
  words.push_back(word);
  return words;
}

/// Words of the registry for a value of this name in any command; empty for other names.
Words words_for(const std::string& command, const std::string& name) {
  if (command == "stress" && name == "technique") return with(technique_names(), "all");
  if (name == "technique") return technique_words();
  if (name == "outputs" && command == "plan") return planes_and_techniques();
  if (name == "--techniques" || name == "--elsewhere") return technique_names();
  if (name == "--filter" || name == "--falloff") return with(technique_names(), "none");
  if (name == "--only") return planes_and_techniques();
  if (name == "--preset" || name == "--presets" || name == "--adaptive") return preset_names();
  if (name == "--with") return extra_names();
  if (name == "--shot" || name == "--sequence") return shot_names();
  if (name == "scene" || name == "--scene" || name == "--scenes") return scene_names();
  return {};
}

Words split(const std::string& text, char separator) {
  Words parts;
  size_t begin = 0;
  for (size_t end; (end = text.find(separator, begin)) != std::string::npos; begin = end + 1)
    parts.push_back(text.substr(begin, end - begin));
  parts.push_back(text.substr(begin));
  return parts;
}

/// A type such as "full|half|quarter" (typed.h), "none|NAME", "OUT.exr" or "FILE|-" tells words and files by itself.
void add_from_type(const std::string& type, Completion& value) {
  const Words parts = split(type, '|');
  for (const std::string& part : parts) {
    const bool is_word =
        parts.size() > 1 && std::none_of(part.begin(), part.end(), [](char c) { return c >= 'A' && c <= 'Z'; });
    const size_t dot = part.rfind('.');
    if (is_word) {
      add_new(value.words, part);
    } else if (dot != std::string::npos) {
      value.has_files = true;
      value.ending = part.substr(dot);
    } else if (contains(Words{"FILE", "DIR", "JSON", "SCENE"}, part)) {
      value.has_files = true;
    }
  }
  value.is_list = type.find("A,B") != std::string::npos || type.find("[,") != std::string::npos;
}

std::string name_of(const CLI::Option& option) {
  const bool is_long = !option.get_positional() && !option.get_lnames().empty();
  return is_long ? "--" + option.get_lnames().front() : option.get_single_name();
}

Completion completion_of(const CLI::App& command, const CLI::Option& option) {
  Completion value;
  value.words = words_for(command.get_name(), name_of(option));
  add_from_type(option.get_type_name(), value);
  return value;
}

/// Help up to the first semicolon or bracket, cut to fit on a terminal's line beside a flag.
std::string short_help(const std::string& help) {
  constexpr size_t longest = 90;
  std::string text = help.substr(0, help.find_first_of(";([\n"));
  if (text.size() > longest) text = text.substr(0, text.rfind(' ', longest));
  while (!text.empty() && (text.back() == ' ' || text.back() == ':')) text.pop_back();
  return text;
}

CompletedFlag flag_of(const CLI::App& command, const CLI::Option& option) {
  CompletedFlag flag;
  for (const std::string& name : option.get_snames()) flag.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) flag.names.push_back("--" + name);
  flag.help = short_help(option.get_description());
  if (option.get_items_expected_max() == 0) return flag;
  flag.type = option.get_type_name().empty() ? "VALUE" : option.get_type_name();
  flag.value = completion_of(command, option);
  return flag;
}

std::vector<CompletedFlag> flags_of(const ParameterList& parameters, const std::set<std::string>& settable) {
  std::vector<CompletedFlag> flags;
  for (const Parameter& p : parameters) {
    if (!settable.count(p.name)) continue;
    CompletedFlag flag{{"--" + p.name}, short_help(p.help), type_name(p), {}};
    std::replace(flag.names.front().begin(), flag.names.front().end(), '_', '-');
    flag.value.words = p.choices;
    if (p.type == Parameter::Type::boolean) flag.value.words = {"on", "off"};
    flags.push_back(flag);
  }
  return flags;
}

CompletedCommand completed(const CLI::App& command, const std::set<std::string>& settable) {
  CompletedCommand result{command.get_name(), short_help(command.get_description()), {}, {}, {}};
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_positional())
      result.arguments.push_back({option->get_single_name(), completion_of(command, *option)});
    else
      result.flags.push_back(flag_of(command, *option));
  }
  if (settable.empty()) return result;
  const auto add = [&](const std::string& name, const ParameterList& parameters) {
    std::vector<CompletedFlag> flags = flags_of(parameters, settable);
    if (!flags.empty()) result.parameters.emplace_back(name, std::move(flags));
  };
  const bool of_scenes = contains(Words{"capture", "reference"}, command.get_name());
  for (const std::string& word : of_scenes ? Words() : technique_words())
    add(word, find_technique(technique_for(word)).parameters);
  for (const SceneRecipe& recipe : builtin_scenes()) {
    if (of_scenes) add(recipe.name, recipe.parameters);
  }
  return result;
}

}  // namespace

void add_completion(CLI::App& app, ParameterFlags parameter_flags) {
  using Writer = std::string (*)(const CompletedWords&);
  auto writer = std::make_shared<Writer>();
  CLI::App* command = app.add_subcommand("completion", "what a shell completes, as a script for that shell");
  command->group("");  // not shown
  add_choice<Writer>(*command, "shell", *writer, {{"bash", bash_completion}, {"zsh", zsh_completion}}, "which shell")
      ->required();
  command->footer(
      "Examples:\n"
      "  source <(gloam completion bash)\n"
      "  gloam completion zsh > ~/.zfunc/_gloam");
  command->callback([&app, writer, parameter_flags] {
    CompletedWords first{{}, technique_words()};
    for (const std::string& name : command_names())
      first.commands.push_back(completed(*app.get_subcommand(name), parameter_flags(app.get_subcommand(name))));
    fmt::print("{}", (*writer)(first));
  });
}

}  // namespace gloam::cli
