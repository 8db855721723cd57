#include "cli/pick/shot.h"

#include <algorithm>

#include "base/statistics.h"
#include "choose/shot.h"
#include "gloam/error.h"

namespace gloam::cli {
namespace {

using namespace gloam::bench;

constexpr size_t most_rows = 12;

Json entry_of(const SequenceRow& row) {
  return {{"technique", row.variation.technique->name},
          {"preset", row.variation.name()},
          {"temporal", row.variation.temporal},
          {"ms", median(row.ms)},
          {"rmse", row.rmse},
          {"ssim", row.ssim},
          {"flicker", row.flicker.flicker() ? Json(*row.flicker.flicker()) : Json(nullptr)}};
}

void print(const MeasuredShot& shot, const PickOptions& options, const DeviceInfo& device) {
  std::vector<std::vector<std::string>> table = {{"", "technique", "preset", "", "ms", "RMSE", "SSIM", "flicker"}};
  const std::vector<SequenceRow>& rows = shot.measured.rows;
  for (size_t i = 0; i < std::min(rows.size(), most_rows); ++i) {
    const std::optional<double> flicker = rows[i].flicker.flicker();
    table.push_back({i == 0 ? ">" : "", rows[i].variation.technique->name, rows[i].variation.name(),
                     rows[i].variation.temporal ? "temporal" : "", fmt::format("{:.2f}", median(rows[i].ms)),
                     fmt::format("{:.4f}", rows[i].rmse), fmt::format("{:.4f}", rows[i].ssim),
                     flicker ? fmt::format("{:.4f}", *flicker) : "-"});
  }
  print_table(table, 4);
  fmt::print("{} of {} settings, over {} frames; {}; ms: kernels of one frame; {} decides (--by)\n", table.size() - 1,
             rows.size(), shot.sequence.frames.size(), printable(device.name), name_of(options.by));
}

}  // namespace

void pick_on_shot(const SequenceBenchFlags& flags, const PickOptions& options, const SceneOptions& scene,
                  const std::vector<Skipped>& skipped, Device& device, const JsonFlag& json,
                  const std::function<std::string(const Variation&)>& run_line) {
  if (options.by == PickBy::flip)
    throw UsageError("--by flip: is measured on one frame; of a shot, --by takes rmse, ssim and flicker");
  check(flags);
  MeasureOptions measuring;
  measuring.techniques = options.techniques;
  measuring.progress = options.progress;
  MeasuredShot shot = measure_own_shot(flags, measuring, scene, skipped, device, {{"--json", json.file()}});
  std::vector<SequenceRow>& rows = shot.measured.rows;
  rank(rows, options);
  const std::string command = run_line(rows.front().variation);
  Json document = {{"command", command}};
  document.update(entry_of(rows.front()));
  document["device"] = device.info().name;
  document["by"] = word_for(options.by, pick_figures);
  document["settings"] = Json::array();
  for (const SequenceRow& row : rows) document["settings"].push_back(entry_of(row));
  document["skipped"] = Json::array();
  for (const Skipped& s : shot.measured.skipped)
    document["skipped"].push_back({{"technique", s.technique}, {"preset", s.preset}, {"why", s.why}});
  json.write(document);
  if (json.only_json()) return;
  print(shot, options, device.info());
  fmt::print("{}\n", printable(command));
}

}  // namespace gloam::cli
