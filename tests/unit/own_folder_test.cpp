// Folders of code that is run, and texts of files of anybody in messages and commands.
#include "run/own_folder.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>

#include "base/command_line.h"
#include "base/files.h"
#include "base/json_text.h"
#include "base/words.h"
#include "gloam/error.h"
#include "run/kept_folders.h"
#include "unit/message_of.h"

namespace gloam::test::own_folder_test {
namespace {

namespace fs = std::filesystem;

class OwnFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "gloam-own-XXXXXX").string();
    folder = mkdtemp(pattern.data());
    if (!why_not_ours(folder).empty()) GTEST_SKIP() << "the temporary files lie where others may write";
  }
  void TearDown() override { fs::remove_all(folder); }
  fs::path made(const char* name, mode_t mode) const {
    const fs::path path = folder / name;
    ::mkdir(path.c_str(), 0700);
    ::chmod(path.c_str(), mode);
    return path;
  }
  fs::path folder;
};

TEST_F(OwnFolder, IsOneThatNobodyElseCanWrite) {
  EXPECT_EQ(why_not_ours(made("own", 0755)), "");
  EXPECT_EQ(why_not_ours(made("own", 0755) / "not" / "there"), "");
  const fs::path open = made("open", 0777);
  EXPECT_EQ(why_not_ours(open), open.string() + " can be written by others (mode 777)");
  EXPECT_EQ(why_not_ours(open / "below"), open.string() + " can be written by others (mode 777)");
  fs::create_symlink(open, folder / "link");
  EXPECT_EQ(why_not_ours(folder / "link"), open.string() + " can be written by others (mode 777)");
  // Where all may make files, but not rename those of others, only a folder below is one's own.
  const fs::path shared = made("shared", 01777);
  EXPECT_NE(why_not_ours(shared), "");
  EXPECT_EQ(why_not_ours(shared / "below"), "");
}

TEST_F(OwnFolder, OfAnotherUserIsNone) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can give a folder away";
  const fs::path given = made("given", 0755);
  ASSERT_EQ(::chown(given.c_str(), 65534, 65534), 0);
  EXPECT_NE(why_not_ours(given).find(" belongs to user "), std::string::npos);
  EXPECT_NE(why_not_ours(given / ".cache/pocl/kcache").find(" belongs to user "), std::string::npos);
}

TEST_F(OwnFolder, IsMadeForOneUserAlone) {
  const mode_t before = ::umask(0);
  const bool is_made = make_own_folder(folder / "a/b/c");
  ::umask(before);
  ASSERT_TRUE(is_made);
  EXPECT_EQ(why_not_ours(folder / "a/b/c"), "");
}

TEST_F(OwnFolder, WhatIsNoFileWasNotKept) {
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  std::ofstream(folder / "file") << "text";
  fs::create_symlink("file", folder / "link");
  EXPECT_EQ(kept_text(folder / "file"), "text");
  for (const char* name : {"pipe", "link", "none", "."})
    EXPECT_FALSE(kept_text(folder / name)) << name;  // and waits for none
  make_way(folder / "pipe");
  make_way(folder / "file");
  EXPECT_FALSE(fs::exists(folder / "pipe"));
  EXPECT_TRUE(fs::exists(folder / "file"));
}

/// What a shell makes of a word.
std::string read_back(const std::string& word) {
  const std::string command = "printf '%s' " + quoted_for_shell(word);
  std::FILE* const pipe = ::popen(command.c_str(), "r");
  std::string text;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) text += char(c);
  ::pclose(pipe);
  return text;
}

TEST(WordsOfAnybody, StayOneLineOfACommand) {
  for (const std::string& word :
       {std::string("a b"), std::string("nl\n touch HACKED #"), std::string("it's\t\\ 100 %\x1b[31m $(x) `y` \"z\""),
        std::string("-n\r"), std::string("caf\xe9.exr"), std::string("caf\xc3\xa9.exr"),
        std::string("\xe2\x80\xaeltr")}) {
    const std::string quoted = quoted_for_shell(word);
    EXPECT_EQ(on_one_line(quoted), quoted) << quoted;
    EXPECT_EQ(read_back(word), word) << quoted;
  }
}

TEST(WordsOfAnybody, MessagesAreBounded) {
  const std::string million(1'000'000, 'x');
  EXPECT_EQ(suggestion(million, {"radius", "samples"}), "");
  const Error error("no key '{}'", million);
  EXPECT_LT(std::string(error.what()).size(), 4100u);
  EXPECT_NE(std::string(error.what()).find("bytes left out"), std::string::npos);
  EXPECT_EQ(shortened("short", 100), "short");
  const std::string accents = shortened(std::string(1000, 'a') + "\xc3\xa9\xc3\xa9", 80);
  EXPECT_EQ(on_one_line(accents), accents);
}

TEST(WordsOfAnybody, JsonIsRefusedInOneShortLine) {
  const auto says = [](const std::string& text) { return message_of([&] { ordered_json_of_text(text, "a.json"); }); };
  for (const std::string& text :
       {"{\"" + std::string(1'000'000, 'k'), std::string("{\"a\": 1e999}"), std::string("\"\\ud800\"")}) {
    const std::string message = says(text);
    EXPECT_EQ(message.rfind("a.json: is not JSON: ", 0), 0u) << message;
    EXPECT_LT(message.size(), 400u);
    EXPECT_EQ(message.find("json.exception"), std::string::npos) << message;
  }
  std::string keys = "{";
  for (int i = 0; i <= 10'000; ++i) keys += fmt::format("{}\"k{}\": 0", i ? ", " : "", i);
  EXPECT_NE(says(keys + "}").find("more than 10000 keys"), std::string::npos);
  EXPECT_NE(says(std::string(1000, '[')).find("levels deep"), std::string::npos);
}

}  // namespace
}  // namespace gloam::test::own_folder_test
