#include "base/files.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstring>
#include <utility>

#include "base/file_identity.h"
#include "base/file_ledger.h"
#include "gloam/error.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;

/// Name of a temporary file where a signal handler can read it: no allocation, no lock.
struct TemporaryName {
  std::atomic<bool> taken{false};   ///< a writer owns this slot
  std::atomic<bool> exists{false};  ///< `path` is complete and may be unlinked
  std::atomic<bool> moving{false};  ///< being renamed: the file is either still there or already under its own name
  char path[PATH_MAX];
};
static_assert(std::atomic<bool>::is_always_lock_free);
static_assert(std::atomic<unsigned>::is_always_lock_free);
std::array<TemporaryName, 16> temporaries;
std::atomic<unsigned> files_written{0};
std::atomic<bool> leaving{false};  ///< a signal handler removes the temporaries and ends the process
std::atomic<int> being_made{0};    ///< temporaries that exist and are not yet among `temporaries`

/// Does not return: for threads that go on while a signal handler ends the process.
[[noreturn]] void wait_for_the_end() {
  for (;;) ::pause();
}

/// While a temporary is made. The signal handler waits until it is known; afterwards none is made.
class Making {
 public:
  Making() {
    being_made.fetch_add(1);
    if (!leaving.load()) return;
    being_made.fetch_sub(1);
    wait_for_the_end();
  }
  ~Making() { being_made.fetch_sub(1); }
  Making(const Making&) = delete;
  Making& operator=(const Making&) = delete;
};

/// Delays signals, so that none arrives between two steps that belong together.
class SignalsLater {
 public:
  SignalsLater() {
    sigset_t all;
    sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~SignalsLater() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsLater(const SignalsLater&) = delete;
  SignalsLater& operator=(const SignalsLater&) = delete;

 private:
  sigset_t before_;
};

constexpr std::string_view temporary_prefix = ".gloam-";
constexpr size_t random_bytes = 12;

std::string random_name() {
  std::array<unsigned char, random_bytes> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != ssize_t(bytes.size()))
    throw Error("no random name for a new file: {}", std::strerror(errno));
  std::string name(temporary_prefix);
  for (const unsigned char byte : bytes) name += fmt::format("{:02x}", byte);
  return name;
}

bool is_temporary_name(const std::string& name) {
  return name.size() == temporary_prefix.size() + 2 * random_bytes && name.starts_with(temporary_prefix) &&
         name.find_first_not_of("0123456789abcdef", temporary_prefix.size()) == std::string::npos;
}

/// Locks a file against `remove_leftovers`; the lock ends with the process. False if that was faster and has removed the file. On
/// file systems without locks nothing is removed.
bool is_safe_from_removal(int descriptor) {
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) return errno != EWOULDBLOCK;
  struct stat about {};
  return ::fstat(descriptor, &about) != 0 || about.st_nlink > 0;
}

/// A new file that no other process has. It is removed unless it is renamed; a signal handler knows it while it exists.
class Temporary {
 public:
  /// In the folder of `target`, since a rename is atomic only within one file system. The name is short, since the target's own may
  /// be as long as names can be.
  Temporary(const fs::path& target, mode_t mode) {
    constexpr int tries = 100;
    for (int i = 0; i < tries && descriptor_ < 0; ++i) {
      path_ = (target.parent_path() / random_name()).string();
      if (path_.size() >= PATH_MAX) throw Error("the path is too long");
      const SignalsLater later;
      const Making making;
      descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
      if (descriptor_ < 0 && errno != EEXIST) break;
      if (descriptor_ < 0) continue;
      if (is_safe_from_removal(descriptor_))
        enter();
      else
        ::close(std::exchange(descriptor_, -1));
    }
    if (descriptor_ < 0) throw Error("{}", std::strerror(errno));
  }
  ~Temporary() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!renamed_) ::unlink(path_.c_str());
    if (!slot_) return;
    slot_->exists.store(false);
    slot_->moving.store(false);
    slot_->taken.store(false);
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  int descriptor() const { return descriptor_; }

  /// Writes the file to the disk and renames it to `target`. A crash after this leaves it whole, unless it is a cache's.
  void finish(const fs::path& target, FileFor file_for) {
    const bool is_for_user = file_for == FileFor::user;
    // Some file systems cannot sync, and report that.
    if (is_for_user && ::fsync(descriptor_) != 0 && errno != EINVAL && errno != ENOTSUP)
      throw Error("{}", std::strerror(errno));
    // A network file system may report a failed write only here.
    if (::close(std::exchange(descriptor_, -1)) != 0) throw Error("{}", std::strerror(errno));
    if (slot_) slot_->moving.store(is_for_user);
    renamed_ = ::rename(path_.c_str(), target.c_str()) == 0;
    if (!renamed_ && leaving.load()) wait_for_the_end();
    if (!renamed_) throw Error("{}", std::strerror(errno));
    if (!is_for_user) return;
    files_written.fetch_add(1);
    sync_folder(target.parent_path());
  }

 private:
  void enter() {
    for (TemporaryName& slot : temporaries) {
      if (slot.taken.exchange(true)) continue;
      slot_ = &slot;
      std::memcpy(slot.path, path_.c_str(), path_.size() + 1);
      slot.exists.store(true);
      return;
    }
  }
  /// Writes the folder, which holds the new name, to the disk. The file is whole without it, so failures are ignored.
  static void sync_folder(const fs::path& folder) {
    const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    ::fsync(descriptor);
    ::close(descriptor);
  }

  std::string path_;
  TemporaryName* slot_ = nullptr;
  int descriptor_ = -1;
  bool renamed_ = false;
};

