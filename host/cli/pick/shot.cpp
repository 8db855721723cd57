#include "cli/pick/shot.h"

#include <algorithm>

#include "base/statistics.h"
#include "gloam/error.h"
#include "measure/sequence_document.h"

namespace gloam::cli {
namespace {

using namespace gloam::bench;

constexpr size_t most_rows = 12;

/// RMSE, 1 - SSIM or flicker.
double figure_of(const SequenceRow& row, PickBy by) {
  if (by == PickBy::flicker) return row.flicker.flicker().value_or(1);
  return by == PickBy::ssim ? 1 - row.ssim : row.rmse;
}

/// How far a setting misses the bound, as a factor; 1 or less: it is within.
double off(const SequenceRow& row, const PickOptions& options) {
  return options.budget ? median(row.ms) / *options.budget : figure_of(row, options.by) / *options.error;
}

/// The best first: those within the bound before others, and of these the nearest to it.
void sort(std::vector<SequenceRow>& rows, const PickOptions& options) {
  std::sort(rows.begin(), rows.end(), [&](const SequenceRow& a, const SequenceRow& b) {
    const double off_a = off(a, options), off_b = off(b, options);
    if ((off_a <= 1) != (off_b <= 1)) return off_a <= 1;
    if (off_a > 1) return off_a < off_b;
    return options.budget ? figure_of(a, options.by) < figure_of(b, options.by) : median(a.ms) < median(b.ms);
  });
}

Json entry_of(const SequenceRow& row) {
  return {{"technique", row.variation.technique->name},
          {"preset", row.variation.name()},
          {"temporal", row.variation.temporal},
          {"ms", median(row.ms)},
          {"rmse", row.rmse},
          {"ssim", row.ssim},
          {"flicker", row.flicker.flicker() ? Json(*row.flicker.flicker()) : Json(nullptr)}};
}

void check_bound(const std::vector<SequenceRow>& rows, const PickOptions& options) {
  const SequenceRow& best = rows.front();
  if (off(best, options) <= 1) return;
  const std::string name = best.variation.technique->name + " " + best.variation.name();
  if (options.budget)
    throw Error("no setting takes {:g} ms a frame or less; the fastest is {} with {:.2f} ms", *options.budget, name,
                median(best.ms));
  throw Error("no setting has {} {:g} or less; the nearest is {} with {:.4f}",
              options.by == PickBy::ssim ? "1 - SSIM" : name_of(options.by), *options.error, name,
              figure_of(best, options.by));
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
  sort(rows, options);
  check_bound(rows, options);
  const std::string command = run_line(rows.front().variation);
  Json document = {{"command", command}};
  document.update(entry_of(rows.front()));
  document["device"] = device.info().name;
  document["by"] = options.by == PickBy::flicker ? "flicker" : options.by == PickBy::ssim ? "ssim" : "rmse";
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
