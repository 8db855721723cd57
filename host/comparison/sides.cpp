#include "comparison/sides.h"

#include <algorithm>
#include <cmath>

#include "base/lists.h"
#include "exr/holdings.h"
#include "exr/options_beside.h"
#include "gloam/error.h"
#include "gloam/option.h"
#include "gloam/planes.h"
#include "shot/memory.h"

namespace gloam::comparison {
namespace {

/// Adds a note if two files of one view each hold different views; they are compared all the same. `is_told`: by
/// the options.
void note_other_view(const FrameFile& test, const FrameFile& reference, bool is_told, std::vector<std::string>& notes) {
  const std::string &a = test.views().front(), &b = reference.views().front();
  if (test.view_is_assumed() == reference.view_is_assumed()) {
    if (a != b && !a.empty() && !b.empty())
      notes.push_back(fmt::format("view '{}' is compared with view '{}'; is this intended?", a, b));
    return;
  }
  const FrameFile& unsure = reference.view_is_assumed() ? reference : test;
  const std::string& view = reference.view_is_assumed() ? a : b;
  if (is_told || view.empty() || view_in_name(unsure.path(), {view})) return;
  notes.push_back(fmt::format("{} lists several views and does not say which it holds; it is taken as '{}'",
                              unsure.path().filename().string(), view));
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

/// Adds a note if a view's poses in the two headers differ: most likely two frames are compared.
void note_other_camera(const FrameFile& test, const FrameFile& reference, std::vector<std::string>& notes) {
  constexpr double tolerance = 1e-4;  // headers hold floats
  for (const std::string& view : test.views()) {
    if (!contains(reference.views(), view)) continue;
    const std::optional<Camera> a = test.camera(view), b = reference.camera(view);
    if (!a || !b || !a->pose || !b->pose) continue;
    const glm::dmat3 turn = a->pose->world_to_view - b->pose->world_to_view;
    const double turned = glm::length(turn[0]) + glm::length(turn[1]) + glm::length(turn[2]);
    const double moved = glm::distance(a->pose->position, b->pose->position);
    if (turned <= tolerance && moved <= tolerance * (1 + glm::length(b->pose->position))) continue;
    notes.push_back("by their headers, test and truth are seen by different cameras; are they of one frame?");
    return;
  }
}

/// Adds a note for an AO made with another radius than its truth.
void note_other_radius(const FrameFile& test, const FrameFile& reference, std::vector<std::string>& notes) {
  const std::optional<double> truth = reference.number_attribute("aoRadius");
  const std::optional<double> used = radius_in(test.text_attribute("gloamParameters"));
  if (!truth || !used || is_near(*truth, *used)) return;
  notes.push_back(fmt::format("the radius of the test is {:g}, and that of the truth {:g}", *used, *truth));
}

/// Rows of the overlap in a frame's own coordinates.
Window window_of(const Frame& frame, const Overlap& overlap, const Rows& rows) {
  const Window& w = overlap.window == Window{} ? frame.window : overlap.window;
  return {w.x0, w.y0 + rows.first, w.x1, w.y0 + rows.last};
}

/// Foreground of a view of one frame; none if the frame has no depth for that view.
std::optional<Mask> foreground(const Frame& frame, const std::string& name, const Overlap& overlap, const Rows& rows) {
  const auto view = std::find_if(frame.views.begin(), frame.views.end(), [&](const View& v) { return v.name == name; });
  const Plane* depth = view == frame.views.end() ? nullptr : view->find("depth");
  if (!depth || !covers(frame, overlap.window, overlap.layout)) return {};
  const Window window = window_of(frame, overlap, rows);
  const Channel& z = depth->channels.front();
  Mask mask;
  mask.reserve(size_t(window.width()) * size_t(window.height()));
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < window.x1; ++x)
      mask.push_back(!is_background(z.at(x - frame.window.x0, y - frame.window.y0)));
  }
  return mask;
}

}  // namespace

