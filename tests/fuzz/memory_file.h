// A file in memory, rewritten for each input, for readers that take a path.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace gloam::fuzz {

class MemoryFile {
 public:
  MemoryFile();
  /// A path under which only this process reads these bytes, until the next call.
  const std::string& hold(const uint8_t* data, size_t size);

 private:
  int descriptor_;
  std::string path_;
};

}  // namespace gloam::fuzz
