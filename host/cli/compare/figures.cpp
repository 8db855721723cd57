#include "cli/compare/figures.h"

#include <algorithm>
#include <cmath>

#include "gloam/planes.h"

namespace gloam::cli {
namespace {

/// The meaning of a positive and a negative bias, in words.
std::string bias_words(double bias, const std::string& plane) {
  if (std::abs(bias) < 5e-6) return "";
  const PlaneKind kind = plane_kind(plane);
  const bool light = kind.meaning == PlaneKind::unit_interval || kind.components.front() == "r";
  return bias > 0 ? (light ? "  (too bright)" : "  (too high)") : (light ? "  (too dark)" : "  (too low)");
}

}  // namespace

Json metrics_document(const Metrics& m) {
  Json document = {{"pixels", m.pixels},
                   {"mae", m.mae},
                   {"rmse", m.rmse},
                   {"bias", m.bias},
                   {"psnr", m.psnr ? Json(*m.psnr) : Json()},
                   {"max", m.max},
                   {"over_1_255", m.over_1_255},
                   {"over_0_05", m.over_0_05},
                   {"ssim", m.ssim},
                   {"gmsd", m.gmsd}};
  if (m.flip) document["flip"] = *m.flip;
  if (m.rse) document["rse"] = *m.rse;
  return document;
}

void print_heading(const PlanePair& planes, const CompareFlags& flags) {
  const std::string test = printable(flags.test), reference = printable(flags.reference);
  if (planes.test == planes.reference)
    fmt::print("{}: {} against {} (test - truth)\n", planes.test, test, reference);
  else
    fmt::print("{} of {} against {} of {} (test - truth)\n", planes.test, test, planes.reference, reference);
}

void print_metrics(const std::string& view, const std::string& plane, const Metrics& m) {
  if (!view.empty()) fmt::print("view {}\n", printable(view));
  std::vector<std::vector<std::string>> rows = {{"pixels", std::to_string(m.pixels)},
                                                {"RMSE", fmt::format("{:.5f}", m.rmse)},
                                                {"MAE", fmt::format("{:.5f}", m.mae)},
                                                {"bias", fmt::format("{:+.5f}{}", m.bias, bias_words(m.bias, plane))},
                                                {"PSNR", m.psnr ? fmt::format("{:.2f} dB", *m.psnr) : "identical"},
                                                {"max", fmt::format("{:.5f}", m.max)},
                                                {"over 1/255", fmt::format("{:.2f} %", 100 * m.over_1_255)},
                                                {"over 0.05", fmt::format("{:.2f} %", 100 * m.over_0_05)},
                                                {"SSIM", fmt::format("{:.4f}", m.ssim)},
                                                {"GMSD", fmt::format("{:.4f}", m.gmsd)}};
  if (m.flip) rows.push_back({"FLIP", fmt::format("{:.4f}", *m.flip)});
  if (m.rse) rows.push_back({"RSE", fmt::format("{:.5f}", *m.rse)});
  print_table(rows, 2);
}

}  // namespace gloam::cli
