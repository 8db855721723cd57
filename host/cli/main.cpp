// The command `gloam`: parses, runs one subcommand, turns every error into one line and an exit status.
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <new>
#include <set>

#include "base/file_ledger.h"
#include "base/files.h"
#include "base/json_text.h"
#include "cli/completion/completion.h"
#include "cli/flags/options.h"
#include "cli/help/commands.h"
#include "cli/help/formatter.h"
#include "cli/list/techniques.h"
#include "cli/process/same_mathematics.h"
#include "cli/process/words.h"
#include "gloam/error.h"
#include "gloam/option.h"
#include "gloam/scene/scene.h"
#include "run/driver.h"
#include "run/kernel_cache.h"
#include "technique/default_technique.h"

namespace gloam::cli {
namespace {

/// Parameters that --set of a command accepts: those of techniques, or of built-in scenes.
std::set<std::string> settable_by(const CLI::App* command_line) {
  std::set<std::string> names;
  if (!command_line) return names;
  const std::string command = command_line->get_name();
  // If a command has a flag of that name, only --set sets the parameter.
  const auto add = [&](const ParameterList& parameters) {
    for (const Parameter& p : parameters) {
      if (!command_line->get_option_no_throw("--" + p.name)) names.insert(p.name);
    }
  };
  if (command == "run" || command == "plan" || command == "auto") {
    for (const Technique& t : registry()) add(t.parameters);
  }
  if (command == "capture" || command == "reference") {
    for (const SceneRecipe& r : builtin_scenes()) add(r.parameters);
  }
  return names;
}

/// The command that the words begin with; null if they begin with none.
const CLI::App* command_of(CLI::App& app, const std::vector<std::string>& words) {
  const std::vector<CLI::App*> found =
      app.get_subcommands([&](const CLI::App* command) { return !words.empty() && command->get_name() == words[0]; });
  return found.empty() ? nullptr : found.front();
}

/// Throws UsageError for a switch with a value, such as --quick=5, which would mean --quick.
void check_switch(const CLI::App* command, const std::string& argument) {
  const size_t equals = argument.find('=');
  if (!command || argument.rfind("--", 0) != 0 || equals == std::string::npos) return;
  const std::string flag = argument.substr(0, equals);
  const CLI::Option* option = command->get_option_no_throw(flag);
  if (option && option->get_items_expected_max() == 0)
    throw UsageError("{} is not allowed: {} takes no value; write {}, or leave it out", argument, flag, flag);
}

/// The name of the parameter that --normal-tolerance=0.5 sets; empty for a word that is no long flag.
std::string parameter_of(const std::string& word) {
  std::string name = word.rfind("--", 0) == 0 ? word.substr(0, word.find('=')).substr(2) : "";
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

/// Throws UsageError for a flag whose value was forgotten, such as --into -o ao.exr, where -o would be the value.
void check_value(const CLI::App* command, const std::set<std::string>& parameters, const std::string& flag,
                 const std::string& next) {
  if (!command || !flag.starts_with("-") || flag.find('=') != std::string::npos || !next.starts_with("-")) return;
  const CLI::Option* option = command->get_option_no_throw(flag);
  if (option ? option->get_items_expected_min() == 0 : parameters.count(parameter_of(flag)) == 0) return;
  if (command->get_option_no_throw(next.substr(0, next.find('='))) || parameters.count(parameter_of(next)) > 0)
    throw UsageError("{} needs a value{}, and the next word, {}, is a flag", flag,
                     option ? ", " + option->get_type_name() : "", next);
}

/// Every parameter is a flag: --normal-tolerance 0.5 becomes --set normal_tolerance=0.5.
std::vector<std::string> with_parameter_flags(CLI::App& app, const std::vector<std::string>& words) {
  const CLI::App* const command = command_of(app, words);
  const std::set<std::string> names = settable_by(command);
  std::vector<std::string> arguments;
  for (size_t i = 0; i < words.size(); ++i) {
    const std::string& argument = words[i];
    check_switch(command, argument);
    const size_t equals = argument.find('=');
    const std::string name = parameter_of(argument);
    if (i + 1 < words.size()) check_value(command, names, argument, words[i + 1]);
    if (name.empty() || names.count(name) == 0) {
      arguments.push_back(argument);
      continue;
    }
    arguments.push_back("--set");
    if (equals != std::string::npos) {
      arguments.push_back(name + argument.substr(equals));
    } else if (i + 1 < words.size()) {
      arguments.push_back(name + "=" + words[++i]);
    } else {
      throw UsageError("{} needs a value", argument);
    }
  }
  std::reverse(arguments.begin(), arguments.end());  // as CLI11 takes them
  return arguments;
}

/// The words of the command line. Throws UsageError for an empty one.
std::vector<std::string> words_of(int argc, char** argv) {
  const std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  for (size_t i = 0; i < words.size(); ++i) {
    // Most likely from an unset shell variable.
    if (words[i].empty())
      throw UsageError("argument {} is empty{}; give it a value or leave it out", i + 1,
                       i > 0 ? fmt::format(" (after '{}')", words[i - 1]) : "");
  }
  return words;
}

std::vector<std::string> flag_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  for (const std::string& name : settable_by(&command)) names.push_back("--" + name);
  return names;
}

/// The error in the command line, in one line, which begins with the command as it was typed: `gloam ao` is `gloam run ao`.
std::string usage_message(CLI::App& app, const CLI::ParseError& error, const std::vector<std::string>& typed) {
  const std::vector<CLI::App*> parsed = app.get_subcommands();
  const bool is_technique = !parsed.empty() && !typed.empty() && names_technique(typed.front());
  const std::string command = parsed.empty() ? "" : is_technique ? typed.front() : parsed.front()->get_name();
  const std::string help = fmt::format("(gloam {}{}--help)", command, command.empty() ? "" : " ");
  const std::vector<std::string> extras = app.remaining(true);
  if (command.empty() && !extras.empty()) return meant_by_first_word(extras.front());
  if (!command.empty())
    if (const std::string meant = meant_without_technique(*parsed.front()); !meant.empty()) return meant;
  if (!extras.empty()) {
    const std::string& extra = extras.front();
    const bool is_flag = extra.rfind("-", 0) == 0;
    return fmt::format("{}: {} '{}'{} {}", command, is_flag ? "no flag" : "one argument too many:", extra,
                       is_flag ? suggestion(extra.substr(0, extra.find('=')), flag_names(*parsed.front())) : "", help);
  }
  std::string message;
  if (!command.empty()) message = repeated_in_words(*parsed.front(), command);
  if (!command.empty() && message.empty()) message = lacking_in_words(*parsed.front(), command);
  if (!message.empty()) return fmt::format("{} {}", message, help);
  message = error.what();
  std::replace(message.begin(), message.end(), '\n', ' ');
  return fmt::format("{}{}{} {}", command, command.empty() ? "" : ": ", message, help);
}

/// `settable`: those that are flags.
void print_parameters(const std::string& owner, const ParameterList& parameters,
                      const std::set<std::string>& settable) {
  if (parameters.empty()) return;
  const ParameterValues initial(parameters);
  std::vector<std::vector<std::string>> rows;
  for (const Parameter& p : parameters) {
    rows.push_back({(settable.count(p.name) ? "  --" : "  --set ") + p.name, initial.text(p.name),
                    "(" + allowed_values(p) + ")", p.help});
  }
  fmt::print("Parameters of {}:\n", owner);
  print_table(rows, 4);
  fmt::print("\n");
}

/// `gloam hbao+ --help` and `gloam capture statue --help` begin with what these are, and their parameters.
void print_parameters_of(CLI::App& app, const std::vector<std::string>& words) {
  const std::set<std::string> settable = settable_by(command_of(app, words));
  for (const std::string& word : words) {
    const std::vector<std::string> names = technique_names();
    const std::string name = technique_for(word);
    if (contains(names, name)) {
      print_technique(find_technique(name), settable);
      fmt::print("\n");
    }
    if (const SceneRecipe* recipe = find_builtin_scene(word))
      print_parameters(recipe->name, recipe->parameters, settable);
  }
}

/// Whether a flag was given, among any other arguments.
bool asks_for(const CLI::App& app, const std::string& flag) {
  for (const CLI::App* command : app.get_subcommands())
    if (command->get_option(flag)->count() > 0) return true;
  return app.get_option(flag)->count() > 0;
}

/// `gloam help --only`, and `gloam help lanes`. Throws UsageError for a word that is nothing, with what was probably meant.
int print_help_of_word(CLI::App& app, const std::string& word) {
  const std::string help = help_of_flag(app, word.starts_with("-") ? word : "--" + word);
  if (help.empty()) throw UsageError("{}", meant_by_first_word(word));
  fmt::print("{}", help);
  return 0;
}

/// --help, --help-all or --version, with `words` on the command line.
int show(CLI::App& app, const CLI::Success& what, const std::vector<std::string>& words) {
  const bool has_command = !app.get_subcommands().empty();
  if (!has_command && !app.get_option_no_throw(words.front())) return print_help_of_word(app, words.front());
  const bool is_all = what.get_name() == CLI::CallForAllHelp().get_name();
  if (is_all && !has_command) {
    fmt::print("{}{}", app.help(), help_of_all_commands(app));
    return 0;
  }
  print_parameters_of(app, words);
  std::fflush(stdout);  // CLI11 writes to std::cout
  return app.exit(what);
}

int run_command(int argc, char** argv) {
  CLI::App app{
      "gloam: ambient occlusion and other image-space effects on captured G-buffers, and how near to truth they are."};
  app.footer(
      "Examples:\n"
      "  gloam ao frame.exr\n"
      "  gloam run ao frame.exr -o ao.exr --radius 0.3\n"
      "  gloam info frame.exr\n"
      "  gloam compare ao.exr truth.exr -o difference.png\n"
      "  gloam capture colonnade -o frame.exr --size 960x540\n"
      "  gloam reference ao frame.exr -o truth.exr --radius 0.5\n"
      "  gloam bench -o out/bench --frame frame.exr --truth truth.exr\n"
      "  gloam report out/bench\n"
      "  gloam view frame.exr ao.exr\n"
      "  gloam set make gloam-1\n"
      "  gloam stress hbao+\n"
      "gloam COMMAND --help shows the flags of a command, --help-all all of them where there are many, and gloam help "
      "WORD tells\n"
      "of a flag or a technique. Every technique is a command too: gloam ao frame.exr is gloam run ao frame.exr -o "
      "frame_ao.exr.");
  app.formatter(std::make_shared<HelpFormatter>());
  app.set_help_flag("-h,--help", "this help");
  app.set_help_all_flag("--help-all", "this help with all flags, also those that few need");
  app.set_version_flag("-V,--version", "gloam " GLOAM_VERSION, "the version");
  app.require_subcommand(1);
  app.name("gloam");
  add_commands(app);
  add_completion(app, settable_by);
  for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; })) add_quiet_flag(*command);
  const std::vector<std::string> typed = words_of(argc, argv), words = completed_words(typed);
  // Prints help for a person who looks for the commands. The exit status is that of wrong usage, as git's is not 0 either: a script
  // whose command is empty by mistake must fail.
  if (words.empty()) {
    fmt::print("{}", app.help());
    return UsageError("").exit_status();
  }
  try {
    app.parse(with_parameter_flags(app, words));
  } catch (const CLI::Success& success) {
    return show(app, success, words);
  } catch (const UsageError&) {  // a value that is not allowed
    if (asks_for(app, "--help-all")) return show(app, CLI::CallForAllHelp(), words);
    if (!asks_for(app, "--help")) throw;
    return show(app, CLI::CallForHelp(), words);
  } catch (const CLI::ParseError& error) {
    throw UsageError("{}", usage_message(app, error, typed));
  }
  return 0;
}

}  // namespace
}  // namespace gloam::cli

