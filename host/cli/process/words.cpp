#include "cli/process/words.h"

#include <filesystem>

#include "base/command_line.h"
#include "cli/help/commands.h"
#include "cli/list/techniques.h"
#include "gloam/error.h"
#include "gloam/frame_pattern.h"
#include "technique/default_technique.h"

namespace gloam::cli {
namespace {

/// `what`: the technique that was given in the frame's place, or "ao".
std::string order_in_words(const std::string& command, const std::string& frame, const std::string& what) {
  return fmt::format("{}: '{}' is a frame, and what is computed comes first: gloam {} {} {}", command, frame, command,
                     what, quoted_for_shell(frame));
}

/// The first example of the command's help, or that with the technique that was given.
std::string example_of(const CLI::App& command) {
  const std::string name = command.get_name();
  for (const CLI::Option* place : command.get_options([](const CLI::Option* o) { return o->get_positional(); }))
    if (place->count() > 0 && (name == "run" || name == "plan") && names_technique(place->results().front()))
      return fmt::format("gloam {}{} frame.exr", name == "run" ? "" : "plan ", place->results().front());
  const std::string footer = command.get_footer();
  const size_t start = footer.find("  gloam ");
  if (start == std::string::npos) return "";
  const std::string line = footer.substr(start + 2, footer.find('\n', start) - start - 2);
  return line.substr(0, line.find("  "));  // what follows says what it does
}

}  // namespace

bool names_technique(const std::string& word) {
  if (contains(technique_names(), word)) return true;
  const std::string made_by = technique_for(word);
  return made_by != word && contains(outputs_of(find_technique(made_by)), word);
}

bool names_frame(const std::string& word) {
  std::error_code failed;
  const std::filesystem::path path(word);
  return path.extension() == ".exr" || FramePattern::is_pattern(word) || std::filesystem::is_regular_file(path, failed);
}

std::vector<std::string> completed_words(std::vector<std::string> words) {
  if (words.empty()) return words;
  if (words.front() == "help") {
    while (!words.empty() && words.front() == "help") words.erase(words.begin());
    words.push_back("--help");
  }
  if (names_technique(words.front())) words.insert(words.begin(), "run");
  return words;
}

std::string meant_by_first_word(const std::string& word) {
  if (names_frame(word))
    return fmt::format(
        "'{}' is a file, and a command comes first: gloam ao {} computes ambient occlusion, gloam info {} tells what "
        "it holds",
        word, quoted_for_shell(word), quoted_for_shell(word));
  if (word.starts_with("-"))
    return fmt::format("no flag '{}'{} (gloam --help)", word, suggestion(word, {"--help", "--version"}));
  std::vector<std::string> names = command_names();
  const std::string commands = enumerate(names);
  names.insert(names.end(), {"ao", "help"});
  for (const std::string& name : technique_names()) names.push_back(name);
  return fmt::format(
      "no command '{}'{}; there are {}, and each technique is one too: gloam ao frame.exr (gloam --help)", word,
      suggestion(word, names), commands);
}

std::string meant_without_technique(const CLI::App& command) {
  const std::string name = command.get_name();
  if (name != "run" && name != "plan") return "";
  const std::vector<const CLI::Option*> places =
      command.get_options([](const CLI::Option* o) { return o->get_positional(); });
  if (places.size() < 2 || places[0]->count() != 1 || places[1]->count() != 0) return "";
  const std::string frame = places[0]->results().front();
  if (!names_frame(frame) || names_technique(frame)) return "";
  return order_in_words(name, frame, "ao");
}

std::string lacking_in_words(const CLI::App& command, const std::string& name) {
  const auto lacking = command.get_options([](const CLI::Option* o) { return o->get_required() && o->count() == 0; });
  if (lacking.empty()) return "";
  const CLI::Option& first = *lacking.front();
  const std::string what = (first.get_positional() ? "" : first.get_name() + " ") + first.get_type_name();
  const std::string example = example_of(command);
  return fmt::format("{}: {} is missing ({}){}", name, what, first.get_description(),
                     example.empty() ? "" : "; give it as in: " + example);
}

std::string repeated_in_words(const CLI::App& command, const std::string& name) {
  const auto repeated = command.get_options([](const CLI::Option* o) {
    return o->get_multi_option_policy() == CLI::MultiOptionPolicy::Throw && o->nonpositional() &&
           int(o->count()) > o->get_items_expected_max();
  });
  if (repeated.empty()) return "";
  return fmt::format("{}: {} is given {} times ({}); give it once", name, repeated.front()->get_name(),
                     repeated.front()->count(), fmt::join(repeated.front()->results(), ", "));
}

void check_order(const std::string& command, const std::string& technique, const std::string& frame) {
  if (names_technique(technique) || !names_frame(technique)) return;
  throw UsageError("{}", order_in_words(command, technique, names_technique(frame) ? frame : "ao"));
}

}  // namespace gloam::cli
