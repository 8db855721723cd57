// Frames in memory, the table of planes, messages, and files that exist whole or not at all.
#include "gloam/frame.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>

#include "base/files.h"
#include "base/page_pool.h"
#include "gloam/error.h"
#include "gloam/planes.h"

namespace gloam::frame_test {
namespace {

using namespace gloam;
namespace fs = std::filesystem;

/// A folder that is removed after the test.
struct Folder {
  fs::path path;
  Folder() {
    std::string name = (fs::temp_directory_path() / "gloam_frame_XXXXXX").string();
    path = ::mkdtemp(name.data());
  }
  ~Folder() { fs::remove_all(path); }
  size_t count() const { return size_t(std::distance(fs::directory_iterator(path), {})); }
};

void put(const fs::path& path, const std::string& text) { std::ofstream(path) << text; }

TEST(Frame, WithoutPlanesHasAllElse) {
  Frame frame{.display = {0, 0, 4, 3},
              .window = {-1, 0, 5, 3},
              .views = {},
              .pixel_aspect = 1.5,
              .attributes = {{"gloamScene", "fence"}},
              .numbers = {{"aoRadius", 0.5}},
              .assumed = {"a sentence"}};
  View& view = frame.views.emplace_back();
  view.name = "left";
  view.camera = Camera{.fx = 10, .fy = 11, .cx = 2, .cy = 1};
  view.camera_before = Camera{.fx = 12, .fy = 11, .cx = 2, .cy = 1};
  view.origin = {1, 2, 3};
  view.planes["depth"].name = "depth";
  const Frame copy = without_planes(frame);
  EXPECT_TRUE(copy.display == frame.display && copy.window == frame.window);
  EXPECT_EQ(copy.pixel_aspect, 1.5);
  EXPECT_EQ(copy.attributes, frame.attributes);
  EXPECT_EQ(copy.numbers, frame.numbers);
  EXPECT_EQ(copy.assumed, frame.assumed);
  ASSERT_EQ(copy.views.size(), 1u);
  EXPECT_EQ(copy.views[0].name, "left");
  EXPECT_EQ(copy.views[0].camera->fx, 10);
  EXPECT_EQ(copy.views[0].camera_before->fx, 12);
  EXPECT_EQ(copy.views[0].origin, view.origin);
  EXPECT_TRUE(copy.views[0].planes.empty());
}

TEST(Layout, PitchIsAMultipleOf16AndRowsAreApart) {
  const Layout layout(17, 3);
  EXPECT_EQ(layout.pitch, 32);
  EXPECT_EQ(layout.index(0, 0), size_t(Layout::guard));
  EXPECT_EQ(layout.index(0, 1) - layout.index(0, 0), 32u);
  EXPECT_EQ(layout.count(), 3u * 32 + 2 * Layout::guard);
}

TEST(Channel, IsPageAligned) {
  for (int width : {1, 17, 1000}) EXPECT_EQ(reinterpret_cast<uintptr_t>(Channel(Layout(width, 5)).data()) % 4096, 0u);
}

TEST(Channel, FillPaddingLeavesTheImageAlone) {
  Channel channel(Layout(17, 3), 1);
  channel.fill_padding(9);
  int image = 0, padding = 0;
  for (size_t i = 0; i < channel.layout().count(); ++i) (channel.data()[i] == 1 ? image : padding) += 1;
  EXPECT_EQ(image, 17 * 3);
  EXPECT_EQ(padding, int(channel.layout().count()) - 17 * 3);
  EXPECT_EQ(channel.at(16, 2), 1);
  EXPECT_EQ(channel.row(2)[17], 9);
}

TEST(Channel, CloneIsIndependent) {
  Channel channel(Layout(4, 4), 2);
  Channel copy = channel.clone();
  copy.at(1, 1) = 5;
  EXPECT_EQ(channel.at(1, 1), 2);
  EXPECT_EQ(copy.at(0, 0), 2);
  EXPECT_EQ(Channel().clone().data(), nullptr);
}

TEST(Channel, ImpossibleSizeThrows) { EXPECT_THROW(Channel(Layout(1 << 30, 1 << 30)), std::bad_alloc); }

TEST(Frame, UnknownViewNamesThoseThereAre) {
  Frame frame;
  frame.views.resize(2);
  frame.views[0].name = "left";
  frame.views[1].name = "right";
  EXPECT_EQ(&frame.view("right"), &frame.views[1]);
  try {
    frame.view("middle");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("'left' and 'right'"), std::string::npos);
  }
}

TEST(Planes, TableIsConsistent) {
  std::set<std::string> names, channels;
  for (const PlaneKind& kind : plane_kinds()) {
    EXPECT_TRUE(names.insert(kind.name).second) << kind.name;
    EXPECT_EQ(kind.components.size(), kind.channels.size()) << kind.name;
    for (const std::string& channel : kind.channels) EXPECT_TRUE(channels.insert(channel).second) << channel;
    EXPECT_FALSE(kind.help.empty());
    EXPECT_EQ(kind.meaning == PlaneKind::view_depth, is_background(kind.outside)) << kind.name;
  }
}

TEST(Planes, EveryChannelIsInTheTableForReaders) {
  const std::string page = read_text(fs::path(GLOAM_SOURCE_DIR) / "docs/gbuffer.md");
  std::set<std::string> rows;
  std::istringstream lines(page.substr(page.find("| plane | channels |")));
  for (std::string line; std::getline(lines, line) && line.starts_with("|");) {
    std::istringstream words(line);
    for (std::string word; words >> word;) {
      std::erase_if(word, [](char c) { return c == '`' || c == ','; });
      rows.insert(word);
    }
  }
  for (const PlaneKind& kind : plane_kinds()) {
    EXPECT_TRUE(rows.count(kind.name)) << kind.name;
    for (const std::string& channel : kind.channels) EXPECT_TRUE(rows.count(channel)) << channel;
  }
}

TEST(Planes, DepthLayersAndUnknownNames) {
  EXPECT_EQ(plane_kind("peel.00").channels, std::vector<std::string>{"peel.00.Z"});
  EXPECT_EQ(plane_kind("stochastic.12").meaning, PlaneKind::view_depth);
  EXPECT_EQ(plane_kind("ao").outside, 1);
  EXPECT_EQ(plane_kind("curvature").channels, std::vector<std::string>{"curvature"});
  EXPECT_EQ(plane_kind("peel.x").channels, std::vector<std::string>{"peel.x"});
}

TEST(Messages, SuggestionIsNearOrAbsent) {
  EXPECT_EQ(suggestion("depht", {"normal", "depth"}), " (did you mean 'depth'?)");
  EXPECT_EQ(suggestion("HBAO", {"hbao", "ssao"}), " (did you mean 'hbao'?)");
  EXPECT_EQ(suggestion("zebra", {"normal", "depth"}), "");
  EXPECT_EQ(suggestion("x", {}), "");
  EXPECT_EQ(suggestion("--tol", {"--fov"}), "") << "one letter of three is the same";
}

TEST(Messages, SuggestionCompletesWhatIsCutShort) {
  EXPECT_EQ(suggestion("--rad", {"--ray", "--radius"}), " (did you mean '--radius'?)");
  EXPECT_EQ(suggestion("--out", {"--outputs", "--output"}), " (did you mean '--output'?)");
  EXPECT_EQ(suggestion("back", {"depth", "back_depth"}), " (did you mean 'back_depth'?)");
  EXPECT_EQ(suggestion("--r", {"--radius"}), "") << "one letter is no start";
  EXPECT_EQ(suggestion("--", {"--radius"}), "");
}

TEST(Messages, NoSuggestionForNumbers) {
  EXPECT_EQ(suggestion("1", {"2", "a"}), "");
  EXPECT_EQ(suggestion("-12", {"-1", "-123"}), "");
  EXPECT_EQ(suggestion("", {"a"}), "");
}

TEST(Messages, NothingReachesTheTerminalRaw) {
  EXPECT_EQ(printable("a\x1b[31mb\n\t\x7f"), "a\\x1b[31mb\\x0a\\x09\\x7f");
  EXPECT_EQ(printable("Größe 深度 \U0001f600"), "Größe 深度 \U0001f600");
  EXPECT_EQ(printable("\xff\xc3"), "\\xff\\xc3");                             // no UTF-8, and cut short
  EXPECT_EQ(printable("\xc0\x8a\xed\xa0\x80"), "\\xc0\\x8a\\xed\\xa0\\x80");  // overlong newline, surrogate
  EXPECT_EQ(printable("\xc2\x9b"), "\\xc2\\x9b");                             // CSI in one character
  EXPECT_EQ(printable(printable("a\n")), printable("a\n"));
  EXPECT_STREQ(Error("no view '{}'", "a\x1b\n").what(), "no view 'a\\x1b\\x0a'");
  EXPECT_STREQ(UsageError(std::string("a\nb")).what(), "a\\x0ab");
}

TEST(Messages, Enumerate) {
  EXPECT_EQ(enumerate({}), "");
  EXPECT_EQ(enumerate({"a"}), "a");
  EXPECT_EQ(enumerate({"a", "b", "c"}), "a, b and c");
}

TEST(Messages, ExitStatus) {
  EXPECT_EQ(Error("x").exit_status(), 1);
  EXPECT_EQ(UsageError("x").exit_status(), 2);
}

TEST(WriteAtomically, ReplacesTheFile) {
  Folder folder;
  put(folder.path / "out.txt", "old");
  write_atomically(folder.path / "out.txt", [](NewFile& file) { file.append("new"); });
  EXPECT_EQ(read_text(folder.path / "out.txt"), "new");
  EXPECT_EQ(folder.count(), 1u);
}

TEST(WriteAtomically, FailureLeavesTheOldFileAndNothingElse) {
  Folder folder;
  const fs::path path = folder.path / "out.txt";
  put(path, "old");
  try {
    write_atomically(path, [](NewFile& file) {
      file.append("half");
      throw std::runtime_error("no space\nleft");
    });
    FAIL();
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_TRUE(message.starts_with(path.string())) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
    EXPECT_EQ(message.find(".gloam-"), std::string::npos) << "the temporary name means nothing to the user";
  }
  EXPECT_EQ(read_text(path), "old");
  EXPECT_EQ(folder.count(), 1u);
}

TEST(WriteAtomically, RefusesWhatCannotBeWritten) {
  Folder folder;
  put(folder.path / "file", "x");
  auto never = [](NewFile&) { FAIL() << "called"; };
  EXPECT_THROW(write_atomically(folder.path / "file" / "out.txt", never), Error);  // a file in place of a folder
  EXPECT_THROW(write_atomically(folder.path / "missing" / "out.txt", never), Error);
  EXPECT_THROW(write_atomically(folder.path, never), Error);
  EXPECT_THROW(write_atomically("/dev/null", never), Error);
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(WriteAtomically, LongNamesAndEmptyOnes) {
  Folder folder;
  const auto write = [](NewFile& file) { file.append("new"); };
  const fs::path longest = folder.path / (std::string(251, 'n') + ".png");
  write_atomically(longest, write);
  EXPECT_EQ(read_text(longest), "new");
  EXPECT_EQ(folder.count(), 1u);
  EXPECT_THROW(write_atomically(folder.path / (std::string(252, 'n') + ".png"), write), Error);
  try {
    write_atomically("", write);
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "an empty path cannot be written");
  }
}

TEST(WriteAtomically, StrangeNamesStayOutOfMessages) {
  Folder folder;
  try {
    const fs::path path = folder.path / "a\x1b\n.txt";
    write_atomically(path, [&](NewFile&) { throw Error("{}: no space", path.string()); });
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.what(), (folder.path / "a\\x1b\\x0a.txt").string() + ": no space");
  }
}

