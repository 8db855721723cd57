#include "results/measurements.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/files.h"
#include "base/json_object.h"
#include "base/json_text.h"
#include "base/lists.h"
#include "gloam/error.h"
#include "technique/ambient_occlusion.h"

namespace gloam::report {
namespace {

Milliseconds milliseconds_of(const JsonObject& object) {
  const double median = object.number("median");
  return {median, object.number_if("min").value_or(median), object.number_if("max").value_or(median),
          object.numbers_if("rounds")};
}

std::optional<PassCount> count_of(const JsonObject& pass) {
  if (pass.json().value("per_pixel", Json()).is_null()) return {};
  const JsonObject count = pass.object_if("per_pixel");
  return PassCount{count.number("operations"), count.number("loads"), count.number("bytes_loaded"),
                   count.number("bytes_stored")};
}

std::optional<Peaks> peaks_of(const JsonObject& scene) {
  const JsonObject peaks = scene.object_if("peaks");
  const Peaks found{peaks.number_if("copy_gb_per_s"), peaks.number_if("gather_g_per_s"), peaks.number_if("fma_gflops")};
  if (!found.copy_gb_per_s && !found.gather_g_per_s && !found.fma_gflops) return {};
  return found;
}

/// The two numbers of a size; empty if there is none.
std::pair<Number, Number> size_of(const JsonObject& o) {
  const std::vector<double> size = o.numbers_if("size");
  if (size.size() != 2) {
    if (o.find("size")) o.refuse("size", "a list of width and height is needed");
    return {};
  }
  return {size[0], size[1]};
}

Ladder ladder_of(const JsonObject& l) {
  return {l.number_if("t0w"), l.number_if("t1"),      l.number_if("t2"),       l.number_if("t12"),
          l.number_if("t3"),  l.number_if("t4_bias"), l.number_if("t4_noise"), l.number_if("t5")};
}

/// The plane that was measured; older files know ambient occlusion alone.
std::string effect_of(const JsonObject& o) {
  const std::string effect = o.text_if("effect");
  return effect.empty() ? "ao" : effect;
}

/// What one effect was measured on, apart from the same scene of another.
std::string with_effect(const std::string& text, const std::string& effect) {
  if (effect == "ao") return text;
  return text.empty() ? effect : fmt::format("{} ({})", text, effect);
}

/// For files that do not state what a technique reads.
Reads reads_by_name(const std::string& technique) {
  if (technique.starts_with(peeled_prefix)) return {{"depth", "peel"}};
  if (technique.starts_with(stochastic_prefix)) return {{"depth", "stochastic"}};
  return {{"depth"}};
}

Reads reads_of(const JsonObject& o) {
  Reads reads = reads_by_name(o.text("technique"));
  if (const auto depths = o.texts_if("depths")) reads.depths = *depths;
  reads.views = int(std::clamp(o.number_if("views").value_or(1), 0.0, 1e9));
  return reads;
}

RoundRatios round_ratios_of(const JsonObject& o, const std::string& ratio) {
  return {o.numbers_if(ratio), o.numbers_if("cpu_" + ratio)};
}

Row row_of(const JsonObject& o) {
  Row row;
  row.technique = o.text("technique");
  row.preset = o.text_if("preset");
  row.variant = o.text_if("variant");
  row.effect = effect_of(o);
  row.scene = with_effect(o.text("scene"), row.effect);
  row.kind = o.text_if("kind");
  row.reads = reads_of(o);
  if (o.json().value("submitted", Json()).is_object())
    row.submitted = o.json()["submitted"];
  else
    row.ms = milliseconds_of(o.object("ms"));
  row.ssim = o.number_if("ssim");
  row.flip = o.number_if("flip");
  row.flicker = o.number_if("flicker");
  row.inconsistency = o.number_if("inconsistency");
  row.rmse_to_truth = o.number_if("rmse_to_truth");
  row.bias = o.number_if("bias");
  row.ratio_to_hbao_plus = o.number_if("ratio_to_hbao_plus");
  row.ratio_to_gather_floor = o.number_if("ratio_to_gather_floor");
  row.ratio_to_copy_floor = o.number_if("ratio_to_copy_floor");
  row.ratio_to_naive = o.number_if("ratio_to_naive");
  row.ratio_to_native = o.number_if("ratio_to_native");
  row.hbao_plus_rounds = round_ratios_of(o, "ratio_to_hbao_plus_rounds");
  row.gather_floor_rounds = round_ratios_of(o, "ratio_to_gather_floor_rounds");
  row.copy_floor_rounds = round_ratios_of(o, "ratio_to_copy_floor_rounds");
  row.processes = o.numbers_if("processes");
  row.own_floor_ms = o.number_if("own_floor_ms");
  row.ratio_to_own_floor = o.number_if("ratio_to_own_floor");
  row.ladder = ladder_of(o.object_if("ladder"));
  for (const JsonObject& n : o.objects_if("naive")) row.naive.push_back({n.text("part"), n.number("ratio")});
  for (const JsonObject& s : o.objects_if("spent_on")) row.spent_on.push_back({s.text("what"), s.number("share")});
  for (const JsonObject& p : o.objects_if("passes"))
    row.passes.push_back({p.text("name"), milliseconds_of(p.object("ms")), count_of(p)});
  row.width = o.number_if("width");
  row.height = o.number_if("height");
  row.lanes = o.number_if("lanes");
  row.samples = o.number_if("samples");
  row.resolution = o.text_if("resolution");
  row.math = o.text_if("math");
  row.real = o.text_if("real");
  row.storage = o.text_if("storage");
  row.settings = o.object_if("settings").json();
  row.image = o.text_if("image");
  return row;
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

Scene scene_of(const JsonObject& o) {
  Scene scene;
  scene.title = o.text("name");
  scene.effect = effect_of(o);
  scene.name = with_effect(scene.title, scene.effect);
  scene.kind = o.text_if("kind");
  scene.own_class = scene.scene_class = o.text_if("class");
  if (scene.scene_class != "own") scene.scene_class = with_effect(scene.scene_class, scene.effect);
  std::tie(scene.width, scene.height) = size_of(o);
  scene.radius = o.number_if("radius");
  scene.radius_from = o.text_if("radius_from");
  scene.radius_pixels = o.number_if("radius_pixels");
  scene.truth_noise = o.number_if("truth_noise");
  scene.truth_image = o.text_if("truth_image");
  const JsonObject base = o.object_if("base");
  scene.base = base.text_if("name");
  scene.base_rmse = base.number_if("rmse_to_truth");
  scene.base_bias = base.number_if("bias");
  scene.white = o.number_if("white").value_or(1);
  scene.peaks = peaks_of(o);
  return scene;
}

Growth growth_of(const JsonObject& o) {
  Growth growth{o.text("technique"), o.text("over"), o.text_if("scene"), o.number("exponent")};
  const std::vector<JsonObject> points = o.objects_if("points");
  if (points.empty()) return growth;
  growth.x_from = points.front().number_if("x");
  growth.x_to = points.back().number_if("x");
  growth.ms_from = points.front().number_if("ms");
  growth.ms_to = points.back().number_if("ms");
  return growth;
}

PaperFigure paper_figure_of(const JsonObject& o) {
  return {o.text_if("table"), o.text_if("row"),     o.text_if("column"),       o.text_if("base"),
          o.number_if("ms"),  o.number_if("ratio"), o.number_if("paper_ratio")};
}

Converged converged_of(const JsonObject& o) {
  return {o.text("technique"),
          with_effect(o.text("scene"), effect_of(o)),
          o.number_if("rmse_to_truth"),
          o.number_if("bias"),
          reads_of(o),
          effect_of(o)};
}

ScaleChange scale_change_of(const JsonObject& o) {
  return {o.text("technique"),        o.text("scene"),   o.text("from"), o.text("to"),
          o.number_if("mean_change"), o.number_if("mae")};
}

PlaneReading plane_reading_of(const JsonObject& o) {
  return {o.text("technique"),      o.text("plane"),     o.number("least"), o.number_if("mean"), o.number_if("tilt"),
          o.number_if("direction"), o.text_if("camera"), o.number_if("x"),  o.number_if("y")};
}

SequenceRow sequence_row_of(const JsonObject& o) {
  const JsonObject worst = o.object_if("worst");
  return {.technique = o.text("technique"),
          .preset = o.text_if("preset"),
          .temporal = o.json().value("temporal", Json(false)) == Json(true),
          .ms = milliseconds_of(o.object("ms")),
          .ratio_to_hbao_plus = o.number_if("ratio_to_hbao_plus"),
          .rmse = o.number_if("rmse"),
          .worst_rmse = worst.number_if("rmse"),
          .worst_frame = worst.number_if("frame"),
          .ssim = o.number_if("ssim"),
          .flicker = o.number_if("flicker")};
}

std::optional<Sequence> sequence_of(const JsonObject& o) {
  Sequence sequence;
  for (const JsonObject& row : o.objects_if("rows")) sequence.rows.push_back(sequence_row_of(row));
  if (sequence.rows.empty()) return {};
  sequence.shot = o.text_if("shot");
  if (const Json frames = o.json().value("frames", Json::array()); frames.is_array()) sequence.frames = frames.size();
  std::tie(sequence.width, sequence.height) = size_of(o);
  sequence.radius = o.number_if("radius");
  sequence.truth_rays = o.number_if("truth_rays");
  sequence.truth_change = o.number_if("truth_change");
  return sequence;
}

std::map<std::string, HeldCases> stability_of(const JsonObject& o) {
  std::map<std::string, HeldCases> stability;
  for (const auto& [technique, counts] : o.json().items()) {
    const JsonObject each = o.object(technique);
    stability[technique] = {size_t(each.whole("held")), size_t(each.whole("cases"))};
  }
  return stability;
}

SetFacts set_of(const JsonObject& o) {
  return {o.text_if("name"), o.text_if("part"), o.text_if("hash"), o.number_if("seed")};
}

Measurements content_of(const JsonObject& o) {
  Measurements m;
  m.device = o.text_if("device");
  m.cpu = o.text_if("cpu");
  m.driver = o.text_if("driver");
  m.date = o.text_if("date");
  m.commit = o.text_if("commit");
  m.gloam = o.text_if("gloam");
  m.command = o.texts_if("command").value_or(std::vector<std::string>());
  m.set = set_of(o.object_if("set"));
  m.cores = o.number_if("cores");
  m.rounds = o.number_if("rounds");
  m.rays = o.number_if("rays");
  for (const JsonObject& each : o.objects_if("scenes")) m.scenes.push_back(scene_of(each));
  set_kinds_apart(m.scenes);
  for (const JsonObject& each : o.objects("results")) {
    Row row = row_of(each);
    (row.submitted.is_null() ? m.rows : m.submitted).push_back(std::move(row));
  }
  for (const JsonObject& each : o.objects_if("growth")) m.growth.push_back(growth_of(each));
  for (const JsonObject& each : o.objects_if("skipped"))
    m.skipped.push_back(
        {each.text_if("technique"), each.text_if("preset"), each.text_if("scene"), each.text_if("why")});
  for (const JsonObject& each : o.objects_if("left_out")) {
    if (const std::string what = each.text_if("what"); what != "everything" && what != "rounds") continue;
    const std::string variant = each.text_if("variant");
    m.skipped.push_back({each.text_if("technique"), each.text_if("preset") + (variant.empty() ? "" : ", " + variant),
                         each.text_if("scene"), "left out to end in time; --all measures it"});
  }
  for (const JsonObject& each : o.objects_if("paper")) m.paper.push_back(paper_figure_of(each));
  for (const JsonObject& each : o.objects_if("converged")) m.converged.push_back(converged_of(each));
  for (const JsonObject& each : o.objects_if("scales")) m.scales.push_back(scale_change_of(each));
  for (const JsonObject& each : o.objects_if("planes")) m.planes.push_back(plane_reading_of(each));
  m.sequence = sequence_of(o.object_if("sequence"));
  m.stability = stability_of(o.object_if("stability"));
  return m;
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
  Measurements m = content_of(JsonObject(document, {name, "remove the file, and gloam bench makes it anew"}));
  for (const auto* rows : {&m.rows, &m.submitted}) add_scenes_of_rows(m, *rows);
  return m;
}

bool reads_peeled_layers(const Reads& reads) { return contains(reads.depths, "peel"); }

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
