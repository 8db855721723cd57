// gloam compare --stereo OUT.exr [--frame PAIR.exr], gloam compare --stereo LEFT.exr RIGHT.exr --frame PAIR.exr
#include "cli/compare/stereo.h"

#include "base/json_text.h"
#include "cli/flags/memory.h"
#include "gloam/error.h"
#include "gloam/stereo_pictures.h"

namespace gloam::cli {
namespace {

/// Angles of normals in half precision are exact to about 0.03 degrees.
constexpr double smallest_angle = 0.1;

void print_result(const CompareFlags& flags, const StereoComparison& c, const std::vector<std::string>& written) {
  fmt::print("{} of {}: stereo inconsistency{}\n", c.plane, printable(flags.test),
             c.result.normal_check ? fmt::format(", normal-check {:g} degrees", *c.result.normal_check) : "");
  std::vector<std::vector<std::string>> rows = {stereo_heading("view")};
  for (size_t i = 0; i < 2; ++i) rows.push_back(stereo_cells(c.pair.views[i].name, c.result.views[i].figures));
  rows.push_back(stereo_cells("both", c.result.both));
  print_table(rows, 1);
  print_written(written);
}

bool is_frame_name(const std::string& path) { return std::filesystem::path(path).extension() == ".exr"; }

/// Writes the pictures asked for, and returns their files.
std::vector<std::string> write_pictures(const CompareFlags& flags, const StereoFlags& stereo,
                                        const StereoComparison& c) {
  const Plane &left = *c.pair.views[0].find(c.plane), &right = *c.pair.views[1].find(c.plane);
  if (is_frame_name(flags.picture))
    write_errors(flags.picture, c);
  else if (!flags.picture.empty())
    write_inconsistency_picture(flags.picture, left, c.result.views[0], stereo.magnify);
  if (!stereo.anaglyph.empty()) write_anaglyph(stereo.anaglyph, left, right);
  if (!stereo.side_by_side.empty()) write_side_by_side(stereo.side_by_side, left, right);
  std::vector<std::string> written = {flags.picture, stereo.anaglyph, stereo.side_by_side};
  std::erase(written, "");
  return written;
}

void check_names(const CompareFlags& flags, const StereoFlags& stereo) {
  if (!is_frame_name(flags.picture)) check_picture_name(flags.picture, "-o");
  check_picture_name(stereo.anaglyph, "--anaglyph");
  check_picture_name(stereo.side_by_side, "--side-by-side");
  check_paths({{"the result", flags.test}, {"the second eye's result", flags.reference}, {"--frame", flags.frame}},
              {{"-o", flags.picture},
               {"--anaglyph", stereo.anaglyph},
               {"--side-by-side", stereo.side_by_side},
               {"--json", flags.json.file()}});
  check_no_single_view(flags);
}

}  // namespace

void StereoFlags::add_to(CLI::App& app) {
  const Heading heading(app, "Two views");
  CLI::Option* on =
      app.add_flag("--stereo", is_asked_for,
                   "how far the two views of the test are from each other where both see the same surface (Shi, "
                   "Billeter, Eisemann 2022, section 4.1)");
  CLI::Option* angle = add_number(app, "--normal-check", normal_check, {smallest_angle, 180},
                                  "a pixel counts where its normal is within this angle of those of its neighbours in "
                                  "the other view; default 6",
                                  "DEGREES")
                           ->needs(on);
  app.add_flag("--no-normal-check", no_normal_check, "whatever the normals are")->needs(on)->excludes(angle);
  add_number(app, "--magnify", magnify, {1e-3, 1e6},
             "errors in the picture are shown this many times as large; default 20", "N")
      ->needs(on);
  add_text(app, "--anaglyph", anaglyph, "BOTH.png",
           "both views for glasses that are red on the left and cyan on the right")
      ->needs(on);
  add_text(app, "--side-by-side", side_by_side, "BOTH.png", "both views beside each other")->needs(on);
}

Json stereo_document(const StereoComparison& c) {
  const auto mean = [](const StereoFigures& f) { return f.counted > 0 ? Json(f.mean) : Json(); };
  const StereoFigures &left = c.result.views[0].figures, &right = c.result.views[1].figures, &both = c.result.both;
  return {{"inconsistency", {{"left", mean(left)}, {"right", mean(right)}, {"mean", both.mean}}},
          {"pixels", both.counted},
          {"rejected_share", both.rejected_share()},
          {"rmse", both.rmse},
          {"p99", both.p99},
          {"max", both.max},
          {"rejected", {{"outside", both.outside}, {"hidden", both.hidden}, {"edge", both.edge}}},
          {"plane", c.plane},
          {"views", {c.pair.views[0].name, c.pair.views[1].name}},
          {"normal_check", or_null(c.result.normal_check)},
          {"memory_bytes", c.memory}};
}

std::vector<std::string> stereo_heading(const std::string& first) {
  return {first, "mean", "RMSE", "99 %", "max", "pixels", "rejected"};
}

std::vector<std::string> stereo_cells(const std::string& name, const StereoFigures& f) {
  std::vector<std::string> cells = {name};
  for (const double value : {f.mean, f.rmse, f.p99, f.max}) cells.push_back(fmt::format("{:.5f}", value));
  cells.insert(cells.end(), {std::to_string(f.counted), fmt::format("{:.2f} %", 100 * f.rejected_share())});
  return cells;
}

StereoOptions StereoFlags::options() const {
  StereoOptions options;
  options.normal_check = no_normal_check ? std::nullopt : std::optional(normal_check);
  return options;
}

void check_no_single_view(const CompareFlags& flags) {
  if (!flags.frame_flags.view.empty())
    throw UsageError("--view {}: --stereo needs two views; --views A,B says which", flags.frame_flags.view);
}

StereoComparison compare_stereo(const comparison::ComparedFiles& files, const ReadOptions& options,
                                const FrameFlags& flags, const StereoFlags& stereo) {
  comparison::TwoEyes eyes(files, options, stereo.options());
  const unsigned long long memory = planned_memory(flags, files.test, eyes.bytes(), "give a smaller part of the image");
  std::vector<std::string> notes;
  StereoComparison c{eyes.compare(notes), memory};
  note(notes);
  return c;
}

void stereo_command(const CompareFlags& flags, const StereoFlags& stereo) {
  check_names(flags, stereo);
  StereoComparison c = compare_stereo(flags, flags.frame_flags.read_options(), flags.frame_flags, stereo);
  const std::vector<std::string> written = write_pictures(flags, stereo, c);
  flags.json.write(stereo_document(c), written);
  if (!flags.json.only_json()) print_result(flags, c, written);
}

}  // namespace gloam::cli
