#include "fuzz/memory_file.h"

#include <sys/mman.h>
#include <unistd.h>

#include "fuzz/promise.h"

namespace gloam::fuzz {

MemoryFile::MemoryFile()
    : descriptor_(::memfd_create("fuzz", MFD_CLOEXEC)), path_("/proc/self/fd/" + std::to_string(descriptor_)) {
  require(descriptor_ >= 0, "a file in memory can be made");
}

const std::string& MemoryFile::hold(const uint8_t* data, size_t size) {
  const bool held = ::ftruncate(descriptor_, 0) == 0 && ::pwrite(descriptor_, data, size, 0) == ssize_t(size);
  require(held, "a file in memory can be written");
  return path_;
}

}  // namespace gloam::fuzz
