// A target: the reader, its first inputs, and how an input is changed. libFuzzer calls it, and so does driver.cpp, which needs no
// instrumented build.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/random.h"

/// libFuzzer's own names. Returns 0; ends the program if a promise is broken.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);
/// Changes an input in place; returns the new size.
extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t most, unsigned seed);
/// Changes bytes regardless of their meaning: libFuzzer's function, or that of driver.cpp.
extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t most);

namespace gloam::fuzz {

/// First inputs, all of them valid or nearly so.
std::vector<std::string> seeds();

/// Size of the largest input.
inline constexpr size_t largest_input = 1 << 16;

/// `LLVMFuzzerMutate` for text that may grow by `room` bytes.
std::string mutated(std::string bytes, size_t room = 16);

/// Copies a text to libFuzzer's buffer; returns the size that fits.
size_t put(const std::string& text, uint8_t* data, size_t most);

}  // namespace gloam::fuzz
