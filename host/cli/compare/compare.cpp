// gloam compare TEST.exr REF.exr [-o difference.png]; stereo.cpp has the form with --stereo, sequence.cpp that of shots
#include <memory>

#include "cli/compare/figures.h"
#include "cli/compare/sequence.h"
#include "cli/compare/stereo.h"
#include "cli/flags/memory.h"
#include "cli/flags/options.h"
#include "comparison/two_files.h"
#include "gloam/error.h"
#include "gloam/visualise.h"

namespace gloam::cli {
namespace {

using comparison::FileFigures;
using comparison::ViewFigures;

Json document_of(const FileFigures& figures, unsigned long long memory) {
  Json document = metrics_document(figures.pooled());
  if (const auto shown = figures.pooled_shown()) document["shown"] = metrics_document(*shown);
  document["memory_bytes"] = memory;
  if (figures.exposure > 0) document["exposure"] = figures.exposure;
  document["plane"] = figures.planes.test;
  document["truth_plane"] = figures.planes.reference;
  for (size_t i = 0; figures.views.size() > 1 && i < figures.views.size(); ++i) {
    Json& view = document["views"][figures.pairs[i].first] = metrics_document(figures.views[i].all);
    if (figures.views[i].shown) view["shown"] = metrics_document(*figures.views[i].shown);
  }
  return document;
}

void print(const FileFigures& figures, const CompareFlags& flags) {
  print_heading(figures.planes, flags);
  if (figures.exposure > 0) fmt::print("SSIM, GMSD and FLIP at exposure {:.4g}\n", figures.exposure);
  const bool are_shown = std::all_of(figures.views.begin(), figures.views.end(),
                                     [](const ViewFigures& view) { return view.shown.has_value(); });
  for (size_t i = 0; i < figures.views.size(); ++i) {
    print_metrics(figures.views.size() > 1 ? figures.pairs[i].first : "", figures.planes.test, figures.views[i].all);
    if (!are_shown) continue;
    fmt::print("of these where the frame shows most of what is reflected\n");
    print_metrics("", figures.planes.test, *figures.views[i].shown);
  }
  print_written(figures.pictures);
}

void compare_command(const CompareFlags& flags) {
  check_picture_name(flags.picture, "-o");
  check_paths({{"the test", flags.test}, {"the reference", flags.reference}, {"--frame", flags.frame}},
              {{"-o", flags.picture}, {"--json", flags.json.file()}});
  std::vector<std::string> notes;
  comparison::TwoFiles files(flags, flags.frame_flags.read_options(), notes);
  check_pictures({"-o", flags.picture}, files.views());
  const unsigned long long memory =
      planned_memory(flags.frame_flags, flags.test + " against " + flags.reference, files.bytes(!flags.picture.empty()),
                     flags.picture.empty() ? "compare one view (--view) or a part of it"
                                           : "leave -o out, or compare one view (--view)");
  const FileFigures figures = files.compare(flags.picture, notes);
  if (!figures.is_background_known)
    notes.push_back("no depth in either file: every pixel counts; --frame FRAME.exr tells the background");
  note(notes);
  flags.json.write(document_of(figures, memory), figures.pictures);
  if (!flags.json.only_json()) print(figures, flags);
}

}  // namespace

void add_compare(CLI::App& app) {
  auto flags = std::make_shared<CompareFlags>();
  auto stereo = std::make_shared<StereoFlags>();
  auto sequence = std::make_shared<CompareSequenceFlags>();
  CLI::App* command = app.add_subcommand(
      "compare", "how far an image is from the truth, or its two views from each other: figures and a picture");
  add_text(*command, "test", flags->test, "TEST.exr",
           "EXR file, such as gloam run writes; those of a sequence: test.####.exr")
      ->required();
  add_text(*command, "reference", flags->reference, "REF.exr",
           "EXR file with the truth; with --stereo: none, or the file of the second eye");
  add_text(*command, "-o,--output", flags->picture, "DIFFERENCE.png",
           "picture of test, truth, difference and histogram; of a sequence: plot over its frames; with --stereo: "
           "of the first view's errors, or ERRORS.exr with those of both");
  add_text(*command, "--what", flags->plane, "PLANE",
           "plane of the test to compare (--plane PLANE does the same); default: the first that both have, "
           "results first. ao_raw goes with "
           "the truth's ao where that has no ao_raw");
  add_text(*command, "--frame", flags->frame, "FRAME.exr",
           "frame whose depth tells the background; with --stereo also its normals and cameras count");
  add_number(
      *command, "--exposure", flags->exposure, {1e-30, 1e30},
      "of radiance, before SSIM, GMSD and FLIP; default: what the truth of a reflection says, else the values as "
      "they are",
      "FACTOR");
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