void Side::survey(const std::string& plane, bool with_depth) {
  std::vector<std::string> planes = {plane};
  if (with_depth && plane != "depth" && contains(file.common_planes(), "depth")) planes.push_back("depth");
  frame = file.survey(planes);
}

bool Side::has(const std::string& plane) {
  const auto has = [&](const View& view) { return view.find(plane) != nullptr; };
  if (plane == "depth") return std::all_of(frame.views.begin(), frame.views.end(), has);
  const Frame one_row = file.read_rows({plane}, 0, 1);
  return std::all_of(one_row.views.begin(), one_row.views.end(), has);
}

Frame Side::read(const std::string& plane, const Overlap& overlap, const Rows& rows) {
  if (plane == "depth") return {};
  const Window window = window_of(frame, overlap, rows);
  return file.read_rows({plane}, window.y0 - frame.window.y0, window.y1 - frame.window.y0);
}

Plane Side::rows_of(const Frame& read, const std::string& plane, const std::string& view, const Overlap& overlap,
                    const Rows& rows) const {
  const Frame& from = plane == "depth" ? frame : read;
  return cropped(*from.view(view).find(plane), from.window, window_of(frame, overlap, rows));
}

Overlap overlap_of(const Side& test, const Side& reference) {
  const Frame &a = test.frame, &b = reference.frame;
  const auto over = [](const Window& window) { return Overlap{window, Layout(window.width(), window.height())}; };
  if (a.window == b.window) return over(a.window);
  if (a.display == b.display) return over(a.display);
  if (a.width() == b.width() && a.height() == b.height()) return {{}, Layout(a.width(), a.height())};  // other origin
  throw Error("{} is {}x{} and {} is {}x{}; only images of one size can be compared", test.file.path().string(),
              a.width(), a.height(), reference.file.path().string(), b.width(), b.height());
}

/// Counts the plane that comes first. A picture needs all rows at once, and copies of them; figures need some rows and those around
/// them.
unsigned long long bytes_of_comparison(const ComparedFiles& files, const ReadOptions& options, const FrameFile& test,
                                       const FrameFile& reference, bool draws) {
  const PlanePair pair = comparable_planes(test, reference, files.plane).front();
  const bool test_tells = contains(test.common_planes(), "depth");
  const auto planes = [](const std::string& plane, bool with_depth) {
    return with_depth ? std::vector<std::string>{plane, "depth"} : std::vector<std::string>{plane};
  };
  const auto tests = planes(pair.test, files.frame.empty()),
             truths = planes(pair.reference, files.frame.empty() && !test_tells);
  const Window window = test.window();
  const size_t components = plane_kind(pair.test).components.size();
  unsigned long long bytes = process_bytes + Comparison::bytes(window.width(), components);
  if (!files.frame.empty())
    bytes += FrameFile(files.frame, options_beside(options, files.frame)).bytes_to_read({"depth"});
  if (!draws) {
    const int most_rows = std::max(test.rows_at_once({pair.test}), Comparison::step) + 2 * Comparison::reach();
    const unsigned long long rows = components * Layout(window.width(), most_rows).bytes();
    constexpr int copies = 4;  // of both sides' rows: as decoded, cut to the overlap, exposed, encoded
    return bytes + test.bytes_to_read_by_rows(tests) + reference.bytes_to_read_by_rows(truths) + 2 * copies * rows;
  }
  constexpr int copies = 3;  // of both sides' images, the difference and its picture included
  const unsigned long long image = components * Layout(window.width(), window.height()).bytes();
  return bytes + test.bytes_to_read(tests) + reference.bytes_to_read(truths) + 2 * copies * image;
}

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

