#include <OpenEXR/Iex.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfStringVectorAttribute.h>
#include <OpenEXR/ImfTiledInputPart.h>
#include <OpenEXR/ImfVecAttribute.h>
#include <OpenEXR/ImfVersion.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <utility>

#include "base/files.h"
#include "base/lists.h"
#include "camera/camera_json.h"
#include "camera/camera_search.h"
#include "camera/field_of_view.h"
#include "camera/matrices.h"
#include "exr/channel_names.h"
#include "exr/decode.h"
#include "exr/file.h"
#include "exr/stream.h"
#include "exr/validation.h"
#include "exr/verify.h"
#include "exr/view_planes.h"
#include "gloam/error.h"
#include "gloam/exr.h"
#include "gloam/light_field.h"
#include "gloam/planes.h"
#include "normalise/depth.h"
#include "normalise/normalise.h"
#include "normalise/normals.h"
#include "normalise/reflectance.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;

constexpr double assumed_fov = 60;
/// Width over height: beyond, a header's pixelAspectRatio is no statement about pixels.
constexpr float narrowest_pixel = 0.01f;

// --- Attributes
// -------------------------------------------------------------------------------------------------------

template <typename Attribute>
const Attribute* attribute(const Imf::Header& header, const std::string& name) {
  return header.findTypedAttribute<Attribute>(name);
}

std::optional<Imath::M44d> matrix(const Imf::Header& header, const std::string& name) {
  if (const auto* found = attribute<Imf::M44dAttribute>(header, name)) return found->value();
  if (const auto* found = attribute<Imf::M44fAttribute>(header, name)) return Imath::M44d(found->value());
  return {};
}

std::optional<double> number(const Imf::Header& header, const std::string& name) {
  if (const auto* found = attribute<Imf::FloatAttribute>(header, name)) return found->value();
  if (const auto* found = attribute<Imf::DoubleAttribute>(header, name)) return found->value();
  return {};
}

std::string text(const Imf::Header& header, const std::string& name) {
  const auto* found = attribute<Imf::StringAttribute>(header, name);
  return found ? found->value() : "";
}

glm::dvec3 origin_in(const Imf::Header& header, const std::string& prefix) {
  const auto* found = attribute<Imf::V3dAttribute>(header, prefix + "gloamOrigin");
  return found ? glm::dvec3(found->value().x, found->value().y, found->value().z) : glm::dvec3(0.0);
}

/// Near and far planes are trusted only where they can be planes.
void read_clipping(const Imf::Header& header, const std::string& prefix, Camera& camera,
                   std::vector<std::string>& notes) {
  const auto note = [&](const std::string& what) {
    const std::string sentence = fmt::format("camera: {} in the header cannot be and is not used", what);
    if (std::find(notes.begin(), notes.end(), sentence) == notes.end()) notes.push_back(sentence);
  };
  const auto usable = [&](const char* name) -> std::optional<double> {
    const std::optional<double> value = number(header, prefix + name);
    if (!value || *value > 0) return value;
    note(fmt::format("{}{} {:g}", prefix, name, *value));
    return {};
  };
  camera.near = usable("near");
  camera.far = usable("far");
  if (!camera.near || !camera.far || *camera.near < *camera.far) return;
  note(fmt::format("{}near {:g} with far {:g}", prefix, *camera.near, *camera.far));
  camera.near.reset();
  camera.far.reset();
}

bool says_unknown_pose(const Imf::Header& header, const std::string& prefix) {
  return text(header, prefix + "gloamPose") == "unknown";
}

std::optional<Pose> pose_in(const Imf::Header& header, const std::string& prefix) {
  const auto to_camera = matrix(header, prefix + "worldToCamera");
  if (!to_camera || says_unknown_pose(header, prefix)) return {};
  return pose_from_matrix(*to_camera, origin_in(header, prefix));
}

std::optional<Camera> camera_in(const Imf::Header& header, const std::string& prefix, const Window& display,
                                std::vector<std::string>& notes) {
  const auto to_camera = matrix(header, prefix + "worldToCamera"), to_ndc = matrix(header, prefix + "worldToNDC");
  if (!to_camera || !to_ndc) return {};
  Camera camera = camera_from_matrices(*to_camera, *to_ndc, display, origin_in(header, prefix), &notes);
  camera.source = printable(text(header, prefix + "gloamCamera"));
  if (camera.source.empty()) camera.source = "header";
  // gloam writes matrices for a camera whose place is unknown too; they must not come back as knowledge.
  if (says_unknown_pose(header, prefix)) camera.pose.reset();
  read_clipping(header, prefix, camera, notes);
  return camera;
}

