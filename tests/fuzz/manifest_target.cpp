// Manifests and recipes of sets: any text is one that can be written and read again, or is refused in one line.
#include "fuzz/json_damage.h"
#include "fuzz/promise.h"
#include "fuzz/target.h"
#include "set/manifest.h"
#include "set/recipe.h"

namespace gloam::fuzz {
namespace {

constexpr const char* name = "manifest.json";

void read_manifest_text(const std::string& text) {
  const sets::Manifest manifest = sets::manifest_of(text, name);
  const std::string written = sets::text_of(manifest);
  require(sets::text_of(sets::manifest_of(written, "again")) == written, "a manifest is written as it is read");
}

sets::Manifest example() {
  const std::string digits(64, 'a');
  sets::SetItem walk{"walk", "sequence", "architecture", 64, 36, {"left", "right"}, {5}, 1.25, "MIT", {}, {}};
  walk.files = {{"frames/walk.0005.exr", digits}};
  walk.truths = {{"ao", 64, 0.01, 0.2, {{"truths/walk_ao.0005.exr", digits}}}};
  sets::Manifest manifest;
  manifest.set = "small";
  manifest.part = "seeded";
  manifest.seed = 7;
  manifest.items = {walk};
  return manifest;
}

const std::vector<std::string>& words() {
  static const std::vector<std::string> names = {
      "set",    "part",  "seed",     "gloam", "commit", "licence", "hash",   "items",  "name",   "kind",   "class",
      "size",   "views", "frames",   "files", "file",   "sha256",  "truths", "effect", "rays",   "noise",  "best_error",
      "radius", "scene", "settings", "shot",  "eyes",   "display", "hard",   "light",  "layers", "hashes", ""};
  return names;
}

}  // namespace

std::vector<std::string> seeds() {
  sets::Manifest empty = example(), public_part = example();
  empty.items.clear();
  public_part.part = "public";
  public_part.seed.reset();
  return {sets::text_of(example()), sets::text_of(public_part), sets::text_of(empty),
          R"({"set": "s", "summary": "", "licence": "MIT", "size": [8, 6], "layers": 2, "items": [
            {"name": "a", "kind": "eyes", "scene": "slab", "eyes": {"distance": 0.1, "convergence": 2}, "radius": 1, "truths": []},
            {"name": "b", "kind": "sequence", "scene": "clockwork", "shot": "gears", "frames": [1, 2], "radius": 1,
             "truths": [{"effect": "ao", "rays": 64, "best_error": 0.1}]},
            {"name": "c", "kind": "display", "scene": "pillar", "display": "small", "settings": {"sheets": "3"}, "radius": 1, "truths": []},
            {"name": "d", "kind": "hard", "hard": "corner", "radius": 1, "truths": [{"effect": "ao", "rays": 0}]}],
            "hashes": {"frames/a.exr": "00"}})",
          "[]"};
}

}  // namespace gloam::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace gloam::fuzz;
  const std::string text(reinterpret_cast<const char*>(data), size);
  reads(name, [&] { read_manifest_text(text); });
  reads(name, [&] { gloam::sets::recipe_of(text, name); });
  return 0;
}

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t most, unsigned seed) {
  using namespace gloam::fuzz;
  static const std::vector<std::string> starts = seeds();
  gloam::Random random(seed);
  return put(damaged_json({reinterpret_cast<const char*>(data), size}, starts, words(), random), data, most);
}
