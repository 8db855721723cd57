// A hash of bytes that is the same on every machine.
#pragma once

#include <cstdint>
#include <string_view>

namespace gloam {

/// FNV-1a, 64 bits. `state`: the hash of the bytes before.
inline uint64_t hash_of(std::string_view bytes, uint64_t state = 0xcbf29ce484222325ull) {
  for (const char byte : bytes) state = (state ^ static_cast<unsigned char>(byte)) * 0x100000001b3ull;
  return state;
}

}  // namespace gloam
