// gloam run on a shot as a process among others: killed and started again, beside another, in little memory, on a full disk.
#include <chrono>
#include <random>
#include <thread>

#include "cli/shot_fixture.h"
#include "gloam/frame_pattern.h"
#include "sequence/frame_locks.h"

namespace gloam::test {
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

/// At random moments, so each run of the test tries others; a failure tells them.
TEST_F(ShotProcess, KilledAtAnyMomentTheSameCommandGoesOn) {
  std::vector<int> frames;
  for (int number = 1; number <= 24; ++number) frames.push_back(number);
  make_shot(frames);
  const auto start_time = std::chrono::steady_clock::now();
  ASSERT_EQ(run().status, 0);
  const double whole = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_time).count();
  const auto expected = contents();
  ASSERT_EQ(expected.size(), 24u);
  for (const auto& [name, unused] : expected) fs::remove(path(name));
  std::mt19937 random(std::random_device{}());
  std::string moments;
  for (int i = 0; i < 24; ++i) {
    const int ms = std::uniform_int_distribution<int>(0, int(1000 * whole))(random);
    moments += fmt::format("{} ", ms);
    const pid_t child = start(run_of({"--resume"}));
    std::this_thread::sleep_for(std::chrono::milliseconds(ms));
    kill(child, SIGKILL);
    finish(child);
    for (const auto& [name, bytes] : contents())
      EXPECT_TRUE(bytes == expected.at(name)) << name << " after " << moments;
  }
  const Result last = run({"--resume"});
  EXPECT_EQ(last.status, 0) << last.err << moments;
  EXPECT_TRUE(contents() == expected) << moments;
  EXPECT_EQ(hidden_files(), std::vector<std::string>()) << moments;
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
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
  for (const char* words : {"free some space", "--resume", "No space left on device"})
    EXPECT_NE(said.find(words), std::string::npos) << said;
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
#endif

}  // namespace
}  // namespace gloam::test
