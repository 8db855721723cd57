#include "measure/sequence_document.h"

#include <algorithm>

#include "base/json_text.h"
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

Json json_of(const SequenceRow& row) {
  return {{"technique", row.variation.technique->name},
          {"preset", row.variation.name()},
          {"temporal", row.variation.temporal},
          {"ms", milliseconds(row.ms)},
          {"ratio_to_hbao_plus", or_null(row.ratio)},
          {"rmse", row.rmse},
          {"worst", {{"frame", row.worst_frame}, {"rmse", row.worst_rmse}}},
          {"ssim", row.ssim},
          {"flicker", or_null(row.flicker.flicker())},
          {"new_rmse", or_null(row.flicker.new_rmse())},
          {"old_rmse", or_null(row.flicker.old_rmse())}};
}

/// ".0123"
std::string error_words(const std::optional<double>& error) {
  if (!error) return "-";
  const std::string text = fmt::format("{:.4f}", *error);
  return text.starts_with("0.") ? text.substr(1) : text;
}

}  // namespace

Json document_of(const MeasuredSequence& sequence, const SequenceMeasurement& measurement, const DeviceInfo& device) {
  Json rows = Json::array(), skipped = Json::array();
  for (const SequenceRow& row : measurement.rows) rows.push_back(json_of(row));
  for (const Skipped& s : measurement.skipped)
    skipped.push_back(
        {{"technique", s.technique}, {"preset", or_null(s.preset)}, {"scene", or_null(s.scene)}, {"why", s.why}});
  const Frame& first = sequence.frames.front().frame;
  Json document = origin_of(device);
  document.update({{"results", Json::array()},
                   {"sequence",
                    {{"shot", sequence.name},
                     {"class", sequence.scene_class},
                     {"frames", numbers_of(sequence)},
                     {"size", {first.width(), first.height()}},
                     {"radius", sequence.radius.value},
                     {"radius_from", name_of(sequence.radius.from)},
                     {"truth_rays", or_null(sequence.truth_rays)},
                     {"truth_noise", or_null(sequence.truth_noise)},
                     {"truth_change", or_null(measurement.truth_change)},
                     {"comparable", or_null(measurement.comparable)},
                     {"motion", measurement.motions},
                     {"made", sequence.made},
                     {"reused", sequence.reused},
                     {"rows", rows}}},
                   {"skipped", skipped},
                   {"paper", Json::array()}});
  return document;
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
