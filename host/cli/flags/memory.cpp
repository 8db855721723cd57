#include "cli/flags/memory.h"

#include <algorithm>
#include <charconv>

#include "base/memory.h"
#include "gloam/error.h"

namespace gloam::cli {
namespace {

using Bytes = unsigned long long;

/// A need below this gets no note.
constexpr Bytes worth_telling = 1ull << 30;

/// Notes the need, or throws Error if it is over the limit.
Bytes checked(Bytes need, const MemoryLimit& limit, const std::string& name, const std::string& ways_out) {
  if (need > limit.bytes)
    throw Error("{}: would take about {} of memory, and {}; {}, or allow more by --limit-memory", name,
                memory_in_words(need), limit.words, ways_out);
  if (need > worth_telling) note({fmt::format("memory: about {} at the peak", memory_in_words(need))});
  return need;
}

}  // namespace

MemoryLimit limit_of(const FrameFlags& flags, const std::string& memory) {
  MemoryLimit limit;
  if (flags.limit_memory.empty()) {
    limit = available_limit();
  } else {
    limit.bytes = parse_memory(flags.limit_memory, "--limit-memory");
    limit.words = fmt::format("--limit-memory {} allows {}", flags.limit_memory, memory_in_words(limit.bytes));
  }
  if (memory.empty()) return limit;
  const Bytes bytes = parse_memory(memory, "--memory");
  if (bytes >= limit.bytes) return limit;
  return {bytes, fmt::format("--memory {} allows {}", memory, memory_in_words(bytes))};
}

unsigned long long parse_memory(const std::string& text, const std::string& flag) {
  constexpr Bytes least = 1ull << 20, most = 1ull << 50;
  double number = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  const std::string units = "KMGT";
  const size_t unit = stop + 1 == end ? units.find(*stop) : std::string::npos;
  const double bytes = unit == std::string::npos ? 0 : number * double(1ull << 10 * (unit + 1));
  if (error != std::errc() || !(bytes >= double(least) && bytes <= double(most)))
    throw UsageError("{} {} is not allowed; a size such as 4G or 512M is, from 1M to 1024T", flag, text);
  return Bytes(bytes);
}

unsigned long long planned_memory(const FrameFlags& flags, const std::string& name, const std::string& device,
                                  const MemoryNeed& need, const std::string& ways_out) {
  const MemoryLimit limit = limit_of(flags);
  Bytes bytes = need(true);
  if (bytes > limit.bytes && !Device(device).info().shares_memory) bytes = need(false);
  return checked(bytes, limit, name, ways_out);
}

unsigned long long planned_memory(const FrameFlags& flags, const std::string& name, unsigned long long need,
                                  const std::string& ways_out) {
  return checked(need, limit_of(flags), name, ways_out);
}

}  // namespace gloam::cli
