// Output files that exist whole or not at all.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "gloam/error.h"

namespace gloam {

/// A file that is being written, under a temporary name.
class NewFile {
 public:
  explicit NewFile(int descriptor) : descriptor_(descriptor) {}
  /// Throws Error with the cause only; `write_atomically` adds the path.
  void append(std::string_view bytes);
  /// Open for writing; owned by this object.
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

/// Whose file it is: one for the user is written through to the disk, and counts among the files that an interrupted command tells of;
/// one of a cache is neither.
enum class FileFor { user, cache };

/// Calls `write` on a new file in the folder of `path`, writes it to the disk, and renames it to `path`. The new file has a random
/// name, created exclusively, so that no other process has it, on any machine that shares the folder. It gets the permissions of
/// the file that it replaces. A symbolic link is written through, even if its target is missing. On any error, and on SIGHUP,
/// SIGINT or SIGTERM, the new file is removed and `path` is left as it was. Throws Error naming `path`.
void write_atomically(const std::filesystem::path& path, const std::function<void(NewFile&)>& write,
                      FileFor file_for = FileFor::user);

/// Removes files that `write_atomically` left in a folder when its process was killed, and returns their number. Those of running
/// processes are locked and stay; on a network file system also those of other machines.
int remove_leftovers(const std::filesystem::path& folder);

/// Whether `write_atomically` failed because the disk is full, a quota is used up, or a file would be larger than files may be.
bool is_lack_of_space(const Error& error);

/// The reason why no file can be written under a name: it is a folder, a device or a pipe; else empty. For a check before anything
/// is computed.
std::string why_unwritable(const std::filesystem::path& path);

/// Installs handlers for SIGHUP, SIGINT and SIGTERM that remove the temporary file, print one line (that the command was
/// interrupted, and how many files were written since this call), and exit with status 128 + signal. A signal that is ignored
/// (nohup) stays ignored. SIGXFSZ is ignored: a file over the size limit becomes an ordinary error.
void remove_temporaries_on_signal();

/// Replaces the number of files written in that line by a text, from now on. `text` must live as long as the program.
void say_on_interruption(const char* text);

/// That handler also calls a function, of system calls alone.
void call_on_signal(void (*function)());

/// That handler also kills this group of processes; 0: none. Groups of children do not get a terminal's Ctrl-C.
void kill_group_on_signal(int group);

/// Writes a whole file by `write_atomically`.
void write_text(const std::filesystem::path& path, const std::string& text);

/// Throws Error naming a path that can be opened but is not a file with an end: a folder, a device, or a pipe, which would wait
/// for its other end. Does nothing for a missing file.
void check_regular(const std::filesystem::path& path);

/// Reads a whole text file. Throws Error naming it.
std::string read_text(const std::filesystem::path& path);

}  // namespace gloam
