// Runs a target without libFuzzer: with inputs from a seed, or with given files. For the ordinary test run, and to repeat the
// findings of a fuzzer.
#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/target.h"

namespace {

using gloam::Random;
using namespace gloam::fuzz;
namespace fs = std::filesystem;

/// No input may take longer.
constexpr unsigned watchdog_seconds = 20;

// --- Changing bytes

Random byte_source(0);

void set_byte(std::string& bytes, Random& random) {
  if (!bytes.empty()) bytes[random.below(bytes.size())] = char(random.next());
}

void flip_bit(std::string& bytes, Random& random) {
  if (!bytes.empty()) bytes[random.below(bytes.size())] ^= char(1 << random.below(8));
}

/// A whole number of some width at its limits.
void set_number(std::string& bytes, Random& random) {
  const int64_t value = random.pick<int64_t>({0, 1, -1, INT8_MIN, UINT8_MAX, INT16_MAX, UINT16_MAX, INT32_MIN,
                                              INT32_MAX, INT64_MIN, INT64_MAX, 1 << 16, 1 << 28});
  const size_t width = random.pick<size_t>({1, 2, 4, 8});
  if (bytes.size() < width) return;
  std::memcpy(&bytes[random.below(bytes.size() - width + 1)], &value, width);
}

void remove_bytes(std::string& bytes, Random& random) {
  if (bytes.empty()) return;
  const size_t at = random.below(bytes.size()), most = random.one_in(4) ? 64 : 4;
  bytes.erase(at, 1 + random.below(most));
}

void insert_bytes(std::string& bytes, Random& random) {
  const size_t size = 1 + random.below(8);
  const std::string more(size, char(random.next()));
  bytes.insert(random.below(bytes.size() + 1), more);
}

void copy_bytes(std::string& bytes, Random& random) {
  if (bytes.empty()) return;
  const size_t from = random.below(bytes.size()), size = 1 + random.below(16), at = random.below(bytes.size());
  const std::string piece = bytes.substr(from, size);
  bytes.replace(at, random.one_in(2) ? piece.size() : 0, piece);
}

}  // namespace

extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t most) {
  std::string bytes(reinterpret_cast<const char*>(data), size);
  const auto change =
      byte_source.pick({set_byte, flip_bit, set_number, remove_bytes, insert_bytes, copy_bytes, set_byte, flip_bit});
  change(bytes, byte_source);
  return put(bytes, data, most);
}

namespace {

// --- One input

/// The present input, where a signal handler finds it.
const uint8_t* current = nullptr;
size_t current_size = 0;
char kept_name[4096] = {};

/// Saves the input that ends the program, and lets the signal end it.
extern "C" void keep_input(int signal) {
  const int file = ::open(kept_name, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  [[maybe_unused]] ssize_t put = ::write(file, current, current_size);
  ::close(file);
  static const char kept[] = "fuzz: the input is kept: give it as the argument to run it again: ";
  put = ::write(STDERR_FILENO, kept, sizeof kept - 1);
  put = ::write(STDERR_FILENO, kept_name, std::strlen(kept_name));
  put = ::write(STDERR_FILENO, "\n", 1);
  ::signal(signal, SIG_DFL);
  ::raise(signal);
}

void keep_input_on_signals(const std::string& name) {
  std::snprintf(kept_name, sizeof kept_name, "%s", name.c_str());
  static char stack[1 << 16];  // a separate stack: the program's may be used up
  const stack_t apart{stack, 0, sizeof stack};
  ::sigaltstack(&apart, nullptr);
  struct sigaction action {};
  action.sa_handler = keep_input;
  action.sa_flags = SA_NODEFER | SA_ONSTACK;
  for (int signal : {SIGABRT, SIGALRM, SIGBUS, SIGFPE, SIGILL, SIGSEGV}) ::sigaction(signal, &action, nullptr);
}

void feed(const std::string& input) {
  current = reinterpret_cast<const uint8_t*>(input.data());
  current_size = input.size();
  ::alarm(watchdog_seconds);
  LLVMFuzzerTestOneInput(current, current_size);
  ::alarm(0);
}

std::string slurp(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    std::fprintf(stderr, "fuzz: %s cannot be read\n", path.c_str());
    std::exit(2);
  }
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Feeds files, and files of folders. Returns how many.
size_t feed_files(const std::vector<std::string>& paths) {
  size_t count = 0;
  for (const std::string& path : paths) {
    if (!fs::is_directory(path)) {
      feed(slurp(path));
      ++count;
      continue;
    }
    for (const auto& entry : fs::recursive_directory_iterator(path))
      if (entry.is_regular_file()) feed(slurp(entry.path())), ++count;
  }
  return count;
}

// --- Many inputs

/// Every input depends only on the seed and its own number.
std::string input_of(const std::vector<std::string>& starts, uint64_t seed, uint64_t number) {
  Random random(seed, number);
  byte_source = Random(random.next());
  std::string input = starts[size_t(number) % starts.size()];
  for (int changes = random.between(0, 4); changes > 0; --changes) {
    const size_t size = input.size();
    input.resize(std::max(largest_input, size));
    input.resize(
        LLVMFuzzerCustomMutator(reinterpret_cast<uint8_t*>(input.data()), size, input.size(), unsigned(random.next())));
  }
  return input;
}

void feed_many(uint64_t seed, uint64_t count) {
  const std::vector<std::string> starts = seeds();
  for (uint64_t i = 0; i < count; ++i) feed(input_of(starts, seed, i));
}

void write_seeds(const fs::path& folder) {
  fs::create_directories(folder);
  size_t number = 0;
  for (const std::string& seed : seeds()) {
    std::ofstream(folder / ("seed-" + std::to_string(number++)), std::ios::binary) << seed;
  }
}

// --- Arguments

constexpr const char* usage = "[--runs N] [--seed N] [--write-seeds FOLDER] [FILE or FOLDER...]";

struct Arguments {
  uint64_t runs = 0, seed = 1;
  std::string seed_folder;
  std::vector<std::string> paths;
};

[[noreturn]] void wrong_usage(const char* program) {
  std::fprintf(stderr, "usage: %s %s\n", program, usage);
  std::exit(2);
}

Arguments parse(int count, char** values) {
  Arguments arguments;
  for (int i = 1; i < count; ++i) {
    const std::string_view flag = values[i];
    if (!flag.starts_with("--")) {
      arguments.paths.emplace_back(flag);
      continue;
    }
    const std::string_view value = ++i < count ? values[i] : "";
    uint64_t* number = flag == "--runs" ? &arguments.runs : flag == "--seed" ? &arguments.seed : nullptr;
    if (flag == "--write-seeds" && !value.empty())
      arguments.seed_folder = value;
    else if (!number || std::from_chars(value.data(), value.data() + value.size(), *number).ec != std::errc())
      wrong_usage(values[0]);
  }
  return arguments;
}

}  // namespace

int main(int count, char** values) {
  const Arguments arguments = parse(count, values);
  keep_input_on_signals(fs::path(values[0]).filename().string() + "-failed-" + std::to_string(::getpid()));
  if (!arguments.seed_folder.empty()) write_seeds(arguments.seed_folder);
  const auto start = std::chrono::steady_clock::now();
  const size_t files = feed_files(arguments.paths);
  feed_many(arguments.seed, arguments.runs);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::printf("%zu files and %llu inputs made from seed %llu in %.1f s: all read or refused as promised\n", files,
              static_cast<unsigned long long>(arguments.runs), static_cast<unsigned long long>(arguments.seed),
              seconds);
  return 0;
}
