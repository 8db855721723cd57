#include "report/page.h"

#include <fmt/format.h>

#include "base/json_text.h"
#include "page/embedded_pictures.h"
#include "page/html.h"
#include "page/submitted.h"
#include "report/embedded.h"

namespace gloam::report {
namespace {

/// The pictures of one bench.json.
struct PicturesOfFolder {
  const EmbeddedPictures& all;
  const std::filesystem::path& folder;
  Json index(const std::string& name) const { return all.index(folder, name); }
};

// --- Data for the page, fronts included: the page computes none.

Json json(const Number& number) { return or_null(number); }

Json json(const Milliseconds& ms) { return {{"median", ms.median}, {"min", ms.min}, {"max", ms.max}}; }

Json json(const Ladder& l) {
  return {{"t0w", json(l.t0w)},           {"t1", json(l.t1)}, {"t2", json(l.t2)},
          {"t12", json(l.t12)},           {"t3", json(l.t3)}, {"t4_bias", json(l.t4_bias)},
          {"t4_noise", json(l.t4_noise)}, {"t5", json(l.t5)}};
}

Json json(const PassCount& count) {
  return {{"operations", count.operations},
          {"loads", count.loads},
          {"bytes_loaded", count.bytes_loaded},
          {"bytes_stored", count.bytes_stored}};
}

Json json(const Peaks& peaks) {
  return {{"copy_gb_per_s", json(peaks.copy_gb_per_s)},
          {"gather_g_per_s", json(peaks.gather_g_per_s)},
          {"fma_gflops", json(peaks.fma_gflops)}};
}

Json json(const Row& row, const PicturesOfFolder& pictures) {
  Json spent_on = Json::array(), passes = Json::array();
  for (const Share& s : row.spent_on) spent_on.push_back({{"what", s.what}, {"share", s.share}});
  for (const Pass& p : row.passes)
    passes.push_back({{"name", p.name},
                      {"ms", json(p.ms)},
                      {"per_pixel", p.per_pixel ? json(*p.per_pixel) : Json(nullptr)},
                      {"bound", p.bound ? Json{{"by", p.bound->by}, {"share", p.bound->share}} : Json(nullptr)}});
  return {{"technique", row.technique},
          {"preset", row.preset},
          {"variant", row.variant},
          {"scene", row.scene},
          {"ms", json(row.ms)},
          {"reads", in_words(row.reads)},
          {"rmse", json(row.rmse_to_truth)},
          {"bias", json(row.bias)},
          {"ssim", json(row.ssim)},
          {"flip", json(row.flip)},
          {"flicker", json(row.flicker)},
          {"inconsistency", json(row.inconsistency)},
          {"ratio", json(row.ratio_to_hbao_plus)},
          {"to_gather_floor", json(row.ratio_to_gather_floor)},
          {"to_copy_floor", json(row.ratio_to_copy_floor)},
          {"to_naive", json(row.ratio_to_naive)},
          {"to_native", json(row.ratio_to_native)},
          {"own_floor_ms", json(row.own_floor_ms)},
          {"to_own_floor", json(row.ratio_to_own_floor)},
          {"ladder", json(row.ladder)},
          {"spent_on", spent_on},
          {"passes", passes},
          {"width", json(row.width)},
          {"height", json(row.height)},
          {"lanes", json(row.lanes)},
          {"samples", json(row.samples)},
          {"resolution", row.resolution},
          {"math", row.math},
          {"storage", row.storage},
          {"settings", row.settings},
          {"picture", pictures.index(row.image)}};
}

Json json(const Scene& scene, const std::vector<Row>& rows, const PicturesOfFolder& pictures) {
  const SceneFront front = front_of_scene(rows, scene.name);
  return {{"name", scene.name},
          {"title", scene.title},
          {"effect", scene.effect},
          {"class", scene.scene_class},
          {"base", {{"name", scene.base.name}, {"rmse", json(scene.base.rmse)}, {"bias", json(scene.base.bias)}}},
          {"white", scene.white},
          {"peaks", scene.peaks ? json(*scene.peaks) : Json(nullptr)},
          {"width", json(scene.width)},
          {"height", json(scene.height)},
          {"radius", json(scene.radius)},
          {"radius_pixels", json(scene.radius_pixels)},
          {"truth_noise", json(scene.truth_noise)},
          {"truth_picture", pictures.index(scene.truth_image)},
          {"front", front.all},
          {"plain_front", front.plain},
          {"front_time", front.time == TimeOf::ratio ? "ratio" : "ms"},
          {"candidates", front.candidates}};
}

Json json(const ClassFront& front) {
  Json points = Json::array();
  for (const ClassPoint& p : front.points) {
    points.push_back({{"technique", p.technique},
                      {"preset", p.preset},
                      {"variant", p.variant},
                      {"rmse", p.error},
                      {"ratio", p.ratio},
                      {"on_front", p.on_front},
                      {"on_plain_front", p.on_plain_front},
                      {"fronts", p.fronts}});
  }
  return {{"name", front.name}, {"scenes", front.scenes}, {"points", points}, {"left_out", front.left_out}};
}

Json json(const Growth& g) {
  const bool has_points = !g.points.empty();
  const GrowthPoint first = has_points ? g.points.front() : GrowthPoint(),
                    last = has_points ? g.points.back() : GrowthPoint();
  const auto known = [&](double value) { return has_points ? Json(value) : Json(); };
  return {{"technique", g.technique}, {"over", g.over},        {"scene", g.scene},           {"exponent", g.exponent},
          {"x_from", known(first.x)}, {"x_to", known(last.x)}, {"ms_from", known(first.ms)}, {"ms_to", known(last.ms)}};
}

Json json(const PaperFigure& f) {
  return {{"table", f.table}, {"row", f.row},           {"column", f.column},
          {"ms", json(f.ms)}, {"ratio", json(f.ratio)}, {"paper_ratio", json(f.paper_ratio)},
          {"base", f.base}};
}

Json json(const Sequence& sequence) {
  Json rows = Json::array();
  for (const SequenceRow& row : sequence.rows)
    rows.push_back({{"technique", row.technique},
                    {"preset", row.preset},
                    {"temporal", row.temporal},
                    {"ms", json(row.ms)},
                    {"ratio", json(row.ratio_to_hbao_plus)},
                    {"rmse", json(row.rmse)},
                    {"worst_rmse", json(row.worst.rmse)},
                    {"worst_frame", json(row.worst.frame)},
                    {"ssim", json(row.ssim)},
                    {"flicker", json(row.flicker)}});
  return {{"shot", sequence.shot},
          {"frames", sequence.frames.size()},
          {"width", json(sequence.width)},
          {"height", json(sequence.height)},
          {"truth_change", json(sequence.truth_change)},
          {"rows", rows}};
}

Json data_of(const Measurements& m, const PicturesOfFolder& pictures) {
  Json data = {{"device", m.device}, {"cpu", m.cpu},           {"driver", m.driver},       {"date", m.date},
               {"commit", m.commit}, {"cores", json(m.cores)}, {"rounds", json(m.rounds)}, {"rays", json(m.rays)}};
  for (const char* list : {"scenes", "classes", "rows", "growth", "skipped", "paper"}) data[list] = Json::array();
  for (const Scene& scene : m.scenes) data["scenes"].push_back(json(scene, m.rows, pictures));
  for (const ClassFront& front : fronts_of_classes(m)) data["classes"].push_back(json(front));
  for (const Row& row : m.rows) data["rows"].push_back(json(row, pictures));
  for (const Row& row : m.submitted) data["rows"].push_back(submitted_row(row, json(row, pictures)));
  for (const Growth& g : m.growth) data["growth"].push_back(json(g));
  for (const Skipped& s : m.skipped)
    data["skipped"].push_back({{"technique", s.technique}, {"preset", s.preset}, {"scene", s.scene}, {"why", s.why}});
  for (const PaperFigure& f : m.paper) data["paper"].push_back(json(f));
  data["sequence"] = m.sequence ? json(*m.sequence) : Json(nullptr);
  return data;
}

}  // namespace

Page make_page(const Measurements& measurements, const std::filesystem::path& folder, const PageOptions& options) {
  Page made;
  EmbeddedPictures embedded;
  for (const Scene& scene : measurements.scenes) embedded.add(folder, scene.truth_image);
  for (const auto* rows : {&measurements.rows, &measurements.submitted}) {
    for (const Row& row : *rows) embedded.add(folder, row.image);
  }
  embedded.embed(options.picture_width, options.progress);
  made.pictures = embedded.count();
  made.notes = embedded.notes();
  const PicturesOfFolder pictures{embedded, folder};
  page::Parts parts = page::shared_parts();
  parts.insert(embedded_files().begin(), embedded_files().end());
  parts["data"] = page::script_text(data_of(measurements, pictures));
  parts["pictures"] = embedded.html();
  made.html = page::filled(parts.at("report.html"), parts);
  return made;
}

}  // namespace gloam::report
