#include "cli/score/print.h"

#include <algorithm>
#include <cstdio>

#include "gloam/error.h"

namespace gloam::cli {
namespace {

std::string figure(const std::optional<double>& value, const char* format = "{:.4f}") {
  return value ? fmt::format(fmt::runtime(format), *value) : "-";
}

std::string time_of(const Json& row) {
  const Json& whole = row["submitted"]["whole"];
  if (whole.is_object()) {
    const std::string ms = fmt::format("{:.1f}", whole["ms"]["median"].get<double>());
    return whole["ratio"].is_null() ? ms : fmt::format("{} ({:.2f}x)", ms, whole["ratio"].get<double>());
  }
  return row["ms"].is_null() ? "-" : fmt::format("{:.3g} stated", row["ms"]["median"].get<double>());
}

std::string in_words(const score::BestFit& fit, bool is_of_shares) {
  return is_of_shares ? fmt::format("1 - {:.3f} (1 - ao^{:.3f})", fit.strength, fit.exponent)
                      : fmt::format("times {:.4g}", fit.scale);
}

Json fit_document(const score::BestFit& fit, bool is_of_shares) {
  if (!is_of_shares) return {{"exponent", nullptr}, {"strength", nullptr}, {"scale", fit.scale}, {"rmse", fit.rmse}};
  return {{"exponent", fit.exponent}, {"strength", fit.strength}, {"scale", nullptr}, {"rmse", fit.rmse}};
}

}  // namespace

void tell_left_out(const std::vector<score::LeftOut>& left_out) {
  for (const score::LeftOut& each : left_out)
    std::fputs((printable(fmt::format("gloam: {}: left out: {}", each.item, each.why)) + "\n").c_str(), stderr);
}

void print_scores(const score::Entry& entry, const std::vector<ScoredRow>& rows,
                  const std::map<std::string, score::BestFit>& fits) {
  fmt::print("{}{}\n", printable(entry.name), entry.version.empty() ? "" : " " + printable(entry.version));
  std::vector<std::vector<std::string>> table = {
      {"item", "effect", "ms", "RMSE", "bias", "SSIM", "FLIP", "flicker", "eyes", "RMSE at fit"}};
  for (const ScoredRow& row : rows) {
    const score::Figures& f = row.scored.figures;
    const size_t missing = row.scored.missing.size();
    table.push_back({row.scored.target.name + (missing ? fmt::format(" ({} frames missing)", missing) : ""),
                     row.scored.target.effect, time_of(row.row), figure(f.rmse), figure(f.bias, "{:+.4f}"),
                     figure(f.ssim), figure(f.flip), figure(f.flicker), figure(f.inconsistency),
                     row.at_fit ? figure(row.at_fit->rmse) : "-"});
  }
  print_table(table, 2);
  for (const auto& [effect, fit] : fits)
    fmt::print("best fit of {} over all items: {}\n", effect, in_words(fit, score::is_share(effect)));
}

Json scores_document(const score::Entry& entry, const std::vector<ScoredRow>& rows,
                     const std::map<std::string, score::BestFit>& fits, const std::vector<score::LeftOut>& left_out) {
  Json list = Json::array(), left = Json::array(), fitted = Json::object();
  for (const ScoredRow& row : rows) list.push_back(row.row);
  for (const score::LeftOut& each : left_out) left.push_back({{"item", each.item}, {"why", each.why}});
  for (const auto& [effect, fit] : fits) fitted[effect] = fit_document(fit, score::is_share(effect));
  return {{"name", entry.name}, {"results", list}, {"fit", fitted}, {"left_out", left}};
}

}  // namespace gloam::cli
