#include "run/kernel_cache.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <vector>

#include "base/files.h"
#include "base/hash.h"
#include "gloam/error.h"
#include "run/driver.h"
#include "run/kept_folders.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;

constexpr const char *magic = "gloam compiled kernel 1\n", *ending = ".kernel";
constexpr std::uintmax_t most_bytes = 256u << 20;  ///< of all files; the oldest go

std::atomic<int> damaged = 0;

/// Two hashes of 64 bits: no two keys of a folder have both in common.
std::string digest_of(const std::string& text) {
  return fmt::format("{:016x}{:016x}", hash_of(text), hash_of(text, hash_of("gloam")));
}

/// What a file begins with: the key's digest and the program's, one line each.
std::string header_of(const std::string& key_digest, const std::string& program) {
  return fmt::format("{}{}\n{}\n", magic, key_digest, digest_of(program));
}

/// The program in a file's bytes, if they are whole and are this key's.
std::optional<std::string> program_in(const std::string& bytes, const std::string& key_digest) {
  const size_t length = header_of(key_digest, "").size();
  if (bytes.size() <= length) return {};
  std::string program = bytes.substr(length);
  if (bytes.compare(0, length, header_of(key_digest, program)) != 0) return {};
  return program;
}

void remove_damaged(const fs::path& path) {
  std::error_code ignored;
  fs::remove(path, ignored);
  ++damaged;
}

std::vector<fs::directory_entry> entries_of(const fs::path& folder) {
  std::vector<fs::directory_entry> all;
  std::error_code failed;
  for (fs::directory_iterator at(folder, failed), end; !failed && at != end; at.increment(failed)) {
    if (at->path().extension() == ending) all.push_back(*at);
  }
  return all;
}

/// Removes what killed processes left half written, and the oldest files until the others take no more than `most_bytes`.
void prune(const fs::path& folder) {
  remove_leftovers(folder);
  struct File {
    fs::file_time_type written;
    std::uintmax_t bytes;
    fs::path path;
  };
  std::vector<File> files;
  std::uintmax_t sum = 0;
  std::error_code failed;
  for (const fs::directory_entry& entry : entries_of(folder)) {
    files.push_back({entry.last_write_time(failed), entry.file_size(failed), entry.path()});
    sum += failed ? 0 : files.back().bytes;
  }
  std::sort(files.begin(), files.end(), [](const File& a, const File& b) { return a.written < b.written; });
  for (size_t i = 0; i < files.size() && sum > most_bytes; ++i) {
    sum -= std::min(sum, files[i].bytes);
    fs::remove(files[i].path, failed);
  }
}

}  // namespace

fs::path KernelCache::path_of(const std::string& key) const { return folder_ / (digest_of(key) + ending); }

std::optional<std::string> KernelCache::find(const std::string& key) const {
  if (folder_.empty()) return {};
  const std::optional<std::string> bytes = kept_text(path_of(key));
  if (!bytes) return {};
  std::optional<std::string> program = program_in(*bytes, digest_of(key));
  if (!program) remove_damaged(path_of(key));
  return program;
}

void KernelCache::keep(const std::string& key, const std::string& program) const {
  if (folder_.empty() || program.empty()) return;
  std::error_code failed;
  fs::create_directories(folder_, failed);
  try {
    const auto write = [&](NewFile& file) {
      file.append(header_of(digest_of(key), program));
      file.append(program);
    };
    make_way(path_of(key));
    write_atomically(path_of(key), write, FileFor::cache);
  } catch (const Error&) {
    return;
  }
  static std::once_flag once;
  std::call_once(once, [this] { prune(folder_); });
}

void KernelCache::remove(const std::string& key) const { remove_damaged(path_of(key)); }

KernelCache::Check KernelCache::check() const {
  Check result;
  if (folder_.empty()) return result;
  for (const fs::directory_entry& entry : entries_of(folder_)) {
    const std::optional<std::string> bytes = kept_text(entry.path());
    if (bytes && program_in(*bytes, entry.path().stem().string())) {
      ++result.kept;
    } else {
      ++result.damaged;
      remove_damaged(entry.path());
    }
  }
  return result;
}

KernelCache own_kernel_cache() {
  const fs::path& folder = cache_folder().folder;
  return KernelCache(folder.empty() ? folder : folder / "kernels");
}

bool keeps_no_kernels_yet(const DeviceInfo& device) {
  if (device.platform == "Portable Computing Language") return pocl_keeps_nothing();
  return !device.keeps_kernels && entries_of(own_kernel_cache().folder()).empty();
}

std::string damaged_kernels_note() {
  const int count = damaged.load();
  if (count == 0) return "";
  return fmt::format("{} compiled {} in gloam's cache folder {} damaged, and {} compiled anew", count,
                     count == 1 ? "kernel" : "kernels", count == 1 ? "was" : "were", count == 1 ? "was" : "were");
}

}  // namespace gloam
