#include "set/making.h"

#include <embree3/rtcore.h>
#ifdef __GLIBC__
#include <gnu/libc-version.h>
#endif

#include <chrono>

#include "base/elapsed.h"
#include "base/file_ledger.h"
#include "base/file_lock.h"
#include "base/files.h"
#include "base/lists.h"
#include "gloam/error.h"
#include "gloam/option.h"
#include "set/item_making.h"

namespace gloam::sets {
namespace {

void make_folder(const std::filesystem::path& folder) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) throw Error("{}: cannot be made ({})", folder.string(), failed.message());
}

/// What an earlier run made; empty if there was none.
Manifest earlier(const Recipe& recipe, const MakeOptions& options) {
  std::error_code unknown;
  if (!std::filesystem::exists(options.folder / "manifest.json", unknown)) return {};
  const LooksAtFiles looks;
  Manifest manifest = read_manifest(options.folder);
  const bool is_same = manifest.set == recipe.name && manifest.seed == options.seed;
  if (!is_same)
    throw Error("{}: holds {}{}; name another folder, or remove this one", options.folder.string(), manifest.set,
                manifest.seed ? fmt::format(" of seed {}", *manifest.seed) : "");
  return manifest;
}

/// An earlier run's item whose files are those of the recipe: names and numbers; contents are compared later.
bool is_of(const SetItem& item, const ItemRecipe& recipe) {
  const auto fits = [](const std::vector<SetFile>& files, const std::vector<std::string>& names) {
    return std::equal(files.begin(), files.end(), names.begin(), names.end(),
                      [](const SetFile& file, const std::string& name) { return file.file == name; });
  };
  if (!fits(item.files, frame_files(recipe)) || item.truths.size() != recipe.truths.size()) return false;
  for (size_t i = 0; i < item.truths.size(); ++i) {
    if (item.truths[i].effect != recipe.truths[i].effect) return false;
    if (!fits(item.truths[i].files, truth_files(recipe, recipe.truths[i].effect))) return false;
  }
  return true;
}

/// The recipe's items in its order: those made now, and those of an earlier run.
std::vector<SetItem> merged(const Recipe& recipe, const std::vector<SetItem>& made,
                            const std::vector<SetItem>& before) {
  std::vector<SetItem> items;
  for (const ItemRecipe& wanted : recipe.items) {
    const auto is_it = [&](const SetItem& item) { return item.name == wanted.name; };
    auto found = std::find_if(made.begin(), made.end(), is_it);
    if (found == made.end()) {
      found = std::find_if(before.begin(), before.end(), is_it);
      if (found == before.end() || !is_of(*found, wanted)) continue;
    }
    items.push_back(*found);
  }
  return items;
}

/// `frames_differ`: a truth starts from its frame.
std::string likely_cause(const Recipe& recipe, const MakeOptions& options, const std::string& file,
                         bool frames_differ) {
  if (!file.starts_with("frames/") && frames_differ) return "its frame differs";
  const std::string what = file.starts_with("frames/") ? "the scene or its capture" : "how the truth is traced";
  const std::string mine = fmt::format("gloam {} {}", options.gloam, options.commit);
  if (mine != recipe.frozen_with)
    return fmt::format("{} changed between {} and {}, or {}", what, recipe.frozen_with, mine, libraries_in_words());
  return fmt::format("{}: gloam was compiled otherwise, or {}", what, libraries_in_words());
}

void compare_with_frozen(const Recipe& recipe, const MakeOptions& options, MakeResult& result) {
  for (const SetItem& item : result.manifest.items) {
    bool frames_differ = false, is_frozen = true;
    for (const SetFile& file : files_of(item)) {
      const auto frozen = recipe.hashes.find(file.file);
      if (frozen == recipe.hashes.end()) {
        is_frozen = false;
        continue;
      }
      if (frozen->second == file.sha256) continue;
      result.differences.push_back(
          {file.file, frozen->second, file.sha256, likely_cause(recipe, options, file.file, frames_differ)});
      frames_differ = true;
    }
    if (!is_frozen && !options.seed) result.unfrozen.push_back(item.name);
  }
}

// --- Several processes that make items of one set

std::filesystem::path lock_of(const std::filesystem::path& folder) { return folder / ".gloam-lock-set"; }

/// Held while an item is made, whose unfinished truths lie beside it.
class ItemLock {
 public:
  ItemLock(const Recipe& recipe, const ItemRecipe& item, const std::filesystem::path& folder)
      : lock_(lock_of(folder), byte_of(recipe, item)) {
    if (lock_.is_held_by_another())
      throw Error("{}: another gloam makes {} there; wait for its end, or name other items by {}", folder.string(),
                  item.name, option("only"));
  }

 private:
  /// Byte 0 is the manifest's.
  static FileLock::Ranges byte_of(const Recipe& recipe, const ItemRecipe& item) {
    const int number = int(&item - recipe.items.data()) + 1;
    return {{number, number}};
  }
  FileLock lock_;
};

/// Writes the manifest with these items, and with those that others have made.
void add_to_manifest(const Recipe& recipe, const std::vector<SetItem>& made, const MakeOptions& options,
                     Manifest& manifest) {
  constexpr double patience = 60;  ///< seconds; writing takes a fraction of one
  const FileLock lock(lock_of(options.folder), {{0, 0}}, patience);
  if (lock.is_held_by_another())
    throw Error("{}: another gloam has held the manifest for {} s; end that process, and run this one again",
                options.folder.string(), patience);
  manifest.items = merged(recipe, made, earlier(recipe, options).items);
  manifest.hash = hash_of(manifest.items);
  write_manifest(options.folder, manifest);
}

}  // namespace

std::string libraries_in_words() {
#ifdef __GLIBC__
  const std::string c_library = fmt::format("glibc {}", gnu_get_libc_version());
#else
  const std::string c_library = "another C library than glibc";
#endif
  return fmt::format("{} and Embree {} compute otherwise", c_library, RTC_VERSION_STRING);
}

MakeResult make_set(const Recipe& recipe, const MakeOptions& options) {
  const std::vector<const ItemRecipe*> chosen = chosen_items(recipe, options.only);
  earlier(recipe, options);  // of another set: refused before anything is made
  for (const char* folder : {"frames", "truths"}) {
    make_folder(options.folder / folder);
    remove_leftovers(options.folder / folder);
  }
  MakeResult result;
  Manifest& manifest = result.manifest;
  manifest.set = recipe.name;
  manifest.part = options.seed ? "seeded" : "public";
  manifest.seed = options.seed;
  manifest.gloam = options.gloam, manifest.commit = options.commit;
  manifest.licence = recipe.licence;
  double all = 0, done = 0;
  for (const ItemRecipe* item : chosen) all += work_in(*item);
  std::vector<SetItem> made;
  for (const ItemRecipe* item : chosen) {
    const auto start = std::chrono::steady_clock::now();
    const double own = work_in(*item);
    const ItemLock making(recipe, *item, options.folder);
    ItemMaker maker(recipe, *item, options.folder, [&](const std::string& what, double share) {
      if (options.progress) options.progress(what, (done + share * own) / all);
    });
    made.push_back(maker.make());
    done += own;
    result.made += maker.made();
    result.kept += maker.kept();
    add_to_manifest(recipe, made, options, manifest);
    if (options.item_done) options.item_done(made.back(), seconds_since(start));
  }
  for (const ItemRecipe& item : recipe.items) {
    if (!find_item(manifest, item.name)) result.missing.push_back(item.name);
  }
  compare_with_frozen(recipe, options, result);
  return result;
}

}  // namespace gloam::sets
