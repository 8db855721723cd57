#include "cli/info/views.h"

#include <algorithm>

#include "compare/plane_pairs.h"
#include "gloam/error.h"
#include "gloam/visualise.h"

namespace gloam::cli {
namespace {

/// Throws the error of a --what that cannot be drawn.
[[noreturn]] void refuse(const FrameFile& file, const std::string& asked) {
  const std::vector<std::string> common = file.common_planes();
  const std::string path = file.path().string(), why = file.why_missing(asked);
  if (!why.empty()) throw Error("--what {}: {}: {}; draw views that have it (--views A,B)", asked, path, why);
  if (common.empty()) throw Error("--what {}: {}", asked, holdings(file));
  throw Error("--what {}: {} has no such plane{}; it has {}", asked, path, suggestion(asked, common),
              first_names(common));
}

/// The planes that could be drawn: the one asked for, else all that every view has, results before inputs.
std::vector<std::string> drawable_planes(const FrameFile& file, const std::string& asked) {
  const std::vector<std::string> common = file.common_planes();
  if (contains(common, asked)) return {asked};
  if (!asked.empty()) refuse(file, asked);
  std::vector<std::string> planes = results_among(common);
  for (const std::string& plane : inputs_among(common)) add_new(planes, plane);
  if (planes.empty())
    throw Error("{}: no plane that {}; {}", file.path().string(),
                file.planes().empty() ? "gloam knows" : "all its views have", holdings(file));
  return planes;
}

bool has(const Frame& frame, const std::string& plane) {
  return std::all_of(frame.views.begin(), frame.views.end(), [&](const View& view) { return view.find(plane); });
}

/// A frame with the plane to draw.
struct Drawing {
  Frame frame;
  std::string plane;
};

/// Reads the first plane that turns out to be usable.
Drawing read_drawing(FrameFile& file, const std::string& asked) {
  const bool has_depth = contains(file.common_planes(), "depth");
  Drawing drawing;
  for (const std::string& plane : drawable_planes(file, asked)) {
    std::vector<std::string> planes = {plane};
    if (has_depth) add_new(planes, "depth");
    drawing = {file.read(planes), plane};
    if (has(drawing.frame, plane)) return drawing;
  }
  throw Error("{}: '{}' cannot be drawn: {}", file.path().string(), drawing.plane,
              fmt::join(drawing.frame.assumed, "; "));
}

}  // namespace

void ViewPictureFlags::add_to(CLI::App& app) {
  const auto option = [&](const char* name, std::string& value, const char* help, const char* type) {
    add_text(app, name, value, type, help)->group("One plane of all views");
  };
  option("--sheet", sheet, "a plane of every view as small pictures; then nothing else is read or said", "VIEWS.png");
  option("--scan-line", scan_line,
         "a row of every view, one below the other: an epipolar image of cameras side by side", "LINE.png");
  add_number(app, "--row", row, {0, 65535}, "which row --scan-line shows, 0 on top; default: the middle", "N")
      ->group("One plane of all views");
  option("--what", what, "which plane; default: the first result, else color, else normal, else depth", "PLANE");
}

void ViewPictureFlags::check() const {
  check_picture_name(sheet, "--sheet");
  check_picture_name(scan_line, "--scan-line");
  if (row && scan_line.empty()) throw UsageError("--row {}: needs --scan-line LINE.png", *row);
  if (!what.empty() && !any()) throw UsageError("--what {}: needs --sheet VIEWS.png or --scan-line LINE.png", what);
}

std::vector<std::string> write_view_pictures(const std::string& path, const ViewPictureFlags& flags,
                                             const FrameFlags& frame_flags) {
  if (!flags.any()) return {};
  ReadOptions options = frame_flags.read_options();
  options.as_stored = true;
  FrameFile file(path, options);
  const int height = file.display().height();
  const int row = flags.row.value_or(height / 2);
  check_number(row, "--row", {0, height - 1});
  const Drawing drawing = read_drawing(file, flags.what);
  note(drawing.frame.assumed);
  const std::string title = file.path().filename().string();
  std::vector<std::string> written;
  if (!flags.sheet.empty()) {
    write_view_sheet(flags.sheet, drawing.frame, {title, drawing.plane});
    written.push_back(flags.sheet);
  }
  if (!flags.scan_line.empty()) {
    write_scan_lines(flags.scan_line, drawing.frame, {title, drawing.plane, row});
    written.push_back(flags.scan_line);
  }
  return written;
}

}  // namespace gloam::cli
