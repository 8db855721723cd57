#include "cli/making_folder.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/file_ledger.h"
#include "gloam/error.h"

namespace gloam::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* name_begin = ".gloam-making-";

/// The folder, locked; -1 if another process has it.
int locked(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor < 0 || ::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return descriptor;
  ::close(descriptor);
  return -1;
}

void remove_abandoned(const fs::path& beside) {
  std::error_code failed;
  for (fs::directory_iterator entry(beside, failed), end; !failed && entry != end; entry.increment(failed)) {
    if (!entry->path().filename().string().starts_with(name_begin)) continue;
    const int descriptor = locked(entry->path());
    if (descriptor < 0) continue;
    std::error_code ignored;
    fs::remove_all(entry->path(), ignored);
    ::close(descriptor);
  }
}

}  // namespace

MakingFolder::MakingFolder(const fs::path& beside) {
  remove_abandoned(beside);
  constexpr int tries = 100;  // another process may take one for a leftover before it is locked
  for (int i = 0; i < tries && lock_ < 0; ++i) {
    std::string path = (beside / (std::string(name_begin) + "XXXXXX")).string();
    if (!::mkdtemp(path.data())) throw Error("{}: cannot be written ({})", beside.string(), std::strerror(errno));
    path_ = path;
    lock_ = locked(path_);
  }
  if (lock_ < 0) throw Error("{}: no folder can be made in it", beside.string());
}

MakingFolder::~MakingFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  ::close(lock_);
}

bool MakingFolder::hand_over(const fs::path& name, const fs::path& to) const {
  std::error_code failed;
  if (!fs::exists(path_ / name, failed)) return false;
  check_before_writing(to);
  fs::rename(path_ / name, to, failed);
  if (failed) throw Error("{}: cannot be written ({})", to.string(), failed.message());
  has_written(to);
  return true;
}

}  // namespace gloam::cli
