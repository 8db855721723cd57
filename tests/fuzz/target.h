// A target: what is fed, the inputs to begin with, and how an input is changed. libFuzzer calls it, and so does driver.cpp,
// which needs no instrumented build.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/random.h"

/// libFuzzer's own names. Returns 0; ends the program where a promise is broken.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);
/// Changes an input in place; the new size.
extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t most, unsigned seed);
/// Changes bytes without regard to what they mean: libFuzzer's, or that of driver.cpp.
extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t most);

namespace gloam::fuzz {

/// Inputs to begin with, all of them valid or nearly so.
std::vector<std::string> seeds();

/// The size of the largest input that a target is fed.
inline constexpr size_t largest_input = 1 << 16;

/// `LLVMFuzzerMutate` for text that may grow by `room` bytes.
std::string mutated(std::string bytes, size_t room = 16);

/// Puts a text where libFuzzer wants it; the size that fits.
size_t put(const std::string& text, uint8_t* data, size_t most);

}  // namespace gloam::fuzz
