#include "report/sections_sequence.h"

#include <fmt/format.h>

#include <algorithm>

#include "report/markdown_text.h"

namespace gloam::report {
namespace {

/// "gallery:walk, 10 frames of 640x360, radius 0.5, truths with 256 rays per pixel; the truth's own change is .052."
std::string words_about(const Sequence& sequence) {
  std::string words = fmt::format("{}, {} frames", plain_text(sequence.shot), sequence.frames.size());
  if (sequence.width && sequence.height) words += fmt::format(" of {:.0f}x{:.0f}", *sequence.width, *sequence.height);
  if (sequence.radius) words += fmt::format(", radius {:g}", *sequence.radius);
  if (sequence.truth_rays) words += fmt::format(", truths with {:g} rays per pixel", *sequence.truth_rays);
  if (sequence.truth_change) words += "; the truth's own change is " + error_text(sequence.truth_change);
  return words + ".";
}

std::string table_of_rows(std::vector<SequenceRow> rows) {
  std::stable_sort(rows.begin(), rows.end(),
                   [](const SequenceRow& a, const SequenceRow& b) { return a.ms.median < b.ms.median; });
  Table table({"setting", "time", "RMSE", "worst frame", "SSIM", "flicker"}, "lr");
  for (const SequenceRow& row : rows)
    table.add({setting_text(row.technique, row.preset, row.temporal ? "temporal" : ""),
               ratio_text(row.ratio_to_hbao_plus), error_text(row.rmse), error_text(row.worst.rmse),
               error_text(row.ssim), error_text(row.flicker)});
  return table.text();
}

}  // namespace

std::string sequence_section(const Material& material) {
  std::string text;
  for (const Source& source : material.sources) {
    const std::optional<Sequence>& sequence = source.measurements.sequence;
    if (sequence) text += paragraph(words_about(*sequence)) + table_of_rows(sequence->rows);
  }
  if (text.empty()) return "";
  return "## Over the frames of a shot\n\n" +
         paragraph(
             "RMSE and SSIM are means over the frames, *worst frame* is the largest RMSE of one. *Flicker* is the RMSE "
             "of "
             "an image's change from frame to frame, to that of the truth. *temporal*: accumulated over the frames. "
             "Time "
             "is that of one frame over HBAO+ medium on the same frame; fastest first.") +
         text;
}

}  // namespace gloam::report
