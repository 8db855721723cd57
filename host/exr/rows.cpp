#include "exr/rows.h"

#ifdef _OPENMP
#include <omp.h>
#endif

#include <algorithm>

#include "base/lists.h"
#include "exr/assumed_camera.h"
#include "exr/conversion.h"
#include "exr/decode_planes.h"
#include "exr/depth.h"
#include "exr/fills.h"
#include "exr/memory.h"
#include "gloam/error.h"
#include "normalise/normalise.h"
#include "normalise/normals.h"

namespace gloam {
namespace {

/// While one lives, this thread works on rows alone. OpenEXR's threads decode the next ones meanwhile, and threads of OpenMP, which wait by
/// spinning, would take the cores from them: on busy cores a file took seven times as long.
class OneThread {
 public:
#ifdef _OPENMP
  OneThread() : before_(omp_get_max_threads()) { omp_set_num_threads(1); }
  ~OneThread() { omp_set_num_threads(before_); }
  OneThread(const OneThread&) = delete;

 private:
  int before_;
#else
  OneThread() {}
#endif
};

/// Sums over a view's rows.
struct ViewSums {
  ViewSums(const Layout& image, Fills to_count) : samples(image), fills(std::move(to_count)) {}
  NormalSamples samples;
  long long missing = 0, missing_where_encoded = 0;  ///< missing normals, taken as stored and taken as encoded
  Fills fills;
};

Plane decoded(const Plane& normal, const Camera& camera) {
  Plane out = normal.clone();
  bring_to_view_space(out, {.range = NormalRange::unsigned_values}, camera);
  return out;
}

void add_rows(ViewSums& sums, const View& rows, const View& whole, int first_row) {
  const Plane* depth = whole.find("depth");
  if (const Plane* normal = rows.find("normal")) {
    sums.samples.take(*normal, first_row);
    if (depth) {
      const Channel& z = depth->channels.front();
      sums.missing += count_missing_normals(*normal, z, first_row);
      sums.missing_where_encoded += count_missing_normals(decoded(*normal, *whole.camera), z, first_row);
    }
  }
  if (depth) sums.fills.add(rows, depth->channels.front(), first_row);
}

/// Planes that can be used only after a survey.
std::vector<std::string> planes_to_survey(const ExrFile& file, const Frame& frame,
                                          const std::vector<std::string>& asked) {
  std::vector<std::string> planes;
  if (contains(asked, "normal")) planes.push_back("normal");
  for (const View& view : frame.views) {
    if (!view.find("depth")) continue;
    for (const std::string& plane : Fills(file, view.name).planes())
      if (contains(asked, plane)) add_new(planes, plane);
  }
  for (const char* plane : {"color", "albedo"})
    if (contains(asked, plane)) planes.emplace_back(plane);
  return planes;
}

/// One entry per view of the frame. `light`: of all views.
std::vector<ViewSums> sums_of(const ExrFile& file, const FileCameras& cameras, const Frame& frame,
                              const std::vector<std::string>& planes, LightCounts& light) {
  const Layout image(file.window.width(), file.window.height());
  std::vector<ViewSums> sums;
  for (const View& view : frame.views) sums.emplace_back(image, Fills(file, view.name));
  const OneThread alone;
  const int step = rows_at_once(file, planes);
  for (int first = 0; !planes.empty() && first < image.height; first += step) {
    const Frame rows = decode_rows(file, cameras, planes, first, std::min(first + step, image.height));
    for (size_t i = 0; i < sums.size(); ++i) {
      add_rows(sums[i], rows.views[i], frame.views[i], first);
      light.add(rows.views[i], frame.views[i].find("depth"), first);
    }
  }
  return sums;
}

/// Converts the depth of all views. Returns whether any view has a pixel of the depth that --background names.
bool convert_depths(const ExrFile& file, const FileCameras& cameras, Survey& survey) {
  bool has_background = false;
  for (View& view : survey.frame.views) {
    assume_missing_camera(file, cameras, view, survey.frame);
    has_background |= has_named_background(file, view);
    survey.conventions.take(convert_depth(file, cameras, view, survey.frame, survey.conventions.read_depth));
    view.planes.erase("alpha");
  }
  return has_background;
}

void settle_normals(const ExrFile& file, const View& view, const ViewSums& sums, Survey& survey) {
  const auto count_missing = [&](const NormalForm& form) {
    return form.range == NormalRange::signed_values ? sums.missing : sums.missing_where_encoded;
  };
  const auto form = find_normal_form(file, view, sums.samples, count_missing, survey.frame, survey.conventions.normals);
  survey.normal_forms[view.name] = form;
  survey.conventions.take(form);
}

}  // namespace

std::vector<std::string> planes_surveyed_whole(const std::vector<std::string>& asked) {
  std::vector<std::string> planes;
  if (!contains(planes_to_decode(asked), "depth")) return planes;
  planes.push_back("depth");
  if (contains(asked, "alpha")) planes.push_back("alpha");
  return planes;
}

std::vector<std::string> planes_by_rows(const std::vector<std::string>& asked) {
  std::vector<std::string> planes = asked;
  std::erase(planes, "depth");
  return planes;
}

Frame decode_rows(const ExrFile& file, const FileCameras& cameras, const std::vector<std::string>& planes, int first,
                  int last) {
  const Window& all = file.window;
  Frame frame = allocate_planes(file, cameras, planes, {all.x0, all.y0 + first, all.x1, all.y0 + last});
  decode_planes(file, frame);
  return frame;
}

Survey survey_planes(const ExrFile& file, const FileCameras& cameras, const std::vector<std::string>& asked,
                     Frame frame) {
  Survey survey{std::move(frame), {}, {}};
  note_assumptions(file, cameras, asked, survey.frame);
  const bool has_background = convert_depths(file, cameras, survey);
  const std::vector<std::string> planes = planes_to_survey(file, survey.frame, asked);
  LightCounts light;
  const std::vector<ViewSums> sums = sums_of(file, cameras, survey.frame, planes, light);
  for (size_t i = 0; i < sums.size(); ++i) {
    const View& view = survey.frame.views[i];
    if (contains(planes, "normal") && file.source("normal", view.name)) settle_normals(file, view, sums[i], survey);
    sums[i].fills.note(survey.frame);
  }
  if (!has_background) note_missing_background(file, survey.frame);
  note_light(file, light, survey.frame);
  finish_frame(file, survey.frame);
  return survey;
}

void convert_rows(const ExrFile& file, const FileCameras& cameras,
                  const std::map<std::string, std::optional<NormalForm>>& normal_forms, Frame& rows) {
  const OneThread alone;
  for (View& view : rows.views) {
    assume_missing_camera(file, cameras, view, rows);
    const auto normal = view.planes.find("normal");
    if (normal == view.planes.end()) continue;
    const std::optional<NormalForm>& form = normal_forms.at(view.name);
    if (form)
      bring_to_view_space(normal->second, *form, *view.camera);
    else
      view.planes.erase(normal);
  }
  normalise_planes(rows, file.options.background, file.options.as_stored);
}

}  // namespace gloam