// --- Decoding
// ---------------------------------------------------------------------------------------------------------

bool holds(const Channel& channel, float value) {
  for (int y = 0; y < channel.layout().height; ++y)
    if (const float* row = channel.row(y);
        std::find(row, row + channel.layout().width, value) != row + channel.layout().width)
      return true;
  return false;
}

bool all_background(const Channel& depth) {
  for (int y = 0; y < depth.layout().height; ++y)
    if (const float* row = depth.row(y); !std::all_of(row, row + depth.layout().width, is_background)) return false;
  return true;
}

void scale_image(Channel& channel, float scale) {
  for (int y = 0; y < channel.layout().height; ++y)
    for (float* p = channel.row(y); p != channel.row(y) + channel.layout().width; ++p) *p *= scale;
}

std::string type_name(Imf::PixelType type) {
  return type == Imf::HALF ? "half" : type == Imf::FLOAT ? "float" : "uint";
}

void append_new(std::vector<std::string>& list, const std::vector<std::string>& items) {
  for (const std::string& item : items)
    if (!contains(list, item)) list.push_back(item);
}

/// "the view left", "the views left and right"
std::string views_in_words(const std::vector<std::string>& views) {
  return (views.size() == 1 ? "the view " : "the views ") + enumerate(views);
}

/// What the cameras of a JSON are for, and what the frame has instead.
std::string misfit(const std::string& json, const std::map<std::string, Camera>& cameras, const std::string& frame,
                   const std::vector<std::string>& views) {
  std::vector<std::string> named;
  for (const auto& [view, camera] : cameras)
    if (!view.empty()) named.push_back(view);
  return fmt::format("{} has {}, and {} {}", json,
                     named.empty() ? "one camera, for no view by name" : views_in_words(named), frame,
                     views == std::vector<std::string>{""} ? "names none" : "has " + views_in_words(views));
}

void check_flags(const ReadOptions& options) {
  if (options.near && options.far && !(*options.near < *options.far))
    throw UsageError("--near {:g} --far {:g}: near must be less than far", *options.near, *options.far);
}

/// One of the two is from a flag, the other from the camera.
void check_clipping(const ReadOptions& options, const Camera& camera) {
  if (!camera.near || !camera.far || *camera.near < *camera.far || (!options.near && !options.far)) return;
  if (options.near)
    throw Error("--near {:g}: must be less than far, {:g} ({}); give --far as well", *camera.near, *camera.far,
                camera.source);
  throw Error("--far {:g}: must be more than near, {:g} ({}); give --near as well", *camera.far, *camera.near,
              camera.source);
}

}  // namespace

// --- FrameFile
// --------------------------------------------------------------------------------------------------------

void FrameFile::Impl::open() {
  stream = std::make_unique<ExrInput>(path);
  char magic[4] = {};
  if (stream->size() >= 4) stream->read(magic, 4);
  stream->seekg(0);
  if (std::memcmp(magic, "\x76\x2f\x31\x01", 4) != 0) throw Error("{}: is not an EXR file", path.string());
  use_all_threads();
  guarded(path, [&] {
    check_claims(path, *stream, options.most_pixels);
    file = std::make_unique<Imf::MultiPartInputFile>(*stream);
  });
  check_parts();
}

void FrameFile::Impl::check_parts() const {
  for (int part = 0; part < file->parts(); ++part) {
    const Imf::Header& header = file->header(part);
    if (header.hasType() && Imf::isDeepData(header.type()))
      throw Error("{}: is a deep EXR, with many samples per pixel; flatten it first", path.string());
    check_size(path, box_of(header.displayWindow()), "display", options.most_pixels);
    check_size(path, box_of(header.dataWindow()), "data", options.most_pixels);
  }
}

/// Which view a part belongs to. Names tell where no part has the attribute, and both eyes have parts: "left", "beauty_right".
void FrameFile::Impl::name_parts() {
  std::vector<std::string> eyes;
  bool is_said = !multi_view().empty();
  for (int part = 0; part < file->parts(); ++part) {
    const Imf::Header& header = file->header(part);
    is_said = is_said || header.hasView();
    part_views.push_back(header.hasView() ? header.view() : "");
    eyes.push_back(header.hasName() ? eye_in_name(header.name()) : "");
  }
  if (is_said || !contains(eyes, "left") || !contains(eyes, "right")) return;
  part_views = eyes;
  camera_notes.push_back("views: left and right are taken from the names of the parts");
}

