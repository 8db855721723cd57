#include "cli/compare/rows.h"

#include <algorithm>

#include "cli/flags/memory.h"
#include "gloam/error.h"
#include "gloam/planes.h"

namespace gloam::cli {
namespace {

/// Rows of the overlap in a frame's own coordinates.
Window window_of(const Frame& frame, const Overlap& overlap, const Rows& rows) {
  const Window& w = overlap.window == Window{} ? frame.window : overlap.window;
  return {w.x0, w.y0 + rows.first, w.x1, w.y0 + rows.last};
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

/// Counts the plane that comes first. A picture needs all rows at once, and copies of them; figures need some rows and those around
/// them.
unsigned long long bytes_of_comparison(const CompareFlags& flags, const ReadOptions& options, const FrameFile& test,
                                       const FrameFile& reference) {
  const PlanePair pair = comparable_planes(test, reference, flags.plane).front();
  const bool test_tells = contains(test.common_planes(), "depth");
  const auto planes = [](const std::string& plane, bool with_depth) {
    return with_depth ? std::vector<std::string>{plane, "depth"} : std::vector<std::string>{plane};
  };
  const auto tests = planes(pair.test, flags.frame.empty()),
             truths = planes(pair.reference, flags.frame.empty() && !test_tells);
  const Window window = test.window();
  const size_t components = plane_kind(pair.test).components.size();
  unsigned long long bytes = process_bytes + Comparison::bytes(window.width(), components);
  if (!flags.frame.empty())
    bytes += FrameFile(flags.frame, options_beside(options, flags.frame)).bytes_to_read({"depth"});
  if (flags.picture.empty()) {
    const int most_rows = std::max(test.rows_at_once({pair.test}), Comparison::step) + 2 * Comparison::reach();
    const unsigned long long rows = components * Layout(window.width(), most_rows).bytes();
    constexpr int copies = 4;  // of both sides' rows: as decoded, cut to the overlap, exposed, encoded
    return bytes + test.bytes_to_read_by_rows(tests) + reference.bytes_to_read_by_rows(truths) + 2 * copies * rows;
  }
  constexpr int copies = 3;  // of both sides' images, the difference and its picture included
  const unsigned long long image = components * Layout(window.width(), window.height()).bytes();
  return bytes + test.bytes_to_read(tests) + reference.bytes_to_read(truths) + 2 * copies * image;
}

}  // namespace gloam::cli
