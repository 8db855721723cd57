// Promises about the sources: files of host/ are short or say why not, a .cpp has its own header, and the public headers show no
// library that a program using gloam would then need.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace gloam::test::sources_test {
namespace {

namespace fs = std::filesystem;

constexpr size_t most_lines = 400;
/// Begins the reason in the first comment of a longer file.
const std::string reason = "Long, because ";

/// Folders below host/ whose files are entries of one list, and so have no header of their own.
const std::vector<std::string> without_headers = {"cli/", "python/", "stress/cases/", "scene/built_in/"};

std::vector<std::string> lines_of(const fs::path& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

std::vector<fs::path> files_below(const fs::path& folder, const std::set<std::string>& endings) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && endings.contains(entry.path().extension().string())) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// The leading comment lines.
std::string first_comment(const std::vector<std::string>& lines) {
  const auto is_comment = [](const std::string& line) { return line.starts_with("//"); };
  const auto begin = std::find_if(lines.begin(), lines.end(), is_comment);
  std::string text;
  for (auto line = begin; line != lines.end() && is_comment(*line); ++line) text += *line + "\n";
  return text;
}

/// Files below `host` of more than `most_lines` lines whose first comment gives no reason.
std::vector<std::string> long_without_reason(const fs::path& host) {
  std::vector<std::string> found;
  for (const fs::path& file : files_below(host, {".cpp", ".h", ".js", ".css", ".html"})) {
    const std::vector<std::string> lines = lines_of(file);
    if (lines.size() > most_lines && first_comment(lines).find(reason) == std::string::npos)
      found.push_back(file.lexically_relative(host).generic_string());
  }
  return found;
}

/// Files .cpp below `host` that have no header of their name: neither beside them nor among the public headers of their room.
std::vector<std::string> without_own_header(const fs::path& host) {
  std::vector<std::string> found;
  for (const fs::path& file : files_below(host, {".cpp"})) {
    const std::string name = file.lexically_relative(host).generic_string();
    const auto is_above = [&](const std::string& folder) { return name.starts_with(folder); };
    if (std::any_of(without_headers.begin(), without_headers.end(), is_above)) continue;
    const std::string header = file.stem().string() + ".h";
    const fs::path room = host / name.substr(0, name.find('/'));
    const fs::path folders[] = {file.parent_path(), room / "include/gloam", room / "include/gloam/scene"};
    const auto has_header = [&](const fs::path& folder) { return fs::exists(folder / header); };
    if (std::none_of(std::begin(folders), std::end(folders), has_header)) found.push_back(name);
  }
  return found;
}

/// "FILE:LINE: text" for each line of a public header that includes anything but gloam's public headers, the standard's, glm and
/// fmt, or that names a type of OpenCV, Embree or OpenCL which it does not declare itself.
std::vector<std::string> not_public(const fs::path& include) {
  static const std::regex other_library(R"(#\s*include\s*<(?!glm/|fmt/)[^>]*/.*)");
  static const std::regex internal_header(R"(#\s*include\s*"(?!gloam/).*)");
  static const std::regex type(R"(\b(cv|cl)::|\bRTC[A-Z]\w*|\bcl_[a-z]\w*)");
  static const std::regex declared(R"(typedef struct \w+\* (cl_\w+);)");
  std::vector<std::string> found;
  for (const fs::path& file : files_below(include, {".h"})) {
    const std::vector<std::string> lines = lines_of(file);
    std::string own = "none of its own";
    for (const std::string& line : lines) {
      if (std::smatch match; std::regex_search(line, match, declared)) own += "|" + match[1].str();
    }
    const std::regex own_type("\\b(" + own + ")\\b");
    for (size_t i = 0; i < lines.size(); ++i) {
      const std::string code = std::regex_replace(lines[i].substr(0, lines[i].find("//")), own_type, "");
      if (!std::regex_match(code, other_library) && !std::regex_match(code, internal_header) &&
          !std::regex_search(code, type))
        continue;
      found.push_back(file.lexically_relative(include).generic_string() + ":" + std::to_string(i + 1) + ": " +
                      lines[i]);
    }
  }
  return found;
}

const fs::path host = fs::path(GLOAM_SOURCE_DIR) / "host";

TEST(Sources, FilesOfTheHostAreShortOrSayWhyNot) {
  for (const std::string& file : long_without_reason(host))
    ADD_FAILURE() << "host/" << file << " has more than " << most_lines
                  << " lines: split it by its nouns, or let its first comment say '" << reason << "...'";
}

TEST(Sources, ASourceFileHasItsOwnHeader) {
  for (const std::string& file : without_own_header(host))
    ADD_FAILURE() << "host/" << file
                  << " has no header of its name, neither beside it nor in its room's include/gloam: name "
                  << "both alike, or declare what it defines in a header of its own";
}

TEST(Sources, PublicHeadersShowPublicHeadersOnly) {
  for (const fs::directory_entry& room : fs::directory_iterator(host)) {
    if (!fs::exists(room.path() / "include")) continue;
    for (const std::string& line : not_public(room.path() / "include"))
      ADD_FAILURE()
          << room.path().filename() << "/include/" << line
          << "\nbelongs in a header beside the room's files: programs that use gloam would need what it names";
  }
}

class MadeSources : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "gloam_sources_XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  void TearDown() override { fs::remove_all(folder_); }
  void write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << text;
  }
  static std::string lines(size_t count) {
    std::string text;
    for (size_t i = 0; i < count; ++i) text += "int a;\n";
    return text;
  }
  fs::path folder_;
};