ViewPairs pair_views(const FrameFile& test, const FrameFile& reference, bool is_told, std::vector<std::string>& notes) {
  const std::vector<std::string>&a = test.views(), &b = reference.views();
  if (a.size() == 1 && b.size() == 1) {
    note_other_view(test, reference, is_told, notes);
    return {{a[0], b[0]}};
  }
  const FrameFile& one = b.size() == 1 ? reference : test;
  const std::optional<std::string> named =
      a.size() == 1 || b.size() == 1 ? view_in_name(one.path(), (&one == &reference ? test : reference).views())
                                     : std::nullopt;
  if (named) {
    notes.push_back(fmt::format("{} goes with view '{}', which its name ends in; {} chooses another",
                                one.path().filename().string(), *named, option("view")));
    return {b.size() == 1 ? std::pair(*named, b[0]) : std::pair(a[0], *named)};
  }
  for (const FrameFile* file : {&test, &reference}) {
    if (!file->view_is_assumed()) continue;
    notes.push_back(fmt::format("{} lists several views and holds one, taken as '{}'; {} says which it is",
                                file->path().filename().string(), file->views()[0], option("view")));
  }
  ViewPairs pairs;
  for (const std::string& name : a) {
    if (contains(b, name)) pairs.emplace_back(name, name);
  }
  if (!pairs.empty()) return pairs;
  const auto words = [](const std::vector<std::string>& views) {
    return views.size() == 1 && views[0].empty() ? "one without a name" : enumerate(views);
  };
  throw Error("{} has the views {} and {} has {}; {} says which to compare", test.path().string(), words(a),
              reference.path().string(), words(b), option("view", "NAME"));
}

double exposure_of(const ComparedFiles& files, const FrameFile& reference, const std::string& plane) {
  if (files.exposure) return *files.exposure;
  return plane == "reflection" ? reference.number_attribute("gloamExposure").value_or(0) : 0;
}

void note_differences(const FrameFile& test, const FrameFile& reference, const PlanePair& planes,
                      std::vector<std::string>& notes) {
  note_other_camera(test, reference, notes);
  if (planes.test == "ao" || planes.test == "ao_raw") note_other_radius(test, reference, notes);
}

std::string frame_of_result(const FrameFile& test, const FrameFile& reference, const ReadOptions& options,
                            std::vector<std::string>& notes) {
  if (contains(test.common_planes(), "depth") || contains(reference.common_planes(), "depth")) return "";
  const std::string named = test.text_attribute(frame_attribute);
  const std::filesystem::path path = test.path().parent_path() / named;
  std::error_code unknown;
  if (named.empty() || !std::filesystem::is_regular_file(path, unknown)) return "";
  // Another frame of that name is most likely of another size.
  if (std::to_string(std::filesystem::file_size(path, unknown)) != test.text_attribute(frame_bytes_attribute))
    return "";
  try {
    const FrameFile frame(path, options_beside(options, path));
    const std::vector<std::string> views = frame.views();
    const bool has_views = std::all_of(test.views().begin(), test.views().end(),
                                       [&](const std::string& view) { return contains(views, view); });
    if (!has_views || !contains(frame.common_planes(), "depth") || frame.window() != test.window()) return "";
  } catch (const Error&) {
    return "";
  }
  notes.push_back(
      fmt::format("no depth in either file: the background is that of {}, which the test was made of; {} names another",
                  path.string(), option("frame", "FRAME.exr")));
  return path.string();
}

FrameFile background_file(const ComparedFiles& files, const ReadOptions& options) {
  FrameFile file(files.frame, options_beside(options, files.frame));
  if (!contains(file.common_planes(), "depth"))
    throw Error("{}: no depth to tell the background by; {}", files.frame, holdings(file));
  return file;
}

std::optional<Mask> mask_of(const ComparedFiles& files, const Frame& extra, const Side& test, const Side& reference,
                            const std::pair<std::string, std::string>& views, const Overlap& overlap,
                            const Rows& rows) {
  if (!files.frame.empty()) {
    const Window window = window_under(extra, files.frame, test.frame, overlap.window, overlap.layout);
    return foreground(extra, view_of(extra, views.first), {window, overlap.layout}, rows);
  }
  if (const auto mask = foreground(test.frame, views.first, overlap, rows)) return mask;
  return foreground(reference.frame, views.second, overlap, rows);
}

}  // namespace gloam::comparison
