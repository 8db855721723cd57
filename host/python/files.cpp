// gloam.read and gloam.write
#include "python/files.h"

#include "base/files.h"
#include "base/lists.h"
#include "base/words.h"
#include "exr/holdings.h"
#include "gloam/color_holds.h"
#include "gloam/margin.h"
#include "gloam/planes.h"
#include "python/frames.h"
#include "python/interrupts.h"
#include "python/memory.h"
#include "python/requests.h"
#include "sequence/plan_files.h"

namespace gloam::python {
namespace {

/// Throws Error for a plane that the files do not hold.
void check_planes(const FrameFiles& files, const std::vector<std::string>& planes) {
  std::vector<std::string> held = files.common_planes();
  for (const std::string& plane : planes) {
    if (!contains(held, plane))
      throw Error("{}: no plane '{}'{}; {}", files.name(), plane, suggestion(plane, held), holdings(files));
  }
}

SharedFrame read(const std::vector<std::string>& paths, const py::dict& words, const std::vector<std::string>& planes) {
  const ReadOptions options = read_options(words);
  const std::optional<Camera> camera = given_camera(words);
  return without_lock([&](Interrupts&) {
    FrameFiles files(paths, options);
    check_planes(files, planes);
    return read_frame(files, planes.empty() ? files.common_planes() : planes, camera);
  });
}

SharedFrame read_for(const std::vector<std::string>& paths, const py::dict& words, const py::dict& request_words) {
  const ReadOptions options = read_options(words);
  const PlanRequest request = plan_request(request_words);
  const std::optional<Camera> camera = given_camera(words);
  return without_lock([&](Interrupts&) {
    FrameFiles files(paths, options);
    return read_planned(files, request, camera);
  });
}

/// Moves the planes of `more` into a copy of the frame that has only `carried` of its own planes.
Frame joined(const HeldFrame* frame, HeldFrame* more, const std::vector<std::string>& carried) {
  if (!more) return copy_of(frame->frame, common_planes(frame->frame));
  if (!frame) return std::move(more->frame);
  Frame joined = copy_of(frame->frame, carried);
  std::erase_if(joined.views, [&](const View& view) { return !contains(view_names(more->frame), view.name); });
  if (more->frame.width() != joined.width() || more->frame.height() != joined.height())
    throw Error("the planes are {} x {} pixels, and their frame is {} x {}; write them without the frame",
                more->frame.width(), more->frame.height(), joined.width(), joined.height());
  for (View& view : more->frame.views) {
    for (auto& [name, plane] : view.planes) joined.view(view.name).planes[name] = std::move(plane);
  }
  return joined;
}

/// `more`: planes that go into the file, besides those of the frame that are `carried`; none: all of the frame's planes do.
void write(const std::string& path, const HeldFrame* frame, HeldFrame* more, const std::vector<std::string>& carried,
           const std::map<std::string, std::string>& attributes, const std::map<std::string, double>& numbers,
           const std::string& compression, bool half, bool keeps_margin) {
  if (std::filesystem::path(path).extension() != ".exr")
    throw UsageError("write {}: a frame is an EXR file, or a picture of a plane; name it with .exr or .png", path);
  if (const std::string why = why_unwritable(path); !why.empty()) throw Error("{}: cannot be written, {}", path, why);
  const WriteOptions options{.half = half,
                             .compression = compression,
                             .half_planes = {},
                             .shows_result = more != nullptr,
                             .keeps_margin = keeps_margin};
  check(options);
  without_lock([&](Interrupts&) {
    Frame whole = joined(frame, more, carried);
    if (more) whole.attributes = attributes, whole.numbers = numbers;
    write_frame(path, whole, options);
    return true;
  });
}

/// Arrays, with a camera for each view if they have any.
void write_image(const std::string& path, HeldFrame& image, const std::optional<std::vector<Camera>>& cameras,
                 const std::string& compression, bool half) {
  for (size_t i = 0; cameras && i < cameras->size(); ++i) image.frame.views[i].camera = (*cameras)[i];
  write(path, &image, nullptr, {}, {}, {}, compression, half, true);
}

}  // namespace

SharedFrame read_frame(FrameFiles& files, const std::vector<std::string>& planes, const std::optional<Camera>& camera) {
  auto held = std::make_shared<HeldFrame>();
  held->name = files.name();
  std::vector<std::string> notes;
  unsigned long long bytes = 0;
  for (const FrameFile& file : files.files()) bytes += file.bytes_to_read(planes);
  check_memory(bytes, held->name, "read fewer planes (planes=[...]) or one view (views=[...])");
  held->frame = files.read(planes);
  take_camera(camera, held->frame);
  const FrameFile& first = files.files().front();
  if (const std::optional<double> radius = stated_radius(first, notes)) held->frame.numbers["aoRadius"] = *radius;
  for (const char* name : {"gloamExposure", "gloamStochasticRadius"}) {
    if (const std::optional<double> number = first.number_attribute(name)) held->frame.numbers[name] = *number;
  }
  for (const char* name : {"gloamScene", "gloamTechnique", "gloamParameters", "gloamRun", color_holds_attribute,
                           "gloamStochasticSurfaces"}) {
    if (const std::string text = first.text_attribute(name); !text.empty())
      held->frame.attributes[name] = on_one_line(text);
  }
  add_new(held->frame.assumed, notes);
  return held;
}

SharedFrame read_planned(FrameFiles& files, const PlanRequest& request, const std::optional<Camera>& camera) {
  std::vector<std::string> planes = plan_for_files(files, request).inputs;
  if (contains(files.common_planes(), "depth")) add_new(planes, "depth");
  return read_frame(files, planes, camera);
}

void add_files(py::module_& module) {
  module.def("read", &read);
  module.def("read_for", &read_for);
  module.def("write", &write);
  module.def("write_image", &write_image);
  module.def("notes_on_margin", [](const HeldFrame& held, bool is_kept) {
    return texts_of(notes_on_margin(held.frame, is_kept, is_kept));
  });
}

}  // namespace gloam::python
