// gloam run on a shot as a process among others: killed and started again, beside another, in little memory, on a full disk.
#include <chrono>
#include <numeric>
#include <random>
#include <sstream>
#include <thread>

#include "cli/shot_fixture.h"
#include "gloam/frame_pattern.h"
#include "sequence/frame_locks.h"
#include "support/long.h"

namespace gloam::test::shot_process_test {
namespace {

class ShotProcess : public ShotTest {
 protected:
  /// Also hidden ones.
  std::vector<std::string> hidden_files() const {
    std::vector<std::string> hidden;
    for (const std::string& name : files())
      if (name.front() == '.') hidden.push_back(name);
    return hidden;
  }
  void expect_counts(const Result& result, int done, int skipped) const {
    ASSERT_EQ(result.status, 0) << result.err;
    const nlohmann::json summary = lines_of(result.out).back();
    EXPECT_EQ(summary["done"], done) << result.out << result.err;
    EXPECT_EQ(summary["skipped"], skipped) << result.out << result.err;
  }
  static std::vector<int> range(int first, int last) {
    std::vector<int> frames(size_t(last - first + 1));
    std::iota(frames.begin(), frames.end(), first);
    return frames;
  }
  /// The outputs that are there.
  size_t outputs() const {
    const std::vector<std::string> names = files();
    return size_t(std::count_if(names.begin(), names.end(), [](const auto& name) { return name.starts_with("ao."); }));
  }
  /// Waits until a command has written so many outputs, or has ended.
  void wait_for_outputs(pid_t child, size_t count) const {
    siginfo_t ended{};
    while (outputs() < count && waitid(P_PID, id_t(child), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 &&
           ended.si_pid == 0)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  /// Starts a command and kills it a little after a random number of frames, until it was killed `times` times, and then lets it end: at
  /// no moment is there a file that differs from those of an undisturbed run.
  void kill_at_moments(int times, const Arguments& command) const {
    ASSERT_EQ(gloam(command).status, 0);
    const auto expected = contents();
    ASSERT_GE(expected.size(), 24u);
    Arguments resumed = command;
    resumed.emplace_back("--resume");
    std::mt19937 random(std::random_device{}());
    const auto up_to = [&](size_t most) { return std::uniform_int_distribution<size_t>(0, most)(random); };
    std::string moments;
    for (int killed = 0; killed < times;) {
      if (outputs() == expected.size())
        for (const auto& [name, unused] : expected) fs::remove(path(name));
      const size_t there = outputs(), frames = there + up_to(expected.size() - there - 1), ms = up_to(20);
      moments += fmt::format("{} frames + {} ms, ", frames, ms);
      const pid_t child = start(resumed);
      wait_for_outputs(child, frames);
      std::this_thread::sleep_for(std::chrono::milliseconds(ms));
      kill(child, SIGKILL);
      killed += finish(child).status == 128 + SIGKILL;
      for (const auto& [name, bytes] : contents())
        EXPECT_TRUE(bytes == expected.at(name)) << name << " after " << moments;
    }
    const Result last = gloam(resumed);
    EXPECT_EQ(last.status, 0) << last.err << moments;
    EXPECT_TRUE(contents() == expected) << moments;
    EXPECT_EQ(hidden_files(), std::vector<std::string>()) << moments;
  }
  struct MemorySample {
    long frames_done;
    double mebibytes;
  };
  /// Resident memory of a command with `--json -` until it ends, twenty times a second.
  std::vector<MemorySample> memory_of(const Arguments& command) const {
    std::vector<MemorySample> samples;
    const pid_t child = start(command);
    siginfo_t ended{};
    while (waitid(P_PID, id_t(child), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 && ended.si_pid == 0) {
      const std::string said = slurp(path("stdout")), status = slurp(fmt::format("/proc/{}/status", child));
      if (const size_t at = status.find("VmRSS:"); at != std::string::npos)
        samples.push_back({std::count(said.begin(), said.end(), '\n'), std::stod(status.substr(at + 6)) / 1024});
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    const Result result = finish(child);
    EXPECT_EQ(result.status, 0) << result.err;
    return samples;
  }
  /// Over the samples in which more than `from` and at most `to` frames were done.
  static double mean_memory(const std::vector<MemorySample>& samples, long from, long to) {
    double sum = 0;
    int count = 0;
    for (const MemorySample& sample : samples)
      if (sample.frames_done > from && sample.frames_done <= to) sum += sample.mebibytes, ++count;
    EXPECT_GT(count, 0) << "no sample from frame " << from << " to " << to;
    return sum / std::max(1, count);
  }
  Result resume(const Arguments& more = {}) const {
    Arguments all = {"--resume", "--json", "-"};
    all.insert(all.end(), more.begin(), more.end());
    return run(all);
  }
};

TEST_F(ShotProcess, ResumeLeavesFramesThatWereMadeInTheSameWay) {
  make_shot({1, 2, 3, 4});
  expect_counts(resume({"--frames", "1-2"}), 2, 0);
  expect_counts(resume(), 2, 2);
  const auto made = contents();
  const auto time = fs::last_write_time(path("ao.0001.exr"));
  const Result again = resume();
  expect_counts(again, 0, 4);
  EXPECT_EQ(lines_of(again.out)[0]["status"], "skipped");
  EXPECT_EQ(fs::last_write_time(path("ao.0001.exr")), time);
  EXPECT_EQ(contents(), made);
  expect_counts(resume({"--memory", "2G", "-q"}), 0, 4);
}

TEST_F(ShotProcess, ResumeWritesAgainWhatWasMadeInAnotherWay) {
  make_shot({1, 2, 3, 4});
  expect_counts(resume(), 4, 0);
  const auto made = contents();
  const auto expect_again = [&](const Result& result, int done, const std::string& why) {
    expect_counts(result, done, 4 - done);
    EXPECT_NE(result.err.find(why), std::string::npos) << result.err;
  };
  expect_again(resume({"--preset", "low"}), 4, "1-4: it was made with other settings");
  expect_again(resume({"--float"}), 4, "other settings");
  expect_again(resume(), 4, "other settings");
  write_frame(path("ao.0002.exr"), frame_of(2));
  expect_again(resume(), 1, "2: it was not made by a run on a sequence");
  fs::resize_file(path("ao.0003.exr"), fs::file_size(path("ao.0003.exr")) - 100);
  expect_again(resume(), 1, "3: it is damaged");
  write_frame(path("shot.0004.exr"), frame_of(4));
  expect_again(resume(), 1, "4: its input has changed");
  std::string text = slurp(path("ao.0001.exr"));
  const size_t version = text.find("kernels ") + 8;
  text[version] = text[version] == '0' ? '1' : '0';
  std::ofstream(path("ao.0001.exr"), std::ios::binary) << text;
  expect_again(resume(), 1, "1: it was made by another version");
  const auto again = contents();
  for (const auto& [name, bytes] : made) EXPECT_TRUE(name == "ao.0004.exr" || again.at(name) == bytes) << name;
  std::ofstream(path("camera.json")) << R"({"width": 64, "height": 48, "fx": 50, "fy": 50, "cx": 32, "cy": 24,
                                            "camera_to_world": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]})";
  expect_again(resume({"--camera", file("camera.json")}), 4, "its input has changed");
  expect_counts(resume({"--camera", file("camera.json")}), 0, 4);
}

/// At random moments, so each run of the test tries others; a failure tells them. They are counted in frames, so that none depends on how
/// fast the machine is.
TEST_F(ShotProcess, KilledAtAnyMomentTheSameCommandGoesOn) {
  make_shot(range(1, 24));
  kill_at_moments(24, run_of({}));
}

TEST_F(ShotProcess, KilledAtFiftyMomentsTheSameCommandGoesOn) {
  ONLY_IN_LONG_RUN();
  make_shot(range(1, 60));
  kill_at_moments(50, run_of({}));
}

/// Across the border of two blocks of frames, which begin with an empty history.
TEST_F(ShotProcess, KilledAtFiftyMomentsAShotThatGoesOnOverTimeIsTheSame) {
  ONLY_IN_LONG_RUN();
  walk(60, 0.01, 64, 36);
  for (int i = 60; i >= 1; --i) renumber(i, i + 30);
  kill_at_moments(50, run_of({"--temporal"}, "gtao"));
}

TEST_F(ShotProcess, AnotherProcessOnTheSameFramesIsRefused) {
  make_shot({1, 2, 3});
  {
    const FrameLocks locks(FramePattern(file("ao.####.exr"), "-o"), {2});
    for (const Arguments& more : std::vector<Arguments>{{}, {"--resume"}, {"--frames", "2-3"}})
      expect_refused(run_of(more), 1, {"another gloam is writing"});
    const Result other = run({"--frames", "1,3"});
    EXPECT_EQ(other.status, 0) << other.err;
  }
  EXPECT_EQ(run().status, 0);
  EXPECT_EQ(hidden_files(), std::vector<std::string>());
}

TEST_F(ShotProcess, TwoAtOnceEitherWriteOrSayWhy) {
  make_shot({1, 2, 3, 4, 5, 6});
  const pid_t one = start(run_of({})), other = start(run_of({}));
  int first_status = 0, second_status = 0;
  waitpid(one, &first_status, 0);
  waitpid(other, &second_status, 0);
  EXPECT_TRUE(first_status == 0 || second_status == 0);
  EXPECT_EQ(contents().size(), 6u);
  EXPECT_EQ(hidden_files(), std::vector<std::string>());
}

TEST_F(ShotProcess, InterruptedLeavesNoTemporaryFiles) {
  std::vector<int> frames;
  for (int number = 1; number <= 60; ++number) frames.push_back(number);
  make_shot(frames);
  const pid_t child = start(run_of({}));
  for (int i = 0; i < 5000 && contents().empty(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  kill(child, SIGINT);
  const Result result = finish(child);
  if (result.status == 0) GTEST_SKIP() << "it was faster";
  EXPECT_EQ(result.status, 128 + SIGINT);
  EXPECT_NE(result.err.find("--resume"), std::string::npos) << result.err;
  for (const std::string& name : hidden_files()) EXPECT_EQ(name.rfind(".gloam-lock-", 0), 0u) << name;
  EXPECT_EQ(run({"--resume"}).status, 0);
  EXPECT_EQ(hidden_files(), std::vector<std::string>());
}

/// The output's folder is a disk of its own, of 48 KiB, where the system lets users mount one.
TEST_F(ShotProcess, AFullDiskStopsTheShot) {
  std::vector<int> frames;
  for (int number = 1; number <= 40; ++number) frames.push_back(number);
  make_shot(frames);
  fs::create_directory(path("disk"));
  const auto on_small_disk = [&](const std::string& command) {
    const std::string mount = "mount -t tmpfs -o size=48k none " + file("disk");
    return WEXITSTATUS(
        std::system(("unshare -rm bash -c '" + mount + " && " + command + "' 2>" + file("stderr")).c_str()));
  };
  if (on_small_disk("true") != 0) GTEST_SKIP() << "no disk can be mounted: " << slurp(path("stderr"));
  const std::string run = fmt::format("{} run hbao+ {} -o {} --radius 0.5 --json - >{}", program, file("shot.####.exr"),
                                      file("disk/ao.####.exr"), file("stdout"));
  EXPECT_EQ(on_small_disk(run + "; status=$?; ls -A " + file("disk") + " >" + file("listing") + "; exit $status"), 1);
  const std::string said = slurp(path("stderr"));
  // Two frames are written at a time: one may find no space, and so leave it to the other. It is told in a line of its own.
  std::vector<std::string> told;
  std::istringstream text(said);
  for (std::string line; std::getline(text, line);) told.push_back(line);
  ASSERT_FALSE(told.empty()) << said;
  for (const std::string& line : told) EXPECT_NE(line.find("No space left on device"), std::string::npos) << said;
  for (size_t i = 0; i < told.size(); ++i) {
    for (const char* words : {"free some space", "--resume"})
      EXPECT_EQ(told[i].find(words) != std::string::npos, i + 1 == told.size()) << said;
  }
  const std::vector<nlohmann::json> lines = lines_of(slurp(path("stdout")));
  ASSERT_FALSE(lines.empty());
  const int done = lines.back()["done"].get<int>(), failed = lines.back()["failed"].get<int>();
  EXPECT_GE(done, 1);
  EXPECT_GE(failed, 3);
  EXPECT_LT(done + failed, 40) << "it stops";
  const std::string listing = slurp(path("listing"));
  EXPECT_EQ(std::count(listing.begin(), listing.end(), '\n'), done) << listing;
  EXPECT_EQ(listing.find(".gloam"), std::string::npos) << listing;
}

/// One of two chunks finds its disk full; once there is space, the same command writes the rest.
TEST_F(ShotProcess, AChunkWhoseDiskWasFullGoesOn) {
  make_shot(range(1, 40));
  ASSERT_EQ(run({"-q"}).status, 0);
  const auto whole = contents();
  for (const auto& [name, bytes] : whole) fs::rename(path(name), path("whole." + name));
  fs::create_directory(path("disk"));
  const Result printed = gloam({"run", "hbao+", file("shot.####.exr"), "-o", file("disk/ao.####.exr"), "--radius",
                                "0.5", "-q", "--chunks", "2", "--print"});
  ASSERT_EQ(printed.status, 0) << printed.err;
  std::ofstream(path("list")) << printed.out;
  std::ofstream(path("script")) << R"(
    cd "$1"
    mount -t tmpfs -o size=48k none disk || exit 77
    sed -n 1p list | sh >out 2>first; echo $? >status
    ls -A disk >listing
    for name in $(cat listing); do cmp disk/$name whole.$name || exit 3; done
    mount -o remount,size=16m disk || exit 77
    set -e
    sed -n 2p list | sh >out
    sed -n 1p list | sh >out
    for name in whole.ao.*; do cmp $name disk/${name#whole.}; done
    ls -A disk | wc -l >count
  )";
  const int status = WEXITSTATUS(
      std::system(("unshare -rm bash " + file("script") + " " + folder.string() + " 2>" + file("stderr")).c_str()));
  if (status == 77 || slurp(path("stderr")).find("unshare") != std::string::npos)
    GTEST_SKIP() << "no disk can be mounted: " << slurp(path("stderr"));
  EXPECT_EQ(status, 0) << slurp(path("stderr")) << slurp(path("out"));
  EXPECT_EQ(slurp(path("status")), "1\n");
  const std::string said = slurp(path("first")), listing = slurp(path("listing"));
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
  EXPECT_NE(said.find("No space left on device"), std::string::npos) << said;
  EXPECT_GE(std::count(listing.begin(), listing.end(), '\n'), 1) << listing;
  EXPECT_LT(std::count(listing.begin(), listing.end(), '\n'), 20) << listing;
  EXPECT_EQ(listing.find(".gloam"), std::string::npos) << listing;
  EXPECT_EQ(slurp(path("count")), "40\n");
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST_F(ShotProcess, KeepsToItsMemory) {
  constexpr int size = 1536;  // a frame of 2 planes takes 18 MiB
  for (int number = 1; number <= 12; ++number)
    write_frame(path(numbered("shot", number)), frame_of(number, size, size));
  expect_refused(run_of({"--memory", "170M"}), 1, {"--memory 170M allows 170 MiB", "one frame of the shot would take"});
  for (const int mebibytes : {300, 400, 600}) {
    const pid_t child = start(run_of({"--memory", fmt::format("{}M", mebibytes)}));
    int status = 0;
    rusage usage{};
    wait4(child, &status, 0, &usage);
    EXPECT_EQ(status, 0) << slurp(path("stderr"));
    RecordProperty(fmt::format("peak of {}", mebibytes), int(usage.ru_maxrss / 1024));
    EXPECT_LT(double(usage.ru_maxrss) / 1024, 1.05 * mebibytes);
    EXPECT_EQ(contents().size(), 12u);
  }
}

/// Frames are links to a few files, and each sample is taken with the number of frames that were told as done.
TEST_F(ShotProcess, MemoryDoesNotGrowOverTenThousandFrames) {
  ONLY_IN_LONG_RUN();
  constexpr int frames = 10000;
  walk(20, 0.01, 64, 36);
  for (int i = 1; i <= 20; ++i) fs::rename(path(numbered("shot", i)), path(numbered("link", i)));
  for (int i = 1; i <= frames; ++i) fs::create_hard_link(path(numbered("link", 1 + i % 20)), path(numbered("shot", i)));
  for (const Arguments& more : std::vector<Arguments>{{}, {"--temporal"}}) {
    Arguments command = run_of({"--json", "-"}, "gtao");
    command.insert(command.end(), more.begin(), more.end());
    const std::vector<MemorySample> samples = memory_of(command);
    const double second = mean_memory(samples, frames / 4, frames / 2);
    const double last = mean_memory(samples, 3 * frames / 4, frames);
    RecordProperty(more.empty() ? "second quarter" : "second quarter, temporal", fmt::format("{:.1f} MiB", second));
    RecordProperty(more.empty() ? "last quarter" : "last quarter, temporal", fmt::format("{:.1f} MiB", last));
    EXPECT_GT(second, 10) << "memory was measured";
    EXPECT_LT(last, 1.02 * second);
    EXPECT_EQ(contents().size(), size_t(frames));
    for (const auto& [name, bytes] : contents()) fs::remove(path(name));
  }
}
#endif

}  // namespace
}  // namespace gloam::test::shot_process_test