TEST(WriteAtomically, SymbolicLinkStaysOne) {
  Folder folder;
  put(folder.path / "real", "old");
  fs::create_symlink("real", folder.path / "link");
  write_atomically(folder.path / "link", [](NewFile& file) { file.append("new"); });
  EXPECT_TRUE(fs::is_symlink(folder.path / "link"));
  EXPECT_EQ(read_text(folder.path / "real"), "new");
}

TEST(WriteAtomically, ALinkToNothingIsWrittenThrough) {
  Folder folder;
  fs::create_directory(folder.path / "elsewhere");
  fs::create_symlink("link2", folder.path / "link");
  fs::create_symlink("elsewhere/real", folder.path / "link2");
  write_atomically(folder.path / "link", [](NewFile& file) { file.append("new"); });
  EXPECT_TRUE(fs::is_symlink(folder.path / "link"));
  EXPECT_TRUE(fs::is_symlink(folder.path / "link2"));
  EXPECT_EQ(read_text(folder.path / "elsewhere" / "real"), "new");
  fs::create_symlink("round", folder.path / "round");
  EXPECT_THROW(write_atomically(folder.path / "round", [](NewFile& file) { file.append("new"); }), Error);
  fs::create_symlink("missing/real", folder.path / "lost");
  EXPECT_THROW(write_atomically(folder.path / "lost", [](NewFile& file) { file.append("new"); }), Error);
}