/// Prints a message as one line on standard error. A closed standard error is no further error.
static int failed(const char* message, int status) {
  if (isatty(STDERR_FILENO)) std::fputs("\r\033[K", stderr);  // remains of a progress bar
  std::fputs(("gloam: " + gloam::printable(message) + "\n").c_str(), stderr);
  return status;
}

/// Runs the command; turns every error into one line and an exit status.
static int status_of_command(int argc, char** argv) {
  try {
    // `stress` itself reports a driver that ends one of its children.
    if (argc > 1 && std::strcmp(argv[1], "stress") != 0) gloam::restart_where_the_driver_dies(argv);
    const int status = gloam::cli::run_command(argc, argv);
    if (const std::string kept = gloam::keep_kernels_made_anew(); !kept.empty()) gloam::cli::note({kept});
    if (const std::string damaged = gloam::damaged_kernels_note(); !damaged.empty()) gloam::cli::note({damaged});
    gloam::cli::print_notes();
    // Of more than a buffer the last write may succeed, or have nothing left to write, after an earlier one has failed.
    if (std::fflush(stdout) != 0 || std::ferror(stdout)) return failed("standard output: cannot be written", 1);
    return status;
  } catch (const gloam::Error& error) {
    return failed(error.what(), error.exit_status());
  } catch (const std::bad_alloc&) {
    const std::string limit = gloam::memory_limit();
    return failed(("out of memory" + (limit.empty() ? "; use a smaller frame" : limit)).c_str(), 1);
  } catch (const nlohmann::json::exception& error) {
    return failed(("a value of JSON is of another type than expected: " + gloam::reason_of(error)).c_str(), 1);
  } catch (const std::exception& error) {
    return failed(error.what(), 1);
  }
}

int main(int argc, char** argv) {
  gloam::set_caller(gloam::Caller::command);
  gloam::cli::restart_with_same_mathematics(argc, argv);
  gloam::begin_file_ledger();
  gloam::remove_temporaries_on_signal();
  gloam::give_pocl_a_folder();
  const int status = status_of_command(argc, argv);
  gloam::remove_kernels_made_anew();
  return status;
}
