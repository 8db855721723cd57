#include "base/file_ledger.h"

#include <atomic>
#include <deque>
#include <map>
#include <mutex>
#include <vector>

#include "base/file_identity.h"
#include "gloam/error.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;
using Inode = std::pair<dev_t, ino_t>;

/// What is known of one name of a file.
struct Entry {
  fs::path path;
  std::string place;
  std::optional<Inode> file;
  bool is_read = false;
  std::string read_as;  ///< for the user; empty: it was opened, and no flag names it
  bool is_output = false, is_written = false;
  std::string flag;
  OutputUse use = OutputUse::result;
};

class Ledger {
 public:
  void read(const fs::path& path, const std::string& what) {
    const std::lock_guard lock(mutex_);
    const FileIdentity identity = identity_of(path);
    for (Entry* entry : entries_of(identity)) {
      if (entry->is_written) return;  // the command's own
    }
    Entry& own = entry_at(path, identity);
    own.is_read = true;
    if (own.read_as.empty()) own.read_as = what;
    for (const Entry* entry : entries_of(identity)) {
      if (entry->is_output && !may_be(own, *entry)) refuse(*entry, in_words(own, entry->path));
    }
  }

  void read_names(std::function<std::string(const fs::path&)> what) {
    const std::lock_guard lock(mutex_);
    const LooksAtFiles looks;
    for (const Entry& entry : entries_) {
      if (!entry.is_output || entry.is_written) continue;
      if (const std::string found = what(follow_links(entry.path)); !found.empty()) refuse(entry, found);
    }
    names_.push_back(std::move(what));
  }

  void write(const std::string& flag, const fs::path& path, OutputUse use) {
    const std::lock_guard lock(mutex_);
    const FileIdentity identity = identity_of(path);
    Entry asked{path, identity.place, identity.file};
    asked.is_output = true, asked.flag = flag, asked.use = use;
    for (const Entry* entry : entries_of(identity)) {
      if (entry->is_output && entry->flag == flag && entry->path == path) return;
      if (entry->is_output) refuse(asked, entry->flag.empty() ? "a file that is written already" : entry->flag);
      if (entry->is_read && !may_be(*entry, asked)) refuse(asked, in_words(*entry, path));
    }
    check_names(asked);
    Entry& own = entry_at(path, identity);
    own.path = path, own.is_output = true, own.flag = flag, own.use = use;
  }

  void before_writing(const fs::path& path) {
    const std::lock_guard lock(mutex_);
    if (!misfit_.empty()) throw UsageError("{}", misfit_);
    const FileIdentity identity = identity_of(path);
    bool is_told = false;
    for (const Entry* entry : entries_of(identity)) {
      is_told = is_told || entry->is_output;
      if (entry->is_read && !(entry->is_output && entry->use == OutputUse::grows))
        throw UsageError("{}: is {}, and nothing is written over it; name another file", path.string(),
                         in_words(*entry, path));
      if (entry->place == identity.place && entry->is_written && entry->use == OutputUse::result &&
          !entry->flag.empty())
        throw UsageError("{}: is written already, as {}; name another file", path.string(), entry->flag);
    }
    if (is_told) return;
    Entry asked{path, identity.place, identity.file};
    check_names(asked);
  }

  void written(const fs::path& path) {
    const std::lock_guard lock(mutex_);
    const FileIdentity identity = identity_of(path);
    Entry& own = entry_at(path, identity);
    own.file = identity.file;
    if (own.file) inodes_.emplace(*own.file, &own);
    own.is_output = own.is_written = true;
  }

 private:
  /// Names at the same place, and other names of the same file. An inode is used again once its file is gone, so it counts only if
  /// the other name still leads to it.
  std::vector<Entry*> entries_of(const FileIdentity& identity) {
    std::vector<Entry*> found;
    const auto place = places_.find(identity.place);
    if (place != places_.end()) found.push_back(place->second);
    if (!identity.file) return found;
    const auto [first, last] = inodes_.equal_range(*identity.file);
    for (auto it = first; it != last; ++it) {
      Entry* entry = it->second;
      if (entry->place != identity.place && entry->file == identity.file &&
          identity_of(entry->path).file == identity.file)
        found.push_back(entry);
    }
    return found;
  }

  Entry& entry_at(const fs::path& path, const FileIdentity& identity) {
    Entry*& entry = places_[identity.place];
    if (!entry) {
      entries_.push_back({path, identity.place, identity.file});
      entry = &entries_.back();
      if (entry->file) inodes_.emplace(*entry->file, entry);
    }
    return *entry;
  }

  /// Whether one file may be both: what a command goes on from is read by itself, but is no input that a flag names.
  static bool may_be(const Entry& read, const Entry& output) {
    return output.use == OutputUse::grows && read.read_as.empty();
  }

  static std::string in_words(const Entry& read, const fs::path& output) {
    if (!read.read_as.empty()) return read.read_as;
    return read.path == output ? "a file that is read" : fmt::format("'{}', which is read", read.path.string());
  }

  void check_names(const Entry& output) {
    const LooksAtFiles looks;
    for (const auto& what : names_) {
      if (const std::string found = what(follow_links(output.path)); !found.empty()) refuse(output, found);
    }
  }

  /// Keeps the sentence: what catches the error may go on with another frame or file, and writes nothing any more.
  [[noreturn]] void refuse(const Entry& output, const std::string& also) {
    misfit_ = fmt::format("{}{}{}: is also {}; name another file", output.flag, output.flag.empty() ? "" : " ",
                          output.path.string(), also);
    throw UsageError("{}", misfit_);
  }

  std::mutex mutex_;
  std::deque<Entry> entries_;  // stay where they are
  std::map<std::string, Entry*> places_;
  std::multimap<Inode, Entry*> inodes_;
  std::vector<std::function<std::string(const fs::path&)>> names_;
  std::string misfit_;
};

std::atomic<bool> is_kept{false};
thread_local int looking = 0;

Ledger& ledger() {
  static Ledger of_process;
  return of_process;
}

}  // namespace

void begin_file_ledger() { is_kept.store(true); }

bool has_file_ledger() { return is_kept.load(); }

void opens_file(const fs::path& path) { reads_file(path, ""); }

void reads_file(const fs::path& path, const std::string& what) {
  if (is_kept.load() && looking == 0 && !path.empty()) ledger().read(path, what);
}

void reads_names(std::function<std::string(const fs::path&)> what) {
  if (is_kept.load()) ledger().read_names(std::move(what));
}

void writes_file(const std::string& flag, const fs::path& path, OutputUse use) {
  if (is_kept.load() && !path.empty()) ledger().write(flag, path, use);
}

void check_before_writing(const fs::path& path) {
  if (is_kept.load()) ledger().before_writing(path);
}

void has_written(const fs::path& path) {
  if (is_kept.load()) ledger().written(path);
}

LooksAtFiles::LooksAtFiles() { ++looking; }
LooksAtFiles::~LooksAtFiles() { --looking; }

}  // namespace gloam
