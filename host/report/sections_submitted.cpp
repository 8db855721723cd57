#include "report/sections_submitted.h"

#include <fmt/format.h>

#include <algorithm>

#include "page/submitted.h"
#include "report/markdown_text.h"

namespace gloam::report {
namespace {

std::string plain_figure(const Number& value) { return value ? fmt::format("{:.3f}", *value) : "-"; }

/// The nearest plain setting that gloam has on a scene; null if it has none with an error.
const Row* nearest_of_gloam(const Material& material, const std::string& scene) {
  const Row* nearest = nullptr;
  for (const Row& row : material.all.rows) {
    if (row.scene != scene || !row.rmse_to_truth || !row.variant.empty()) continue;
    if (!nearest || *row.rmse_to_truth < *nearest->rmse_to_truth) nearest = &row;
  }
  return nearest;
}

std::string time_text(const SubmittedFacts& facts) {
  std::string text;
  if (facts.whole_ratio) text = fmt::format("{} times gloam run, both whole", ratio_text(facts.whole_ratio));
  if (facts.stated_ms)
    text += fmt::format("{}{:.3g} ms stated{}", text.empty() ? "" : "; ", *facts.stated_ms,
                        facts.device.empty() ? "" : " (" + plain_text(facts.device) + ")");
  return text.empty() ? "-" : text;
}

}  // namespace

std::string submitted_section(const Material& material) {
  std::string tables;
  for (const Scene& scene : material.all.scenes) {
    Table table({"method", "RMSE (bias)", "at its best fit", "SSIM", "FLIP", "time"}, "lrrrrl");
    for (const Row& row : material.all.submitted) {
      if (row.scene != scene.name) continue;
      const SubmittedFacts facts = facts_of(row.submitted);
      const std::string version = facts.version.empty() ? "" : " " + facts.version;
      table.add({plain_text(row.technique + version), error_and_bias(row.rmse_to_truth, row.bias),
                 error_text(facts.fit_rmse), plain_figure(row.ssim), plain_figure(row.flip), time_text(facts)});
    }
    if (table.empty()) continue;
    if (const Row* own = nearest_of_gloam(material, scene.name))
      table.add({setting_text(own->technique, own->preset) + ", the nearest of gloam",
                 error_and_bias(own->rmse_to_truth, own->bias), "-", plain_figure(own->ssim), plain_figure(own->flip),
                 own->ratio_to_hbao_plus ? ratio_text(own->ratio_to_hbao_plus) + " times HBAO+ medium" : "-"});
    tables += fmt::format("### Submitted on {}\n\n", plain_text(scene.name)) + table.text();
  }
  if (tables.empty()) return "";
  return "## Submitted methods\n\n" +
         paragraph(
             "Images that others made, scored by `gloam score` against the same truths. The best fit is 1 - s (1 - "
             "AO^p), of light a factor, one for all images of a method. Stated times are their authors' own, measured "
             "elsewhere; a ratio to gloam run is of whole processes, in turn on one machine.") +
         tables;
}

}  // namespace gloam::report
