#include "exr/holdings.h"

#include <algorithm>

#include "exr/plane_facts.h"
#include "gloam/error.h"
#include "gloam/option.h"

namespace gloam {

std::string first_names(std::vector<std::string> names) {
  const size_t most = 16;
  const std::string rest = names.size() > most ? fmt::format(" and {} more", names.size() - most) : "";
  names.resize(std::min(names.size(), most));
  return fmt::format("{}{}", fmt::join(names, ", "), rest);
}

std::string hint_on_depth(const FrameFile& file) {
  const std::vector<std::string> names = file.all_channels(), planes = file.common_planes();
  if (std::find(planes.begin(), planes.end(), "depth") != planes.end() || unread_channels(file).empty()) return "";
  if (names.size() == 1 && planes.empty())
    return fmt::format("{} takes its only channel for the depth", channels_option("depth", names.front()));
  return fmt::format("{} takes a channel of another name for it, {} makes it of positions",
                     channels_option("depth", "CHANNEL"), channels_option("position", "LAYER"));
}

std::string holdings(const FrameFile& file) {
  const std::vector<std::string> names = file.all_channels();
  const std::string name = file.path().filename().string();
  if (names.empty()) return name + " has no channels";
  const std::string hint = hint_on_depth(file);
  return fmt::format("{} has only {}{}{}", name, first_names(names), hint.empty() ? "" : "; ", hint);
}

std::string holdings(const FrameFiles& files) {
  std::vector<std::string> words;
  for (const FrameFile& file : files.files()) words.push_back(holdings(file));
  return enumerate(words);
}

}  // namespace gloam
