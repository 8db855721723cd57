// Sequences: names and numbers of frames, which frames there are, the pipeline, locks.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "base/command_line.h"
#include "camera/camera_list.h"
#include "gloam/frame_numbers.h"
#include "gloam/frame_pattern.h"
#include "sequence/chunks.h"
#include "sequence/frame_list.h"
#include "sequence/frame_locks.h"
#include "sequence/pipeline.h"
#include "unit/message_of.h"

namespace gloam::test::sequence_test {
namespace {

namespace fs = std::filesystem;

class Sequence : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "gloam-sequence-XXXXXX").string();
    folder = mkdtemp(pattern.data());
  }
  void TearDown() override { fs::remove_all(folder); }
  std::string path(const std::string& name) const { return (folder / name).string(); }
  void make(const std::vector<std::string>& names) const {
    for (const std::string& name : names) std::ofstream(folder / name) << name;
  }
  std::vector<FramePattern> patterns(const std::vector<std::string>& names) const {
    std::vector<FramePattern> all;
    for (const std::string& name : names) all.emplace_back(path(name), "FRAME.exr");
    return all;
  }

  fs::path folder;
};

using Numbers = std::vector<int>;

TEST_F(Sequence, NumbersOfFrames) {
  const auto parsed = [](const std::string& text) { return parse_frame_numbers(text, "--frames"); };
  EXPECT_EQ(parsed("7"), (Numbers{7}));
  EXPECT_EQ(parsed("0-3"), (Numbers{0, 1, 2, 3}));
  EXPECT_EQ(parsed("1-10x3"), (Numbers{1, 4, 7, 10}));
  EXPECT_EQ(parsed("1-9x3"), (Numbers{1, 4, 7}));
  EXPECT_EQ(parsed("1,5,9-12"), (Numbers{1, 5, 9, 10, 11, 12}));
  EXPECT_EQ(parsed("9-10,1,9"), (Numbers{1, 9, 10})) << "in order, each once";
  EXPECT_EQ(parsed("0007-0009"), (Numbers{7, 8, 9}));
  for (const char* text :
       {"", "a", "1-", "-1", "3-1", "1-5x0", "1-5x", "1x2", "1,,2", "1,", "1 - 5", "1.5", "+1", "1000000000"}) {
    const std::string message = message_of([&] { parsed(text); });
    EXPECT_EQ(message.rfind(std::string("--frames ") + text, 0), 0u) << text << ": " << message;
  }
  EXPECT_NE(message_of([&] { parsed("0-1000000"); }).find("more than 1000000"), std::string::npos);
}

TEST_F(Sequence, NumbersInWords) {
  EXPECT_EQ(frames_in_words({}), "");
  EXPECT_EQ(frames_in_words({5}), "5");
  EXPECT_EQ(frames_in_words({1, 2, 3, 7, 9, 10}), "1-3, 7, 9-10");
  EXPECT_EQ(frames_in_words({1, 3, 5, 7}, 2), "1, 3 and 2 more");
}

TEST_F(Sequence, PatternsAndTheirFiles) {
  const FramePattern hashes("a/shot.####.exr", "-o"), percent("a/shot.%04d.exr", "-o"), plain("shot.%d.exr", "-o"),
      single("shot_#", "-o");
  EXPECT_EQ(hashes.path_of(7), "a/shot.0007.exr");
  EXPECT_EQ(percent.path_of(7), "a/shot.0007.exr");
  EXPECT_EQ(hashes.path_of(12345), "a/shot.12345.exr");
  EXPECT_EQ(plain.path_of(7), "shot.7.exr");
  EXPECT_EQ(single.path_of(12), "shot_12");
  EXPECT_EQ(hashes.normal_name(), percent.normal_name());
  EXPECT_EQ(plain.folder(), ".");
  EXPECT_EQ(hashes.frame_of("shot.0007.exr"), 7);
  EXPECT_EQ(hashes.frame_of("shot.12345.exr"), 12345);
  for (const char* other : {"shot.007.exr", "shot.00007.exr", "shot.-007.exr", "shot..exr", "shot.0007.exr.bak",
                            "ashot.0007.exr", "shot.000a.exr", "shot.1234567890.exr", "shot.exr", ""})
    EXPECT_FALSE(hashes.frame_of(other)) << other;
  for (const int frame : {0, 1, 999, 10000, last_frame_number})
    EXPECT_EQ(hashes.frame_of(hashes.path_of(frame).filename().string()), frame);
  const std::pair<const char*, const char*> refused[] = {{"shot.exr", "no place"},
                                                         {"v##_shot.####.exr", "several places"},
                                                         {"####/shot.exr", "not of a folder"},
                                                         {"##/shot.####.exr", "not of a folder"},
                                                         {"shot.##########.exr", "9 digits at most"}};
  for (const auto& [text, why] : refused)
    EXPECT_NE(message_of([&, text = text] { FramePattern(text, "-o"); }).find(why), std::string::npos) << text;
}

