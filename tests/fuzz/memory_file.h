// A file in memory, written anew for each input: for readers that take a path.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace gloam::fuzz {

class MemoryFile {
 public:
  MemoryFile();
  /// The path under which this process, and it alone, reads these bytes until the next call.
  const std::string& hold(const uint8_t* data, size_t size);

 private:
  int descriptor_;
  std::string path_;
};

}  // namespace gloam::fuzz
