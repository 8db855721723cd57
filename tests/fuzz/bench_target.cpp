// Results and entries (bench.json, entry.json): any text is read, joined and shown, or refused in one line.
#include <algorithm>
#include <filesystem>

#include "base/json_text.h"
#include "fuzz/json_damage.h"
#include "fuzz/promise.h"
#include "fuzz/target.h"
#include "leaderboard/page.h"
#include "results/joined.h"
#include "score/entry.h"
#include "score/result_file.h"

namespace gloam::fuzz {
namespace {

using score::Json;
using score::Results;

constexpr const char* name = "bench.json";

/// Tables and commands, without pictures.
void show(const std::string& text) {
  const Json document = ordered_json_of_text(text, name);
  const report::Source source{name, std::filesystem::path(name), report::measurements_of(document, name)};
  report::by_group(report::joined({source}), {source});
  leaderboard::Results results;
  results.boards.push_back({source.measurements.set, {0}});
  results.files.push_back(source);
  for (auto* rows : {&results.files[0].measurements.rows, &results.files[0].measurements.submitted}) {
    for (report::Row& row : *rows) row.source = 0;
  }
  leaderboard::make_page(results, {.shown = leaderboard::ShownPictures::none});
}

Json own_scene() { return {{"name", "fuzzed"}, {"effect", "ao"}, {"size", {8, 6}}, {"radius", 0.5}}; }
Json own_row() {
  return {{"technique", "fuzz"},
          {"preset", "submitted"},
          {"scene", "fuzzed"},
          {"effect", "ao"},
          {"submitted", {{"name", "fuzz"}}}};
}

/// What joins is there afterwards, what was there stays, and the result is read again.
void join(const std::string& text) {
  Results results(text, name);
  const size_t before = results.document()["results"].size(), own = results.rows_of("fuzz");
  results.put(own_row(), own_scene());
  require(results.rows_of("fuzz") >= std::max<size_t>(own, 1), "a row that joins is there");
  require(results.document()["results"].size() >= before, "rows stay");
  results.set_fit(own_row(), {{"exponent", 1}});
  const auto written = [](const Results& of) {
    return of.document().dump(-1, ' ', false, Json::error_handler_t::replace);
  };
  Results again(written(results), name);
  require(again.rows_of("fuzz") == results.rows_of("fuzz"), "what is written is read again");
  again.put_measured({{"results", Json::array()}});
  require(again.rows_of("fuzz") == results.rows_of("fuzz"), "what was submitted stays");
  require(again.measured_rows() == 0, "what was measured is replaced");
  Results(written(again), name);
}

const std::vector<std::string>& words() {
  static const std::vector<std::string> names = {
      "device",      "scenes",    "results",       "growth",     "converged", "scales",  "planes",     "skipped",
      "paper",       "sequence",  "stability",     "name",       "class",     "effect",  "size",       "radius",
      "truth_image", "technique", "preset",        "variant",    "settings",  "scene",   "ms",         "median",
      "min",         "max",       "rounds",        "submitted",  "version",   "link",    "authors",    "fit",
      "whole",       "command",   "scored_by",     "set",        "hash",      "seed",    "part",       "rows",
      "held",        "cases",     "width",         "height",     "views",     "depths",  "ladder",     "passes",
      "image",       "kind",      "rmse_to_truth", "bias",       "peaks",     "base",    "convention", "inverted",
      "exponent",    "strength",  "range",         "resolution", "falloff",   "time_ms", "licence",    "processes",
      "__proto__",   ""};
  return names;
}

}  // namespace

std::vector<std::string> seeds() {
  return {
      R"({"device": "d", "cpu": "c", "cores": 2, "driver": "v", "date": "2026-01-01", "commit": "0", "gloam": "0.1.0",
              "command": ["gloam", "bench", "-o", "out"], "set": {"name": "small", "part": "seeded", "seed": 7, "hash": "00ff"},
              "rounds": 9, "rays": 64,
              "scenes": [{"name": "room", "class": "architecture", "effect": "ao", "size": [64, 36], "radius": 0.5, "radius_from": "truth",
                          "radius_pixels": 9, "truth_noise": 0.01, "truth_image": "images/room/truth.png", "white": 1, "kind": "frame",
                          "peaks": {"copy_gb_per_s": 9}, "base": {"name": "white", "rmse_to_truth": 0.2, "bias": 0.1}}],
              "results": [{"technique": "gtao", "preset": "medium", "variant": "half", "depths": ["depth"], "views": 1,
                           "settings": {"radius": 0.5, "samples": 8}, "resolution": "half", "math": "fast", "real": "float",
                           "scene": "room", "effect": "ao", "width": 64, "height": 36,
                           "ms": {"median": 1, "min": 1, "max": 2, "rounds": [1, 2]}, "ratio_to_hbao_plus": 0.5,
                           "ladder": {"t1": 0.1}, "passes": [{"name": "p", "ms": {"median": 1}}], "rmse_to_truth": 0.1, "bias": 0.01,
                           "ssim": 0.9, "flip": 0.1, "image": "images/room/a.png"},
                          {"technique": "theirs", "preset": "submitted", "scene": "room", "effect": "ao", "ms": null, "settings": {},
                           "submitted": {"name": "theirs", "version": "1", "link": "https://x", "authors": ["A"], "time_ms": 2,
                                         "convention": {"inverted": true, "range": [0, 255]}, "fit": {"exponent": 1, "strength": 1},
                                         "whole": {"command": "x", "ms": {"median": 1}, "ratio": 2}, "scored_by": ["gloam", "score"]}}],
              "growth": [{"technique": "gtao", "over": "pixels", "scene": "room", "exponent": 1, "points": [{"x": 1, "ms": 1}]}],
              "converged": [{"technique": "gtao", "scene": "room"}], "scales": [], "planes": [], "skipped": [], "paper": [],
              "stability": {"gtao": {"held": 1, "cases": 2}}})",
      R"({"results": [], "sequence": {"shot": "s", "frames": [1, 2], "size": [8, 6],
              "rows": [{"technique": "gtao", "preset": "low", "ms": {"median": 1}, "rmse": 0.1, "worst": {"frame": 1, "rmse": 0.2}}]}})",
      R"({"name": "theirs", "version": "1", "authors": ["A"], "settings": {"samples": 8}, "time_ms": {"room": 2}, "effect": "ao",
              "convention": {"inverted": false, "exponent": 2.2, "strength": 1, "range": [0, 1], "resolution": "half", "radius": 1}})",
      R"({"results": []})", "[]"};
}

}  // namespace gloam::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace gloam::fuzz;
  const std::string text(reinterpret_cast<const char*>(data), size);
  reads(name, [&] { show(text); });
  reads(name, [&] { join(text); });
  reads(name, [&] { gloam::score::entry_of(text, name); });
  return 0;
}

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t most, unsigned seed) {
  using namespace gloam::fuzz;
  static const std::vector<std::string> starts = seeds();
  gloam::Random random(seed);
  return put(damaged_json({reinterpret_cast<const char*>(data), size}, starts, words(), random), data, most);
}