std::atomic<const char*> interruption_text{nullptr};
std::atomic<int> group_to_kill{0};
std::atomic<void (*)()> function_to_call{nullptr};
void say(const char* text) { [[maybe_unused]] const ssize_t put = ::write(STDERR_FILENO, text, std::strlen(text)); }

extern "C" void remove_and_leave(int signal) {
  if (leaving.exchange(true)) return;  // a second signal, on another thread: one report is enough
  if (const int group = group_to_kill.load()) ::kill(-group, SIGKILL);
  if (void (*const function)() = function_to_call.load()) function();
  while (being_made.load() > 0) continue;  // other threads do: this one delays signals while it makes one
  unsigned written = files_written.load();
  for (TemporaryName& slot : temporaries)
    if (slot.exists.load() && ::unlink(slot.path) != 0 && slot.moving.load()) ++written;
  if (const char* text = interruption_text.load()) {
    say("gloam: interrupted; ");
    say(text);
    say("\n");
    ::_exit(128 + signal);
  }
  static const char nothing[] = "gloam: interrupted; no output was written\n";
  static const char something[] = "gloam: interrupted; already written: ";
  char count[32] = {};
  char* digit = count + sizeof count - 9;
  std::memcpy(digit, " file(s)\n", 9);
  for (unsigned rest = written; rest > 0; rest /= 10) *--digit = char('0' + rest % 10);
  [[maybe_unused]] ssize_t put = written ? ::write(STDERR_FILENO, something, sizeof something - 1)
                                         : ::write(STDERR_FILENO, nothing, sizeof nothing - 1);
  if (written) put = ::write(STDERR_FILENO, digit, size_t(count + sizeof count - digit));
  ::_exit(128 + signal);
}

/// The file that is written for a path: links stay.
fs::path resolved(const fs::path& path) {
  const fs::path target = follow_links(path);
  std::error_code code;
  if (fs::is_symlink(target, code)) throw Error("{}: cannot write: {}", path.string(), std::strerror(ELOOP));
  return target;
}

void check_target(const fs::path& path, const fs::path& target) {
  std::error_code code;
  if (const std::string why = why_unwritable(target); !why.empty())
    throw Error("{}: cannot write: {}", path.string(), why);
  const fs::path folder = target.parent_path().empty() ? fs::path(".") : target.parent_path();
  if (!fs::is_directory(folder, code))
    throw Error("{}: cannot write: '{}' is not a folder", path.string(), folder.string());
}

/// Permissions for the file that replaces `target`, and whether they are those of an existing file.
std::pair<mode_t, bool> permissions_for(const fs::path& target) {
  struct stat about {};
  if (::stat(target.c_str(), &about) != 0) return {0666, false};
  return {about.st_mode & 07777, true};
}

}  // namespace

std::string why_unwritable(const fs::path& path) {
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (code == std::errc::filename_too_long) return code.message();
  if (fs::is_directory(status)) return "it is a folder; name a file in it";
  if (fs::exists(status) && !fs::is_regular_file(status)) return "it is a device or a pipe; name a regular file";
  return "";
}

