#include "fuzz/target.h"

#include <algorithm>
#include <cstring>

namespace gloam::fuzz {

std::string mutated(std::string bytes, size_t room) {
  const size_t size = bytes.size();
  bytes.resize(std::max<size_t>(size + room, 1));
  bytes.resize(LLVMFuzzerMutate(reinterpret_cast<uint8_t*>(bytes.data()), size, bytes.size()));
  return bytes;
}

size_t put(const std::string& text, uint8_t* data, size_t most) {
  const size_t size = std::min(text.size(), most);
  std::memcpy(data, text.data(), size);
  return size;
}

}  // namespace gloam::fuzz
