// `--help` and `--help-all`: what most people need first, in lines as wide as the terminal.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace gloam::cli {

class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter();
  /// `mode`: Normal is --help; All is --help-all, with every flag of a command that has many.
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
  std::string make_subcommand(const CLI::App* command) const override;
  std::string make_option(const CLI::Option* option, bool is_positional) const override;
  std::string make_group(std::string group, bool is_positional, std::vector<const CLI::Option*> options) const override;
  std::string make_footer(const CLI::App* app) const override;

 private:
  std::string first_flags(const CLI::App& command) const;
  std::string where_the_rest_is(const CLI::App& command) const;
  std::string all_flags(const CLI::App& command) const;
};

/// Every command's whole help, one after another.
std::string help_of_all_commands(CLI::App& app);

/// What commands and techniques say of a flag, such as "--only", each thing once, with those that say it; empty where none has the flag.
std::string help_of_flag(CLI::App& app, const std::string& flag);

}  // namespace gloam::cli