mode_t permissions_of(const fs::path& path) {
  struct stat about {};
  EXPECT_EQ(::stat(path.c_str(), &about), 0);
  return about.st_mode & 07777;
}

TEST(WriteAtomically, AReplacedFileKeepsItsPermissionsAndANewOneObeysTheMask) {
  Folder folder;
  const mode_t before = ::umask(027);
  for (const mode_t mode : {0600, 0640, 0666, 0755}) {
    put(folder.path / "out.txt", "old");
    fs::permissions(folder.path / "out.txt", fs::perms(mode));
    write_atomically(folder.path / "out.txt", [&](NewFile& file) {
      for (const auto& entry : fs::directory_iterator(folder.path))
        EXPECT_EQ(permissions_of(entry.path()) & ~mode, 0u) << "open to others while it is written";
      file.append("new");
    });
    EXPECT_EQ(permissions_of(folder.path / "out.txt"), mode);
  }
  write_atomically(folder.path / "new.txt", [](NewFile& file) { file.append("new"); });
  EXPECT_EQ(permissions_of(folder.path / "new.txt"), mode_t(0640));
  ::umask(before);
}

/// Files that another process with the same number left behind, or has open.
TEST(WriteAtomically, FilesThatOthersLeftAreNotTouched) {
  Folder folder;
  std::vector<fs::path> others;
  for (int number = 0; number < 64; ++number) {
    for (const std::string& extension : {std::string(), std::string(".txt")}) {
      others.push_back(folder.path / fmt::format(".gloam-{}-{}{}", ::getpid(), number, extension));
      put(others.back(), "another's");
    }
  }
  write_atomically(folder.path / "out.txt", [](NewFile& file) { file.append("new"); });
  EXPECT_THROW(write_atomically(folder.path / "out.txt", [](NewFile&) { throw std::runtime_error("no"); }), Error);
  EXPECT_EQ(read_text(folder.path / "out.txt"), "new");
  for (const fs::path& other : others) EXPECT_EQ(read_text(other), "another's") << other;
  EXPECT_EQ(folder.count(), others.size() + 1);
}

