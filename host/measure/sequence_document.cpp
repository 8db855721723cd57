#include "measure/sequence_document.h"

#include <algorithm>

#include "base/statistics.h"
#include "gloam/frame_numbers.h"
#include "gloam/option.h"

namespace gloam::bench {
namespace {

std::vector<int> numbers_of(const MeasuredSequence& sequence) {
  std::vector<int> numbers;
  for (const MeasuredFrame& frame : sequence.frames) numbers.push_back(frame.number);
  return numbers;
}

report::SequenceRow result_of(const SequenceRow& row) {
  return {row.variation.technique->name,
          row.variation.name(),
          row.variation.temporal,
          times_of(row.ms),
          row.ratio,
          row.rmse,
          {row.worst_frame, row.worst_rmse},
          row.ssim,
          row.flicker.flicker(),
          row.flicker.new_rmse(),
          row.flicker.old_rmse()};
}

/// ".0123"
std::string error_words(const std::optional<double>& error) {
  if (!error) return "-";
  const std::string text = fmt::format("{:.4f}", *error);
  return text.starts_with("0.") ? text.substr(1) : text;
}

}  // namespace

report::Measurements results_of(const MeasuredSequence& sequence, const SequenceMeasurement& measurement,
                                const DeviceInfo& device) {
  const Frame& first = sequence.frames.front().frame;
  report::Measurements made = results_on(device);
  made.is_of_frames = false;
  made.skipped = measurement.skipped;
  report::Sequence& shot = made.sequence.emplace();
  shot.shot = sequence.name;
  shot.scene_class = sequence.scene_class;
  for (const int number : numbers_of(sequence)) shot.frames.push_back(number);
  shot.width = first.width();
  shot.height = first.height();
  shot.radius = sequence.radius.value;
  shot.radius_from = name_of(sequence.radius.from);
  shot.truth_rays = sequence.truth_rays;
  shot.truth_noise = sequence.truth_noise;
  shot.truth_change = measurement.truth_change;
  shot.comparable = measurement.comparable;
  shot.motion = measurement.motions;
  shot.made = sequence.made;
  shot.reused = sequence.reused;
  for (const SequenceRow& row : measurement.rows) shot.rows.push_back(result_of(row));
  return made;
}

Table table_of_sequence(const MeasuredSequence& sequence, const SequenceMeasurement& measurement) {
  const Frame& first = sequence.frames.front().frame;
  Table table;
  table.title = fmt::format("{}, frames {}, {}x{}, radius {:g}", sequence.name, frames_in_words(numbers_of(sequence)),
                            first.width(), first.height(), sequence.radius.value);
  table.rows = {{"technique", "preset", "", "ms", "/hbao+", "RMSE", "worst", "frame", "SSIM", "flicker"}};
  table.first_number = 3;
  std::vector<const SequenceRow*> rows;
  for (const SequenceRow& row : measurement.rows) rows.push_back(&row);
  std::stable_sort(rows.begin(), rows.end(),
                   [](const SequenceRow* a, const SequenceRow* b) { return median(a->ms) < median(b->ms); });
  for (const SequenceRow* row : rows)
    table.rows.push_back({row->variation.technique->name, row->variation.name(), row->variation.variant,
                          fmt::format("{:.2f}", median(row->ms)), row->ratio ? fmt::format("{:.2f}", *row->ratio) : "-",
                          error_words(row->rmse), error_words(row->worst_rmse), std::to_string(row->worst_frame),
                          fmt::format("{:.3f}", row->ssim), error_words(row->flicker.flicker())});
  if (!measurement.truth_change) {
    table.below = {fmt::format("no flicker: no surface is in two frames whose numbers follow one another ({} are such)",
                               option("frames", "1-10"))};
    return table;
  }
  std::string truth = "the truth's own change is " + error_words(measurement.truth_change);
  if (measurement.comparable) truth += fmt::format(", over {:.1f} % of the foreground", 100 * *measurement.comparable);
  if (!measurement.motions.empty()) truth += fmt::format("; motion: {}", fmt::join(measurement.motions, ", "));
  table.below = {truth};
  return table;
}

}  // namespace gloam::bench
