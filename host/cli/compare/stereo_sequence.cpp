#include <algorithm>

#include "cli/compare/stereo.h"
#include "comparison/shot_files.h"
#include "gloam/error.h"
#include "gloam/frame_numbers.h"
#include "gloam/visualise.h"

namespace gloam::cli {
namespace {

struct StereoRow {
  int frame = 0;
  StereoFigures figures;  ///< of both views
  Json document;
};

const StereoRow& worst_stereo_row(const std::vector<StereoRow>& rows) {
  return *std::max_element(rows.begin(), rows.end(),
                           [](const StereoRow& a, const StereoRow& b) { return a.figures.mean < b.figures.mean; });
}

/// Mean over the frames, which count alike.
double mean_of_stereo(const std::vector<StereoRow>& rows) {
  double sum = 0;
  for (const StereoRow& row : rows) sum += row.figures.mean;
  return sum / double(rows.size());
}

Json stereo_rows_document(const std::vector<StereoRow>& rows, const std::string& plane) {
  Json frames = Json::array();
  for (const StereoRow& row : rows) {
    frames.push_back({{"frame", row.frame}});
    frames.back().update(row.document);
  }
  const StereoRow& worst = worst_stereo_row(rows);
  const Json summary = {{"frames", rows.size()},
                        {"inconsistency", mean_of_stereo(rows)},
                        {"worst", {{"frame", worst.frame}, {"inconsistency", worst.figures.mean}}}};
  return {{"frames", frames}, {"summary", summary}, {"plane", plane}};
}

void print_stereo_rows(const std::vector<StereoRow>& rows, const CompareFlags& flags, const std::string& plane) {
  fmt::print("{} of {}: stereo inconsistency of both views\n\n", plane, printable(flags.test));
  std::vector<std::vector<std::string>> table = {stereo_heading("frame")};
  for (const auto& [frame, figures, document] : rows) table.push_back(stereo_cells(std::to_string(frame), figures));
  print_table(table, 1);
  if (!flags.picture.empty()) print_written({flags.picture});
  const StereoRow& worst = worst_stereo_row(rows);
  fmt::print("mean over {} frames {:.5f}; worst frame {}: {:.5f}\n", rows.size(), mean_of_stereo(rows), worst.frame,
             worst.figures.mean);
}

SequencePlot stereo_plot_of(const std::vector<StereoRow>& rows, const CompareFlags& flags, const std::string& plane) {
  SequenceCurve mean{"mean", {}}, rmse{"RMSE", {}};
  std::vector<int> frames;
  for (const StereoRow& row : rows) {
    frames.push_back(row.frame);
    mean.values.push_back(row.figures.mean);
    rmse.values.push_back(row.figures.rmse);
  }
  const StereoRow& worst = worst_stereo_row(rows);
  return {std::filesystem::path(flags.test).filename().string(),
          fmt::format("{}; stereo inconsistency: mean {:.4g}; worst frame {} (marked), {:.4g}", plane,
                      mean_of_stereo(rows), worst.frame, worst.figures.mean),
          frames,
          {{"Stereo inconsistency of both views", {mean, rmse}}},
          worst.frame};
}

/// Throws UsageError for what two views of a sequence have no form of.
void check_stereo_flags(const CompareFlags& flags, const StereoFlags& stereo, const CompareSequenceFlags& sequence) {
  for (const auto& [flag, value] :
       {NamedPath{"--anaglyph", stereo.anaglyph}, NamedPath{"--side-by-side", stereo.side_by_side},
        NamedPath{"--differences", sequence.differences}}) {
    if (value.empty()) continue;
    throw UsageError("{} {}: shows the two views of one frame; leave it out, or compare one frame", flag, value);
  }
  check_no_single_view(flags);
  if (!flags.reference.empty() && !FramePattern::is_pattern(flags.reference))
    throw UsageError("REF.exr {}: is one file; give the second eye's frames, such as right.####.exr", flags.reference);
}

}  // namespace

void compare_stereo_sequence(const CompareFlags& flags, const StereoFlags& stereo,
                             const CompareSequenceFlags& sequence) {
  check_stereo_flags(flags, stereo, sequence);
  check_plot_name(flags.picture);
  const comparison::ComparedShot shot = open_shot(flags, sequence.choice, "");
  std::vector<StereoRow> rows;
  std::string plane;
  for_each_frame(shot, progress_bar(), [&](const SequenceFrame& at) {
    const StereoComparison c = compare_stereo(shot.files_of(at), shot.options_of(at), flags.frame_flags, stereo);
    if (rows.empty()) plane = c.plane;
    if (plane != c.plane)
      throw Error("{} is compared, and {} of the first frame; --what PLANE says which", c.plane, plane);
    rows.push_back({at.number, c.result.both, stereo_document(c)});
  });
  std::vector<std::string> written;
  if (!flags.picture.empty()) {
    write_sequence_plot(flags.picture, stereo_plot_of(rows, flags, plane));
    written.push_back(flags.picture);
  }
  flags.json.write(stereo_rows_document(rows, plane), written);
  if (!flags.json.only_json()) print_stereo_rows(rows, flags, plane);
}

}  // namespace gloam::cli
