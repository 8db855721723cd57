// Links of the written pages lead to an existing file, and if they name a heading, to an existing one.
#include <regex>
#include <set>

#include "cli/gloam_process.h"

namespace gloam::test::links_test {
namespace {

/// A Markdown page without the parts that are not links: fenced blocks, and code within a line.
std::string without_code(const std::string& page) {
  static const std::regex code("`[^`]*`");
  std::istringstream lines(page);
  std::string text;
  bool in_fence = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```"))
      in_fence = !in_fence;
    else if (!in_fence)
      text += std::regex_replace(line, code, "") + "\n";
  }
  return text;
}

/// The anchor that GitHub gives a heading: letters in lower case, blanks as hyphens; of other characters only digits, hyphens and
/// underscores stay. A link in a heading counts as its text.
std::string anchor_of(const std::string& heading) {
  static const std::regex link(R"(\[([^\]]*)\]\([^)]*\))");
  std::string anchor;
  for (const char c : std::regex_replace(heading, link, "$1")) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == ' ') anchor += '-';
    if (std::isalnum(byte) || c == '-' || c == '_' || byte >= 0x80) anchor += static_cast<char>(std::tolower(byte));
  }
  return anchor;
}

/// Of headings with the same text, the second gets "-1" after its anchor, the third "-2".
std::set<std::string> anchors_of(const std::string& page) {
  static const std::regex form(R"(#{1,6} +(.*?) *)");
  std::set<std::string> anchors;
  std::map<std::string, int> seen;
  std::istringstream lines(page);
  bool in_fence = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) in_fence = !in_fence;
    std::smatch heading;
    if (in_fence || !line.starts_with("#") || !std::regex_match(line, heading, form)) continue;
    const std::string anchor = anchor_of(heading[1]);
    const int before = seen[anchor]++;
    anchors.insert(before ? anchor + "-" + std::to_string(before) : anchor);
  }
  return anchors;
}

/// Targets of links and images, without those of other sites.
std::vector<std::string> relative_links(const std::string& page) {
  const std::string text = without_code(page);
  static const std::regex link(R"(\]\(([^)\s]+)[^)]*\))");
  std::vector<std::string> targets;
  for (std::sregex_iterator found(text.begin(), text.end(), link), end; found != end; ++found) {
    const std::string target = (*found)[1];
    if (target.find("://") == std::string::npos && !target.starts_with("mailto:")) targets.push_back(target);
  }
  return targets;
}

/// The fault of a link; empty if there is none.
std::string fault_of(const fs::path& page, const std::string& target) {
  const std::size_t hash = target.find('#');
  const std::string file = target.substr(0, hash);
  const fs::path path = file.empty() ? page : page.parent_path() / file;
  if (!fs::exists(path)) return "there is no " + path.lexically_normal().string();
  if (hash == std::string::npos || anchors_of(slurp(path)).count(target.substr(hash + 1))) return "";
  return path.lexically_normal().string() + " has no heading for #" + target.substr(hash + 1);
}

std::vector<fs::path> pages() {
  const fs::path root = GLOAM_SOURCE_DIR;
  std::vector<fs::path> all{root / "README.md", root / "CONTRIBUTING.md", root / "bench/README.md",
                            root / "data/README.md"};
  for (const auto& entry : fs::directory_iterator(root / "docs"))
    if (entry.path().extension() == ".md") all.push_back(entry.path());
  for (const auto& entry : fs::directory_iterator(root / "kernels"))
    if (fs::exists(entry.path() / "README.md")) all.push_back(entry.path() / "README.md");
  return all;
}

TEST(Links, LeadToAFileAndAHeading) {
  std::size_t links = 0;
  for (const fs::path& page : pages())
    for (const std::string& target : relative_links(slurp(page))) {
      ++links;
      EXPECT_EQ(fault_of(page, target), "") << page.lexically_relative(GLOAM_SOURCE_DIR) << " links to " << target;
    }
  EXPECT_GT(links, 100u) << "the pages hold more links than this test finds";
}

TEST(Links, AnchorsFollowGitHub) {
  EXPECT_EQ(anchor_of("What a plan adds: resolution, masks"), "what-a-plan-adds-resolution-masks");
  EXPECT_EQ(anchor_of("`hbao+`, dp-hbao_2"), "hbao-dp-hbao_2");
  EXPECT_EQ(anchor_of("As [a page](page.md#x)"), "as-a-page");
  EXPECT_EQ(anchors_of("# One\n```\n# code\n```\n## Two\n## Two\n"), (std::set<std::string>{"one", "two", "two-1"}));
}

TEST(Links, ABrokenOneIsFound) {
  const fs::path page = fs::path(GLOAM_SOURCE_DIR) / "docs/architecture.md";
  EXPECT_EQ(relative_links("[a](b.md) ![c](d.png \"title\") `[e](f)` [g](https://h)\n```\n[i](j)\n```\n[k](#l)"),
            (std::vector<std::string>{"b.md", "d.png", "#l"}));
  EXPECT_EQ(fault_of(page, "glossary.md"), "");
  EXPECT_EQ(fault_of(page, "#a-run"), "");
  EXPECT_NE(fault_of(page, "no_such_page.md"), "");
  EXPECT_NE(fault_of(page, "#no-such-heading"), "");
  EXPECT_NE(fault_of(page, "glossary.md#no-such-heading"), "");
}

}  // namespace
}  // namespace gloam::test::links_test
