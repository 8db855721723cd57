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
  char path[PATH_MAX];
};
static_assert(std::atomic<bool>::is_always_lock_free);
std::array<Temporary, 16> temporaries;

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
    slot_->taken.store(false);
  }
  Registered(const Registered&) = delete;
  Registered& operator=(const Registered&) = delete;
  void renamed() { renamed_ = true; }

 private:
  std::string path_;
  Temporary* slot_ = nullptr;
  bool renamed_ = false;
};

extern "C" void remove_and_leave(int signal) {
  for (Temporary& slot : temporaries)
    if (slot.exists.load()) ::unlink(slot.path);
  static const char interrupted[] = "gloam: interrupted; no output was written\n";
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, interrupted, sizeof interrupted - 1);
  ::_exit(128 + signal);
}

/// Where the data has to go: through a symbolic link, so that the link stays one.
fs::path resolved(const fs::path& path) {
  std::error_code code;
  if (!fs::is_symlink(path, code)) return path;
  const fs::path target = fs::weakly_canonical(path, code);
  return code ? path : target;
}

/// Beside the target, since only within one file system is a rename one step.
fs::path temporary_name(const fs::path& target) {
  static std::atomic<unsigned> counter{0};
  return target.parent_path() /
         fmt::format(".{}.{}-{}.part{}", target.stem().string(), ::getpid(), counter++, target.extension().string());
}

void check_target(const fs::path& path, const fs::path& target) {
  std::error_code code;
  const fs::file_status status = fs::status(target, code);
  if (fs::is_directory(status)) throw Error("{}: cannot write: it is a directory; name a file in it", path.string());
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw Error("{}: cannot write: it is a device or a pipe; name a regular file", path.string());
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

void write_atomically(const fs::path& path, const std::function<void(const fs::path&)>& write) {
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
    for (size_t at; (at = cause.find(temporary.string())) != std::string::npos;)
      cause.replace(at, temporary.string().size(), path.string());
    for (char& c : cause)
      if (c == '\n' || c == '\r') c = ' ';
    if (cause.starts_with(path.string())) throw Error("{}", cause);
    throw Error("{}: cannot write: {}", path.string(), cause);
  }
  if (::rename(temporary.c_str(), target.c_str()) != 0)
    throw Error("{}: cannot write: {}", path.string(), std::strerror(errno));
  registered.renamed();
}

void remove_temporaries_on_signal() {
  struct sigaction action {};
  action.sa_handler = remove_and_leave;
  sigemptyset(&action.sa_mask);
  for (int signal : {SIGINT, SIGTERM}) ::sigaction(signal, &action, nullptr);
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
