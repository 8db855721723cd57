// gloam compare TEST.exr REF.exr [-o difference.png]; compare_stereo.cpp has the form with --stereo, compare_sequence.cpp that of
// sequences
#include <algorithm>
#include <cmath>
#include <memory>

#include "cli/compare/figures.h"
#include "cli/compare/sequence.h"
#include "cli/compare/sides.h"
#include "cli/compare/stereo.h"
#include "cli/compare/stereo_sequence.h"
#include "cli/flags/memory.h"
#include "cli/flags/options.h"
#include "gloam/error.h"
#include "gloam/metrics.h"
#include "gloam/planes.h"
#include "gloam/visualise.h"

namespace gloam::cli {
namespace {

/// One view of the test against one of the reference.
struct ViewComparison {
  Comparison all, shown;  ///< shown: pixels whose reflected surfaces the frame shows
  bool is_background_known = false;
};

/// The inputs of a comparison, and its results so far.
struct Comparing {
  const CompareFlags& flags;
  Side &test, &reference;
  const Frame& extra;
  const ViewPairs& pairs;
  PlanePair planes;
  Overlap overlap;
  double exposure;
  std::vector<ViewComparison> views;
  std::vector<std::string> pictures;
};

/// Adds rows [first, last), with the surrounding rows that figures need. All rows at once may be drawn.
void add_rows(Comparing& c, int first, int last) {
  const int height = c.overlap.layout.height;
  const Rows rows{std::max(first - Comparison::reach(), 0), std::min(last + Comparison::reach(), height)};
  const Frame tests = c.test.read(c.planes.test, c.overlap, rows),
              truths = c.reference.read(c.planes.reference, c.overlap, rows);
  for (size_t i = 0; i < c.pairs.size(); ++i) {
    const auto& [test_view, truth_view] = c.pairs[i];
    ViewComparison& view = c.views[i];
    const Plane left = without_confidence(c.test.rows_of(tests, c.planes.test, test_view, c.overlap, rows));
    Plane truth = c.reference.rows_of(truths, c.planes.reference, truth_view, c.overlap, rows);
    const std::optional<Mask> known = mask_of(c.flags, c.extra, c.test, c.reference, c.pairs[i], c.overlap, rows);
    view.is_background_known = known.has_value();
    const Mask mask = known ? *known : Mask(size_t(c.overlap.layout.width) * size_t(rows.last - rows.first), 1);
    const std::optional<Mask> where_shown = shown_pixels(truth, mask);
    const Plane right = without_confidence(std::move(truth));
    naming_files(c.flags, [&] {
      view.all.add({left, right, mask, rows.first}, first, last);
      if (where_shown) view.shown.add({left, right, *where_shown, rows.first}, first, last);
    });
    if (c.flags.picture.empty()) continue;
    const Metrics figures = naming_files(c.flags, [&] { return view.all.figures(); });
    c.pictures.push_back(picture_path(c.flags.picture, test_view, c.pairs.size() > 1).string());
    write_difference_picture(
        c.pictures.back(), left, right, mask, figures,
        {c.test.file.path().filename().string(), c.reference.file.path().filename().string(), 0, c.exposure});
  }
}

/// Adds all rows: at once for a picture, which shows the whole image, else some at a time.
void add_all_rows(Comparing& c) {
  const int height = c.overlap.layout.height;
  const int at_once =
      std::min(c.test.file.rows_at_once({c.planes.test}), c.reference.file.rows_at_once({c.planes.reference}));
  const int steps = std::max(at_once / Comparison::step, 1);
  const int step = c.flags.picture.empty() ? steps * Comparison::step : height;
  for (int first = 0; first < height; first += step) add_rows(c, first, std::min(first + step, height));
}

void compare_command(const CompareFlags& flags) {
  check_picture_name(flags.picture, "-o");
  check_paths({{"the test", flags.test}, {"the reference", flags.reference}, {"--frame", flags.frame}},
              {{"-o", flags.picture}, {"--json", flags.json.file()}});
  ReadOptions options = flags.frame_flags.read_options();
  options.as_stored = true;
  Side test{FrameFile(flags.test, options), {}};
  Side reference{FrameFile(flags.reference, options_beside(options, flags.reference)), {}};
  const auto pairs = pair_views(test.file, reference.file, !options.views.empty());
  check_pictures({"-o", flags.picture}, test.file.views());
  const unsigned long long memory =
      planned_memory(flags.frame_flags, flags.test + " against " + flags.reference,
                     bytes_of_comparison(flags, options, test.file, reference.file),
                     flags.picture.empty() ? "compare one view (--view) or a part of it"
                                           : "leave -o out, or compare one view (--view)");
  const PlanePair planes = survey_sides(test, reference, flags.plane, !flags.frame.empty());
  note_other_camera(test.file, reference.file);
  if (planes.test == "ao" || planes.test == "ao_raw") note_other_radius(test.file, reference.file);
  const Frame extra = background_frame(flags, options);
  const double exposure = exposure_of(flags, reference.file, planes.reference);
  Comparing comparing{flags, test, reference, extra, pairs, planes, overlap_of(test, reference), exposure, {}, {}};
  const int height = comparing.overlap.layout.height;
  for (size_t i = 0; i < pairs.size(); ++i)
    comparing.views.push_back({Comparison(height, exposure), Comparison(height, exposure)});
  add_all_rows(comparing);
  std::vector<Metrics> all, shown;
  Json views = Json::object();
  bool background_known = false;
  for (size_t i = 0; i < pairs.size(); ++i) {
    const ViewComparison& view = comparing.views[i];
    background_known = background_known || view.is_background_known;
    all.push_back(naming_files(flags, [&] { return view.all.figures(); }));
    views[pairs[i].first] = metrics_document(all.back());
    if (view.shown.pixels() == 0) continue;
    shown.push_back(view.shown.figures());
    views[pairs[i].first]["shown"] = metrics_document(shown.back());
  }
  const std::vector<std::string>& pictures = comparing.pictures;
  if (!background_known) note({"no depth in either file: every pixel counts; --frame FRAME.exr tells the background"});
  Json document = metrics_document(pooled(all));
  if (!shown.empty()) document["shown"] = metrics_document(pooled(shown));
  document["memory_bytes"] = memory;
  if (exposure > 0) document["exposure"] = exposure;
  document["plane"] = planes.test;
  document["truth_plane"] = planes.reference;
  if (pairs.size() > 1) document["views"] = views;
  flags.json.write(document, pictures);
  if (flags.json.only_json()) return;
  print_heading(planes, flags);
  if (exposure > 0) fmt::print("SSIM, GMSD and FLIP at exposure {:.4g}\n", exposure);
  for (size_t i = 0; i < all.size(); ++i) {
    print_metrics(pairs.size() > 1 ? pairs[i].first : "", planes.test, all[i]);
    if (shown.size() != all.size()) continue;
    fmt::print("of these where the frame shows most of what is reflected\n");
    print_metrics("", planes.test, shown[i]);
  }
  for (const std::string& path : pictures) fmt::print("wrote {}\n", printable(path));
}

}  // namespace

void add_compare(CLI::App& app) {
  auto flags = std::make_shared<CompareFlags>();
  auto stereo = std::make_shared<StereoFlags>();
  auto sequence = std::make_shared<CompareSequenceFlags>();
  CLI::App* command = app.add_subcommand(
      "compare", "how far an image is from the truth, or its two views from each other: figures and a picture");
  command->add_option("test", flags->test, "EXR file, such as gloam run writes; those of a sequence: test.####.exr")
      ->required()
      ->type_name("TEST.exr");
  command
      ->add_option("reference", flags->reference,
                   "EXR file with the truth; with --stereo: none, or the file of the second eye")
      ->type_name("REF.exr");
  command
      ->add_option(
          "-o,--output", flags->picture,
          "picture of test, truth, difference and histogram; of a sequence: plot over its frames; with --stereo: "
          "of the first view's errors, or ERRORS.exr with those of both")
      ->type_name("DIFFERENCE.png");
  command
      ->add_option("--what", flags->plane,
                   "plane of the test to compare (--plane PLANE does the same); default: the first that both have, "
                   "results first. ao_raw goes with "
                   "the truth's ao where that has no ao_raw")
      ->type_name("PLANE");
  command
      ->add_option("--frame", flags->frame,
                   "frame whose depth tells the background; with --stereo also its normals and cameras count")
      ->type_name("FRAME.exr");
  add_number(
      *command, "--exposure", flags->exposure, {1e-30, 1e30},
      "of radiance, before SSIM, GMSD and FLIP; default: what the truth of a reflection says, else the values as "
      "they are")
      ->type_name("FACTOR");
  stereo->add_to(*command);
  sequence->add_to(*command);
  flags->frame_flags.add_to(*command);
  flags->json.add_to(*command);
  command->footer(
      "Background never counts. Examples:\n"
      "  gloam compare ao.exr truth.exr -o difference.png\n"
      "  gloam compare ao.exr truth_left.exr --view left --json -\n"
      "  gloam compare ao.exr truth.exr --what ao_raw\n"
      "  gloam compare ao.exr truth.exr --plane ao=Lamp.R\n"
      "  gloam compare reflection.exr truth.exr --plane reflection --view left\n"
      "  gloam compare 'ao.####.exr' 'truth.####.exr' --frame 'shot.####.exr' -o plot.png\n"
      "  gloam compare --stereo ao.exr --frame pair.exr -o inconsistency.png --anaglyph both.png");
  command->callback([flags, stereo, sequence] {
    flags->take_plane_names();
    const bool has_frames = is_sequence(*flags, *sequence);
    if (stereo->is_asked_for && flags->exposure)
      throw UsageError("--exposure {}: two views are compared as they are; leave it out", *flags->exposure);
    if (stereo->is_asked_for && has_frames) return compare_stereo_sequence(*flags, *stereo, *sequence);
    if (stereo->is_asked_for) return stereo_command(*flags, *stereo);
    if (has_frames) return compare_sequence(*flags, *sequence);
    if (flags->reference.empty())
      throw UsageError(
          "compare: REF.exr is required, or --stereo for the two views of one file (gloam compare --help)");
    compare_command(*flags);
  });
}

}  // namespace gloam::cli
