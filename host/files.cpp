#include "gloam/files.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstring>
#include <fstream>
#include <iterator>

#include "gloam/error.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;

/// Names of files in the making, where a signal handler can read them: no allocation, no lock.
struct Temporary {
  std::atomic<bool> taken{false};   ///< a writer owns this slot
  std::atomic<bool> exists{false};  ///< `path` is complete and may be unlinked
  std::atomic<bool> moving{false};  ///< being renamed: the file is either still there or already under its own name
  char path[PATH_MAX];
};
static_assert(std::atomic<bool>::is_always_lock_free);
static_assert(std::atomic<unsigned>::is_always_lock_free);
std::array<Temporary, 16> temporaries;
std::atomic<unsigned> files_written{0};

/// Holds a slot of the registry and removes the file unless it was renamed.
class Registered {
 public:
  explicit Registered(const std::string& path) : path_(path) {
    if (path.size() >= PATH_MAX) throw Error("{}: cannot write: the path is too long", path);
    for (Temporary& slot : temporaries) {
      if (slot.taken.exchange(true)) continue;
      slot_ = &slot;
      std::memcpy(slot.path, path.c_str(), path.size() + 1);
      slot.exists.store(true);
      return;
    }
  }
  ~Registered() {
    if (!renamed_) ::unlink(path_.c_str());
    if (!slot_) return;
    slot_->exists.store(false);
    slot_->moving.store(false);
    slot_->taken.store(false);
  }
  Registered(const Registered&) = delete;
  Registered& operator=(const Registered&) = delete;
  /// To `target`; false where it fails, with the cause in errno.
  bool rename(const fs::path& target) {
    if (slot_) slot_->moving.store(true);
    renamed_ = ::rename(path_.c_str(), target.c_str()) == 0;
    if (renamed_) files_written.fetch_add(1);
    return renamed_;
  }

 private:
  std::string path_;
  Temporary* slot_ = nullptr;
  bool renamed_ = false;
};

std::atomic<const char*> interruption_text{nullptr};
std::atomic<bool> leaving{false};

void say(const char* text) { [[maybe_unused]] const ssize_t put = ::write(STDERR_FILENO, text, std::strlen(text)); }

extern "C" void remove_and_leave(int signal) {
  if (leaving.exchange(true)) return;  // a second signal on another thread: one says it
  unsigned written = files_written.load();
  for (Temporary& slot : temporaries)
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

/// Where the data has to go: through a symbolic link, so that the link stays one.
fs::path resolved(const fs::path& path) {
  std::error_code code;
  if (!fs::is_symlink(path, code)) return path;
  const fs::path target = fs::weakly_canonical(path, code);
  return code ? path : target;
}

/// Beside the target, since only within one file system is a rename one step. Short, since the target's own name may be
/// as long as a name can be; with the extension, by which codecs choose the format.
fs::path temporary_name(const fs::path& target) {
  static std::atomic<unsigned> counter{0};
  const std::string extension = target.extension().string();
  return target.parent_path() /
         fmt::format(".gloam-{}-{}{}", ::getpid(), counter++, extension.size() <= 16 ? extension : "");
}

void check_target(const fs::path& path, const fs::path& target) {
  std::error_code code;
  if (const std::string why = why_unwritable(target); !why.empty())
    throw Error("{}: cannot write: {}", path.string(), why);
  const fs::path folder = target.parent_path().empty() ? fs::path(".") : target.parent_path();
  if (!fs::is_directory(folder, code))
    throw Error("{}: cannot write: '{}' is not a folder", path.string(), folder.string());
}

/// Creates the file, so that an unwritable folder is told here, by its own cause, and not by a codec.
void create(const fs::path& path, const fs::path& temporary) {
  const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor < 0) throw Error("{}: cannot write: {}", path.string(), std::strerror(errno));
  ::close(descriptor);
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

void write_atomically(const fs::path& path, const std::function<void(const fs::path&)>& write) {
  if (path.empty()) throw Error("an empty path cannot be written");
  const fs::path target = resolved(path);
  check_target(path, target);
  const fs::path temporary = temporary_name(target);
  Registered registered(temporary.string());
  create(path, temporary);
  try {
    write(temporary);
  } catch (const std::exception& error) {
    // A codec names the file it was given, which is of no use to the reader and soon gone.
    std::string cause = error.what();
    for (char& c : cause)
      if (c == '\n' || c == '\r') c = ' ';
    cause = printable(cause);
    const std::string given = printable(temporary.string()), meant = printable(path.string());
    for (size_t at = 0; (at = cause.find(given, at)) != std::string::npos; at += meant.size())
      cause.replace(at, given.size(), meant);
    if (cause.starts_with(meant)) throw Error("{}", cause);
    throw Error("{}: cannot write: {}", path.string(), cause);
  }
  if (!registered.rename(target)) throw Error("{}: cannot write: {}", path.string(), std::strerror(errno));
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

void say_on_interruption(const char* text) { interruption_text.store(text); }

void write_text(const std::filesystem::path& path, const std::string& text) {
  write_atomically(path, [&](const std::filesystem::path& temporary) {
    std::ofstream stream(temporary, std::ios::binary);
    stream << text;
    stream.close();
    if (!stream) throw Error("{}: cannot be written", path.string());
  });
}

std::string read_text(const fs::path& path) {
  std::error_code code;
  if (fs::is_directory(path, code)) throw Error("{}: is a directory, not a text file", path.string());
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error("{}: cannot read: {}", path.string(), std::strerror(errno));
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (file.bad()) throw Error("{}: cannot read: {}", path.string(), std::strerror(errno));
  return text;
}

}  // namespace gloam