std::vector<FileChannel> FrameFile::Impl::list_channels() const {
  std::vector<FileChannel> channels;
  for (int part = 0; part < file->parts(); ++part) {
    const Imf::Header& header = file->header(part);
    const std::string name = header.hasName() ? header.name() : "";
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c)
      channels.push_back({part, view_of_part(part), name, c.name(), type_name(c.channel().type)});
  }
  return channels;
}

std::vector<std::string> FrameFile::Impl::multi_view() const {
  for (int part = 0; part < file->parts(); ++part)
    if (Imf::hasMultiView(file->header(part))) return Imf::multiView(file->header(part));
  return {};
}

void FrameFile::Impl::find_planes() {
  name_parts();
  const std::vector<FileChannel> channels = list_channels();
  channel_names.clear();
  for (const FileChannel& channel : channels) channel_names.push_back(channel.name);
  named(path, [&] { names = name_planes(channels, multi_view(), {options.views, options.channels}); });
  // Mitsuba's depth is the length of the ray, whatever the user called it.
  if (any_text("generatedBy").find("Mitsuba") == std::string::npos) return;
  for (PlaneSource& plane : names.planes)
    if (plane.plane == "depth") plane.said = DeclaredConvention::ray_distance;
}

void FrameFile::Impl::find_window() {
  Box box = box_of(file->header(0).displayWindow());
  display = window_of(box);
  const float aspect = file->header(0).pixelAspectRatio();
  if (aspect >= narrowest_pixel && aspect <= 1 / narrowest_pixel)
    pixel_aspect = double(aspect);
  else
    camera_notes.push_back(fmt::format("camera: pixelAspectRatio {:g} in the header cannot be; 1 is taken", aspect));
  for (const PlaneSource& plane : names.planes)
    for (const ChannelSource& channel : plane.channels)
      box = united(box, box_of(file->header(channel.part).dataWindow()));
  set_window(box);
}

void FrameFile::Impl::set_window(const Box& box) {
  check_size(path, box, "display and data", options.most_pixels);
  // Rows are padded: a frame of one column takes sixteen.
  const Layout layout(int(box.x1 - box.x0), int(box.y1 - box.y0));
  if (layout.count() > size_t(std::numeric_limits<int>::max()))
    throw Error("{}: {} x {} pixels take {} x {} with their padding, more than 2^31", path.string(), layout.width,
                layout.height, layout.pitch, layout.height);
  window = window_of(box);
}

/// The header that speaks for a view: that of the first part of this view, else the first.
const Imf::Header& FrameFile::Impl::header_of(const std::string& view) const {
  for (int part = 0; part < file->parts(); ++part)
    if (!view.empty() && view_of_part(part) == view) return file->header(part);
  return file->header(0);
}

/// The first thing that `found(header, prefix)` returns for the headers and attribute prefixes that speak for a view.
template <typename Found>
auto FrameFile::Impl::in_headers(const std::string& view, const Found& found) const {
  using Result = decltype(found(file->header(0), ""));
  for (int part = 0; part < file->parts(); ++part) {
    const Imf::Header& header = file->header(part);
    if (!view.empty())
      if (Result result = found(header, view + ".")) return result;
    const std::string own = view_of_part(part);
    if (!own.empty() && own != view) continue;
    // Matrices without a view's name are those of the part's view, or of the default view.
    const std::vector<std::string> views = multi_view();
    if (own.empty() && !views.empty() && views.front() != view) continue;
    if (Result result = found(header, "")) return result;
  }
  return Result{};
}

/// Of the modules of the light-field display that the header describes.
const std::map<std::string, Camera>& FrameFile::Impl::display_cameras() {
  if (const std::string json = any_text("gloamDisplay"); modules.empty() && !json.empty()) {
    for (auto& [name, camera] : module_cameras(display_from_text(json, "attribute gloamDisplay"), display)) {
      camera.source = "header";
      modules.emplace(name, camera);
    }
  }
  return modules;
}

