#include "cli/compare/sides.h"

#include <algorithm>
#include <cmath>

#include "gloam/error.h"

namespace gloam::cli {
namespace {

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

/// "0.5" of "hbao+: radius=0.5 bias=0.1"; none where there is no radius.
std::optional<double> radius_in(const std::string& parameters) {
  const std::string key = " radius=";
  const size_t at = parameters.find(key);
  if (at == std::string::npos) return {};
  return std::strtod(parameters.c_str() + at + key.size(), nullptr);
}

/// Two radii, finite or not, as near as float and decimals keep them.
bool is_near(double a, double b) { return a == b || std::abs(a - b) <= 1e-3 * std::min(a, b); }

}  // namespace

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

double exposure_of(const CompareFlags& flags, const FrameFile& reference, const std::string& plane) {
  if (flags.exposure) return *flags.exposure;
  return plane == "reflection" ? reference.number_attribute("gloamExposure").value_or(0) : 0;
}

void note_other_camera(const FrameFile& test, const FrameFile& reference) {
  constexpr double tolerance = 1e-4;  // headers hold floats
  for (const std::string& view : test.views()) {
    if (!contains(reference.views(), view)) continue;
    const std::optional<Camera> a = test.camera(view), b = reference.camera(view);
    if (!a || !b || !a->pose || !b->pose) continue;
    const glm::dmat3 turn = a->pose->world_to_view - b->pose->world_to_view;
    const double turned = glm::length(turn[0]) + glm::length(turn[1]) + glm::length(turn[2]);
    const double moved = glm::distance(a->pose->position, b->pose->position);
    if (turned <= tolerance && moved <= tolerance * (1 + glm::length(b->pose->position))) continue;
    note({"by their headers, test and truth are seen by different cameras; are they of one frame?"});
    return;
  }
}

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

}  // namespace gloam::cli