TEST_F(Sequence, WhatIsAPattern) {
  for (const char* text : {"a.####.exr", "a#.exr", "a.%04d.exr", "a.%d.exr"})
    EXPECT_TRUE(FramePattern::is_pattern(text));
  for (const char* text : {"a.exr", "100%.exr", "a.%4d.exr", "a.%s.exr", ""})
    EXPECT_FALSE(FramePattern::is_pattern(text));
  make({"take#1.exr"});
  EXPECT_FALSE(FramePattern::is_pattern(path("take#1.exr"))) << "a file of the very name";
}

TEST_F(Sequence, FramesThatAreThere) {
  make({"s.0003.exr", "s.0001.exr", "s.0010.exr", "s.10000.exr", "s.2.exr", "t.0001.exr", "s.0004.json"});
  EXPECT_EQ(FramePattern(path("s.####.exr"), "").frames_there(), (Numbers{1, 3, 10, 10000}));
  EXPECT_NE(message_of([&] { FramePattern(path("none/s.####.exr"), "").frames_there(); }).find("none"),
            std::string::npos);
}

std::string numbers_and_sources(const std::vector<SequenceFrame>& frames) {
  std::string words;
  for (const SequenceFrame& frame : frames)
    words += frame.number == frame.source ? fmt::format("{} ", frame.number)
                                          : fmt::format("{}from{} ", frame.number, frame.source);
  return words;
}

TEST_F(Sequence, WhichFramesAreComputed) {
  make({"s.0002.exr", "s.0003.exr", "s.0006.exr", "r.0002.exr", "r.0006.exr"});
  const auto listed = [&](const FrameChoice& choice, const std::vector<std::string>& names = {"s.####.exr"}) {
    std::vector<std::string> notes;
    return numbers_and_sources(list_frames(patterns(names), choice, notes));
  };
  EXPECT_EQ(listed({}), "2 3 6 ");
  EXPECT_EQ(listed({Numbers{3, 6}, {}}), "3 6 ");
  EXPECT_EQ(listed({Numbers{3, 4, 6, 7}, MissingFrames::skip}), "3 6 ");
  EXPECT_EQ(listed({Numbers{3, 4, 6, 7}, MissingFrames::hold}), "3 4from3 6 7from6 ");
  EXPECT_EQ(listed({{}, MissingFrames::hold}), "2 3 4from3 5from3 6 ");
  EXPECT_EQ(listed({Numbers{5}, MissingFrames::hold}), "5from3 ") << "a frame before the range";
  EXPECT_EQ(listed({{}, MissingFrames::skip}, {"s.####.exr", "r.####.exr"}), "2 6 ") << "both eyes";
  EXPECT_EQ(listed({Numbers{2, 3}, MissingFrames::hold}, {"s.####.exr", "r.####.exr"}), "2 3from2 ");
  const auto refused = [&](const FrameChoice& choice, const std::vector<std::string>& names = {"s.####.exr"}) {
    return message_of([&] { listed(choice, names); });
  };
  EXPECT_NE(refused({Numbers{2, 4, 5, 7}, {}}).find("frames 4-5, 7 are missing"), std::string::npos);
  EXPECT_NE(refused({{}, MissingFrames::error}).find("4-5"), std::string::npos);
  EXPECT_NE(refused({{}, {}}, {"s.####.exr", "r.####.exr"}).find("r.0003.exr"), std::string::npos)
      << "one eye lacks it";
  EXPECT_NE(refused({Numbers{1}, MissingFrames::hold}).find("no frame before it"), std::string::npos);
  EXPECT_NE(refused({Numbers{20, 21}, MissingFrames::skip}).find("but 2-3, 6 are"), std::string::npos);
  EXPECT_NE(refused({}, {"none.####.exr"}).find("no file of this pattern"), std::string::npos);
  std::vector<std::string> notes;
  list_frames(patterns({"s.####.exr"}), {}, notes);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("4-5 of 2-6 are not there"), std::string::npos) << notes[0];
}

