#include "exr/image_names.h"

#include <algorithm>

#include "base/lists.h"
#include "base/words.h"
#include "exr/channel_spellings.h"
#include "gloam/error.h"
#include "gloam/option.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;

/// The names in a file's name, in lower case: "scene_WorldNormal-0001" has "scene", "world", "normal", "worldnormal".
std::vector<std::string> words_in(const std::string& stem) {
  std::vector<std::string> words;
  std::string word, joined;
  bool was_lower = false;
  const auto end_word = [&] {
    if (!word.empty()) words.push_back(lower(word));
    word.clear();
  };
  const auto end_piece = [&] {
    end_word();
    if (!joined.empty()) words.push_back(lower(joined));
    joined.clear();
  };
  for (const char c : stem) {
    const bool is_upper = c >= 'A' && c <= 'Z', is_letter = is_upper || (c >= 'a' && c <= 'z');
    if (!is_letter) {
      end_piece();
    } else {
      if (is_upper && was_lower) end_word();
      word += c, joined += c;
    }
    was_lower = is_letter && !is_upper;
  }
  end_piece();
  return words;
}

/// Words of planes in file names besides those that channels are called by.
std::string plane_of_word(const std::string& word) {
  static const std::vector<std::pair<const char*, const char*>> more = {
      {"colour", "color"}, {"rough", "roughness"}, {"zbuffer", "depth"}};
  for (const auto& [name, plane] : more)
    if (word == name) return plane;
  constexpr size_t shortest = 2;  // "n", "p" and "c" end many names
  if (word.size() < shortest) return "";
  for (const channel_names::Spelling& spelling : channel_names::spellings())
    if (spelling.layer == word && spelling.plane != "backdrop") return spelling.plane;  // "env.hdr" is a map of light
  return "";
}

}  // namespace

std::string plane_in_file_name(const fs::path& file) {
  const std::vector<std::string> words = words_in(file.stem().string());
  for (auto word = words.rbegin(); word != words.rend(); ++word)
    if (const std::string plane = plane_of_word(*word); !plane.empty()) return plane;
  return "";
}

bool is_named_for_disparities(const fs::path& file) {
  const std::vector<std::string> words = words_in(file.stem().string());
  return std::any_of(words.begin(), words.end(),
                     [](const std::string& word) { return word == "disp" || word == "disparity"; });
}

void take_name_of_depth(const fs::path& file, ReadOptions& options, std::vector<std::string>& notes) {
  if (options.depth != DepthConvention::automatic || !is_named_for_disparities(file)) return;
  options.depth = DepthConvention::inverse;
  notes.push_back(fmt::format("depth: {} is taken as inverse, since its name speaks of disparities; {} says otherwise",
                              file.filename().string(), option("depth", "z")));
}

void take_space_in_name(const fs::path& file, ReadOptions& options) {
  if (options.normals.space != NormalSpace::automatic) return;
  std::vector<std::string> words = words_in(file.stem().string());
  const size_t single = words.size();
  for (size_t i = 0; i + 1 < single; ++i) words.push_back(words[i] + words[i + 1]);
  for (const channel_names::Spelling& spelling : channel_names::spellings()) {
    if (spelling.plane != "normal" || !contains(words, spelling.layer)) continue;
    if (spelling.said == DeclaredConvention::world_space) options.normals.space = NormalSpace::world;
    if (spelling.said == DeclaredConvention::view_space) options.normals.space = NormalSpace::view;
  }
}

}  // namespace gloam