std::optional<Camera> FrameFile::Impl::header_camera(const std::string& view) {
  if (const auto module = display_cameras().find(view); module != modules.end()) return module->second;
  return in_headers(view, [&](const Imf::Header& header, const std::string& prefix) {
    return camera_in(header, prefix, display, camera_notes);
  });
}

/// For a header without a whole camera.
std::optional<Pose> FrameFile::Impl::header_pose(const std::string& view) {
  const std::optional<Pose> pose =
      in_headers(view, [&](const Imf::Header& header, const std::string& prefix) { return pose_in(header, prefix); });
  const bool projects = in_headers(view, [&](const Imf::Header& header, const std::string& prefix) {
    return matrix(header, prefix + "worldToNDC").has_value();
  });
  if (pose)
    append_new(camera_notes, {"camera: the header has worldToCamera and no worldToNDC: it tells the pose only"});
  else if (projects)
    append_new(camera_notes, {"camera: the header has worldToNDC and no worldToCamera: it is not used"});
  return pose;
}

std::map<std::string, Camera> FrameFile::Impl::json_cameras() {
  std::optional<fs::path> json = options.camera_file;
  if (json->empty()) json = find_camera_file(path, &camera_notes);
  if (!json) return {};
  json_name = json->filename().string();
  const std::optional<fs::path> others = eye && options.camera_file.empty() ? find_camera_file(eye->other) : json;
  std::error_code unknown;
  json_is_shared = eye && others && fs::equivalent(*others, *json, unknown);
  if (!options.camera_file.empty() && is_display_text(read_text(*json))) {
    const LightFieldDisplay of_file = read_display(*json);
    const auto of_modules = named(*json, [&] { return module_cameras(of_file, display); });
    return {of_modules.begin(), of_modules.end()};
  }
  return read_camera_file(*json, display, camera_notes);
}

/// Where the JSON has none for the view: Error if the user named the JSON, else a note.
std::optional<Camera> FrameFile::Impl::json_camera(const std::map<std::string, Camera>& from_json,
                                                   const std::string& view) {
  if (from_json.empty()) return {};
  const std::vector<std::string> wanted = eye ? std::vector<std::string>{eye->name} : names.views;
  if (const auto exact = from_json.find(eye ? eye->name : view); exact != from_json.end()) return exact->second;
  // A single camera serves a single view, under any name; two eyes do not share one.
  const auto single = from_json.find("");
  if (single != from_json.end() && wanted.size() == 1 && !json_is_shared) return single->second;
  const std::string why = misfit(json_name, from_json, path.filename().string(), wanted);
  if (!options.camera_file.empty())
    throw Error("{}; give a JSON with {}", why,
                wanted.front().empty() ? "one camera" : "a camera for each of the frame's views");
  json_misfit = why;
  append_new(camera_notes, {fmt::format("camera: {}: it is not used", why)});
  return {};
}

/// By header, else by JSON.
std::optional<Camera> FrameFile::Impl::known_camera(const std::string& view, std::optional<Pose>& pose) {
  std::optional<Camera> camera;
  if (options.camera_file.empty()) {
    // A flag is there to overrule what the file says, also where that is no camera.
    passing_over(options.fov_degrees || options.only_looks, [&] {
      named(path, [&] {
        guarded(path, [&] {
          camera = header_camera(view);
          if (!camera) pose = header_pose(view);
        });
      });
    });
  }
  if (!camera) {
    const bool is_asked_for = !options.camera_file.empty();
    passing_over(options.only_looks || (options.fov_degrees && !is_asked_for), [&] {
      if (!std::exchange(json_read, true)) from_json = json_cameras();
      camera = json_camera(from_json, view);
    });
  }
  if (camera && pose) camera->pose = pose;
  return camera;
}

/// Where it is allowed to, an Error of `find` becomes a note.
template <typename Find>
void FrameFile::Impl::passing_over(bool is_allowed, const Find& find) {
  try {
    find();
  } catch (const Error& error) {
    if (!is_allowed && options.camera_file.empty()) throw Error("{}; --fov or --camera tells another", error.what());
    if (!is_allowed) throw;
    const char* instead =
        options.fov_degrees ? "--fov takes its place" : "gloam run refuses it; --fov or --camera tell another";
    append_new(camera_notes, {fmt::format("camera: {}: not used; {}", error.what(), instead)});
  }
}

