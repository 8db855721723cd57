// Measurements as a page of documentation: one Markdown file, and sheets of pictures beside it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report/joined.h"
#include "report/needs.h"

namespace gloam::report {

struct MarkdownOptions {
  std::string command;             ///< that makes the page, as it says
  std::filesystem::path page;      ///< where it will be written: links are relative to its folder
  std::filesystem::path pictures;  ///< folder for sheets; empty: none
};

/// A file that goes with the page.
struct PictureFile {
  std::filesystem::path path;
  std::string png;
};

/// What is best for whom, over the scenes of a group.
struct GroupChoices {
  std::string name;
  std::vector<std::string> scenes;
  std::vector<Choice> choices;
};

struct MarkdownPage {
  std::string text;
  std::vector<PictureFile> pictures;
  std::vector<GroupChoices> groups;
  std::vector<std::string> notes;  ///< pictures that could not be had, and why
};

/// Writes nothing. Throws Error where the sources contradict each other (joined.h).
MarkdownPage make_markdown(const std::vector<Source>& sources, const MarkdownOptions& options);

}  // namespace gloam::report
