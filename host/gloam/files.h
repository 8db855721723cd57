// Output files that exist whole or not at all.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace gloam {

/// Calls `write(temporary)` with a path in the folder of `path`, then renames it to `path`. On any error, and on
/// SIGHUP, SIGINT or SIGTERM, the temporary file is removed and `path` is left as it was. Throws Error naming `path`.
void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path&)>& write);

/// Why no file can be written under a name, whatever its contents: it is a folder, a device or a pipe; else empty. For
/// telling before anything is computed.
std::string why_unwritable(const std::filesystem::path& path);

/// Installs handlers for SIGHUP, SIGINT and SIGTERM that remove a temporary file in the making, say in one line that
/// the command was interrupted and how many files were written since this call, and leave with status 128 + signal. A signal
/// that is ignored (nohup) stays so. SIGXFSZ is ignored: a file over the limit becomes an ordinary error.
void remove_temporaries_on_signal();

/// From now on an interruption says this instead of the number of files written. `text` must live as long as the program.
void say_on_interruption(const char* text);

/// A whole file, by `write_atomically`.
void write_text(const std::filesystem::path& path, const std::string& text);

/// A whole text file. Throws Error naming it.
std::string read_text(const std::filesystem::path& path);

}  // namespace gloam
