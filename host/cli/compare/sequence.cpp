#include "cli/compare/sequence.h"

#include "base/json_text.h"
#include "cli/compare/figures.h"
#include "cli/flags/memory.h"
#include "cli/flags/shot_flags.h"
#include "comparison/shot.h"
#include "gloam/error.h"
#include "gloam/flicker.h"
#include "gloam/frame_numbers.h"
#include "gloam/visualise.h"

namespace gloam::cli {
namespace {

using comparison::FrameFigures;
using comparison::ShotFigures;

std::vector<int> numbers_of(const ShotFigures& c) {
  std::vector<int> numbers;
  for (const FrameFigures& frame : c.frames) numbers.push_back(frame.number);
  return numbers;
}

Json pair_document(const std::optional<FlickerSums>& pair) {
  const FlickerSums sums = pair.value_or(FlickerSums{});
  return {{"flicker", or_null(sums.flicker())},   {"truth_change", or_null(sums.truth_change())},
          {"comparable", or_null(sums.share())},  {"new_share", or_null(sums.new_share())},
          {"new_rmse", or_null(sums.new_rmse())}, {"old_rmse", or_null(sums.old_rmse())}};
}

Json row_document(const ShotFigures& c, const FrameFigures& row) {
  Json document = {{"frame", row.number}};
  document.update(metrics_document(row.figures));
  document.update(pair_document(row.pair));
  if (row.exposure > 0) document["exposure"] = row.exposure;
  if (row.views.size() > 1) {
    for (size_t i = 0; i < row.views.size(); ++i) document["views"][c.views[i].first] = metrics_document(row.views[i]);
  }
  return document;
}

Json sequence_document(const ShotFigures& c, unsigned long long memory) {
  Json frames = Json::array();
  for (const FrameFigures& row : c.frames) frames.push_back(row_document(c, row));
  const FrameFigures& worst = c.worst();
  Json summary = {{"frames", c.frames.size()},
                  {"pairs", c.pairs},
                  {"mean", metrics_document(c.means())},
                  {"worst", {{"frame", worst.number}, {"rmse", worst.figures.rmse}}}};
  summary.update(pair_document(c.all_pairs()));
  summary["motion"] = c.motion;
  return {{"frames", frames},
          {"summary", summary},
          {"plane", c.planes.test},
          {"truth_plane", c.planes.reference},
          {"memory_bytes", memory}};
}

std::string pairs_in_words(const ShotFigures& c) { return c.pairs == 1 ? "1 pair" : fmt::format("{} pairs", c.pairs); }

std::string figure_or_dash(const std::optional<double>& value) { return value ? fmt::format("{:.5f}", *value) : "-"; }
std::string percent_or_dash(const std::optional<double>& share) {
  return share ? fmt::format("{:.1f} %", 100 * *share) : "-";
}

std::vector<std::string> cells_of(const std::string& name, const Metrics& m, const std::optional<FlickerSums>& pair) {
  const FlickerSums sums = pair.value_or(FlickerSums{});
  std::vector<std::string> cells = {name,
                                    fmt::format("{:.5f}", m.rmse),
                                    fmt::format("{:.5f}", m.mae),
                                    fmt::format("{:+.5f}", m.bias),
                                    fmt::format("{:.4f}", m.ssim),
                                    fmt::format("{:.4f}", m.gmsd)};
  if (m.flip) cells.push_back(fmt::format("{:.4f}", *m.flip));
  cells.insert(cells.end(),
               {figure_or_dash(sums.flicker()), figure_or_dash(sums.truth_change()), percent_or_dash(sums.share())});
  return cells;
}

void print_sequence(const ShotFigures& c, const CompareFlags& flags, const std::vector<std::string>& written) {
  print_heading(c.planes, flags);
  fmt::print("{} frames: {}\nmotion: {}\n\n", c.frames.size(), frames_in_words(numbers_of(c)), printable(c.motion));
  std::vector<std::vector<std::string>> table = {{"frame", "RMSE", "MAE", "bias", "SSIM", "GMSD"}};
  if (c.frames.front().figures.flip) table.front().push_back("FLIP");
  table.front().insert(table.front().end(), {"flicker", "truth's change", "comparable"});
  for (const FrameFigures& row : c.frames) table.push_back(cells_of(std::to_string(row.number), row.figures, row.pair));
  table.push_back(cells_of("mean", c.means(), c.all_pairs()));
  print_table(table, 1);
  if (c.sums.flicker())
    fmt::print(
        "\nflicker {:.5f}: RMSE of the change from frame to frame along motion, over {}; the truth's own "
        "change is {:.5f} (RMS)\n",
        *c.sums.flicker(), pairs_in_words(c), *c.sums.truth_change());
  if (c.sums.new_rmse() && c.sums.old_rmse())
    fmt::print("RMSE {:.5f} where a surface came into view within the last {} frames ({}), {:.5f} elsewhere\n",
               *c.sums.new_rmse(), FlickerMeter::young, percent_or_dash(c.sums.new_share()), *c.sums.old_rmse());
  print_written(written);
  const FrameFigures& worst = c.worst();
  fmt::print("worst frame {}: RMSE {:.5f}\n", worst.number, worst.figures.rmse);
}

SequencePlot plot_of(const ShotFigures& c, const CompareFlags& flags) {
  SequenceCurve rmse{"RMSE", {}}, mae{"MAE", {}}, flicker{"flicker", {}}, change{"the truth's own change", {}};
  for (const FrameFigures& row : c.frames) {
    const FlickerSums sums = row.pair.value_or(FlickerSums{});
    rmse.values.push_back(row.figures.rmse);
    mae.values.push_back(row.figures.mae);
    flicker.values.push_back(sums.flicker());
    change.values.push_back(sums.truth_change());
  }
  const FrameFigures& worst = c.worst();
  const auto name = [](const std::string& path) { return std::filesystem::path(path).filename().string(); };
  const std::string of_flicker =
      c.sums.flicker() ? fmt::format("; flicker {:.4g} over {}", *c.sums.flicker(), pairs_in_words(c)) : "";
  return {name(flags.test) + "  against  " + name(flags.reference),
          fmt::format("{}; mean RMSE {:.4g}; worst frame {} (marked), RMSE {:.4g}{}; motion: {}", c.planes.test,
                      c.means().rmse, worst.number, worst.figures.rmse, of_flicker, c.motion),
          numbers_of(c),
          {{"Error of each frame", {rmse, mae}}, {"Change from the frame before, along motion", {flicker, change}}},
          worst.number};
}

}  // namespace

void CompareSequenceFlags::add_to(CLI::App& app) {
  add_frames(app, choice);
  add_missing_without_hold(app, choice);
  add_text(app, "--differences", differences, "DIFFERENCE.####.png",
           "of a sequence: a picture of each frame's differences, in one scale")
      ->group("Shots");
  app.add_flag("--sequence", is_asked_for, "the test is a sequence, test.####.exr; refuse one file")->group("Shots");
}

std::string CompareSequenceFlags::any() const {
  if (is_asked_for) return "--sequence";
  if (choice.frames) return "--frames";
  if (choice.missing) return "--missing";
  return differences.empty() ? "" : "--differences";
}

bool is_sequence(const CompareFlags& flags, const CompareSequenceFlags& sequence) {
  const bool is_pattern = FramePattern::is_pattern(flags.test);
  if (!is_pattern) {
    if (!sequence.any().empty())
      throw UsageError("{}: TEST.exr {} is one file; name the frames of a sequence, such as test.####.exr",
                       sequence.any(), flags.test);
    for (const auto& [name, path] : {NamedPath{"REF.exr", flags.reference}, NamedPath{"--frame", flags.frame}}) {
      if (path.empty() || !FramePattern::is_pattern(path)) continue;
      throw UsageError("{} {}: names many frames, and TEST.exr {} is one file; name one frame, or give the test's too",
                       name, path, flags.test);
    }
    return false;
  }
  return true;
}

void check_plot_name(const std::string& path) {
  if (FramePattern::is_pattern(path))
    throw UsageError("-o {}: the plot is one picture; --differences names a picture for each frame", path);
  check_picture_name(path, "-o");
}

void compare_sequence(const CompareFlags& flags, const CompareSequenceFlags& sequence) {
  check_plot_name(flags.picture);
  check_picture_name(sequence.differences, "--differences");
  if (flags.reference.empty())
    throw UsageError("compare: REF.exr is required: the error of a sequence, and of its changes, is against a truth");
  const comparison::ComparedShot shot = open_shot(flags, sequence.choice, sequence.differences);
  const unsigned long long memory = planned_memory(flags.frame_flags, flags.test + " against " + flags.reference,
                                                   shot.bytes(), "compare one view (--view) or a part of it");
  std::vector<std::string> notes, written;
  const ShotFigures figures = compare_shot(shot, sequence.differences, progress_bar(), notes);
  note(notes);
  if (!sequence.differences.empty())
    written.push_back(
        fmt::format("{} for {} frames, colours to +-{:g}", sequence.differences, figures.frames.size(), figures.range));
  if (!flags.picture.empty()) {
    write_sequence_plot(flags.picture, plot_of(figures, flags));
    written.push_back(flags.picture);
  }
  flags.json.write(sequence_document(figures, memory), written);
  if (!flags.json.only_json()) print_sequence(figures, flags, written);
}

}  // namespace gloam::cli