void FrameFile::Impl::find_cameras() {
  from_json.clear();
  json_read = false;
  for (const std::string& view : names.views) {
    std::optional<Pose> pose;
    std::optional<Camera> camera = known_camera(view, pose);
    if (options.fov_degrees) {
      Camera flagged = camera_from_fov(*options.fov_degrees, display, pixel_aspect, "--fov");
      flagged.pose = pose;
      if (camera) flagged.pose = camera->pose, flagged.near = camera->near, flagged.far = camera->far;
      camera = flagged;
    }
    if (!camera && pose) poses.emplace(view, *pose);
    if (!camera) continue;
    if (options.near) camera->near = options.near;
    if (options.far) camera->far = options.far;
    named(path, [&] { check_clipping(options, *camera); });
    cameras.emplace(view, *camera);
  }
}

const PlaneSource* FrameFile::Impl::source(const std::string& plane, const std::string& view) const {
  return find_source(names.planes, plane, view);
}

bool FrameFile::Impl::has(const std::string& plane, const std::string& view) const {
  return has_plane(names.planes, plane, view);
}

std::string FrameFile::Impl::any_text(const std::string& name) const {
  for (int part = 0; part < file->parts(); ++part)
    if (std::string value = text(file->header(part), name); !value.empty()) return value;
  return "";
}

bool FrameFile::Impl::any_attribute(const std::string& name) const {
  for (int part = 0; part < file->parts(); ++part)
    if (file->header(part).find(name.c_str()) != file->header(part).end()) return true;
  return false;
}

/// The planes asked for and, for the background of the normals, depth.
std::vector<std::string> FrameFile::Impl::needed(const std::vector<std::string>& planes) const {
  std::vector<std::string> all;
  append_new(all, planes);
  if (contains(all, "normal")) append_new(all, {"depth"});
  return all;
}

/// `rows`: as wide as the window.
Frame FrameFile::Impl::allocate(const std::vector<std::string>& planes, const Window& rows) const {
  Frame frame;
  frame.display = display;
  frame.window = rows;
  frame.pixel_aspect = pixel_aspect;
  const Layout layout(rows.width(), rows.height());
  for (const std::string& name : names.views) {
    View& view = frame.views.emplace_back();
    view.name = name;
    const auto camera = cameras.find(name);
    if (camera != cameras.end()) view.camera = camera->second;
    const Imf::Header& header = header_of(name);
    const bool prefixed = !name.empty() && attribute<Imf::V3dAttribute>(header, name + ".gloamOrigin");
    view.origin = origin_in(header, prefixed ? name + "." : "");
    for (const std::string& plane : planes) {
      if (!has(plane, name)) continue;
      Plane& to = view.planes[plane];
      to.name = plane;
      if (const PlaneSource* from = source(plane, name))
        for (size_t i = 0; i < from->channels.size(); ++i) to.channels.emplace_back(layout);
      else
        to.channels.emplace_back(layout, plane_kind(plane).outside);
    }
  }
  return frame;
}

void FrameFile::Impl::decode(Frame& frame) {
  std::map<int, PartDecoding> parts;
  for (View& view : frame.views)
    for (auto& [name, plane] : view.planes) {
      const PlaneSource* from = source(name, view.name);
      for (size_t i = 0; from && i < from->channels.size(); ++i) {
        Decoding& decoding = parts[from->channels[i].part][from->channels[i].name];
        decoding.targets.push_back(&plane.channels[i]);
        if (decoding.targets.size() == 1) decoding.outside = plane_kind(name).outside;
      }
    }
  for (auto& [number, decodings] : parts) {
    const int part = number;
    PartDecoding& decoding = decodings;
    named(path, [&] { check_sampling(file->header(part), decoding); });
    check_plausible(path, file->header(part), stream->size());
    guarded(path, [&] { decode_part(*file, part, decoding, frame.window); });
  }
  for (View& view : frame.views)
    for (auto& [name, plane] : view.planes) {
      const PlaneSource* from = source(name, view.name);
      for (size_t i = 0; from && i < from->channels.size(); ++i)
        if (from->channels[i].scale != 1) scale_image(plane.channels[i], from->channels[i].scale);
      for (size_t i = 0; from && options.count_nonfinite && !is_surveying && i < from->channels.size(); ++i)
        nonfinite[{name, view.name}] +=
            count_nonfinite(plane.channels[i], box_of(file->header(from->channels[i].part).dataWindow()), frame.window);
    }
}

