#include "score/result_file.h"

#include <algorithm>
#include <cmath>

#include "base/file_identity.h"
#include "base/file_lock.h"
#include "base/files.h"
#include "base/json_object.h"
#include "base/json_text.h"
#include "base/statistics.h"
#include "gloam/error.h"
#include "measure/document.h"
#include "measure/pictures.h"
#include "results/measurements.h"

namespace gloam::score {
namespace {

Json views_of(const Figures& figures) {
  Json views = Json::object();
  for (const auto& [view, m] : figures.views)
    views[view] = {{"rmse_to_truth", m.rmse}, {"bias", m.bias}, {"ssim", m.ssim}, {"flip", or_null(m.flip)}};
  return views;
}

Json submitted_of(const Scored& scored, const Entry& entry, const RowDetails& details) {
  Json submitted = {{"name", entry.name},
                    {"version", or_null(entry.version)},
                    {"link", or_null(entry.link)},
                    {"authors", entry.authors},
                    {"licence", or_null(entry.licence)},
                    {"device", or_null(entry.device)},
                    {"time_ms", or_null(entry.stated_time(scored.target.name))},
                    {"settings", entry.settings},
                    {"convention", document_of(entry.convention)},
                    {"fit", nullptr},
                    {"whole", details.whole ? document_of(*details.whole) : Json(nullptr)},
                    {"views", views_of(scored.figures)},
                    {"rmse_at_own_size", or_null(scored.figures.rmse_at_own_size)},
                    {"scored_by", details.scored_by}};
  if (!scored.target.is_sequence) return submitted;
  submitted["frames"] = scored.frames;
  submitted["missing_frames"] = scored.missing;
  return submitted;
}

std::string text_in(const Json& object, const char* key, const std::string& usual = "") {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : usual;
}

bool is_submitted(const Json& row) {
  const auto found = row.find("submitted");
  return found != row.end() && found->is_object();
}

bool is_row_of(const Json& row, const std::string& entry) {
  return is_submitted(row) && text_in(row["submitted"], "name") == entry;
}

/// Scene and effect that a row or a scene is of.
using Place = std::pair<std::string, std::string>;
Place place_of(const Json& object, const char* name) {
  return {text_in(object, name), text_in(object, "effect", "ao")};
}
Place place_of_row(const Json& row) { return place_of(row, "scene"); }
Place place_of_scene(const Json& scene) { return place_of(scene, "name"); }

/// Throws Error for two scenes of one name that differ in size or radius.
void check_same(const Json& before, const Json& now, const std::string& file) {
  const auto differs = [&](const char* key) {
    const Json &a = before.value(key, Json()), &b = now.value(key, Json());
    if (a.is_null() || b.is_null()) return false;
    if (!a.is_number() || !b.is_number()) return a != b;
    return std::abs(a.get<double>() - b.get<double>()) > 1e-4 * std::abs(b.get<double>());
  };
  for (const char* key : {"size", "radius"}) {
    if (differs(key))
      throw Error("{}: has '{}' with the {} {}, and the new results have {}; write them to another folder", file,
                  text_in(now, "name"), key, shown(before[key]), shown(now[key]));
  }
}

/// The scene of a place; null if there is none.
Json* scene_at(Json& scenes, const Place& place) {
  const auto is_it = [&](const Json& scene) { return place_of_scene(scene) == place; };
  const auto found = std::find_if(scenes.begin(), scenes.end(), is_it);
  return found == scenes.end() ? nullptr : &*found;
}

/// What a scene does not say, as another says it.
void fill_in(Json& scene, const Json& other) {
  for (const char* key : {"truth_image", "kind", "base", "white"}) {
    if ((!scene.contains(key) || scene[key].is_null()) && other.contains(key)) scene[key] = other[key];
  }
}

/// Nothing was computed here, so there is no device.
Json new_document(const report::SetFacts& set) {
  Json document = report::document_of(bench::results_on(DeviceInfo{}));
  document["set"] = set.empty() ? Json(nullptr) : report::json_of(set);
  return document;
}

/// Bytes of the lock's file.
constexpr int change_byte = 0, measuring_byte = 1;

/// Beside the file itself, which a link in the folder may lead to.
std::filesystem::path lock_of(const std::filesystem::path& folder) {
  return follow_links(folder / "bench.json").parent_path() / ".gloam-lock-bench";
}

}  // namespace

Json milliseconds_of(const std::vector<double>& rounds) {
  Json document = milliseconds(rounds);
  document["rounds"] = rounds;
  return document;
}

std::string in_words(const report::SetFacts& set) {
  const std::string seed = set.seed ? fmt::format(" {:.0f}", *set.seed) : "";
  return fmt::format("{} ({}{}, hash {})", set.name, set.part, seed, set.hash.substr(0, 12));
}

Json document_of(const WholeTimes& whole) {
  std::vector<double> ratios;
  for (size_t i = 0; i < std::min(whole.ms.size(), whole.gloam_ms.size()); ++i)
    ratios.push_back(whole.ms[i] / whole.gloam_ms[i]);
  Json document = {{"command", whole.command},
                   {"ms", milliseconds_of(whole.ms)},
                   {"gloam_command", whole.gloam_command},
                   {"gloam_ms", whole.gloam_ms.empty() ? Json(nullptr) : milliseconds_of(whole.gloam_ms)},
                   {"ratio", ratios.empty() ? Json(nullptr) : Json(median(ratios))},
                   {"ratio_rounds", ratios}};
  return document;
}

Json row_of(const Scored& scored, const Entry& entry, const RowDetails& details) {
  const Target& target = scored.target;
  const Figures& f = scored.figures;
  const double ms = entry.stated_time(target.name).value_or(0);
  const int scale = entry.convention.scale;
  return report::json_of(report::Row{.is_of_frames = false,
                                     .technique = entry.name,
                                     .preset = "submitted",
                                     .scene = target.name,
                                     .effect = target.effect,
                                     .kind = target.kind,
                                     .ms = {ms, ms, ms},
                                     .rmse_to_truth = f.rmse,
                                     .bias = f.bias,
                                     .ssim = f.ssim,
                                     .flip = f.flip,
                                     .flicker = f.flicker,
                                     .inconsistency = f.inconsistency,
                                     .width = scored.scene.width,
                                     .height = scored.scene.height,
                                     .resolution = scale == 1   ? "full"
                                                   : scale == 2 ? "half"
                                                                : "quarter",
                                     .settings = entry.settings,
                                     .image = scored.picture,
                                     .submitted = submitted_of(scored, entry, details)});
}

Json document_of(const BestFit& fit, const Figures& figures, const std::string& effect) {
  const bool is_of_shares = is_share(effect);
  return {{"exponent", is_of_shares ? Json(fit.exponent) : Json(nullptr)},
          {"strength", is_of_shares ? Json(fit.strength) : Json(nullptr)},
          {"scale", is_of_shares ? Json(nullptr) : Json(fit.scale)},
          {"rmse_to_truth", figures.rmse},
          {"bias", figures.bias},
          {"ssim", figures.ssim},
          {"flip", or_null(figures.flip)}};
}

Json scene_of(const Scored& scored) { return report::json_of(scored.scene); }

Results::Results(const std::string& text, std::string name) : name_(std::move(name)) {
  document_ = ordered_json_of_text(text, name_);
  set_ = report::measurements_of(document_, name_).set;
  if (!document_.contains("scenes") || document_["scenes"].is_null()) document_["scenes"] = Json::array();
}

Results::Results(const report::SetFacts& set, std::string name)
    : document_(new_document(set)), name_(std::move(name)), set_(set) {}

size_t Results::rows_of(const std::string& entry) const {
  const Json& rows = document_["results"];
  return size_t(std::count_if(rows.begin(), rows.end(), [&](const Json& row) { return is_row_of(row, entry); }));
}

size_t Results::measured_rows() const {
  const auto length = [](const Json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_array() ? found->size() : 0;
  };
  const Json& rows = document_["results"];
  const auto submitted = size_t(std::count_if(rows.begin(), rows.end(), is_submitted));
  return rows.size() - submitted + length(document_, "paper") +
         length(document_.value("sequence", Json::object()), "rows");
}

void Results::check_files_of(const std::string& entry) const {
  for (const Json& row : document_["results"]) {
    if (!row.contains("submitted") || !row["submitted"].is_object()) continue;
    const std::string other = row["submitted"].value("name", "");
    if (other != entry && bench::file_name(other) == bench::file_name(entry))
      throw Error(
          "{}: holds rows of '{}', whose files are called as those of '{}' would be; give the method another name",
          name_, other, entry);
  }
}

void Results::put(Json row, Json scene) {
  Json &rows = document_["results"], &scenes = document_["scenes"];
  const Place place = place_of_row(row);
  if (Json* known = scene_at(scenes, place)) {
    check_same(*known, scene, name_);
    fill_in(*known, scene);
  } else {
    scenes.push_back(std::move(scene));
  }
  const std::string entry = row["submitted"]["name"];
  const auto is_before = [&](const Json& each) { return is_row_of(each, entry) && place_of_row(each) == place; };
  const auto before = std::find_if(rows.begin(), rows.end(), is_before);
  if (before != rows.end())
    *before = std::move(row);
  else
    rows.push_back(std::move(row));
}

void Results::set_fit(const Json& row, const Json& fit) {
  for (Json& each : document_["results"]) {
    if (is_row_of(each, row["submitted"]["name"]) && place_of_row(each) == place_of_row(row))
      each["submitted"]["fit"] = fit;
  }
}

void Results::remove_others(const std::string& entry, const std::vector<Place>& kept) {
  Json left = Json::array();
  for (Json& row : document_["results"]) {
    const bool is_other = is_row_of(row, entry) && std::find(kept.begin(), kept.end(), place_of_row(row)) == kept.end();
    if (!is_other) left.push_back(std::move(row));
  }
  document_["results"] = std::move(left);
}

void Results::check_scene(const Json& scene) const {
  const Place place = place_of_scene(scene);
  const auto is_on_it = [&](const Json& row) { return is_submitted(row) && place_of_row(row) == place; };
  const Json& rows = document_["results"];
  if (std::none_of(rows.begin(), rows.end(), is_on_it)) return;
  Json scenes = document_["scenes"];
  if (const Json* known = scene_at(scenes, place)) check_same(*known, scene, name_);
}

void Results::put_measured(Json measured) {
  if (!measured.contains("scenes")) measured["scenes"] = Json::array();
  for (const Json& scene : measured["scenes"]) check_scene(scene);
  for (Json& row : document_["results"]) {
    if (!is_submitted(row)) continue;
    const Place place = place_of_row(row);
    Json *before = scene_at(document_["scenes"], place), *now = scene_at(measured["scenes"], place);
    if (before && now) fill_in(*now, *before);
    if (before && !now) measured["scenes"].push_back(*before);
    measured["results"].push_back(std::move(row));
  }
  document_ = std::move(measured);
}

ResultFile::ResultFile(const std::filesystem::path& folder, const report::SetFacts& set)
    : path_(folder / "bench.json"), set_(set), found_(set, path_.string()) {
  std::error_code unknown;
  is_new_ = !std::filesystem::exists(path_, unknown);
  found_ = read();
}

Results ResultFile::read() const {
  std::error_code unknown;
  const std::string name = path_.string();
  if (!std::filesystem::exists(path_, unknown)) return Results(set_, name);
  Results results(read_text(path_), name);
  const report::SetFacts& before = results.set_;
  if (set_.empty() && !before.empty())
    throw Error("{}: is of the set {}, and these results are of no set; name another folder", name, in_words(before));
  if (!set_.empty() && before.empty() && !results.document_["results"].empty())
    throw Error("{}: is of no set, and these results are of {}; name another folder", name, in_words(set_));
  if (!set_.empty() && !before.empty() && before.hash != set_.hash)
    throw Error("{}: is of the set {}, and these results are of another version, {}; name another folder", name,
                in_words(before), in_words(set_));
  if (!set_.empty()) results.document_["set"] = report::json_of(set_);
  return results;
}

void ResultFile::update(const std::function<void(Results&)>& change) const {
  constexpr double patience = 120;  ///< seconds; a change takes a fraction of one
  const FileLock lock(lock_of(path_.parent_path()), {{change_byte, change_byte}}, patience);
  if (lock.is_held_by_another())
    throw Error("{}: another gloam has held the file for {} s; end that process, and run this one again",
                path_.string(), patience);
  Results results = read();
  change(results);
  write_text(path_, report::text_of(results.document_));
}

MeasuringAlone::MeasuringAlone(const std::filesystem::path& folder)
    : lock_(lock_of(folder), {{measuring_byte, measuring_byte}}) {
  if (lock_.is_held_by_another())
    throw Error("{}: another gloam bench measures into it; wait for its end, or name another folder", folder.string());
}

}  // namespace gloam::score
