// Output files that exist whole or not at all.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace gloam {

/// A file that is being written and is not seen under its own name yet.
class NewFile {
 public:
  explicit NewFile(int descriptor) : descriptor_(descriptor) {}
  /// Throws Error with the cause alone, which `write_atomically` completes.
  void append(std::string_view bytes);
  /// Open for writing; stays the file's.
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

/// Has `write` fill a new file in the folder of `path`, brings it to the disk, and then renames it to `path`. The new file has a
/// random name, made exclusively, so that no other process has it, on no machine that shares the folder. It gets the
/// permissions of the file that it replaces. A symbolic link is written through, also one whose target is missing. On any error,
/// and on SIGHUP, SIGINT or SIGTERM, the new file is removed and `path` is left as it was. Throws Error naming `path`.
void write_atomically(const std::filesystem::path& path, const std::function<void(NewFile&)>& write);

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

/// Throws Error naming what can be opened and is no file that ends: a folder, a device, or a pipe, which would wait for its
/// other end. Nothing where there is nothing.
void check_regular(const std::filesystem::path& path);

/// A whole text file. Throws Error naming it.
std::string read_text(const std::filesystem::path& path);

}  // namespace gloam
