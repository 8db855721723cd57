#include "base/memory.h"

#include <gtest/gtest.h>

#include <fstream>

namespace gloam::memory_test {
namespace {

namespace fs = std::filesystem;

/// The files of a machine that describe its memory.
class Machine : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "gloam-machine-XXXXXX").string();
    root = mkdtemp(pattern.data());
    put("proc/meminfo", "MemTotal: 8000000 kB\nMemFree: 1 kB\nMemAvailable:    4000000 kB\n");
  }
  void TearDown() override { fs::remove_all(root); }
  void put(const fs::path& file, const std::string& text) {
    fs::create_directories((root / file).parent_path());
    std::ofstream(root / file) << text;
  }
  fs::path root;
};

constexpr unsigned long long available = 4000000ull << 10;

TEST_F(Machine, TellsWhatIsAvailable) { EXPECT_EQ(available_memory(root), available); }

TEST_F(Machine, GroupAllowsLess) {
  put("proc/self/cgroup", "0::/jobs/one\n");
  put("sys/fs/cgroup/jobs/one/memory.max", "max\n");
  put("sys/fs/cgroup/jobs/one/memory.current", "100\n");
  EXPECT_EQ(available_memory(root), available);
  // The parent group has the limit. Its file cache can be dropped.
  put("sys/fs/cgroup/jobs/memory.max", "1000000\n");
  put("sys/fs/cgroup/jobs/memory.current", "700000\n");
  put("sys/fs/cgroup/jobs/memory.stat", "anon 300000\ninactive_file 250000\nactive_file 150000\n");
  EXPECT_EQ(available_memory(root), 700000u);
}

TEST_F(Machine, GroupOfTheFirstForm) {
  put("proc/self/cgroup", "9:cpu,cpuacct:/x\n4:memory:/job\n");
  put("sys/fs/cgroup/memory/job/memory.limit_in_bytes", "500000\n");
  put("sys/fs/cgroup/memory/job/memory.usage_in_bytes", "600000\n");
  EXPECT_EQ(available_memory(root), 0u);  // over its limit already
}

TEST_F(Machine, ContainerSeesItsOwnRootOnly) {
  put("proc/self/cgroup", "0::/docker/of-the-host\n");
  put("sys/fs/cgroup/memory.max", "2000000\n");
  put("sys/fs/cgroup/memory.current", "500000\n");
  EXPECT_EQ(available_memory(root), 1500000u);
}

TEST(Memory, InWords) {
  EXPECT_EQ(memory_in_words(1), "1 MiB");
  EXPECT_EQ(memory_in_words(512ull << 20), "512 MiB");
  EXPECT_EQ(memory_in_words(3ull << 29), "1.5 GiB");
}

}  // namespace
}  // namespace gloam::memory_test