int remove_leftovers(const fs::path& folder) {
  int removed = 0;
  std::error_code failed;
  for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end; entry.increment(failed)) {
    if (!is_temporary_name(entry->path().filename().string())) continue;
    const int descriptor = ::open(entry->path().c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) continue;
    if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) removed += ::unlink(entry->path().c_str()) == 0;
    ::close(descriptor);
  }
  return removed;
}

bool is_lack_of_space(const Error& error) {
  const std::string text = error.what();
  const auto names = [&](int code) { return text.find(std::strerror(code)) != std::string::npos; };
  return names(ENOSPC) || names(EDQUOT) || names(EFBIG);
}

void NewFile::append(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t put = ::write(descriptor_, bytes.data(), bytes.size());
    if (put < 0 && errno == EINTR) continue;
    if (put <= 0) throw Error("{}", std::strerror(errno));
    bytes.remove_prefix(size_t(put));
  }
}

void write_atomically(const fs::path& path, const std::function<void(NewFile&)>& write, FileFor file_for) {
  if (path.empty()) throw Error("an empty path cannot be written");
  const fs::path target = resolved(path);
  check_target(path, target);
  if (file_for == FileFor::user) check_before_writing(path);
  const auto [mode, replaces] = permissions_for(target);
  try {
    Temporary temporary(target, mode);
    // Set again, since the umask does not apply to a file that replaces another.
    if (replaces) ::fchmod(temporary.descriptor(), mode);
    NewFile file(temporary.descriptor());
    write(file);
    temporary.finish(target, file_for);
  } catch (const std::exception& error) {
    std::string cause = error.what();
    for (char& c : cause)
      if (c == '\n' || c == '\r') c = ' ';
    cause = printable(cause);
    if (cause.starts_with(printable(path.string()))) throw Error("{}", cause);
    throw Error("{}: cannot write: {}", path.string(), cause);
  }
  if (file_for == FileFor::user) has_written(path);
}

void remove_temporaries_on_signal() {
  struct sigaction action {};
  action.sa_handler = remove_and_leave;
  sigemptyset(&action.sa_mask);
  for (int signal : {SIGHUP, SIGINT, SIGTERM}) {
    struct sigaction before {};
    ::sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) ::sigaction(signal, &action, nullptr);
  }
  ::signal(SIGXFSZ, SIG_IGN);
  files_written.store(0);
}

void call_on_signal(void (*function)()) { function_to_call.store(function); }

void kill_group_on_signal(int group) { group_to_kill.store(group); }

void say_on_interruption(const char* text) { interruption_text.store(text); }

void write_text(const std::filesystem::path& path, const std::string& text) {
  write_atomically(path, [&](NewFile& file) { file.append(text); });
}

void check_regular(const fs::path& path) {
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (fs::is_directory(status)) throw Error("{}: is a folder; name a file in it", path.string());
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw Error("{}: is a device or a pipe; name a regular file", path.string());
}

namespace {

/// A file that is read; closed at the end. It does not wait for the other end of a pipe.
class OpenFile {
 public:
  explicit OpenFile(const fs::path& path) : descriptor_(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {}
  ~OpenFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  bool is_open() const { return descriptor_ >= 0; }
  bool is_regular() const {
    struct stat about {};
    return ::fstat(descriptor_, &about) == 0 && S_ISREG(about.st_mode);
  }
  /// Number of bytes; below 0 for a failure.
  ssize_t read(std::array<char, 1 << 16>& bytes) const {
    ssize_t got = -1;
    do got = ::read(descriptor_, bytes.data(), bytes.size());
    while (got < 0 && errno == EINTR);
    return got;
  }

 private:
  int descriptor_;
};

}  // namespace

std::string read_text(const fs::path& path) {
  const OpenFile file(path);
  const int failure = errno;
  if (!file.is_open() || !file.is_regular()) check_regular(path);
  if (!file.is_open()) throw Error("{}: cannot read: {}", path.string(), std::strerror(failure));
  opens_file(path);
  std::string text;
  std::array<char, 1 << 16> bytes;
  ssize_t got = 0;
  while ((got = file.read(bytes)) > 0) text.append(bytes.data(), size_t(got));
  if (got < 0) throw Error("{}: cannot read: {}", path.string(), std::strerror(errno));
  return text;
}

}  // namespace gloam
