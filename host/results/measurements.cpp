#include "results/measurements.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/files.h"
#include "base/json_text.h"
#include "base/lists.h"
#include "gloam/error.h"
#include "results/json_object.h"
#include "technique/ambient_occlusion.h"

namespace gloam::report {
namespace {

Milliseconds milliseconds_of(const Object& object) {
  const double median = object.needed_number("median");
  return {median, object.number("min").value_or(median), object.number("max").value_or(median),
          object.numbers("rounds")};
}

std::optional<PassCount> count_of(const Object& pass) {
  if (pass.json().value("per_pixel", Json()).is_null()) return {};
  const Object count = pass.object("per_pixel");
  return PassCount{count.needed_number("operations"), count.needed_number("loads"), count.needed_number("bytes_loaded"),
                   count.needed_number("bytes_stored")};
}

std::optional<Peaks> peaks_of(const Object& scene) {
  const Object peaks = scene.object("peaks");
  const Peaks found{peaks.number("copy_gb_per_s"), peaks.number("gather_g_per_s"), peaks.number("fma_gflops")};
  if (!found.copy_gb_per_s && !found.gather_g_per_s && !found.fma_gflops) return {};
  return found;
}

Ladder ladder_of(const Object& l) {
  return {l.number("t0w"), l.number("t1"),      l.number("t2"),       l.number("t12"),
          l.number("t3"),  l.number("t4_bias"), l.number("t4_noise"), l.number("t5")};
}

/// The plane that was measured; older files know ambient occlusion alone.
std::string effect_of(const Object& o) {
  const std::string effect = o.text("effect");
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

Reads reads_of(const Object& o) {
  Reads reads = reads_by_name(o.needed_text("technique"));
  if (const auto depths = o.texts("depths")) reads.depths = *depths;
  reads.views = int(std::clamp(o.number("views").value_or(1), 0.0, 1e9));
  return reads;
}

RoundRatios round_ratios_of(const Object& o, const std::string& ratio) {
  return {o.numbers(ratio.c_str()), o.numbers(("cpu_" + ratio).c_str())};
}

Row row_of(const Object& o) {
  Row row;
  row.technique = o.needed_text("technique");
  row.preset = o.text("preset");
  row.variant = o.text("variant");
  row.effect = effect_of(o);
  row.scene = with_effect(o.needed_text("scene"), row.effect);
  row.kind = o.text("kind");
  row.reads = reads_of(o);
  if (o.json().value("submitted", Json()).is_object())
    row.submitted = o.json()["submitted"];
  else
    row.ms = milliseconds_of(o.needed_object("ms"));
  row.ssim = o.number("ssim");
  row.flip = o.number("flip");
  row.flicker = o.number("flicker");
  row.inconsistency = o.number("inconsistency");
  row.rmse_to_truth = o.number("rmse_to_truth");
  row.bias = o.number("bias");
  row.ratio_to_hbao_plus = o.number("ratio_to_hbao_plus");
  row.ratio_to_gather_floor = o.number("ratio_to_gather_floor");
  row.ratio_to_copy_floor = o.number("ratio_to_copy_floor");
  row.ratio_to_naive = o.number("ratio_to_naive");
  row.ratio_to_native = o.number("ratio_to_native");
  row.hbao_plus_rounds = round_ratios_of(o, "ratio_to_hbao_plus_rounds");
  row.gather_floor_rounds = round_ratios_of(o, "ratio_to_gather_floor_rounds");
  row.copy_floor_rounds = round_ratios_of(o, "ratio_to_copy_floor_rounds");
  row.processes = o.numbers("processes");
  row.own_floor_ms = o.number("own_floor_ms");
  row.ratio_to_own_floor = o.number("ratio_to_own_floor");
  row.ladder = ladder_of(o.object("ladder"));
  for (const Object& n : o.list("naive")) row.naive.push_back({n.needed_text("part"), n.needed_number("ratio")});
  for (const Object& s : o.list("spent_on")) row.spent_on.push_back({s.needed_text("what"), s.needed_number("share")});
  for (const Object& p : o.list("passes"))
    row.passes.push_back({p.needed_text("name"), milliseconds_of(p.needed_object("ms")), count_of(p)});
  row.width = o.number("width");
  row.height = o.number("height");
  row.lanes = o.number("lanes");
  row.samples = o.number("samples");
  row.resolution = o.text("resolution");
  row.math = o.text("math");
  row.real = o.text("real");
  row.storage = o.text("storage");
  row.settings = o.object("settings").json();
  row.image = o.text("image");
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

Scene scene_of(const Object& o) {
  Scene scene;
  scene.title = o.needed_text("name");
  scene.effect = effect_of(o);
  scene.name = with_effect(scene.title, scene.effect);
  scene.kind = o.text("kind");
  scene.own_class = scene.scene_class = o.text("class");
  if (scene.scene_class != "own") scene.scene_class = with_effect(scene.scene_class, scene.effect);
  std::tie(scene.width, scene.height) = o.size("size");
  scene.radius = o.number("radius");
  scene.radius_from = o.text("radius_from");
  scene.radius_pixels = o.number("radius_pixels");
  scene.truth_noise = o.number("truth_noise");
  scene.truth_image = o.text("truth_image");
  const Object base = o.object("base");
  scene.base = base.text("name");
  scene.base_rmse = base.number("rmse_to_truth");
  scene.base_bias = base.number("bias");
  scene.white = o.number("white").value_or(1);
  scene.peaks = peaks_of(o);
  return scene;
}

Growth growth_of(const Object& o) {
  Growth growth{o.needed_text("technique"), o.needed_text("over"), o.text("scene"), o.needed_number("exponent")};
  const std::vector<Object> points = o.list("points");
  if (points.empty()) return growth;
  growth.x_from = points.front().number("x");
  growth.x_to = points.back().number("x");
  growth.ms_from = points.front().number("ms");
  growth.ms_to = points.back().number("ms");
  return growth;
}

PaperFigure paper_figure_of(const Object& o) {
  return {o.text("table"), o.text("row"),     o.text("column"),       o.text("base"),
          o.number("ms"),  o.number("ratio"), o.number("paper_ratio")};
}

Converged converged_of(const Object& o) {
  return {o.needed_text("technique"),
          with_effect(o.needed_text("scene"), effect_of(o)),
          o.number("rmse_to_truth"),
          o.number("bias"),
          reads_of(o),
          effect_of(o)};
}

ScaleChange scale_change_of(const Object& o) {
  return {o.needed_text("technique"), o.needed_text("scene"),  o.needed_text("from"),
          o.needed_text("to"),        o.number("mean_change"), o.number("mae")};
}

PlaneReading plane_reading_of(const Object& o) {
  return {o.needed_text("technique"), o.needed_text("plane"), o.needed_number("least"),
          o.number("mean"),           o.number("tilt"),       o.number("direction"),
          o.text("camera"),           o.number("x"),          o.number("y")};
}

SequenceRow sequence_row_of(const Object& o) {
  const Object worst = o.object("worst");
  return {.technique = o.needed_text("technique"),
          .preset = o.text("preset"),
          .temporal = o.json().value("temporal", Json(false)) == Json(true),
          .ms = milliseconds_of(o.needed_object("ms")),
          .ratio_to_hbao_plus = o.number("ratio_to_hbao_plus"),
          .rmse = o.number("rmse"),
          .worst_rmse = worst.number("rmse"),
          .worst_frame = worst.number("frame"),
          .ssim = o.number("ssim"),
          .flicker = o.number("flicker")};
}

std::optional<Sequence> sequence_of(const Object& o) {
  Sequence sequence;
  for (const Object& row : o.list("rows")) sequence.rows.push_back(sequence_row_of(row));
  if (sequence.rows.empty()) return {};
  sequence.shot = o.text("shot");
  if (const Json frames = o.json().value("frames", Json::array()); frames.is_array()) sequence.frames = frames.size();
  std::tie(sequence.width, sequence.height) = o.size("size");
  sequence.radius = o.number("radius");
  sequence.truth_rays = o.number("truth_rays");
  sequence.truth_change = o.number("truth_change");
  return sequence;
}

std::map<std::string, HeldCases> stability_of(const Object& o) {
  std::map<std::string, HeldCases> stability;
  for (const auto& [technique, counts] : o.json().items()) {
    const Object each = o.needed_object(technique.c_str());
    stability[technique] = {each.needed_count("held"), each.needed_count("cases")};
  }
  return stability;
}

SetFacts set_of(const Object& o) { return {o.text("name"), o.text("part"), o.text("hash"), o.number("seed")}; }

Measurements content_of(const Object& o) {
  Measurements m;
  m.device = o.text("device");
  m.cpu = o.text("cpu");
  m.driver = o.text("driver");
  m.date = o.text("date");
  m.commit = o.text("commit");
  m.gloam = o.text("gloam");
  m.command = o.texts("command").value_or(std::vector<std::string>());
  m.set = set_of(o.object("set"));
  m.cores = o.number("cores");
  m.rounds = o.number("rounds");
  m.rays = o.number("rays");
  for (const Object& each : o.list("scenes")) m.scenes.push_back(scene_of(each));
  set_kinds_apart(m.scenes);
  for (const Object& each : o.needed_list("results")) {
    Row row = row_of(each);
    (row.submitted.is_null() ? m.rows : m.submitted).push_back(std::move(row));
  }
  for (const Object& each : o.list("growth")) m.growth.push_back(growth_of(each));
  for (const Object& each : o.list("skipped"))
    m.skipped.push_back({each.text("technique"), each.text("preset"), each.text("scene"), each.text("why")});
  for (const Object& each : o.list("left_out")) {
    if (const std::string what = each.text("what"); what != "everything" && what != "rounds") continue;
    const std::string variant = each.text("variant");
    m.skipped.push_back({each.text("technique"), each.text("preset") + (variant.empty() ? "" : ", " + variant),
                         each.text("scene"), "left out to end in time; --all measures it"});
  }
  for (const Object& each : o.list("paper")) m.paper.push_back(paper_figure_of(each));
  for (const Object& each : o.list("converged")) m.converged.push_back(converged_of(each));
  for (const Object& each : o.list("scales")) m.scales.push_back(scale_change_of(each));
  for (const Object& each : o.list("planes")) m.planes.push_back(plane_reading_of(each));
  m.sequence = sequence_of(o.object("sequence"));
  m.stability = stability_of(o.object("stability"));
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
  Measurements m = content_of(Object(document, name, ""));
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