TEST_F(Sequence, AListOfCameras) {
  const auto list_of = [&](const std::string& text, const Numbers& frames) {
    std::ofstream(folder / "list.json") << text;
    return CameraList::of_file(folder / "list.json", frames);
  };
  const auto by_number = list_of(R"({"fx": 5, "frames": {"7": {"cx": 1}, "8": {"fx": 6}, "9": {}}})", {7, 8});
  ASSERT_TRUE(by_number);
  EXPECT_EQ(by_number->text_of(7), R"({"cx":1,"fx":5})");
  EXPECT_EQ(by_number->text_of(8), R"({"fx":6})");
  const auto in_order = list_of(R"({"frames": [{"fx": 1}, {"fx": 2}]})", {10, 20});
  ASSERT_TRUE(in_order);
  EXPECT_EQ(in_order->text_of(20), R"({"fx":2})");
  EXPECT_FALSE(list_of(R"({"fx": 1})", {1}));
  EXPECT_FALSE(list_of(R"({"frames": 100, "path": []})", {1})) << "a camera path";
  const auto message = [&](const std::string& text, const Numbers& frames) {
    return message_of([&] { list_of(text, frames); });
  };
  EXPECT_NE(message(R"({"frames": [{}, {}]})", {1, 2, 3}).find("cameras for 2 frames, and there are 3"),
            std::string::npos);
  EXPECT_NE(message(R"({"frames": {"1": {}}})", {1, 2, 3}).find("no camera for frames 2-3"), std::string::npos);
  EXPECT_NE(message(R"({"frames": {"1": 5}})", {1}).find("camera of frame 1 is number"), std::string::npos);
  EXPECT_NE(message("{", {1}).find("list.json"), std::string::npos);
}

// --- Pipeline

/// Frames in flight, and the most there were.
class Count {
 public:
  void enter() {
    const int now = ++now_;
    for (int most = most_; now > most && !most_.compare_exchange_weak(most, now);) continue;
  }
  void leave() { --now_; }
  int most() const { return most_; }

 private:
  std::atomic<int> now_{0}, most_{0};
};

void pause_a_little(size_t frame) { std::this_thread::sleep_for(std::chrono::microseconds(100 * (frame % 7))); }

TEST(PipelineOf, FramesKeepsOrderAndBound) {
  for (const PipelineSize size : {PipelineSize{1, 1, 1}, PipelineSize{2, 2, 2}, PipelineSize{5, 3, 2}}) {
    constexpr size_t frames = 60;
    Count in_flight, computing;
    std::vector<size_t> computed;
    std::vector<std::atomic<int>> steps(frames);
    Pipeline pipeline(frames, size,
                      {[&](size_t i) {
                         in_flight.enter();
                         pause_a_little(i);
                         EXPECT_EQ(steps[i]++, 0);
                         return true;
                       },
                       [&](size_t i) {
                         computing.enter();
                         EXPECT_EQ(steps[i]++, 1);
                         computed.push_back(i);
                         computing.leave();
                         return true;
                       },
                       [&](size_t i) {
                         pause_a_little(i * 3);
                         EXPECT_EQ(steps[i]++, 2);
                         in_flight.leave();
                         return true;
                       }});
    pipeline.run();
    ASSERT_EQ(computed.size(), frames);
    EXPECT_TRUE(std::is_sorted(computed.begin(), computed.end()));
    EXPECT_LE(in_flight.most(), int(size.in_flight));
    EXPECT_EQ(computing.most(), 1);
    for (const std::atomic<int>& done : steps) EXPECT_EQ(done, 3);
  }
}

TEST(PipelineOf, FramesThatEndEarlyLetTheOthersGoOn) {
  constexpr size_t frames = 50;
  std::atomic<int> computed{0}, written{0};
  Pipeline pipeline(frames, {2, 2, 1},
                    {[](size_t i) { return i % 3 != 0; },
                     [&](size_t i) {
                       ++computed;
                       return i % 5 != 0;
                     },
                     [&](size_t) {
                       ++written;
                       return false;
                     }});
  pipeline.run();
  EXPECT_EQ(computed, 33);
  EXPECT_EQ(written, 27);
}

TEST(PipelineOf, FramesStopsWhenAskedTo) {
  std::atomic<size_t> begun{0}, written{0};
  std::atomic<bool> has_stopped{false};
  Pipeline* running = nullptr;
  Pipeline pipeline(1000, {4, 2, 2},
                    {[&](size_t) { return ++begun, true; }, [](size_t) { return true; },
                     [&](size_t i) {
                       if (i == 10) running->stop(), has_stopped = true;
                       while (i > 10 && !has_stopped)
                         std::this_thread::yield();  // however long frame 10 waits for a core
                       return ++written, true;
                     }});
  running = &pipeline;
  pipeline.run();
  EXPECT_LT(begun, 30u);
  EXPECT_EQ(written, begun) << "those begun end";
}

