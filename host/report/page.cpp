#include "report/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <opencv2/imgproc.hpp>

#include "base/files.h"
#include "gloam/error.h"
#include "page/html.h"
#include "picture/picture.h"
#include "report/embedded.h"
#include "report/pictures.h"
#include "report/submitted.h"

namespace gloam::report {
namespace {

namespace fs = std::filesystem;

// --- Pictures

/// Averages over areas; transparent pixels do not count.
cv::Mat reduced(const cv::Mat& grey_alpha, int width) {
  const int height = std::max(1, cvRound(double(grey_alpha.rows) * width / grey_alpha.cols));
  std::vector<cv::Mat> planes;
  cv::Mat in;
  grey_alpha.convertTo(in, CV_32FC2);
  cv::split(in, planes);
  planes[0] = planes[0].mul(planes[1]);
  for (cv::Mat& plane : planes) cv::resize(plane, plane, cv::Size(width, height), 0, 0, cv::INTER_AREA);
  planes[0] /= cv::max(planes[1], 1e-6f);
  cv::Mat merged, out;
  cv::merge(planes, merged);
  merged.convertTo(out, CV_8UC2);
  return out;
}

/// A picture below the folder, at most `width` wide, as grey and alpha. Throws Error.
cv::Mat picture(const fs::path& folder, const std::string& name, int width) {
  const cv::Mat stored = stored_picture(folder, name);
  return width > 0 && stored.cols > width ? reduced(stored, width) : stored;
}

/// Every picture once, in order of first use. The pictures of a scene share their alpha, the frame's foreground, which would take
/// a fifth of every file: it is stored once.
class Pictures {
 public:
  void add(const std::string& name) {
    if (name.empty() || index_.count(name)) return;
    index_[name] = -1;
    names_.push_back(name);
  }

  void embed(const fs::path& folder, const PageOptions& options, Page& page) {
    for (size_t i = 0; i < names_.size(); ++i) {
      try {
        put(picture(folder, names_[i], options.picture_width), page.pictures);
        index_[names_[i]] = page.pictures++;
      } catch (const Error& error) {
        page.notes.push_back(fmt::format("{}; the report goes without this picture", error.what()));
      }
      if (options.progress) options.progress(int(i + 1), int(names_.size()));
    }
  }

  /// Index of a picture; null if there is none.
  Json index(const std::string& name) const {
    const auto found = index_.find(name);
    return found == index_.end() || found->second < 0 ? Json(nullptr) : Json(found->second);
  }
  const std::string& html() const { return html_; }

 private:
  /// Stores a picture as text that the browser ignores until the picture is asked for: 200 of them cost nothing at loading.
  void put_text(const std::string& attributes, const std::string& png) {
    html_ += fmt::format("<script type=\"text/plain\" {}>{}</script>\n", attributes, page::base64(png));
  }

  void put(const cv::Mat& grey_alpha, int number) {
    cv::Mat grey, alpha;
    cv::extractChannel(grey_alpha, grey, 0);
    cv::extractChannel(grey_alpha, alpha, 1);
    put_text(fmt::format("id=\"picture-{}\" data-mask=\"{}\"", number, mask(alpha)), encode_png(grey));
  }

  /// The number of a mask: a black picture with this alpha.
  size_t mask(const cv::Mat& alpha) {
    cv::Mat black = cv::Mat::zeros(alpha.size(), CV_8UC2);
    cv::insertChannel(alpha, black, 1);
    const std::string png = encode_png(black);
    const auto [found, is_new] = masks_.emplace(png, masks_.size());
    if (is_new) put_text(fmt::format("id=\"mask-{}\"", found->second), png);
    return found->second;
  }

  std::map<std::string, int> index_;
  std::map<std::string, size_t> masks_;
  std::vector<std::string> names_;
  std::string html_;
};

// --- Data for the page, fronts included: the page computes none.

Json json(const Number& number) { return number ? Json(*number) : Json(nullptr); }

Json json(const Milliseconds& ms) { return {{"median", ms.median}, {"min", ms.min}, {"max", ms.max}}; }

Json json(const Ladder& l) {
  return {{"t0w", json(l.t0w)},           {"t1", json(l.t1)}, {"t2", json(l.t2)},
          {"t12", json(l.t12)},           {"t3", json(l.t3)}, {"t4_bias", json(l.t4_bias)},
          {"t4_noise", json(l.t4_noise)}, {"t5", json(l.t5)}};
}

Json json(const Row& row, const Pictures& pictures) {
  Json spent_on = Json::array(), passes = Json::array();
  for (const Share& s : row.spent_on) spent_on.push_back({{"what", s.what}, {"share", s.share}});
  for (const Pass& p : row.passes) passes.push_back({{"name", p.name}, {"ms", json(p.ms)}});
  return {{"technique", row.technique},
          {"preset", row.preset},
          {"variant", row.variant},
          {"scene", row.scene},
          {"ms", json(row.ms)},
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

Json json(const Scene& scene, const std::vector<Row>& rows, const Pictures& pictures) {
  const SceneFront front = front_of_scene(rows, scene.name);
  return {{"name", scene.name},
          {"title", scene.title},
          {"effect", scene.effect},
          {"class", scene.scene_class},
          {"base", {{"name", scene.base}, {"rmse", json(scene.base_rmse)}, {"bias", json(scene.base_bias)}}},
          {"white", scene.white},
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
  return {{"technique", g.technique}, {"over", g.over},       {"scene", g.scene},           {"exponent", g.exponent},
          {"x_from", json(g.x_from)}, {"x_to", json(g.x_to)}, {"ms_from", json(g.ms_from)}, {"ms_to", json(g.ms_to)}};
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
                    {"worst_rmse", json(row.worst_rmse)},
                    {"worst_frame", json(row.worst_frame)},
                    {"ssim", json(row.ssim)},
                    {"flicker", json(row.flicker)}});
  return {{"shot", sequence.shot},
          {"frames", sequence.frames},
          {"width", json(sequence.width)},
          {"height", json(sequence.height)},
          {"truth_change", json(sequence.truth_change)},
          {"rows", rows}};
}

Json data_of(const Measurements& m, const Pictures& pictures) {
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

Page make_page(const Measurements& measurements, const fs::path& folder, const PageOptions& options) {
  Page made;
  Pictures pictures;
  for (const Scene& scene : measurements.scenes) pictures.add(scene.truth_image);
  for (const auto* rows : {&measurements.rows, &measurements.submitted}) {
    for (const Row& row : *rows) pictures.add(row.image);
  }
  pictures.embed(folder, options, made);
  page::Parts parts = page::shared_parts();
  parts.insert(embedded_files().begin(), embedded_files().end());
  parts["data"] = page::script_text(data_of(measurements, pictures));
  parts["pictures"] = pictures.html();
  made.html = page::filled(parts.at("report.html"), parts);
  return made;
}

}  // namespace gloam::report
