#include "score/submitted_files.h"

#include <algorithm>
#include <cctype>

#include "base/lists.h"
#include "gloam/error.h"
#include "score/entry.h"
#include "score/stored_image.h"

namespace gloam::score {
namespace {

namespace fs = std::filesystem;

/// Takes ".0007" from the front of a name's rest; 0 where there is no number, -1 for one that is too long.
int take_number(std::string& rest) {
  size_t end = 1;
  while (end < rest.size() && std::isdigit(static_cast<unsigned char>(rest[end]))) ++end;
  if (rest.empty() || rest[0] != '.' || end == 1) return 0;
  const std::string digits = rest.substr(1, end - 1);
  rest.erase(0, end);
  return digits.size() > 9 ? -1 : std::stoi(digits);
}

/// The same at the end, as the truths of sets have it: "walk_ao.0007".
int take_last_number(std::string& rest) {
  const size_t dot = rest.rfind('.');
  if (dot == std::string::npos) return 0;
  std::string end = rest.substr(dot);
  const int number = take_number(end);
  if (number != 0 && end.empty()) rest.resize(dot);
  return end.empty() ? number : 0;
}

/// Takes "_specular_occlusion" from the end; else the usual effect.
std::string take_effect(std::string& rest, const std::string& usual) {
  for (const std::string& effect : scored_effects()) {
    if (!rest.ends_with("_" + effect)) continue;
    rest.resize(rest.size() - effect.size() - 1);
    return effect;
  }
  return usual;
}

std::optional<NamedFile> parsed(const std::string& stem, const Target& target, const std::string& effect) {
  if (!stem.starts_with(target.name)) return {};
  std::string rest = stem.substr(target.name.size());
  NamedFile named{target.name, "", "", take_number(rest)};
  if (named.frame == 0) named.frame = take_last_number(rest);
  named.effect = take_effect(rest, effect);
  if (named.frame < 0) return {};
  if (rest.empty()) return named;
  if (rest[0] != '_' || !contains(target.views, rest.substr(1))) return {};
  named.view = rest.substr(1);
  return named;
}

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (is_image_name(entry->path()) && entry->path().filename().string()[0] != '.') files.push_back(entry->path());
  }
  if (error) throw Error("{}: cannot be read ({})", folder.string(), error.message());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

std::optional<NamedFile> parse_image_name(const std::string& stem, const std::vector<Target>& targets,
                                          const std::string& effect) {
  std::optional<NamedFile> longest;
  for (const Target& target : targets) {
    const auto named = parsed(stem, target, effect);
    if (named && (!longest || named->item.size() > longest->item.size())) longest = named;
  }
  return longest;
}

void SubmittedFiles::add(const fs::path& path, const std::vector<Target>& targets, const std::string& effect) {
  if (const auto named = parse_image_name(path.stem().string(), targets, effect))
    files_.emplace_back(*named, path);
  else
    unknown_.push_back(path);
}

SubmittedFiles::SubmittedFiles(const std::vector<std::string>& paths, const std::vector<Target>& targets,
                               const std::string& effect) {
  for (const std::string& path : paths) {
    std::error_code unknown;
    if (fs::is_directory(path, unknown)) {
      const std::vector<fs::path> files = files_in(path);
      if (files.empty()) throw Error("{}: holds no image; .exr and .png files are read", path);
      for (const fs::path& file : files) add(file, targets, effect);
    } else if (!fs::exists(path, unknown)) {
      throw Error("{}: is not there; name a folder of images, or images", path);
    } else if (!is_image_name(path)) {
      throw Error("{}: is no image; .exr and .png files are read", path);
    } else {
      add(path, targets, effect);
    }
  }
}

std::vector<SubmittedFile> SubmittedFiles::files_of(const Target& target, int frame) const {
  std::vector<SubmittedFile> of_all, of_views;
  for (const auto& [named, path] : files_) {
    const bool is_frame = target.is_sequence ? named.frame == frame : named.frame == 0 || named.frame == frame;
    if (named.item != target.name || named.effect != target.effect || !is_frame) continue;
    (named.view.empty() ? of_all : of_views).push_back({path, named.view});
  }
  if (of_all.size() > 1)
    throw Error("{} and {} are both for {}; leave one of them out", of_all[0].path.string(), of_all[1].path.string(),
                target.in_words(frame));
  return of_all.empty() ? of_views : of_all;
}

bool SubmittedFiles::has(const Target& target) const {
  return std::any_of(files_.begin(), files_.end(), [&](const auto& file) {
    return file.first.item == target.name && file.first.effect == target.effect;
  });
}

std::vector<std::string> SubmittedFiles::effects() const {
  std::vector<std::string> effects;
  for (const auto& file : files_) add_new(effects, file.first.effect);
  return effects;
}

std::string SubmittedFiles::name_for(const Target& target, int frame) {
  return target.name + (target.is_sequence ? fmt::format(".{:04}", frame) : "") + "_" + target.effect + ".exr";
}

}  // namespace gloam::score
