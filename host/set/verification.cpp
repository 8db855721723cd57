#include "set/verification.h"

#include <algorithm>

#include "base/lists.h"
#include "gloam/error.h"
#include "set/content_hash.h"
#include "set/recipe.h"

namespace gloam::sets {
namespace {

namespace fs = std::filesystem;

const Recipe& recipe_for(const fs::path& folder, const Manifest& manifest) {
  if (const Recipe* recipe = recipe_named(manifest.set)) return *recipe;
  throw Error(
      "{}: holds the set '{}', made by gloam {}, and this gloam knows {}: verify it with that version, or make another",
      (folder / "manifest.json").string(), manifest.set, manifest.gloam, enumerate(recipe_names()));
}

std::vector<SetFile> files_of(const Manifest& manifest) {
  std::vector<SetFile> files;
  for (const SetItem& item : manifest.items) {
    const std::vector<SetFile> own = files_of(item);
    files.insert(files.end(), own.begin(), own.end());
  }
  return files;
}

/// What is wrong with a file; empty if nothing is.
std::string wrong_with(const fs::path& folder, const SetFile& file, const std::string& frozen) {
  std::error_code unknown;
  if (!fs::exists(folder / file.file, unknown)) return "is missing";
  std::string hash;
  try {
    hash = content_hash(folder / file.file);
  } catch (const Error& error) {
    return fmt::format("cannot be read: {}", error.what());
  }
  if (hash != file.sha256)
    return fmt::format("was changed: its content has the hash {}, and the manifest says {}", hash, file.sha256);
  if (!frozen.empty() && hash != frozen)
    return fmt::format("is of another version of the set: its content has the hash {}, and the frozen one is {}", hash,
                       frozen);
  return "";
}

void find_extra_files(const fs::path& folder, const std::vector<SetFile>& known, std::vector<Problem>& problems) {
  std::vector<std::string> extra;
  for (const char* room : {"frames", "truths"}) {
    std::error_code failed;
    for (const auto& entry : fs::directory_iterator(folder / room, failed)) {
      const std::string file = std::string(room) + "/" + entry.path().filename().string();
      const bool is_known =
          std::any_of(known.begin(), known.end(), [&](const SetFile& one) { return one.file == file; });
      if (!is_known) extra.push_back(file);
    }
  }
  std::sort(extra.begin(), extra.end());
  for (const std::string& file : extra) {
    const bool unfinished = file.ends_with(".unfinished.exr");
    problems.push_back({file, unfinished ? "is an unfinished truth; gloam set make goes on with it"
                                         : "is not of the set; move it away"});
  }
}

}  // namespace

Verification verify_set(const fs::path& folder, const std::function<void(int, int)>& progress) {
  Verification found{read_manifest(folder)};
  const Recipe& recipe = recipe_for(folder, found.manifest);
  const std::vector<SetFile> files = files_of(found.manifest);
  found.files = int(files.size());
  int done = 0;
  for (const SetFile& file : files) {
    const auto frozen = recipe.hashes.find(file.file);
    const bool is_frozen = !found.manifest.seed && frozen != recipe.hashes.end();
    if (const std::string wrong = wrong_with(folder, file, is_frozen ? frozen->second : ""); !wrong.empty())
      found.problems.push_back({file.file, wrong});
    if (progress) progress(++done, found.files);
  }
  find_extra_files(folder, files, found.problems);
  if (found.manifest.seed) return found;
  for (const ItemRecipe& item : recipe.items) {
    if (!find_item(found.manifest, item.name))
      found.missing.push_back(item.name);
    else if (recipe.hashes.count(frame_files(item).back()) == 0)
      found.unfrozen.push_back(item.name);
  }
  return found;
}

}  // namespace gloam::sets