TEST(PipelineOf, FramesThrowsWhatAStepThrows) {
  for (const int failing : {0, 1, 2}) {
    std::atomic<int> begun{0};
    const auto step = [&](int which) {
      return [&, which](size_t i) {
        begun += which == 0;
        if (which == failing && i == 5) throw std::runtime_error("five");
        return true;
      };
    };
    Pipeline pipeline(1000, {3, 2, 1}, {step(0), step(1), step(2)});
    EXPECT_THROW(pipeline.run(), std::runtime_error);
    EXPECT_LT(begun, 20);
  }
}

TEST(PipelineOf, NoFrames) {
  Pipeline pipeline(0, {}, {[](size_t) { return true; }, [](size_t) { return true; }, [](size_t) { return true; }});
  pipeline.run();
}

// --- Locks

/// Whether another process can lock frames.
bool another_can_lock(const FramePattern& output, const Numbers& frames) {
  const pid_t child = fork();
  if (child == 0) {
    try {
      const FrameLocks locks(output, frames);
    } catch (const Error&) {
      _exit(1);
    }
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return status == 0;
}

TEST_F(Sequence, LocksAreByFrame) {
  const FramePattern output(path("ao.####.exr"), "-o"), same(path("ao.%04d.exr"), "-o"),
      other(path("b.####.exr"), "-o");
  {
    const FrameLocks locks(output, {1, 2, 3, 10});
    for (const Numbers& frames : {Numbers{1}, Numbers{3, 4}, Numbers{10}, Numbers{5, 10}}) {
      EXPECT_FALSE(another_can_lock(output, frames));
      EXPECT_FALSE(another_can_lock(same, frames));
      EXPECT_TRUE(another_can_lock(other, frames));
    }
    EXPECT_TRUE(another_can_lock(output, {4, 5, 9, 11}));
    EXPECT_TRUE(fs::exists(folder));
    EXPECT_FALSE(fs::is_empty(folder));
  }
  EXPECT_TRUE(another_can_lock(output, {1, 2, 3, 10}));
  EXPECT_TRUE(fs::is_empty(folder)) << "the last to end removes the file";
}

TEST_F(Sequence, LocksEndWithTheirProcess) {
  const FramePattern output(path("ao.####.exr"), "-o");
  const pid_t child = fork();
  if (child == 0) {
    const FrameLocks locks(output, {1});
    _exit(0);  // without a destructor
  }
  waitpid(child, nullptr, 0);
  EXPECT_FALSE(fs::is_empty(folder));
  EXPECT_NO_THROW(FrameLocks(output, {1}));
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST(Chunks, AreEvenAndHoldEachFrameOnce) {
  const Numbers frames = parse_frame_numbers("1-7,9,20-21", "--frames");
  EXPECT_EQ(chunks_of(frames, 3), (std::vector<Numbers>{{1, 2, 3}, {4, 5, 6}, {7, 9, 20, 21}}));
  EXPECT_EQ(chunks_of(frames, 1), std::vector<Numbers>{frames});
  EXPECT_EQ(chunks_of(Numbers{5, 6}, 9), (std::vector<Numbers>{{5}, {6}})) << "no chunk is empty";
  for (const int count : {2, 4, 7, 10}) {
    Numbers all;
    for (const Numbers& chunk : chunks_of(frames, count)) {
      EXPECT_EQ(parse_frame_numbers(frames_as_flag(chunk), "--frames"), chunk);
      all.insert(all.end(), chunk.begin(), chunk.end());
    }
    EXPECT_EQ(all, frames) << count;
  }
  EXPECT_EQ(frames_as_flag({7, 9, 20, 21}), "7,9,20-21");
}

TEST(Chunks, WordsAreReadBackByAShell) {
  EXPECT_EQ(quoted_for_shell("radius=0.5"), "radius=0.5");
  EXPECT_EQ(quoted_for_shell("shot.####.exr"), "'shot.####.exr'");
  EXPECT_EQ(quoted_for_shell("it's $HOME"), "'it'\\''s $HOME'");
  EXPECT_EQ(quoted_for_shell(""), "''");
}

}  // namespace
}  // namespace gloam::test::sequence_test
