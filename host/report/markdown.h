// Measurements as a page of documentation: one Markdown file, and sheets of pictures beside it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report/needs.h"
#include "results/joined.h"

namespace gloam::report {

struct MarkdownOptions {
  std::string command;             ///< the command that makes the page, as printed on it
  std::filesystem::path page;      ///< where it will be written: links are relative to its folder
  std::filesystem::path pictures;  ///< folder for sheets; empty: none
};

/// A file that goes with the page.
struct PictureFile {
  std::filesystem::path path;
  std::string png;
};

/// The best settings for each need, over the scenes of a group.
struct GroupChoices {
  std::string name;
  std::vector<std::string> scenes;
  std::vector<Choice> choices;
};

struct MarkdownPage {
  std::string text;
  std::vector<PictureFile> pictures;
  std::vector<GroupChoices> groups;
  std::vector<std::string> notes;  ///< missing pictures, and why
};

/// Makes the page in memory. Throws Error if the sources contradict each other (joined.h).
MarkdownPage make_markdown(const std::vector<Source>& sources, const MarkdownOptions& options);

}  // namespace gloam::report
