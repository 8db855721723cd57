#include "score/targets.h"

#include <algorithm>
#include <map>
#include <memory>

#include "base/file_ledger.h"
#include "base/lists.h"
#include "gloam/error.h"
#include "gloam/frame_numbers.h"
#include "gloam/frame_pattern.h"
#include "gloam/option.h"
#include "score/entry.h"
#include "sequence/pattern_reads.h"
#include "set/content_hash.h"
#include "set/recipe.h"

namespace gloam::score {
namespace {

namespace fs = std::filesystem;

// --- Sets

/// Those files of an item that are of one frame; all of an item that is no sequence.
std::vector<sets::SetFile> files_of_frame(const std::vector<sets::SetFile>& files, size_t index, bool is_sequence) {
  if (!is_sequence) return files;
  return index < files.size() ? std::vector{files[index]} : std::vector<sets::SetFile>();
}

/// The frozen hashes of a set by file; empty for a set that this gloam does not know, and for one made from a seed.
std::map<std::string, std::string> frozen_hashes(const sets::Manifest& manifest) {
  const sets::Recipe* recipe = manifest.part == "public" ? sets::recipe_named(manifest.set) : nullptr;
  return recipe ? recipe->hashes : std::map<std::string, std::string>();
}

/// Throws Error for the first file whose content is not what the manifest says, or not what the set's name stands for.
void check_files(const fs::path& folder, const std::vector<sets::SetFile>& files,
                 const std::map<std::string, std::string>& frozen) {
  for (const sets::SetFile& file : files) {
    const fs::path path = folder / file.file;
    const auto known = frozen.find(file.file);
    if (known != frozen.end() && known->second != file.sha256)
      throw Error(
          "{}: the manifest's hash {}... is not the frozen one, {}...: a set of another version; gloam set make makes "
          "this one",
          path.string(), file.sha256.substr(0, 12), known->second.substr(0, 12));
    std::error_code unknown;
    if (!fs::exists(path, unknown)) throw Error("{}: is missing; gloam set make makes it anew", path.string());
    const std::string hash = sets::content_hash(path);
    if (hash != file.sha256)
      throw Error(
          "{}: is not the set's: its content has the hash {}..., and the manifest says {}...; gloam set make makes it "
          "anew",
          path.string(), hash.substr(0, 12), file.sha256.substr(0, 12));
  }
}

TargetFrame target_frame(const fs::path& folder, const sets::SetItem& item, const sets::SetTruth& truth, size_t index,
                         const std::map<std::string, std::string>& frozen) {
  const bool is_sequence = item.kind == "sequence";
  const std::vector<sets::SetFile> frames = files_of_frame(item.files, index, is_sequence),
                                   truths = files_of_frame(truth.files, index, is_sequence);
  const std::string words = is_sequence ? fmt::format("{} frame {}", item.name, item.frames[index]) : item.name;
  if (frames.empty() || truths.empty())
    throw Error("{}: the manifest names no {} of {}; gloam set make makes the set anew", folder.string(),
                frames.empty() ? "frame" : "truth", words);
  TargetFrame at;
  at.number = is_sequence ? item.frames[index] : 1;
  at.frame = folder / frames.front().file;
  for (const sets::SetFile& file : truths) at.truths.push_back((folder / file.file).string());
  at.check = [folder, frames, truths, frozen, is_checked = std::make_shared<bool>(false)] {
    if (*is_checked) return;
    check_files(folder, frames, frozen);
    check_files(folder, truths, frozen);
    *is_checked = true;
  };
  return at;
}

/// The pattern whose names the frames have. Their numbers are looked for in the first one's name, at its end first.
std::string pattern_of(const std::vector<TargetFrame>& frames) {
  const fs::path& first = frames.front().frame;
  const std::string name = first.filename().string(), number = std::to_string(frames.front().number);
  for (size_t at = name.rfind(number); at != std::string::npos; at = at == 0 ? at : name.rfind(number, at - 1)) {
    size_t begin = at;
    while (begin > 0 && name[begin - 1] == '0') --begin;
    const std::string place(at + number.size() - begin, '#');
    const FramePattern pattern(
        (first.parent_path() / (name.substr(0, begin) + place + name.substr(at + number.size()))).string(), "frames");
    const auto fits = [&](const TargetFrame& each) { return pattern.path_of(each.number) == each.frame; };
    if (std::all_of(frames.begin(), frames.end(), fits)) return pattern.text();
    if (at == 0) break;
  }
  return "";
}

Target target_of(const fs::path& folder, const sets::SetItem& item, const sets::SetTruth& truth,
                 const std::map<std::string, std::string>& frozen) {
  Target target;
  target.name = item.name;
  target.kind = item.kind;
  target.scene_class = item.scene_class;
  target.effect = truth.effect;
  target.radius = item.radius;
  target.views = item.views;
  target.is_sequence = item.kind == "sequence";
  const size_t frames = target.is_sequence ? item.frames.size() : 1;
  for (size_t i = 0; i < frames; ++i) target.frames.push_back(target_frame(folder, item, truth, i, frozen));
  if (target.is_sequence) target.pattern = pattern_of(target.frames);
  return target;
}

// --- Frames of the user's own

/// "shot" for "shots/shot.####.exr".
std::string name_of_pattern(const FramePattern& pattern) {
  std::string name = pattern.name().substr(0, pattern.name().find_first_of("#%"));
  while (!name.empty() && (name.back() == '.' || name.back() == '_' || name.back() == '-')) name.pop_back();
  return name.empty() ? "sequence" : name;
}

std::vector<TargetFrame> frames_of(const OwnFrames& own) {
  const FramePattern frames(own.frame, option("frame"));
  std::vector<FramePattern> truths;
  for (const std::string& truth : own.truths) {
    if (!FramePattern::is_pattern(truth))
      throw UsageError("{}: is one file, and {} a sequence; name one truth for each frame: truth.####.exr",
                       option("truth", truth), option("frame", own.frame));
    truths.emplace_back(truth, option("truth"));
  }
  reads_pattern(frames);
  reads_cameras_beside(frames);
  for (const FramePattern& truth : truths) reads_pattern(truth);
  std::vector<TargetFrame> found;
  for (const int number : frames.frames_there()) {
    TargetFrame at;
    at.number = number;
    at.frame = frames.path_of(number);
    for (const FramePattern& truth : truths) at.truths.push_back(truth.path_of(number).string());
    found.push_back(std::move(at));
  }
  if (found.empty()) throw Error("{}: there is no such frame", option("frame", own.frame));
  return found;
}

/// The effects that the truths of a frame hold.
std::vector<std::string> effects_in_truths(const TargetFrame& at) {
  std::vector<std::string> held, effects;
  for (const std::string& truth : at.truths) {
    ReadOptions options;
    options.as_stored = true;
    add_new(held, FrameFile(truth, options).common_planes());
  }
  for (const std::string& effect : scored_effects()) {
    if (contains(held, effect)) effects.push_back(effect);
  }
  return effects;
}

/// The radius that the truths of an effect state.
std::optional<double> radius_of_truths(const Target& target) {
  ReadOptions options;
  options.as_stored = true;
  for (const std::string& truth : target.frames.front().truths) {
    const FrameFile file(truth, options);
    for (const char* what : {"Radius", "Length"}) {
      if (const auto radius = file.number_attribute(target.effect + what)) return radius;
    }
  }
  return {};
}

}  // namespace

ScoredSet read_set(const std::string& folder, std::vector<std::string>& notes) {
  const sets::Manifest manifest = sets::read_manifest(folder);
  ScoredSet found;
  found.id.name = manifest.set;
  found.id.part = manifest.part;
  found.id.hash = manifest.hash;
  if (manifest.seed) found.id.seed = double(*manifest.seed);
  const std::map<std::string, std::string> frozen = frozen_hashes(manifest);
  if (manifest.part == "public" && frozen.empty())
    notes.push_back(fmt::format(
        "{}: no hash of the set '{}' is frozen in this gloam; its files are compared with its own manifest alone",
        folder, manifest.set));
  for (const sets::SetItem& item : manifest.items) {
    for (const sets::SetTruth& truth : item.truths) found.targets.push_back(target_of(folder, item, truth, frozen));
  }
  if (found.targets.empty()) throw Error("{}: the set has no item with a truth", folder);
  for (const Target& target : found.targets) {
    for (const TargetFrame& at : target.frames) {
      reads_file(at.frame, "a frame of the set");
      for (const std::string& truth : at.truths) reads_file(truth, "a truth of the set");
    }
  }
  return found;
}

void keep_items(std::vector<Target>& targets, const std::vector<std::string>& names) {
  if (names.empty()) return;
  std::vector<std::string> known;
  for (const Target& target : targets) add_new(known, target.name);
  for (const std::string& name : names) {
    if (!contains(known, name))
      throw UsageError("{}: no such item{}; there are {}", option("items", name), suggestion(name, known),
                       enumerate(known));
  }
  std::erase_if(targets, [&](const Target& target) { return !contains(names, target.name); });
}

std::vector<Target> own_targets(const OwnFrames& own, const std::string& effect) {
  Target target;
  target.is_sequence = FramePattern::is_pattern(own.frame);
  if (target.is_sequence) {
    target.name = name_of_pattern(FramePattern(own.frame, option("frame")));
    target.frames = frames_of(own);
    const FramePattern frames(own.frame, option("frame"));
    target.pattern = (fs::path(own.frame).parent_path() / frames.normal_name()).string();
  } else {
    for (const std::string& truth : own.truths) {
      if (FramePattern::is_pattern(truth))
        throw UsageError("{}: is a sequence, and {} one frame; name one file", option("truth", truth),
                         option("frame", own.frame));
    }
    target.name = fs::path(own.frame).stem().string();
    TargetFrame& at = target.frames.emplace_back();
    at.frame = own.frame;
    at.truths = own.truths;
    reads_file(own.frame, option("frame"));
    for (const std::string& truth : own.truths) reads_file(truth, option("truth"));
  }
  target.views = FrameFile(target.frames.front().frame, own.reading).views();
  std::vector<std::string> effects = {effect};
  add_new(effects, effects_in_truths(target.frames.front()));
  std::vector<Target> targets;
  for (const std::string& each : effects) {
    targets.push_back(target);
    targets.back().effect = each;
    targets.back().radius = radius_of_truths(targets.back());
  }
  return targets;
}

std::optional<std::vector<SubmittedFile>> files_given(const std::vector<std::string>& images, const Target& target,
                                                      int frame) {
  std::error_code unknown;
  if (std::any_of(images.begin(), images.end(), [&](const auto& each) { return fs::is_directory(each, unknown); }))
    return {};
  std::vector<SubmittedFile> files;
  for (const std::string& image : images) {
    const bool is_pattern = FramePattern::is_pattern(image);
    if (is_pattern && !target.is_sequence)
      throw UsageError("{}: is a sequence, and {} names one frame; name one image", image, option("frame"));
    if (!is_pattern && target.is_sequence)
      throw UsageError("{}: is one image, and {} a sequence; name a pattern such as ao.####.exr, or a folder", image,
                       option("frame"));
    const fs::path path = is_pattern ? FramePattern(image, "IMAGES").path_of(frame) : fs::path(image);
    std::string view;
    if (images.size() > 1) {
      const auto named = view_in_name(path, target.views);
      if (!named)
        throw UsageError("{}: the name ends in no view of the frame ({}); of several images each name ends in one",
                         image, enumerate(target.views));
      view = *named;
    }
    if (!fs::exists(path, unknown)) throw Error("{}: is not there", path.string());
    reads_file(path, "an image to score");
    files.push_back({path, view});
  }
  return files;
}

}  // namespace gloam::score
