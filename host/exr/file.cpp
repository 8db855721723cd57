#include "exr/file.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "exr/depth_of_positions.h"
#include "exr/errors.h"
#include "exr/opened.h"
#include "exr/other_images.h"
#include "exr/validation.h"
#include "exr/view_planes.h"
#include "gloam/error.h"
#include "gloam/option.h"
#include "image/image_values.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;

/// Least width over height, and height over width, of a pixel: beyond, pixelAspectRatio is ignored as meaningless.
constexpr float narrowest_pixel = 0.01f;

void open_parts(ExrFile& file) {
  std::unique_ptr<ExrInput> stream = open_input(file.path, file.options, file.notes);
  if (!stream->has_magic())
    throw Error("{}: is not an EXR file, nor ends as an image of another format that is read: {}", file.path.string(),
                image_formats());
  use_all_threads();
  OpenedExr opened =
      guarded(file.path, [&] { return open_parts(std::move(stream), file.path, file.options.most_pixels); });
  file.end_of_headers = opened.end_of_headers;
  file.stream = std::move(opened.stream);
  file.parts = std::move(opened.parts);
  check_parts(file.path, *file.parts, file.options.most_pixels);
}

void note_deep_parts(ExrFile& file) {
  for (int part = 0; part < file.headers.parts(); ++part) {
    const Imf::Header& header = file.headers.of_part(part);
    if (!is_deep(header)) continue;
    file.notes.push_back(
        fmt::format("part '{}' is deep, with many samples per pixel, and is left out; flatten it to use it",
                    header.hasName() ? header.name() : std::to_string(part)));
  }
}

void find_planes(ExrFile& file) {
  named(file.path, [&] {
    file.names =
        name_planes(file.headers.channels(), file.headers.listed_views(), {file.options.views, file.options.channels});
  });
  add_depth_of_positions(file);
  // Mitsuba's depth is the length of the ray, whatever name the user gave the channel.
  if (file.options.plane_files.contains("depth")) return;
  if (file.headers.text("generatedBy").find("Mitsuba") == std::string::npos) return;
  for (PlaneSource& plane : file.names.planes)
    if (plane.plane == "depth" && plane.said != DeclaredConvention::made_of_positions)
      plane.said = DeclaredConvention::ray_distance;
}

/// A plane that the user chooses for one view and another view lacks: what all views have would be taken in its place, unsaid.
void check_chosen_planes(ExrFile& file) {
  for (const auto& [plane, channels] : file.options.channels) {
    const std::string why = why_missing(file.names.planes, file.names.views, plane);
    if (why.empty()) continue;
    const auto has_it = [&, &plane = plane](const std::string& view) { return file.has(plane, view); };
    const std::string own = *std::find_if(file.names.views.begin(), file.names.views.end(), has_it);
    const std::string sentence =
        fmt::format("{}: is of view '{}' alone, and {}; {} reads that view, or a choice for all views",
                    channels_option(plane, channels), own, why, option("view", own));
    if (!file.options.only_looks) throw Error("{}: {}", file.path.string(), sentence);
    file.notes.push_back(sentence);
  }
}

void find_pixel_aspect(ExrFile& file) {
  const float aspect = file.headers.of_part(0).pixelAspectRatio();
  if (aspect >= narrowest_pixel && aspect <= 1 / narrowest_pixel)
    file.pixel_aspect = double(aspect);
  else
    file.notes.push_back(fmt::format("camera: pixelAspectRatio {:g} in the header is impossible; 1 is used", aspect));
}

void find_windows(ExrFile& file) {
  Box box = box_of(file.headers.of_part(0).displayWindow());
  file.display = window_of(box);
  for (const PlaneSource& plane : file.names.planes)
    for (const ChannelSource& channel : plane.channels)
      box = united(box, box_of(file.headers.of_part(channel.part).dataWindow()));
  set_window(file, box);
}

}  // namespace

const PlaneSource* ExrFile::source(const std::string& plane, const std::string& view) const {
  return find_source(names.planes, plane, view);
}

bool ExrFile::has(const std::string& plane, const std::string& view) const {
  return has_plane(names.planes, plane, view);
}

ExrFile open_exr(const fs::path& path, const ReadOptions& options) {
  ExrFile file;
  file.path = path;
  file.options = options;
  open_parts(file);
  guarded(path, [&] {
    file.headers = Headers(*file.parts);
    if (file.headers.has_views_by_part_names())
      file.notes.push_back("views: left and right are taken from the names of the parts");
    note_deep_parts(file);
    find_planes(file);
    check_chosen_planes(file);
    find_pixel_aspect(file);
    find_windows(file);
  });
  return file;
}

void choose_view(ExrFile& file, const std::string& view) {
  file.options.views = {view};
  guarded(file.path, [&] { find_planes(file); });
}

void set_window(ExrFile& file, const Box& window) {
  check_size(file.path, window, "display and data", file.options.most_pixels);
  // Rows are padded: a frame of one column takes the memory of sixteen.
  const Layout layout(int(window.x1 - window.x0), int(window.y1 - window.y0));
  if (layout.count() > size_t(std::numeric_limits<int>::max()))
    throw Error("{}: {} x {} pixels take {} x {} with their padding, more than 2^31", file.path.string(), layout.width,
                layout.height, layout.pitch, layout.height);
  file.window = window_of(window);
}

}  // namespace gloam