/// A process that is killed leaves its temporary; it is removed once nobody writes to it.
TEST(WriteAtomically, LeftoversOfKilledProcessesAreRemoved) {
  Folder folder;
  const pid_t child = ::fork();
  if (child == 0) {
    write_atomically(folder.path / "out.txt", [](NewFile& file) {
      file.append("half");
      ::kill(::getpid(), SIGKILL);
    });
    ::_exit(0);
  }
  ::waitpid(child, nullptr, 0);
  put(folder.path / ".gloam-notes", "the user's");
  EXPECT_EQ(folder.count(), 2u);
  write_atomically(folder.path / "out.txt", [&](NewFile& file) {
    file.append("whole");
    EXPECT_EQ(remove_leftovers(folder.path), 1) << "the one being written stays";
  });
  EXPECT_EQ(read_text(folder.path / "out.txt"), "whole");
  EXPECT_EQ(remove_leftovers(folder.path), 0);
  EXPECT_EQ(folder.count(), 2u);
  EXPECT_EQ(remove_leftovers(folder.path / "none"), 0);
}

TEST(PageReuse, GivesThePagesOfFreedImagesAgain) {
  const Layout layout(640, 480);
  const float* first = nullptr;
  {
    const PageReuse reuse(4 * layout.bytes());
    first = Channel(layout).data();
    EXPECT_EQ(Channel(layout).data(), first);
    const Channel one(layout), two(layout);
    EXPECT_NE(one.data(), two.data());
    EXPECT_EQ(Channel(Layout(64, 48)).layout().width, 64) << "another size";
  }
  EXPECT_TRUE(Channel(layout, 1.0f).at(5, 5) == 1.0f) << "and without reuse";
}

