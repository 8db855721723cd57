// What a set of frames and truths on disk holds: DIR/manifest.json.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gloam::sets {

/// A file of a set, and the hash of its content (content_hash.h).
struct SetFile {
  std::string file;  ///< relative to the set's folder: "frames/courtyard.exr"
  std::string sha256;
};

/// The truth of one effect in all frames of an item.
struct SetTruth {
  std::string effect;                ///< its plane: "ao"
  int rays = 0;                      ///< per pixel; 0: a closed form
  double noise = 0;                  ///< distance from the limit of infinitely many rays, RMS; of the noisiest frame
  std::optional<double> best_error;  ///< RMSE of the best technique that was measured on the item; none: not measured
  std::vector<SetFile> files;        ///< one for each frame
};

/// One thing to measure techniques on.
struct SetItem {
  std::string name;         ///< "courtyard"; of small letters, digits and `-`
  std::string kind;         ///< one of `item_kinds`
  std::string scene_class;  ///< "architecture"; "class" in the file
  int width = 0, height = 0;
  std::vector<std::string> views;  ///< empty: one view without a name
  std::vector<int> frames;         ///< numbers of a sequence's frames; else empty
  double radius = 0;               ///< of ambient occlusion and of all effects with a radius, scene units
  std::string licence;
  std::vector<SetFile> files;  ///< the frame, or one file for each of `frames`
  std::vector<SetTruth> truths;
};

struct Manifest {
  std::string set;               ///< "gloam-1"
  std::string part = "public";   ///< or "seeded"
  std::optional<uint64_t> seed;  ///< of a seeded part
  std::string gloam, commit;     ///< that made it
  std::string licence;
  std::string hash;  ///< `hash_of(items)`
  std::vector<SetItem> items;
};

/// frame, sequence, eyes, display, hard.
const std::vector<std::string>& item_kinds();

/// Reads and checks DIR/manifest.json. Throws Error, in one line that names the file and the field, for a missing or broken
/// file, and for a hash that does not fit the items. Does not read the files that it names (verification.h).
Manifest read_manifest(const std::filesystem::path& folder);

/// The same for a text. `name`: the file, for messages.
Manifest manifest_of(const std::string& text, const std::string& name);

/// The document, with the hash made anew.
std::string text_of(const Manifest& manifest);

/// Writes DIR/manifest.json at once.
void write_manifest(const std::filesystem::path& folder, const Manifest& manifest);

/// SHA-256 over an item's description, its files and their hashes.
std::string hash_of(const SetItem& item);
/// SHA-256 over the items' hashes in order.
std::string hash_of(const std::vector<SetItem>& items);

/// Its frames, then the files of its truths.
std::vector<SetFile> files_of(const SetItem& item);

/// nullptr if there is none.
const SetItem* find_item(const Manifest& manifest, const std::string& name);
const SetTruth* find_truth(const SetItem& item, const std::string& effect);

}  // namespace gloam::sets
