#include "results/measurements.h"

#include <algorithm>
#include <map>

#include "base/files.h"
#include "base/json_object.h"
#include "base/json_text.h"
#include "base/lists.h"
#include "gloam/error.h"
#include "results/fields.h"

namespace gloam::report {
namespace {

/// What one effect was measured on, apart from the same scene of another.
std::string with_effect(const std::string& text, const std::string& effect) {
  if (effect == "ao") return text;
  return text.empty() ? effect : fmt::format("{} ({})", text, effect);
}

void set_kinds_apart(std::vector<Scene>& scenes) {
  const std::map<std::string, std::string> apart{{"sequence", "sequences"},
                                                 {"eyes", "pairs of eyes"},
                                                 {"display", "light-field displays"},
                                                 {"hard", "hard cases"}};
  const bool has_frames =
      std::any_of(scenes.begin(), scenes.end(), [](const Scene& scene) { return scene.kind == "frame"; });
  for (Scene& scene : scenes) {
    if (const auto kind = apart.find(scene.kind); has_frames && kind != apart.end())
      scene.scene_class = with_effect(kind->second, scene.effect);
  }
}

/// Effect and scene as pages have them; older files know ambient occlusion alone.
template <typename Thing>
void name_by_effect(Thing& thing) {
  if (thing.effect.empty()) thing.effect = "ao";
  thing.scene = with_effect(thing.scene, thing.effect);
}

void prepare(Scene& scene) {
  if (scene.effect.empty()) scene.effect = "ao";
  scene.title = scene.name;
  scene.own_class = scene.scene_class;
  scene.name = with_effect(scene.title, scene.effect);
  if (scene.scene_class != "own") scene.scene_class = with_effect(scene.scene_class, scene.effect);
  const std::optional<Peaks>& peaks = scene.peaks;
  if (peaks && !peaks->copy_gb_per_s && !peaks->gather_g_per_s && !peaks->fma_gflops) scene.peaks.reset();
}

std::map<std::string, HeldCases> stability_of(const JsonObject& o) {
  std::map<std::string, HeldCases> stability;
  for (const auto& [technique, counts] : o.json().items()) {
    const JsonObject each = o.object(technique);
    stability[technique] = {size_t(each.whole("held")), size_t(each.whole("cases"))};
  }
  return stability;
}

/// What a file holds, in the form that pages are made from.
void prepare(Measurements& m) {
  for (Scene& scene : m.scenes) prepare(scene);
  set_kinds_apart(m.scenes);
  std::vector<Row> all = std::move(m.rows);
  m.rows.clear();
  for (Row& row : all) {
    name_by_effect(row);
    (row.submitted.is_null() ? m.rows : m.submitted).push_back(std::move(row));
  }
  for (Converged& each : m.converged) name_by_effect(each);
  for (const LeftOut& each : m.left_out) {
    if (each.what != "everything" && each.what != "rounds") continue;
    m.skipped.push_back({each.technique, each.preset + (each.variant.empty() ? "" : ", " + each.variant), each.scene,
                         "left out to end in time; gloam bench --all measures it"});
  }
  if (m.sequence && m.sequence->rows.empty()) m.sequence.reset();
}

/// Adds scenes that rows name and the list of scenes lacks.
void add_scenes_of_rows(Measurements& m, const std::vector<Row>& rows) {
  for (const Row& row : rows) {
    const auto is_it = [&](const Scene& scene) { return scene.name == row.scene; };
    if (std::any_of(m.scenes.begin(), m.scenes.end(), is_it)) continue;
    Scene scene;
    scene.name = scene.title = row.scene;
    scene.effect = row.effect;
    scene.width = row.width;
    scene.height = row.height;
    m.scenes.push_back(scene);
  }
}

Measurements read_file(const std::filesystem::path& file) {
  const std::string name = file.string();
  return measurements_of(ordered_json_of_text(read_text(file), name), name);
}

[[noreturn]] void nothing_to_show(const std::filesystem::path& file) {
  const std::filesystem::path folder = file.parent_path();
  throw Error("{}: results is empty, there is nothing to show; 'gloam bench -o {}' measures", file.string(),
              folder.empty() ? "." : folder.string());
}

}  // namespace

Measurements measurements_of(const Json& document, const std::string& name) {
  const JsonObject object(document, {name, "remove the file, and gloam bench makes it anew"});
  Measurements m = read<Measurements>(object);
  prepare(m);
  m.stability = stability_of(object.object_if("stability"));
  for (const auto* rows : {&m.rows, &m.submitted}) add_scenes_of_rows(m, *rows);
  return m;
}

Json document_of(const Measurements& measurements) { return json_of(measurements); }

std::string text_of(const Json& document) {
  const auto line = [](const Json& value) { return value.dump(-1, ' ', false, Json::error_handler_t::replace); };
  std::string text;
  for (const auto& [key, value] : document.items()) {
    text += fmt::format("{}\n{}: ", text.empty() ? "{" : ",", line(key));
    if (!value.is_array() || value.empty() || !value.front().is_object()) {
      text += line(value);
      continue;
    }
    for (const Json& row : value) text += (&row == &value.front() ? "[\n" : ",\n") + line(row);
    text += "\n]";
  }
  return text + "\n}\n";
}

bool reads_peeled_layers(const Reads& reads) { return contains(reads.depths, "peel"); }

std::string in_words(const Reads& reads) {
  if (reads_peeled_layers(reads)) return "all layers";
  const auto is_first = [](const std::string& depth) { return depth == "depth"; };
  if (!std::all_of(reads.depths.begin(), reads.depths.end(), is_first)) return "some layers";
  return reads.views > 1 ? "two views" : "one layer";
}

bool reads_one_layer(const Reads& reads) {
  return reads.views == 1 && std::all_of(reads.depths.begin(), reads.depths.end(),
                                         [](const std::string& depth) { return depth == "depth"; });
}

Measurements read_measurements(const std::filesystem::path& folder) {
  std::error_code unknown;
  if (!std::filesystem::is_directory(folder, unknown))
    throw Error("{}: is not a folder; 'gloam bench -o {}' makes one to report on", folder.string(), folder.string());
  const std::filesystem::path file = measurements_file(folder);
  const Measurements m = read_file(file);
  if (m.rows.empty() && m.submitted.empty() && !m.sequence) nothing_to_show(file);
  return m;
}

std::filesystem::path measurements_file(const std::filesystem::path& folder_or_file) {
  std::error_code unknown;
  const std::string name = folder_or_file.string();
  if (std::filesystem::is_regular_file(folder_or_file, unknown)) return folder_or_file;
  if (!std::filesystem::is_directory(folder_or_file, unknown))
    throw Error("{}: is neither a folder nor a file; 'gloam bench -o DIR' makes DIR/bench.json", name);
  const std::filesystem::path file = folder_or_file / "bench.json";
  if (!std::filesystem::exists(file, unknown))
    throw Error("{}: has no bench.json; 'gloam bench -o {}' makes one", name, name);
  return file;
}

Measurements read_measurements_file(const std::filesystem::path& file) {
  const Measurements m = read_file(file);
  if (m.rows.empty() && m.converged.empty() && m.scales.empty() && m.planes.empty() && m.submitted.empty() &&
      !m.sequence)
    nothing_to_show(file);
  return m;
}

}  // namespace gloam::report