/// Gives the view a camera where none is known, and says so where it matters.
void FrameFile::Impl::settle_camera(View& view, Frame& frame) const {
  if (view.camera) return;
  view.camera = camera_from_fov(assumed_fov, display, pixel_aspect, "assumed 60 degrees");
  view.camera->near = options.near;
  view.camera->far = options.far;
  const auto pose = poses.find(view.name);
  if (pose != poses.end()) view.camera->pose = pose->second;
  // Why a JSON or half a header was of no use is said by its own sentence.
  const char* none =
      !json_misfit.empty() || pose != poses.end() ? "" : "none by flag, header or a JSON beside the file; ";
  if (view.find("depth") || view.find("normal"))
    append_new(frame.assumed,
               {fmt::format("camera: {}a horizontal field of view of {:g} degrees is assumed (--fov, --camera)", none,
                            assumed_fov)});
}

void FrameFile::Impl::convert_depth(View& view, Frame& frame) {
  const auto depth = view.planes.find("depth");
  if (depth == view.planes.end()) return;
  ReadOptions as_named = options;
  const bool automatic = options.depth == DepthConvention::automatic;
  const bool known_planar =
      source("depth", view.name)->said == DeclaredConvention::planar || any_attribute("gloamOrigin");
  if (automatic && known_planar) as_named.depth = DepthConvention::z;
  if (automatic && source("depth", view.name)->said == DeclaredConvention::ray_distance) {
    as_named.depth = DepthConvention::ray;
    append_new(frame.assumed,
               {fmt::format("depth: '{}' is taken as the distance along the ray, as its renderer writes it (--depth z "
                            "says otherwise)",
                            source("depth", view.name)->channels.front().name)});
  }
  const Plane* alpha = view.find("alpha");
  std::vector<std::string> notes;
  if (options.background && holds(depth->second.channels.front(), *options.background)) background_seen = true;
  convention = named(path, [&] {
    return to_view_depth(depth->second.channels.front(), alpha ? &alpha->channels.front() : nullptr, window,
                         *view.camera, as_named, notes);
  });
  if (all_background(depth->second.channels.front()))
    notes.push_back(fmt::format("depth: no pixel{} has a usable depth; all of it is background",
                                view.name.empty() ? "" : " of view '" + view.name + "'"));
  append_new(frame.assumed, notes);
}

/// One picture of a file that lists several views is the eye's, not that of the first view.
void FrameFile::Impl::become(const Eye& as) {
  eye = as;
  if (names.view_is_assumed && contains(multi_view(), as.name)) {
    options.views = {as.name};
    guarded(path, [&] { find_planes(); });
  }
  set_window({as.window.x0, as.window.y0, as.window.x1, as.window.y1});
  find_cameras();
  const std::string& view = names.views.front();
  if (poses.contains(view) || (cameras.contains(view) && cameras.at(view).pose)) return;
  const std::string why = json_misfit.empty() ? "" : fmt::format(" ({}: it is not used)", json_misfit);
  throw Error(
      "{}: has no camera that tells where it stands{}, and two files are two eyes; give --camera FILE with a pose for "
      "each of the views '{}' and '{}'",
      path.string(), why, as.name, as.other_name);
}

/// What flags, the header and the names say about the space of the normals.
NormalSpace FrameFile::Impl::said_space(const PlaneSource& normal) const {
  if (options.normal_space != NormalSpace::automatic) return options.normal_space;
  const std::string written = any_text("gloamNormalSpace");
  if (written == "view") return NormalSpace::view;
  if (written == "world") return NormalSpace::world;
  if (normal.said == DeclaredConvention::view_space) return NormalSpace::view;
  if (normal.said == DeclaredConvention::world_space) return NormalSpace::world;
  return any_text("BlenderMultiChannel").empty() ? NormalSpace::automatic : NormalSpace::world;
}

