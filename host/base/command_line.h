// Command lines: this one as it was given, and words as a shell takes them.
#pragma once

#include <string>
#include <vector>

namespace gloam {

/// The program's name without its folder, and its arguments; of absolute paths the last folder and the name, since files that hold a
/// command are passed on. Paths of the system (/usr, /bin, /dev) stay, since others have them, too. Empty where the system does not tell.
std::vector<std::string> command_line();

/// The same of each word of a command that is one argument: "/home/a/bin/engine {frame}" is "bin/engine {frame}".
std::string command_without_folders(const std::string& command);

/// A word as a POSIX shell reads it back: in quotes where it needs them. Always one line of printable text, whatever is in the word.
std::string quoted_for_shell(const std::string& word);

/// Words as a line for a shell.
std::string shell_line(const std::vector<std::string>& words);

}  // namespace gloam
