// gloam compare --stereo OUT.exr [--frame PAIR.exr], gloam compare --stereo LEFT.exr RIGHT.exr --frame PAIR.exr
#include "cli/compare/stereo.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "cli/compare/stereo_inputs.h"
#include "cli/flags/memory.h"
#include "gloam/error.h"
#include "gloam/planes.h"
#include "gloam/stereo_consistency.h"
#include "gloam/stereo_pictures.h"

namespace gloam::cli {
namespace {

/// Angles of normals in half precision are exact to about 0.03 degrees.
constexpr double smallest_angle = 0.1;

// ---------------------------------------------------------------------------------------------------------------------
// Inputs

/// One view of a file, and the part of its pixels that lies under the images.
struct Source {
  const StereoInput* input = nullptr;
  const View* view = nullptr;
  Window window;
};

/// One source for each eye.
using Sources = std::array<Source, 2>;

Sources sources_of(const std::vector<StereoInput>& results) {
  const Frame& first = results.front().frame;
  if (results.size() == 1)
    return {Source{&results[0], &first.views[0], first.window}, Source{&results[0], &first.views[1], first.window}};
  const Frame& second = results[1].frame;
  if (first.width() != second.width() || first.height() != second.height())
    throw Error("{} is {}x{} and {} is {}x{}; both eyes need images of one size", results[0].name(), first.width(),
                first.height(), results[1].name(), second.width(), second.height());
  return {Source{&results[0], &first.views[0], first.window}, Source{&results[1], &second.views[0], second.window}};
}

/// The views of --frame for those of the results: by name, or in order if each eye has a file.
Sources sources_of(const StereoInput& extra, const std::vector<StereoInput>& results) {
  const Frame &frame = extra.frame, &first = results.front().frame;
  if (frame.views.size() < 2)
    throw Error("--frame {}: holds one view, and the results two; give the frame that they were made of", extra.name());
  if (results.size() == 2 && frame.views.size() > 2)
    throw Error("--frame {}: has the views {}; --views A,B says which two", extra.name(),
                enumerate(extra.file.views()));
  const Window under = window_under(frame, extra.name(), first, first.window, Layout(first.width(), first.height()));
  Sources sources;
  for (size_t i = 0; i < 2; ++i) {
    const View& view = results.size() == 2 ? frame.views[i] : frame.view(view_of(frame, first.views[i].name));
    sources[i] = {&extra, &view, under == Window{} ? frame.window : under};
  }
  return sources;
}

/// Names of the eyes: the views' own, if these differ.
std::array<std::string, 2> names_of(const std::vector<Sources>& sources) {
  for (const Sources& s : sources) {
    const std::string &left = s[0].view->name, &right = s[1].view->name;
    if (!left.empty() && !right.empty() && left != right) return {left, right};
  }
  return {"left", "right"};
}

bool have_cameras(const Sources& sources) {
  return std::all_of(sources.begin(), sources.end(),
                     [](const Source& s) { return s.view->camera && s.view->camera->pose.has_value(); });
}

/// Sources in order of preference: --frame first, since the user named it. But the meaning of depth and normals may depend on the
/// camera: files with a camera come before a file without one.
std::vector<Sources> sources_of(const std::vector<StereoInput>& frames, const std::vector<StereoInput>& results) {
  std::vector<Sources> sources;
  for (const StereoInput& frame : frames) sources.push_back(sources_of(frame, results));
  sources.push_back(sources_of(results));
  std::stable_partition(sources.begin(), sources.end(), have_cameras);
  return sources;
}

/// The first sources that have the plane for both eyes; null if none has.
const Sources* first_with(const std::vector<Sources>& sources, const std::string& plane) {
  for (const Sources& s : sources) {
    if (s[0].view->find(plane) && s[1].view->find(plane)) return &s;
  }
  return nullptr;
}

/// A camera for a window that starts elsewhere.
Camera moved(Camera camera, const Window& from, const Window& to) {
  camera.cx += to.x0 - from.x0;
  camera.cy += to.y0 - from.y0;
  return camera;
}

void take_plane(Frame& pair, const Sources& sources, const std::string& plane) {
  for (size_t i = 0; i < 2; ++i) {
    const Source& s = sources[i];
    pair.views[i].planes[plane] = cropped(*s.view->find(plane), s.input->frame.window, s.window);
  }
}

const char* what_is_missing = "; --frame FRAME.exr names the frame that it was made of";

/// The plane of `results` with the depth, the normals and the cameras of the first sources that have them.
Frame pair_of(const Sources& results, const std::vector<Sources>& sources, const std::string& plane) {
  const std::string name = results[0].input->name();
  if (!have_cameras(sources.front()))
    throw Error(
        "{}: no camera with a pose for both views, so that nobody knows where a pixel lies in the other{}, "
        "--camera FILE.json the cameras",
        name, what_is_missing);
  const Sources& cameras = sources.front();
  for (const Source& eye : results) {
    if (!eye.view->find(plane))
      throw Error("{}: '{}' is of no use: {}", eye.input->name(), plane, fmt::join(eye.input->frame.assumed, "; "));
  }
  const Sources* depth = first_with(sources, "depth");
  if (!depth) throw Error("{}: no depth for both views{}", name, what_is_missing);
  Frame pair;
  pair.display = results[0].input->frame.display;
  pair.window = results[0].window;
  pair.views.resize(2);
  const std::array<std::string, 2> names = names_of(sources);
  for (size_t i = 0; i < 2; ++i) {
    pair.views[i].name = names[i];
    pair.views[i].camera = moved(*cameras[i].view->camera, cameras[i].window, pair.window);
  }
  if (const Sources* normals = first_with(sources, "normal")) take_plane(pair, *normals, "normal");
  take_plane(pair, *depth, "depth");
  take_plane(pair, results, plane);
  return pair;
}

// ---------------------------------------------------------------------------------------------------------------------
// Outputs

Json document_of(const StereoInconsistency& result, const Frame& pair, const std::string& plane) {
  const auto mean = [](const StereoFigures& f) { return f.counted > 0 ? Json(f.mean) : Json(); };
  const StereoFigures& both = result.both;
  return {{"inconsistency",
           {{"left", mean(result.views[0].figures)}, {"right", mean(result.views[1].figures)}, {"mean", both.mean}}},
          {"pixels", both.counted},
          {"rejected_share", both.rejected_share()},
          {"rmse", both.rmse},
          {"p99", both.p99},
          {"max", both.max},
          {"rejected", {{"outside", both.outside}, {"hidden", both.hidden}, {"edge", both.edge}}},
          {"plane", plane},
          {"views", {pair.views[0].name, pair.views[1].name}},
          {"normal_check", result.normal_check ? Json(*result.normal_check) : Json()}};
}

void print_result(const CompareFlags& flags, const StereoInconsistency& result, const Frame& pair,
                  const std::string& plane, const std::vector<std::string>& written) {
  fmt::print("{} of {}: stereo inconsistency{}\n", plane, printable(flags.test),
             result.normal_check ? fmt::format(", normal-check {:g} degrees", *result.normal_check) : "");
  std::vector<std::vector<std::string>> rows = {{"view", "mean", "RMSE", "99 %", "max", "pixels", "rejected"}};
  const auto add = [&](const std::string& name, const StereoFigures& f) {
    std::vector<std::string> row = {name};
    for (const double value : {f.mean, f.rmse, f.p99, f.max}) row.push_back(fmt::format("{:.5f}", value));
    row.push_back(std::to_string(f.counted));
    row.push_back(fmt::format("{:.2f} %", 100 * f.rejected_share()));
    rows.push_back(row);
  };
  for (size_t i = 0; i < 2; ++i) add(pair.views[i].name, result.views[i].figures);
  add("both", result.both);
  print_table(rows, 1);
  for (const std::string& path : written) fmt::print("wrote {}\n", printable(path));
}

/// Writes the raw errors of both views, with depth and cameras. Pixels that do not count are NaN.
void write_errors(const std::string& path, Frame& pair, const StereoInconsistency& result) {
  Frame out;
  out.display = pair.display;
  out.window = pair.window;
  for (size_t i = 0; i < 2; ++i) {
    View view;
    view.name = pair.views[i].name;
    view.camera = pair.views[i].camera;
    view.planes["depth"] = pair.views[i].planes["depth"].clone();
    Plane& errors = view.planes["inconsistency"] = {"inconsistency", {}};
    errors.channels.push_back(result.views[i].error.clone());
    errors.channels[0].fill_padding(std::numeric_limits<float>::quiet_NaN());
    out.views.push_back(std::move(view));
  }
  write_frame(path, out);
}

bool is_frame_name(const std::string& path) { return std::filesystem::path(path).extension() == ".exr"; }

/// Writes the pictures asked for, and returns their files.
std::vector<std::string> write_pictures(const CompareFlags& flags, const StereoFlags& stereo, Frame& pair,
                                        const std::string& plane, const StereoInconsistency& result) {
  const Plane &left = *pair.views[0].find(plane), &right = *pair.views[1].find(plane);
  std::vector<std::string> written;
  if (is_frame_name(flags.picture)) {
    write_errors(flags.picture, pair, result);
    written.push_back(flags.picture);
  } else if (!flags.picture.empty()) {
    write_inconsistency_picture(flags.picture, left, result.views[0], stereo.magnify);
    written.push_back(flags.picture);
  }
  if (!stereo.anaglyph.empty()) {
    write_anaglyph(stereo.anaglyph, left, right);
    written.push_back(stereo.anaglyph);
  }
  if (!stereo.side_by_side.empty()) {
    write_side_by_side(stereo.side_by_side, left, right);
    written.push_back(stereo.side_by_side);
  }
  return written;
}

/// Adds notes on the assumptions about the first sources; about all sources if their normals are unusable.
void note_assumptions(const std::vector<Sources>& sources, bool lacks_normals) {
  std::vector<std::string> assumed;
  for (const Sources& s : sources) {
    if (&s != &sources.front() && !lacks_normals) break;
    for (const Source& source : s) {
      for (const std::string& sentence : source.input->frame.assumed) add_new(assumed, sentence);
    }
  }
  if (lacks_normals)
    assumed.push_back("no normals for both views: pixels count without the normal-check; --frame FRAME.exr gives them");
  note(assumed);
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
  if (!flags.frame_flags.view.empty())
    throw UsageError("--view {}: --stereo needs two views; --views A,B says which", flags.frame_flags.view);
}

StereoOptions options_of(const StereoFlags& stereo) {
  StereoOptions options;
  options.normal_check = stereo.normal_check;
  if (stereo.no_normal_check) options.normal_check.reset();
  return options;
}

}  // namespace

void StereoFlags::add_to(CLI::App& app) {
  const char* group = "Two views";
  CLI::Option* on =
      app.add_flag("--stereo", is_asked_for,
                   "how far the two views of the test are from each other where both see the same surface (Shi, "
                   "Billeter, Eisemann 2022, section 4.1)")
          ->group(group);
  CLI::Option* angle = add_number(app, "--normal-check", normal_check, {smallest_angle, 180},
                                  "a pixel counts where its normal is within this angle of those of its neighbours in "
                                  "the other view; default 6")
                           ->type_name("DEGREES")
                           ->group(group)
                           ->needs(on);
  app.add_flag("--no-normal-check", no_normal_check, "whatever the normals are")
      ->group(group)
      ->needs(on)
      ->excludes(angle);
  add_number(app, "--magnify", magnify, {1e-3, 1e6},
             "errors in the picture are shown this many times as large; default 20")
      ->type_name("N")
      ->group(group)
      ->needs(on);
  app.add_option("--anaglyph", anaglyph, "both views for glasses that are red on the left and cyan on the right")
      ->type_name("BOTH.png")
      ->group(group)
      ->needs(on);
  app.add_option("--side-by-side", side_by_side, "both views beside each other")
      ->type_name("BOTH.png")
      ->group(group)
      ->needs(on);
}

/// Measures, and adds the files' names to an error about inputs that cannot be compared.
StereoInconsistency inconsistency_of(const CompareFlags& flags, const Frame& pair, const std::string& plane,
                                     const StereoOptions& check) {
  try {
    return stereo_inconsistency(pair, plane, check);
  } catch (const Error& error) {
    throw Error("{}{}: {}", flags.test, flags.reference.empty() ? "" : " and " + flags.reference, error.what());
  }
}

StereoComparison compare_stereo(const CompareFlags& flags, const StereoFlags& stereo, const ReadOptions& options) {
  const StereoOptions check = options_of(stereo);
  std::vector<StereoInput> results = open_results(flags, options), frames = open_frame(flags, options);
  StereoComparison c;
  c.plane = flags.plane.empty() ? plane_to_compare(results) : plane_asked_for(results, flags.plane);
  std::vector<std::string> geometry = {"depth"};
  if (check.normal_check) geometry.push_back("normal");
  c.memory = planned_memory(flags.frame_flags, flags.test, bytes_of(results, frames, geometry, c.plane),
                            "give a smaller part of the image");
  read_all(results, geometry, c.plane);
  read_all(frames, geometry, "depth");
  const std::vector<Sources> sources = sources_of(frames, results);
  c.pair = pair_of(sources_of(results), sources, c.plane);
  c.result = inconsistency_of(flags, c.pair, c.plane, check);
  note_assumptions(sources, check.normal_check && !c.result.normal_check);
  return c;
}

Json stereo_document(const StereoComparison& c) {
  Json document = document_of(c.result, c.pair, c.plane);
  document["memory_bytes"] = c.memory;
  return document;
}

void stereo_command(const CompareFlags& flags, const StereoFlags& stereo) {
  check_names(flags, stereo);
  ReadOptions options = flags.frame_flags.read_options();
  options.as_stored = true;
  StereoComparison c = compare_stereo(flags, stereo, options);
  const std::vector<std::string> written = write_pictures(flags, stereo, c.pair, c.plane, c.result);
  flags.json.write(stereo_document(c), written);
  if (!flags.json.only_json()) print_result(flags, c.result, c.pair, c.plane, written);
}

}  // namespace gloam::cli