TEST_F(MadeSources, ALongFileIsFoundUnlessItsFirstCommentSaysWhy) {
  write("room/short.cpp", lines(400));
  write("room/long.cpp", lines(401));
  write("room/reason.cpp", "#include \"x.h\"\n// A scene.\n// Long, because it is one.\n" + lines(401));
  write("room/late.h", "// A header.\n" + lines(401) + "// Long, because it is late.\n");
  EXPECT_EQ(long_without_reason(folder_), (std::vector<std::string>{"room/late.h", "room/long.cpp"}));
}

TEST_F(MadeSources, ASourceFileWithoutAHeaderOfItsNameIsFound) {
  for (const char* name :
       {"room/beside.cpp", "room/beside.h", "room/public.cpp", "room/include/gloam/public.h", "scene/rays.cpp",
        "scene/include/gloam/scene/rays.h", "room/elsewhere.cpp", "scene/include/gloam/elsewhere.h", "cli/run.cpp",
        "stress/cases/sizes.cpp", "scene/built_in/hall.cpp", "room/lost.cpp", "other/beside.cpp", "stress/cases.cpp"})
    write(name, lines(1));
  EXPECT_EQ(without_own_header(folder_),
            (std::vector<std::string>{"other/beside.cpp", "room/elsewhere.cpp", "room/lost.cpp", "stress/cases.cpp"}));
}

TEST_F(MadeSources, AHeaderThatShowsWhatIsNotPublicIsFound) {
  write("gloam/good.h", "#include <vector>\n#include \"gloam/frame.h\"\nint opencv2;  // drawn with cv::Mat\n");
  const std::vector<std::string> bad = {
      "#include <opencv2/core.hpp>", "#include <embree3/rtcore.h>", "#include <CL/opencl.hpp>", "# include \"CL/cl.h\"",
      "#include \"run/driver.h\"",   "void show(const cv::Mat&);",  "struct RTCDeviceTy;",      "cl_mem buffer;"};
  std::string text;
  for (const std::string& line : bad) text += line + "\n";
  write("gloam/bad.h", text);
  const std::vector<std::string> found = not_public(folder_);
  ASSERT_EQ(found.size(), bad.size());
  for (size_t i = 0; i < bad.size(); ++i) EXPECT_EQ(found[i], "gloam/bad.h:" + std::to_string(i + 1) + ": " + bad[i]);
}

}  // namespace
}  // namespace gloam::test::sources_test