/// What becomes of a view's normals: none where they are of no use. `count_missing`: pixels of the foreground without any, once
/// they are in that form.
std::optional<NormalForm> FrameFile::Impl::settle_normals(
    const View& view, const NormalSamples& samples, const std::function<long long(const NormalForm&)>& count_missing,
    Frame& frame) {
  const Plane* depth = view.find("depth");
  NormalForm form{said_space(*source("normal", view.name))};
  std::vector<std::string> notes;
  if (form.space == NormalSpace::automatic && depth) {
    form = named(path, [&] { return samples.form(depth->channels.front(), frame.window, *view.camera, notes); });
  } else if (form.space == NormalSpace::automatic) {
    form.space = NormalSpace::view;
    notes.push_back("normal: taken as view space, as there is no depth to tell it from (--normal-space)");
  }
  append_new(frame.assumed, notes);
  if (form.space == NormalSpace::world && !view.camera->pose) {
    append_new(frame.assumed, {"normals: not used, as where the camera stands is not known (--camera tells)"});
    return {};
  }
  space = form.space == NormalSpace::world ? "world" : "view";
  const long long missing = depth ? count_missing(form) : 0;
  if (missing > 0)
    append_new(frame.assumed,
               {fmt::format("normals: {} pixel{} of the foreground {} none (zero or not finite) and read{} open",
                            missing, missing == 1 ? "" : "s", missing == 1 ? "has" : "have", missing == 1 ? "s" : "")});
  return form;
}

void FrameFile::Impl::convert_normals(View& view, Frame& frame) {
  const auto found = view.planes.find("normal");
  if (found == view.planes.end()) return;
  Plane& normal = found->second;
  NormalSamples samples(normal.channels.front().layout());
  samples.take(normal, 0);
  bool is_brought = false;
  const auto bring = [&](const NormalForm& form) {
    if (!is_brought) bring_to_view_space(normal, form, *view.camera);
    is_brought = true;
  };
  const std::optional<NormalForm> form = settle_normals(
      view, samples,
      [&](const NormalForm& settled) {
        bring(settled);
        return count_missing_normals(normal, view.find("depth")->channels.front());
      },
      frame);
  if (form)
    bring(*form);
  else
    view.planes.erase(found);
}

/// Positions are the world's.
void FrameFile::Impl::judge_positions(View& view, Frame& frame) const {
  if (view.camera->pose || view.planes.erase("position") == 0) return;
  append_new(frame.assumed, {"positions: not used, as where the camera stands is not known (--camera tells)"});
}

/// Cycles' GlossCol is 1 where a Principled BSDF is no metal, whatever that reflects.
bool FrameFile::Impl::is_reflectance_in_doubt(const View& view) const {
  const PlaneSource* reflectance = source("reflectance", view.name);
  return reflectance && view.find("depth") && !options.channels.contains("reflectance") &&
         reflectance->channels.front().name.find("GlossCol") != std::string::npos;
}

/// `share`: of the surfaces where it is 1.
void FrameFile::Impl::note_reflectance(double share, Frame& frame) const {
  if (share < 0.5) return;
  append_new(
      frame.assumed,
      {fmt::format("reflectance: GlossCol is 1 on {:.0f} % of the surfaces, as a Principled BSDF writes it whatever "
                   "it reflects: reflections will be far too bright (--plane reflectance=none takes 0.04)",
                   100 * share)});
}

void FrameFile::Impl::judge_reflectance(View& view, Frame& frame) const {
  const Plane* reflectance = view.find("reflectance");
  if (!reflectance || !is_reflectance_in_doubt(view)) return;
  WhitePixels white;
  white.add(*reflectance, view.find("depth")->channels.front(), 0);
  note_reflectance(white.share(), frame);
}

/// What the names of planes leave to be said, and which views lack what is asked for.
void FrameFile::Impl::note_names(const std::vector<std::string>& asked, const std::vector<std::string>& decoded,
                                 Frame& frame) const {
  if (const auto general = names.assumed.find(""); general != names.assumed.end())
    append_new(frame.assumed, general->second);
  for (const std::string& plane : decoded)
    if (const auto notes = names.assumed.find(plane); notes != names.assumed.end())
      append_new(frame.assumed, notes->second);
  append_new(frame.assumed, unused_planes(names.planes, names.views, asked, "--view chooses one"));
  append_new(frame.assumed, camera_notes);
}

void FrameFile::Impl::note_unseen_background(Frame& frame) const {
  const bool has_depth = std::any_of(frame.views.begin(), frame.views.end(), [](View& v) { return v.find("depth"); });
  if (options.background && has_depth && !background_seen)
    append_new(frame.assumed, {fmt::format("depth: no pixel is {:.9g} (--background)", *options.background)});
}

