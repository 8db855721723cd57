#include "score/result_file.h"

#include <algorithm>
#include <cmath>

#include "base/files.h"
#include "base/json_text.h"
#include "base/statistics.h"
#include "bench/document.h"
#include "gloam/error.h"

namespace gloam::score {
namespace {

/// A time that nobody measured here has no rounds.
Json stated(const std::optional<double>& ms) {
  if (!ms) return nullptr;
  return {{"median", *ms}, {"min", *ms}, {"max", *ms}, {"rounds", Json::array()}};
}

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

bool is_row_of(const Json& row, const std::string& name) {
  return row.is_object() && row.contains("submitted") && row["submitted"].is_object() &&
         row["submitted"].value("name", "") == name;
}

std::string text_in(const Json& object, const char* key, const std::string& usual = "") {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : usual;
}

/// Scene and effect that a row or a scene is of.
std::pair<std::string, std::string> place_of(const Json& object, const char* name) {
  return {text_in(object, name), text_in(object, "effect", "ao")};
}

/// Throws Error for two scenes of one name that differ in size or radius.
void check_same(const Json& before, const Json& now, const std::filesystem::path& path) {
  const auto differs = [&](const char* key) {
    if (!before.contains(key) || before[key].is_null() || now[key].is_null()) return false;
    if (!before[key].is_number()) return before[key] != now[key];
    return std::abs(before[key].get<double>() - now[key].get<double>()) > 1e-4 * std::abs(now[key].get<double>());
  };
  for (const char* key : {"size", "radius"}) {
    if (differs(key))
      throw Error("{}: '{}' there has the {} {}, and here {}; write these results to another folder (-o)",
                  path.string(), text_in(now, "name"), key, before[key].dump(), now[key].dump());
  }
}

std::optional<SetId> set_in(const Json& document) {
  const auto set = document.find("set");
  if (set == document.end() || !set->is_object()) return {};
  SetId id{text_in(*set, "name"), text_in(*set, "part"), text_in(*set, "hash"), {}};
  if (set->contains("seed") && (*set)["seed"].is_number_integer()) id.seed = (*set)["seed"].get<long long>();
  return id;
}

Json new_document(const std::optional<SetId>& set) {
  Json document = bench::origin_of(DeviceInfo{});
  document["device"] = nullptr;  // nothing was computed here
  document["driver"] = nullptr;
  document["set"] = set ? document_of(*set) : Json(nullptr);
  for (const char* list : {"scenes", "results", "growth", "converged", "scales", "planes", "skipped", "paper"})
    document[list] = Json::array();
  return document;
}

}  // namespace

Json milliseconds_of(const std::vector<double>& rounds) {
  Json document = milliseconds(rounds);
  document["rounds"] = rounds;
  return document;
}

Json document_of(const SetId& set) {
  return {
      {"name", set.name}, {"part", set.part}, {"seed", set.seed ? Json(*set.seed) : Json(nullptr)}, {"hash", set.hash}};
}

std::string in_words(const SetId& set) {
  const std::string seed = set.seed ? fmt::format(" {}", *set.seed) : "";
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
  const int scale = entry.convention.scale;
  return {{"technique", entry.name},
          {"preset", "submitted"},
          {"variant", ""},
          {"settings", entry.settings},
          {"resolution", scale == 1   ? "full"
                         : scale == 2 ? "half"
                                      : "quarter"},
          {"scene", target.name},
          {"effect", target.effect},
          {"kind", or_null(target.kind)},
          {"width", scored.scene.width},
          {"height", scored.scene.height},
          {"ms", stated(entry.stated_time(target.name))},
          {"ratio_to_hbao_plus", nullptr},
          {"ratio_to_gather_floor", nullptr},
          {"rmse_to_truth", f.rmse},
          {"bias", f.bias},
          {"ssim", f.ssim},
          {"flip", or_null(f.flip)},
          {"flicker", or_null(f.flicker)},
          {"inconsistency", or_null(f.inconsistency)},
          {"image", or_null(scored.picture)},
          {"submitted", submitted_of(scored, entry, details)}};
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

Json scene_of(const Scored& scored) {
  Json scene = bench::document_of(scored.scene);
  scene["kind"] = or_null(scored.target.kind);
  return scene;
}

ResultFile::ResultFile(const std::filesystem::path& folder, const std::optional<SetId>& set)
    : path_(folder / "bench.json") {
  std::error_code unknown;
  is_new_ = !std::filesystem::exists(path_, unknown);
  if (is_new_) {
    document_ = new_document(set);
    return;
  }
  try {
    document_ = Json::parse(read_text(path_));
  } catch (const nlohmann::json::exception&) {
    throw Error("{}: is not JSON, so nothing can be added to it; remove it, or name another folder (-o)",
                path_.string());
  }
  if (!document_.is_object() || !document_.contains("results") || !document_["results"].is_array())
    throw Error("{}: is no result of gloam bench or gloam score; name another folder (-o)", path_.string());
  if (!document_.contains("scenes") || !document_["scenes"].is_array()) document_["scenes"] = Json::array();
  const std::optional<SetId> before = set_in(document_);
  if (before && !set)
    throw Error("{}: is of the set {}, and no --set is given; name another folder (-o)", path_.string(),
                in_words(*before));
  if (set && !before && !document_["results"].empty())
    throw Error("{}: is of no set, and --set is {}; name another folder (-o)", path_.string(), in_words(*set));
  if (set && before && before->hash != set->hash)
    throw Error("{}: is of the set {}, and --set is {}: another version; name another folder (-o)", path_.string(),
                in_words(*before), in_words(*set));
  if (set) document_["set"] = document_of(*set);
}

size_t ResultFile::rows_of(const std::string& name) const {
  const Json& rows = document_["results"];
  return size_t(std::count_if(rows.begin(), rows.end(), [&](const Json& row) { return is_row_of(row, name); }));
}

void ResultFile::put(Json row, Json scene) {
  Json &rows = document_["results"], &scenes = document_["scenes"];
  const auto place = place_of(row, "scene");
  const auto is_scene = [&](const Json& each) { return each.is_object() && place_of(each, "name") == place; };
  const auto known = std::find_if(scenes.begin(), scenes.end(), is_scene);
  if (known == scenes.end()) {
    scenes.push_back(std::move(scene));
  } else {
    check_same(*known, scene, path_);
    for (const char* key : {"truth_image", "kind", "base", "white"}) {
      if (!known->contains(key) || (*known)[key].is_null()) (*known)[key] = scene[key];
    }
  }
  const std::string name = row["submitted"]["name"];
  const auto is_before = [&](const Json& each) { return is_row_of(each, name) && place_of(each, "scene") == place; };
  const auto before = std::find_if(rows.begin(), rows.end(), is_before);
  if (before != rows.end())
    *before = std::move(row);
  else
    rows.push_back(std::move(row));
}

void ResultFile::set_fit(const Json& row, Json fit) {
  for (Json& each : document_["results"]) {
    if (is_row_of(each, row["submitted"]["name"]) && place_of(each, "scene") == place_of(row, "scene"))
      each["submitted"]["fit"] = fit;
  }
}

void ResultFile::remove_others(const std::string& name, const std::vector<std::pair<std::string, std::string>>& kept) {
  Json left = Json::array();
  for (Json& row : document_["results"]) {
    const bool is_other =
        is_row_of(row, name) && std::find(kept.begin(), kept.end(), place_of(row, "scene")) == kept.end();
    if (!is_other) left.push_back(std::move(row));
  }
  document_["results"] = std::move(left);
}

void ResultFile::write() const {
  write_text(path_, document_.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace gloam::score