TEST(WriteAtomically, TheCauseOfAFailedWriteIsNamed) {
  Folder folder;
  try {
    write_atomically(folder.path / "out.png", [](NewFile& file) {
      ::rlimit limit{};
      ::getrlimit(RLIMIT_FSIZE, &limit);
      const ::rlimit little{16, limit.rlim_max};
      ::signal(SIGXFSZ, SIG_IGN);
      ::setrlimit(RLIMIT_FSIZE, &little);
      const std::string bytes(1000, 'x');
      try {
        file.append(bytes);
      } catch (...) {
        ::setrlimit(RLIMIT_FSIZE, &limit);
        throw;
      }
      ::setrlimit(RLIMIT_FSIZE, &limit);
    });
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.what(), (folder.path / "out.png").string() + ": cannot write: File too large");
  }
  EXPECT_EQ(folder.count(), 0u);
}

TEST(WriteAtomically, SignalRemovesTheTemporary) {
  for (int signal : {SIGHUP, SIGINT, SIGTERM}) {
    Folder folder;
    put(folder.path / "out.txt", "old");
    const pid_t child = ::fork();
    if (child == 0) {
      ::close(STDERR_FILENO);
      remove_temporaries_on_signal();
      write_atomically(folder.path / "out.txt", [&](NewFile& file) {
        file.append("half");
        ::raise(signal);
      });
      ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 128 + signal);
    EXPECT_EQ(folder.count(), 1u);
    EXPECT_EQ(read_text(folder.path / "out.txt"), "old");
  }
}

/// Standard error of a process that writes `before` files and gets a signal while it writes one more.
std::string said_on_signal(int signal, int before) {
  Folder folder;
  int ends[2];
  EXPECT_EQ(::pipe(ends), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    ::dup2(ends[1], STDERR_FILENO);
    ::signal(signal, SIG_DFL);
    remove_temporaries_on_signal();
    for (int i = 0; i < before; ++i)
      write_atomically(folder.path / std::to_string(i), [](NewFile& file) { file.append("whole"); });
    write_atomically(folder.path / "out.txt", [&](NewFile& file) {
      file.append("half");
      ::raise(signal);
    });
    ::_exit(0);
  }
  ::close(ends[1]);
  std::string said;
  char bytes[256];
  for (ssize_t got; (got = ::read(ends[0], bytes, sizeof bytes)) > 0;) said.append(bytes, size_t(got));
  ::close(ends[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 128 + signal);
  EXPECT_EQ(folder.count(), size_t(before));
  return said;
}

TEST(WriteAtomically, TheMessageOnASignalIsTrue) {
  EXPECT_EQ(said_on_signal(SIGTERM, 0), "gloam: interrupted; no output was written\n");
  EXPECT_EQ(said_on_signal(SIGHUP, 1), "gloam: interrupted; already written: 1 file(s)\n");
  EXPECT_EQ(said_on_signal(SIGINT, 12), "gloam: interrupted; already written: 12 file(s)\n");
}

TEST(WriteAtomically, IgnoredSignalsStayIgnoredAndAFileTooLargeIsAnError) {
  Folder folder;
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(SIGHUP, SIG_IGN);  // as under nohup
    ::signal(SIGXFSZ, SIG_DFL);
    remove_temporaries_on_signal();
    ::raise(SIGHUP);
    ::raise(SIGXFSZ);
    ::_exit(7);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 7);
}

TEST(ReadText, NamesWhatItCannotRead) {
  Folder folder;
  EXPECT_THROW(read_text(folder.path), Error);
  try {
    read_text(folder.path / "missing.json");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("missing.json"), std::string::npos);
  }
}

}  // namespace

}  // namespace gloam::frame_test
