// gloam compare TEST.exr REF.exr [-o difference.png]; compare_stereo.cpp has the form with --stereo
#include <algorithm>
#include <cmath>
#include <memory>

#include "cli/compare_inputs.h"
#include "cli/compare_rows.h"
#include "cli/compare_stereo.h"
#include "cli/memory.h"
#include "cli/options.h"
#include "gloam/error.h"
#include "gloam/metrics.h"
#include "gloam/planes.h"
#include "gloam/visualise.h"

namespace gloam::cli {
namespace {

/// Surveys both sides and returns the planes to compare: the first that are usable in both. `is_told`: --frame tells the
/// background.
PlanePair survey_sides(Side& test, Side& reference, const std::string& asked, bool is_told) {
  const bool test_tells = contains(test.file.common_planes(), "depth");
  for (const PlanePair& pair : comparable_planes(test.file, reference.file, asked)) {
    test.survey(pair.test, !is_told);
    reference.survey(pair.reference, !is_told && !test_tells);
    if (test.has(pair.test) && reference.has(pair.reference)) return pair;
  }
  const Side& unusable = test.frame.assumed.empty() ? reference : test;
  throw Error("{}: nothing that both files have can be compared: {}", unusable.file.path().string(),
              fmt::join(unusable.frame.assumed, "; "));
}

using ViewPairs = std::vector<std::pair<std::string, std::string>>;

/// Adds a note if two files of one view each hold different views; they are compared all the same. `is_told`: by --view.
void note_other_view(const FrameFile& test, const FrameFile& reference, bool is_told) {
  const std::string &a = test.views().front(), &b = reference.views().front();
  if (test.view_is_assumed() == reference.view_is_assumed()) {
    if (a != b && !a.empty() && !b.empty())
      note({fmt::format("view '{}' is compared with view '{}'; is this intended?", a, b)});
    return;
  }
  const FrameFile& unsure = reference.view_is_assumed() ? reference : test;
  const std::string& view = reference.view_is_assumed() ? a : b;
  if (is_told || view.empty() || view_in_name(unsure.path(), {view})) return;
  note({fmt::format("{} lists several views and does not say which it holds; it is taken as '{}'",
                    unsure.path().filename().string(), view)});
}

/// Pairs of views (test, reference): the only two there are; the one that a file of one view is named after; those of
/// the same name. A file's name wins over its view's: a file that lists both eyes and holds one is read as the first.
ViewPairs pair_views(const FrameFile& test, const FrameFile& reference, bool is_told) {
  const std::vector<std::string>&a = test.views(), &b = reference.views();
  if (a.size() == 1 && b.size() == 1) {
    note_other_view(test, reference, is_told);
    return {{a[0], b[0]}};
  }
  const FrameFile& one = b.size() == 1 ? reference : test;
  const std::optional<std::string> named =
      a.size() == 1 || b.size() == 1 ? view_in_name(one.path(), (&one == &reference ? test : reference).views())
                                     : std::nullopt;
  if (named) {
    note({fmt::format("{} goes with view '{}', which its name ends in; --view chooses another",
                      one.path().filename().string(), *named)});
    return {b.size() == 1 ? std::pair(*named, b[0]) : std::pair(a[0], *named)};
  }
  for (const FrameFile* file : {&test, &reference}) {
    if (!file->view_is_assumed()) continue;
    note({fmt::format("{} lists several views and holds one, taken as '{}'; --view says which it is",
                      file->path().filename().string(), file->views()[0])});
  }
  ViewPairs pairs;
  for (const std::string& name : a) {
    if (contains(b, name)) pairs.emplace_back(name, name);
  }
  if (!pairs.empty()) return pairs;
  const auto words = [](const std::vector<std::string>& views) {
    return views.size() == 1 && views[0].empty() ? "one without a name" : enumerate(views);
  };
  throw Error("{} has the views {} and {} has {}; --view NAME says which to compare", test.path().string(), words(a),
              reference.path().string(), words(b));
}

/// The exposure by the flag, else by the reference.
double exposure_of(const CompareFlags& flags, const FrameFile& reference, const std::string& plane) {
  if (flags.exposure) return *flags.exposure;
  return plane == "reflection" ? reference.number_attribute("gloamExposure").value_or(0) : 0;
}

Json metrics_document(const Metrics& m) {
  Json document = {{"pixels", m.pixels},
                   {"mae", m.mae},
                   {"rmse", m.rmse},
                   {"bias", m.bias},
                   {"psnr", m.psnr ? Json(*m.psnr) : Json()},
                   {"max", m.max},
                   {"over_1_255", m.over_1_255},
                   {"over_0_05", m.over_0_05},
                   {"ssim", m.ssim},
                   {"gmsd", m.gmsd}};
  if (m.flip) document["flip"] = *m.flip;
  if (m.rse) document["rse"] = *m.rse;
  return document;
}

/// Metrics of several views as one: sums over all their pixels.
Metrics pooled(const std::vector<Metrics>& views) {
  if (views.size() == 1) return views.front();
  Metrics all;
  for (const Metrics& m : views) all.pixels += m.pixels;
  for (const Metrics& m : views) {
    const double share = double(m.pixels) / double(all.pixels);
    all.mae += share * m.mae;
    all.rmse += share * m.rmse * m.rmse;
    all.bias += share * m.bias;
    all.max = std::max(all.max, m.max);
    all.over_1_255 += share * m.over_1_255;
    all.over_0_05 += share * m.over_0_05;
    all.ssim += share * m.ssim;
    all.gmsd += share * m.gmsd;
    if (m.flip) all.flip = all.flip.value_or(0) + share * *m.flip;
    if (m.rse) all.rse = all.rse.value_or(0) + share * *m.rse;
  }
  all.rmse = std::sqrt(all.rmse);
  if (all.rmse > 0) all.psnr = -20 * std::log10(all.rmse);
  return all;
}

/// The meaning of a positive and a negative bias, in words.
std::string bias_words(double bias, const std::string& plane) {
  if (std::abs(bias) < 5e-6) return "";
  const PlaneKind::Meaning meaning = plane_kind(plane).meaning;
  const bool light = meaning == PlaneKind::unit_interval || plane == "color" || plane == "reflection";
  return bias > 0 ? (light ? "  (too bright)" : "  (too high)") : (light ? "  (too dark)" : "  (too low)");
}

/// "ao: ao.exr against truth.exr", or "ao_raw of ao.exr against ao of truth.exr".
void print_heading(const PlanePair& planes, const CompareFlags& flags) {
  const std::string test = printable(flags.test), reference = printable(flags.reference);
  if (planes.test == planes.reference)
    fmt::print("{}: {} against {} (test - truth)\n", planes.test, test, reference);
  else
    fmt::print("{} of {} against {} of {} (test - truth)\n", planes.test, test, planes.reference, reference);
}

void print_metrics(const std::string& view, const std::string& plane, const Metrics& m) {
  if (!view.empty()) fmt::print("view {}\n", printable(view));
  std::vector<std::vector<std::string>> rows = {{"pixels", std::to_string(m.pixels)},
                                                {"RMSE", fmt::format("{:.5f}", m.rmse)},
                                                {"MAE", fmt::format("{:.5f}", m.mae)},
                                                {"bias", fmt::format("{:+.5f}{}", m.bias, bias_words(m.bias, plane))},
                                                {"PSNR", m.psnr ? fmt::format("{:.2f} dB", *m.psnr) : "identical"},
                                                {"max", fmt::format("{:.5f}", m.max)},
                                                {"over 1/255", fmt::format("{:.2f} %", 100 * m.over_1_255)},
                                                {"over 0.05", fmt::format("{:.2f} %", 100 * m.over_0_05)},
                                                {"SSIM", fmt::format("{:.4f}", m.ssim)},
                                                {"GMSD", fmt::format("{:.4f}", m.gmsd)}};
  if (m.flip) rows.push_back({"FLIP", fmt::format("{:.4f}", *m.flip)});
  if (m.rse) rows.push_back({"RSE", fmt::format("{:.5f}", *m.rse)});
  print_table(rows, 2);
}

/// "0.5" of "hbao+: radius=0.5 bias=0.1"; none where there is no radius.
std::optional<double> radius_in(const std::string& parameters) {
  const std::string key = " radius=";
  const size_t at = parameters.find(key);
  if (at == std::string::npos) return {};
  return std::strtod(parameters.c_str() + at + key.size(), nullptr);
}

/// Two radii, finite or not, as near as float and decimals keep them.
bool is_near(double a, double b) { return a == b || std::abs(a - b) <= 1e-3 * std::min(a, b); }

/// Adds a note for an AO made with another radius than its truth.
void note_other_radius(const FrameFile& test, const FrameFile& reference) {
  const std::optional<double> truth = reference.number_attribute("aoRadius");
  const std::optional<double> used = radius_in(test.text_attribute("gloamParameters"));
  if (!truth || !used || is_near(*truth, *used)) return;
  note({fmt::format("the radius of the test is {:g}, and that of the truth {:g}", *used, *truth)});
}

Frame background_frame(const CompareFlags& flags, const ReadOptions& options) {
  if (flags.frame.empty()) return {};
  FrameFile file(flags.frame, options_beside(options, flags.frame));
  if (!contains(file.common_planes(), "depth"))
    throw Error("{}: no depth to tell the background by; {}", flags.frame, holdings(file));
  return file.read({"depth"});
}

/// The foreground by --frame, since the user named it; else by the files' own depth.
std::optional<Mask> mask_of(const CompareFlags& flags, const Frame& extra, const Side& test, const Side& reference,
                            const std::pair<std::string, std::string>& views, const Overlap& overlap,
                            const Rows& rows) {
  if (!flags.frame.empty()) {
    const Window window = window_under(extra, flags.frame, test.frame, overlap.window, overlap.layout);
    return foreground(extra, view_of(extra, views.first), {window, overlap.layout}, rows);
  }
  if (const auto mask = foreground(test.frame, views.first, overlap, rows)) return mask;
  return foreground(reference.frame, views.second, overlap, rows);
}

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

/// Adds the files' names to an error about inputs that cannot be compared.
template <typename Work>
auto naming_files(const CompareFlags& flags, const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    throw Error("{} against {}: {}", flags.test, flags.reference, error.what());
  }
}

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
  const unsigned long long memory =
      planned_memory(flags.frame_flags, flags.test + " against " + flags.reference,
                     bytes_of_comparison(flags, options, test.file, reference.file),
                     flags.picture.empty() ? "compare one view (--view) or a part of it"
                                           : "leave -o out, or compare one view (--view)");
  const PlanePair planes = survey_sides(test, reference, flags.plane, !flags.frame.empty());
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
  CLI::App* command = app.add_subcommand(
      "compare", "how far an image is from the truth, or its two views from each other: figures and a picture");
  command->add_option("test", flags->test, "EXR file, such as gloam run writes")->required()->type_name("TEST.exr");
  command
      ->add_option("reference", flags->reference,
                   "EXR file with the truth; with --stereo: none, or the file of the second eye")
      ->type_name("REF.exr");
  command
      ->add_option("-o,--output", flags->picture,
                   "picture of test, truth, difference and histogram; with --stereo: of the first view's errors, or "
                   "ERRORS.exr with those of both")
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
  flags->frame_flags.add_to(*command);
  flags->json.add_to(*command);
  command->footer(
      "Background never counts. Examples:\n"
      "  gloam compare ao.exr truth.exr -o difference.png\n"
      "  gloam compare ao.exr truth_left.exr --view left --json -\n"
      "  gloam compare ao.exr truth.exr --what ao_raw\n"
      "  gloam compare ao.exr truth.exr --plane ao=Lamp.R\n"
      "  gloam compare reflection.exr truth.exr --plane reflection --view left\n"
      "  gloam compare --stereo ao.exr --frame pair.exr -o inconsistency.png --anaglyph both.png");
  command->callback([flags, stereo] {
    flags->take_plane_names();
    if (stereo->is_asked_for && flags->exposure)
      throw UsageError("--exposure {}: two views are compared as they are; leave it out", *flags->exposure);
    if (stereo->is_asked_for) return stereo_command(*flags, *stereo);
    if (flags->reference.empty())
      throw UsageError(
          "compare: REF.exr is required, or --stereo for the two views of one file (gloam compare --help)");
    compare_command(*flags);
  });
}

}  // namespace gloam::cli
