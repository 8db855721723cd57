#include "cli/compare/sequence.h"

#include <algorithm>

#include "base/json_text.h"
#include "cli/compare/figures.h"
#include "cli/compare/sequence_files.h"
#include "cli/flags/memory.h"
#include "cli/flags/shot_flags.h"
#include "gloam/error.h"
#include "gloam/flicker.h"
#include "gloam/frame_numbers.h"
#include "gloam/visualise.h"

namespace gloam::cli {
namespace {

/// What is kept of a frame.
struct SequenceRow {
  int frame = 0;
  Metrics figures;                  ///< of all views
  std::vector<Metrics> views;       ///< in the order of the views
  double exposure = 0;              ///< of radiance, before SSIM, GMSD and FLIP; 0: none
  std::optional<FlickerSums> pair;  ///< with the frame before
};

/// A comparison of sequences so far.
struct SequenceComparison {
  const ComparedShot& shot;
  std::vector<SequenceRow> rows;
  std::vector<FlickerMeter> meters;  ///< of each view
  FlickerSums sums;                  ///< of all pairs
  size_t pairs = 0;
  // the first frame's, which those of all others have to be
  PlanePair planes;
  Layout layout;
  ViewPairs views;
  std::vector<std::string> motions, surfaces_from;  ///< each once
  double range = 0;                                 ///< of differences, at the ends of the colours
  bool is_background_known = false;
};

/// Throws Error for a frame that is unlike the first one.
void check_like_first(const SequenceComparison& c, const ComparedFrame& frame) {
  const Layout& layout = frame.overlap.layout;
  if (layout.width != c.layout.width || layout.height != c.layout.height)
    throw Error("{} is {}x{}, and the first frame {}x{}; compare frames of one size, chosen by --frames",
                frame.flags.test, layout.width, layout.height, c.layout.width, c.layout.height);
  if (frame.pairs != c.views)
    throw Error("{} has other views than the first frame; --view NAME says which to compare", frame.flags.test);
  if (frame.planes.test != c.planes.test || frame.planes.reference != c.planes.reference)
    throw Error("{} and {} are compared by {} and {}, and the first frame by {} and {}; --what PLANE says which",
                frame.flags.test, frame.flags.reference, frame.planes.test, frame.planes.reference, c.planes.test,
                c.planes.reference);
}

void take_first(SequenceComparison& c, const ComparedFrame& frame) {
  c.planes = frame.planes;
  c.layout = frame.overlap.layout;
  c.views = frame.pairs;
  c.meters.resize(frame.pairs.size());
}

/// Adds the pair with the frame before: none after a gap, since motion is from one frame to the next.
std::optional<FlickerSums> add_pair(SequenceComparison& c, ComparedFrame& frame, int number) {
  const bool follows = !c.rows.empty() && c.rows.back().frame == number - 1;
  std::optional<FlickerSums> pair;
  for (size_t i = 0; i < frame.views.size(); ++i) {
    FlickerMeter& meter = c.meters[i];
    if (!follows) meter.begin_anew();
    const std::optional<FlickerSums> sums = meter.add(std::move(frame.views[i]));
    if (!sums) continue;
    pair = pair.value_or(FlickerSums{}) += *sums;
    add_new(c.motions, in_words(*meter.source()));
  }
  if (pair) c.sums += *pair, ++c.pairs;
  return pair;
}

void add_frame(SequenceComparison& c, const SequenceFrame& at, bool with_range) {
  ComparedFrame frame = read_compared_frame(c.shot, at);
  if (c.rows.empty()) take_first(c, frame);
  check_like_first(c, frame);
  SequenceRow row{at.number, {}, {}, frame.exposure, {}};
  for (const SequenceFramePlanes& view : frame.views) {
    row.views.push_back(naming_files(
        frame.flags, [&] { return gloam::compare(view.test, view.truth, view.foreground, frame.exposure); }));
    if (with_range) c.range = std::max(c.range, difference_range(view.test, view.truth, view.foreground));
  }
  row.figures = pooled(row.views);
  c.is_background_known = c.is_background_known || frame.is_background_known;
  if (!frame.surfaces_from.empty()) add_new(c.surfaces_from, frame.surfaces_from);
  row.pair = add_pair(c, frame, at.number);
  c.rows.push_back(std::move(row));
}

/// Writes the differences of every frame in the colours of one scale. Decodes all frames again: the scale is known only now.
void write_movie(const SequenceComparison& c, const std::string& movie) {
  const FramePattern pattern(movie, "--differences");
  size_t next = 0;
  for_each_frame(c.shot, [&](const SequenceFrame& at) {
    const ComparedFrame frame = read_compared_frame(c.shot, at);
    const SequenceRow& row = c.rows[next++];
    check_like_first(c, frame);
    for (size_t i = 0; i < frame.views.size(); ++i) {
      const SequenceFramePlanes& view = frame.views[i];
      write_difference_picture(picture_path(pattern.path_of(at.number).string(), c.views[i].first, c.views.size() > 1),
                               view.test, view.truth, view.foreground, row.views[i],
                               {frame.test.file.path().filename().string(),
                                frame.reference.file.path().filename().string(), float(c.range), frame.exposure});
    }
  });
}

const SequenceRow& worst_of(const SequenceComparison& c) {
  return *std::max_element(c.rows.begin(), c.rows.end(),
                           [](const SequenceRow& a, const SequenceRow& b) { return a.figures.rmse < b.figures.rmse; });
}

/// Means over the frames, which count alike; `max` is the largest, and `psnr` that of the mean squared error.
Metrics means_of(const SequenceComparison& c) {
  std::vector<Metrics> all;
  double rmse = 0;
  long long pixels = 0;
  for (const SequenceRow& row : c.rows) {
    all.push_back(row.figures);
    all.back().pixels = 1;  // `pooled` weighs by pixels
    rmse += row.figures.rmse;
    pixels += row.figures.pixels;
  }
  Metrics means = pooled(all);
  means.rmse = rmse / double(c.rows.size());
  means.pixels = pixels;
  return means;
}

Json pair_document(const std::optional<FlickerSums>& pair) {
  const FlickerSums sums = pair.value_or(FlickerSums{});
  return {{"flicker", or_null(sums.flicker())},   {"truth_change", or_null(sums.truth_change())},
          {"comparable", or_null(sums.share())},  {"new_share", or_null(sums.new_share())},
          {"new_rmse", or_null(sums.new_rmse())}, {"old_rmse", or_null(sums.old_rmse())}};
}

Json row_document(const SequenceComparison& c, const SequenceRow& row) {
  Json document = {{"frame", row.frame}};
  document.update(metrics_document(row.figures));
  document.update(pair_document(row.pair));
  if (row.exposure > 0) document["exposure"] = row.exposure;
  if (row.views.size() > 1) {
    for (size_t i = 0; i < row.views.size(); ++i) document["views"][c.views[i].first] = metrics_document(row.views[i]);
  }
  return document;
}

/// "plane (of the test)"
std::string motion_in_words(const SequenceComparison& c) {
  if (c.motions.empty()) return "none, no two frames follow one another";
  std::string words = fmt::format("{}", fmt::join(c.motions, " or "));
  const bool has_motion = c.motions != std::vector<std::string>{in_words(MotionSource::still)};
  if (has_motion && !c.surfaces_from.empty()) words += fmt::format(", of {}", fmt::join(c.surfaces_from, " or "));
  return words;
}

Json sequence_document(const SequenceComparison& c, unsigned long long memory) {
  Json frames = Json::array();
  for (const SequenceRow& row : c.rows) frames.push_back(row_document(c, row));
  const SequenceRow& worst = worst_of(c);
  Json summary = {{"frames", c.rows.size()},
                  {"pairs", c.pairs},
                  {"mean", metrics_document(means_of(c))},
                  {"worst", {{"frame", worst.frame}, {"rmse", worst.figures.rmse}}}};
  summary.update(pair_document(c.pairs > 0 ? std::optional(c.sums) : std::nullopt));
  summary["motion"] = motion_in_words(c);
  return {{"frames", frames},
          {"summary", summary},
          {"plane", c.planes.test},
          {"truth_plane", c.planes.reference},
          {"memory_bytes", memory}};
}

std::string pairs_in_words(const SequenceComparison& c) {
  return c.pairs == 1 ? "1 pair" : fmt::format("{} pairs", c.pairs);
}

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

void print_sequence(const SequenceComparison& c, const CompareFlags& flags, const std::vector<std::string>& written) {
  print_heading(c.planes, flags);
  fmt::print("{} frames: {}\nmotion: {}\n\n", c.rows.size(), frames_in_words(c.shot.numbers()),
             printable(motion_in_words(c)));
  std::vector<std::vector<std::string>> table = {{"frame", "RMSE", "MAE", "bias", "SSIM", "GMSD"}};
  if (c.rows.front().figures.flip) table.front().push_back("FLIP");
  table.front().insert(table.front().end(), {"flicker", "truth's change", "comparable"});
  for (const SequenceRow& row : c.rows) table.push_back(cells_of(std::to_string(row.frame), row.figures, row.pair));
  table.push_back(cells_of("mean", means_of(c), c.pairs > 0 ? std::optional(c.sums) : std::nullopt));
  print_table(table, 1);
  if (c.sums.flicker())
    fmt::print(
        "\nflicker {:.5f}: RMSE of the change from frame to frame along motion, over {}; the truth's own "
        "change is {:.5f} (RMS)\n",
        *c.sums.flicker(), pairs_in_words(c), *c.sums.truth_change());
  if (c.sums.new_rmse() && c.sums.old_rmse())
    fmt::print("RMSE {:.5f} where a surface came into view within the last {} frames ({}), {:.5f} elsewhere\n",
               *c.sums.new_rmse(), FlickerMeter::young, percent_or_dash(c.sums.new_share()), *c.sums.old_rmse());
  for (const std::string& path : written) fmt::print("wrote {}\n", printable(path));
  const SequenceRow& worst = worst_of(c);
  fmt::print("worst frame {}: RMSE {:.5f}\n", worst.frame, worst.figures.rmse);
}

SequencePlot plot_of(const SequenceComparison& c, const CompareFlags& flags) {
  SequenceCurve rmse{"RMSE", {}}, mae{"MAE", {}}, flicker{"flicker", {}}, change{"the truth's own change", {}};
  for (const SequenceRow& row : c.rows) {
    const FlickerSums sums = row.pair.value_or(FlickerSums{});
    rmse.values.push_back(row.figures.rmse);
    mae.values.push_back(row.figures.mae);
    flicker.values.push_back(sums.flicker());
    change.values.push_back(sums.truth_change());
  }
  const SequenceRow& worst = worst_of(c);
  const auto name = [](const std::string& path) { return std::filesystem::path(path).filename().string(); };
  const std::string of_flicker =
      c.sums.flicker() ? fmt::format("; flicker {:.4g} over {}", *c.sums.flicker(), pairs_in_words(c)) : "";
  return {name(flags.test) + "  against  " + name(flags.reference),
          fmt::format("{}; mean RMSE {:.4g}; worst frame {} (marked), RMSE {:.4g}{}; motion: {}", c.planes.test,
                      means_of(c).rmse, worst.frame, worst.figures.rmse, of_flicker, motion_in_words(c)),
          c.shot.numbers(),
          {{"Error of each frame", {rmse, mae}}, {"Change from the frame before, along motion", {flicker, change}}},
          worst.frame};
}

/// Two frames of each side, and what measuring and drawing one takes.
unsigned long long bytes_of_sequence(const ComparedShot& shot) {
  const SequenceFrame& first = shot.frames().front();
  CompareFlags flags = shot.flags_of(first);
  const ReadOptions options = shot.options_of(first);
  flags.picture = "whole images";
  const FrameFile test(flags.test, options), reference(flags.reference, options_beside(options, flags.reference));
  return process_bytes + 2 * (bytes_of_comparison(flags, options, test, reference) - process_bytes);
}

}  // namespace

void CompareSequenceFlags::add_to(CLI::App& app) {
  add_frames(app, choice);
  add_missing_without_hold(app, choice);
  app.add_option("--differences", differences, "of a sequence: a picture of each frame's differences, in one scale")
      ->type_name("DIFFERENCE.####.png")
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
  const ComparedShot shot(flags, sequence.choice);
  shot.check_outputs(sequence.differences);
  const unsigned long long memory =
      planned_memory(flags.frame_flags, flags.test + " against " + flags.reference, bytes_of_sequence(shot),
                     "compare one view (--view) or a part of it");
  SequenceComparison c{shot, {}, {}, {}, 0, {}, {}, {}, {}, {}, 0, false};
  for_each_frame(shot, [&](const SequenceFrame& frame) { add_frame(c, frame, !sequence.differences.empty()); });
  for (const std::string& file : shot.files_of_all_frames())
    note({fmt::format("{} is one file for all frames: the camera is taken to stand still", file)});
  if (!c.is_background_known)
    note({"no depth in either file: every pixel counts; --frame 'FRAME.####.exr' tells the background"});
  if (c.pairs == 0)
    note({"no two frames follow one another: flicker is not measured; it is of frames such as 7 and 8"});
  std::vector<std::string> written;
  if (!sequence.differences.empty()) {
    write_movie(c, sequence.differences);
    written.push_back(fmt::format("{} for {} frames, colours to +-{:g}", sequence.differences, c.rows.size(), c.range));
  }
  if (!flags.picture.empty()) {
    write_sequence_plot(flags.picture, plot_of(c, flags));
    written.push_back(flags.picture);
  }
  flags.json.write(sequence_document(c, memory), written);
  if (!flags.json.only_json()) print_sequence(c, flags, written);
}

}  // namespace gloam::cli
