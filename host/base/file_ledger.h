// Which files a command reads and which it writes. No file is both, none is written for two purposes, and nothing is written before
// that is known: what reads a file and what writes one tells the ledger, in whatever order, and the ledger compares (file_identity.h).
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace gloam {

/// Begins the ledger of this process: for a program that runs one command. Without it, in other programs and in Python, nothing
/// below does anything.
void begin_file_ledger();
bool has_file_ledger();

/// A file that is opened to be read. Every function that opens a file of the user calls it. Throws UsageError if the file is an output
/// that is not written yet.
void opens_file(const std::filesystem::path& path);

/// A file that a command reads, by what it is for the user: "the frame", "--camera". Said before the file is opened, where its name is
/// known. An empty path is ignored. Throws as `opens_file`.
void reads_file(const std::filesystem::path& path, const std::string& what);

/// Names that are inputs although no file need be there yet, such as those of a shot's frames: `what` says what a name is ("frame 4 of
/// shot.####.exr"), or nothing.
void reads_names(std::function<std::string(const std::filesystem::path&)> what);

/// Whether an output is a result, which is written once, or a file that the command goes on from, such as bench.json: that one
/// may be read before and is written as often as it grows.
enum class OutputUse { result, grows };

/// A file that a command will write, by its flag. An empty path is ignored. The same flag and path may be said again. Throws
/// UsageError if the file is one that is read, or is written for another flag.
void writes_file(const std::string& flag, const std::filesystem::path& path, OutputUse use = OutputUse::result);

/// The last line of defence, for what writes files: throws UsageError if the file was read, if it is a result that is written
/// already, and if anything that the ledger was told before did not fit, whatever became of that error.
void check_before_writing(const std::filesystem::path& path);
/// The file is written: from now on it is the command's own, and may be read.
void has_written(const std::filesystem::path& path);

/// While it lives, files that this thread opens are no inputs: they are looked at for what an earlier run left in them, or for whether
/// they are of use at all.
class LooksAtFiles {
 public:
  LooksAtFiles();
  ~LooksAtFiles();
  LooksAtFiles(const LooksAtFiles&) = delete;
  LooksAtFiles& operator=(const LooksAtFiles&) = delete;
};

}  // namespace gloam