FrameFile::FrameFile(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

FrameFile FrameFile::without_cameras(const fs::path& path, const ReadOptions& options) {
  auto impl = std::make_unique<Impl>();
  impl->path = path;
  impl->options = options;
  check_flags(options);
  impl->open();
  guarded(path, [&] {
    impl->find_planes();
    impl->find_window();
  });
  return FrameFile(std::move(impl));
}

FrameFile::FrameFile(const fs::path& path, const ReadOptions& options) : FrameFile(without_cameras(path, options)) {
  impl_->find_cameras();
}

void FrameFile::become(const Eye& eye) { impl_->become(eye); }

FrameFile::~FrameFile() = default;
FrameFile::FrameFile(FrameFile&&) noexcept = default;

const fs::path& FrameFile::path() const { return impl_->path; }
Window FrameFile::display() const { return impl_->display; }
Window FrameFile::window() const { return impl_->window; }
const std::vector<std::string>& FrameFile::views() const { return impl_->names.views; }
const std::vector<PlaneSource>& FrameFile::planes() const { return impl_->names.planes; }
std::vector<std::string> FrameFile::all_channels() const { return impl_->channel_names; }
std::optional<double> FrameFile::number_attribute(const std::string& name) const {
  for (int part = 0; part < impl_->file->parts(); ++part) {
    if (const auto value = number(impl_->file->header(part), name)) return value;
  }
  return {};
}
std::string FrameFile::text_attribute(const std::string& name) const { return impl_->any_text(name); }
std::string FrameFile::normal_space() const { return impl_->space; }
const std::vector<std::string>& FrameFile::camera_notes() const { return impl_->camera_notes; }

void FrameFile::verify() {
  std::set<std::pair<int, std::string>> decoded;
  for (const PlaneSource& plane : planes())
    for (const ChannelSource& channel : plane.channels) decoded.emplace(channel.part, channel.name);
  for (int part = 0; part < impl_->file->parts(); ++part)
    check_plausible(impl_->path, impl_->file->header(part), impl_->stream->size());
  guarded(impl_->path, [&] { decode_the_rest(*impl_->file, decoded); });
}

long long FrameFile::nonfinite(const std::string& plane, const std::string& view) const {
  const auto found = impl_->nonfinite.find({plane, view});
  return found == impl_->nonfinite.end() ? 0 : found->second;
}

std::vector<std::string> FrameFile::common_planes() const { return gloam::common_planes(planes(), views()); }

std::string FrameFile::why_missing(const std::string& plane) const {
  return gloam::why_missing(this->planes(), views(), plane);
}

bool FrameFile::view_is_assumed() const { return impl_->names.view_is_assumed; }

std::optional<Camera> FrameFile::camera(const std::string& view) const {
  const auto found = impl_->cameras.find(view);
  return found == impl_->cameras.end() ? std::nullopt : std::optional(found->second);
}

std::string FrameFile::depth_convention() const {
  if (!impl_->convention.empty()) return impl_->convention;
  const auto& all = planes();
  const auto depth = std::find_if(all.begin(), all.end(), [](const PlaneSource& p) { return p.plane == "depth"; });
  if (depth == all.end()) return "";
  switch (impl_->options.depth) {
    case DepthConvention::ray:
      return "ray";
    case DepthConvention::ndc:
      return "ndc";
    case DepthConvention::reversed:
      return "reversed";
    case DepthConvention::z:
      return "z";
    default:
      return depth->said == DeclaredConvention::ray_distance ? "ray" : "z";
  }
}

Frame FrameFile::read(const std::vector<std::string>& planes) {
  const std::vector<std::string> needed = impl_->needed(planes);
  Frame frame = guarded(impl_->path, [&] { return impl_->allocate(needed, impl_->window); });
  impl_->nonfinite.clear();
  impl_->decode(frame);
  impl_->note_names(planes, needed, frame);
  impl_->background_seen = false;
  for (View& view : frame.views) {
    impl_->settle_camera(view, frame);
    impl_->convert_depth(view, frame);
    impl_->convert_normals(view, frame);
    impl_->judge_reflectance(view, frame);
    if (!impl_->options.as_stored) impl_->judge_positions(view, frame);
  }
  impl_->note_unseen_background(frame);
  normalise_planes(frame, impl_->options.background, impl_->options.as_stored);
  for (View& view : frame.views)
    std::erase_if(view.planes, [&](const auto& plane) { return !contains(planes, plane.first); });
  for (std::string& sentence : frame.assumed) sentence = printable(sentence);
  return frame;
}

}  // namespace gloam
