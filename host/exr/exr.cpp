// FrameFile and write_frame, on top of the other files of this folder.
#include "gloam/exr.h"

#include <algorithm>
#include <set>
#include <utility>

#include "base/files.h"
#include "base/lists.h"
#include "exr/added_parts.h"
#include "exr/attributes.h"
#include "exr/conversion.h"
#include "exr/decode_planes.h"
#include "exr/depth.h"
#include "exr/errors.h"
#include "exr/file.h"
#include "exr/file_cameras.h"
#include "exr/memory.h"
#include "exr/position_cameras.h"
#include "exr/rows.h"
#include "exr/stream.h"
#include "exr/validation.h"
#include "exr/verify.h"
#include "exr/view_planes.h"
#include "exr/write.h"
#include "exr/written_header.h"
#include "gloam/error.h"
#include "gloam/option.h"
#include "gloam/planes.h"

namespace gloam {

namespace fs = std::filesystem;

namespace {

/// Planes that are converted with a camera, or dropped without one.
bool needs_camera(const std::string& plane) {
  return plane == "depth" || plane == "position" || plane_kind(plane).meaning == PlaneKind::unit_vector;
}

bool is_plane(const ExrFile& file, const std::string& name) {
  return std::any_of(file.names.planes.begin(), file.names.planes.end(),
                     [&](const PlaneSource& source) { return source.plane == name; });
}

}  // namespace

struct FrameFile::Impl {
  ExrFile file;
  FileCameras cameras;
  std::vector<std::string> camera_notes;  ///< notes on the file and on its cameras
  Conventions conventions;
  std::map<std::string, std::optional<NormalForm>> normal_forms;  ///< of the last survey
  NonfiniteCounts nonfinite;

  void find_cameras(const std::optional<EyeOfPair>& eye) {
    cameras = gloam::find_cameras(file, eye);
    camera_notes.insert(camera_notes.end(), cameras.notes.begin(), cameras.notes.end());
  }

  bool is_settled = false;  ///< positions have been looked at

  void settle() {
    if (std::exchange(is_settled, true) || !has_positions(file)) return;
    const size_t before = cameras.notes.size();
    settle_by_positions(file, cameras);
    camera_notes.insert(camera_notes.end(), cameras.notes.begin() + std::ptrdiff_t(before), cameras.notes.end());
  }

  /// Throws Error if a depth asked for was to be made from positions and cannot be.
  void settle_for(const std::vector<std::string>& planes) {
    if (std::none_of(planes.begin(), planes.end(), needs_camera)) return;
    const bool had_depth = is_plane(file, "depth");
    settle();
    if (!had_depth || !contains(planes, "depth") || is_plane(file, "depth") || file.options.only_looks) return;
    throw Error("{}: has no depth, and none can be made from its positions: {}; {} gives the camera",
                file.path.string(),
                cameras.why_not_fitted.empty() ? "none is one" : cameras.why_not_fitted.begin()->second,
                option("camera", "FILE"));
  }

  void decode(Frame& frame) {
    decode_planes(file, frame);
    if (file.options.count_nonfinite) add_nonfinite(file, frame, nonfinite);
  }
};

// --- Opening

FrameFile::FrameFile(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

FrameFile FrameFile::without_cameras(const fs::path& path, const ReadOptions& options) {
  check_clipping_flags(options);
  auto impl = std::make_unique<Impl>();
  impl->file = open_exr(path, options);
  impl->camera_notes = impl->file.notes;
  return FrameFile(std::move(impl));
}

FrameFile::FrameFile(const fs::path& path, const ReadOptions& options) : FrameFile(without_cameras(path, options)) {
  impl_->find_cameras({});
}

/// If the file lists several views but holds one picture, the picture is this eye's, not the first view's.
void FrameFile::become(const Eye& eye) {
  ExrFile& file = impl_->file;
  if (file.names.view_is_assumed && contains(file.headers.listed_views(), eye.name)) choose_view(file, eye.name);
  set_window(file, box_of(eye.window));
  impl_->find_cameras(EyeOfPair{eye.name, eye.other});
  if (!impl_->cameras.has_pose(views().front())) impl_->settle();
  if (impl_->cameras.has_pose(views().front())) return;
  const std::string& misfit = impl_->cameras.json_misfit;
  throw Error(
      "{}: has no camera with a pose{}, which each of two eyes needs; give {} with a pose for each of the views '{}' "
      "and '{}'",
      file.path.string(), misfit.empty() ? "" : fmt::format(" ({}: it is not used)", misfit), option("camera", "FILE"),
      eye.name, eye.other_name);
}

FrameFile::~FrameFile() = default;
FrameFile::FrameFile(FrameFile&&) noexcept = default;

// --- From the headers

const fs::path& FrameFile::path() const { return impl_->file.path; }
std::vector<fs::path> FrameFile::parts_in_files() const {
  std::vector<fs::path> files = {impl_->file.path};
  for (const auto& [plane, file] : impl_->file.options.plane_files) files.push_back(file);
  if (!impl_->file.options.calibration_file.empty()) files.push_back(impl_->file.options.calibration_file);
  return files;
}
Window FrameFile::display() const { return impl_->file.display; }
Window FrameFile::window() const { return impl_->file.window; }

Window FrameFile::data_window(const std::string& plane, const std::string& view) const {
  const PlaneSource* source = impl_->file.source(plane, view);
  if (!source || source->channels.empty()) return window();
  return window_of(box_of(impl_->file.headers.of_part(source->channels.front().part).dataWindow()));
}

const std::vector<std::string>& FrameFile::views() const { return impl_->file.names.views; }
bool FrameFile::view_is_assumed() const { return impl_->file.names.view_is_assumed; }
const std::vector<PlaneSource>& FrameFile::planes() const { return impl_->file.names.planes; }
const std::vector<std::string>& FrameFile::camera_notes() const { return impl_->camera_notes; }

std::vector<std::string> FrameFile::all_channels() const {
  std::vector<std::string> names;
  for (const FileChannel& channel : impl_->file.headers.channels()) names.push_back(channel.name);
  return names;
}

std::vector<std::string> FrameFile::common_planes() const { return gloam::common_planes(planes(), views()); }

std::string FrameFile::why_missing(const std::string& plane) const {
  return gloam::why_missing(planes(), views(), plane);
}

std::optional<Camera> FrameFile::camera(const std::string& view) const {
  const auto found = impl_->cameras.cameras.find(view);
  return found == impl_->cameras.cameras.end() ? std::nullopt : std::optional(found->second);
}

void FrameFile::fit_cameras() { impl_->settle(); }

std::optional<FrameFile::CameraResidual> FrameFile::camera_residual(const std::string& view) const {
  const auto found = impl_->cameras.positions.find(view);
  if (found == impl_->cameras.positions.end()) return {};
  return CameraResidual{found->second.median, found->second.percentile_99, found->second.is_fitted};
}

std::optional<double> FrameFile::number_attribute(const std::string& name) const {
  return impl_->file.headers.number(name);
}

std::string FrameFile::text_attribute(const std::string& name) const { return impl_->file.headers.text(name); }

std::string FrameFile::text_attribute_of_added(const std::string& content, const std::string& name) const {
  const Headers& headers = impl_->file.headers;
  for (int part = 0; part < headers.parts(); ++part)
    if (is_added_for(headers.of_part(part), content)) return headers.text_for_part(part, name);
  return "";
}

std::vector<std::pair<std::string, std::string>> FrameFile::attributes() const {
  return attribute_texts(impl_->file.headers);
}

// --- From the pixels

const FoundDepth& FrameFile::found_depth() const { return impl_->conventions.read_depth; }

std::string FrameFile::depth_convention() const {
  return impl_->conventions.depth.empty() ? declared_depth_convention(impl_->file) : impl_->conventions.depth;
}

std::string FrameFile::normal_space() const { return impl_->conventions.normal_space; }

const FoundNormals& FrameFile::found_normals() const { return impl_->conventions.normals; }

long long FrameFile::nonfinite(const std::string& plane, const std::string& view) const {
  const auto found = impl_->nonfinite.find({plane, view});
  return found == impl_->nonfinite.end() ? 0 : found->second;
}

void FrameFile::verify() {
  const ExrFile& file = impl_->file;
  std::set<std::pair<int, std::string>> decoded;
  for (const PlaneSource& plane : planes())
    for (const ChannelSource& channel : plane.channels) decoded.emplace(channel.part, channel.name);
  for (int part = 0; part < file.headers.parts(); ++part)
    if (!is_deep(file.headers.of_part(part)))
      check_plausible(file.path, file.headers.of_part(part), file.stream->size());
  guarded(file.path, [&] { decode_the_rest(file, decoded); });
}

// --- Reading

Frame FrameFile::read(const std::vector<std::string>& planes) {
  impl_->settle_for(planes);
  const ExrFile& file = impl_->file;
  Frame frame = allocate_planes(file, impl_->cameras, planes_to_decode(planes), file.window);
  impl_->nonfinite.clear();
  impl_->decode(frame);
  note_assumptions(file, impl_->cameras, planes, frame);
  if (!file.options.unconverted) convert_planes(file, impl_->cameras, frame, impl_->conventions);
  finish_frame(file, frame);
  keep_planes(frame, planes);
  return frame;
}

Frame FrameFile::survey(const std::vector<std::string>& planes) {
  impl_->settle_for(planes);
  const ExrFile& file = impl_->file;
  Frame whole = allocate_planes(file, impl_->cameras, planes_surveyed_whole(planes), file.window);
  impl_->nonfinite.clear();
  impl_->decode(whole);
  // Alpha is counted again with the rows.
  for (const std::string& view : views()) impl_->nonfinite.erase({"alpha", view});
  Survey survey = survey_planes(file, impl_->cameras, planes, std::move(whole));
  impl_->conventions.take(survey.conventions);
  impl_->normal_forms = std::move(survey.normal_forms);
  return std::move(survey.frame);
}

Frame FrameFile::read_rows(const std::vector<std::string>& planes, int first, int last) {
  Frame rows = decode_rows(impl_->file, impl_->cameras, planes_by_rows(planes), first, last);
  if (impl_->file.options.count_nonfinite) add_nonfinite(impl_->file, rows, impl_->nonfinite);
  convert_rows(impl_->file, impl_->cameras, impl_->normal_forms, rows);
  return rows;
}

int FrameFile::rows_at_once(const std::vector<std::string>& planes) const {
  return gloam::rows_at_once(impl_->file, planes_by_rows(planes));
}

// --- Memory

unsigned long long FrameFile::bytes_to_read(const std::vector<std::string>& planes) const {
  const std::vector<std::string> decoded = planes_to_decode(planes);
  return plane_bytes(impl_->file, decoded, window().height()) + decoder_bytes(impl_->file, decoded);
}

unsigned long long FrameFile::bytes_to_read_by_rows(const std::vector<std::string>& planes) const {
  const std::vector<std::string> whole = planes_surveyed_whole(planes);
  const auto whole_bytes = [&](const char* plane) {
    return contains(whole, plane) ? plane_bytes(impl_->file, {plane}, window().height()) : 0;
  };
  // Alpha is in memory as a whole only until the depth convention is known. Tiles need memory besides the rows cut from them.
  const uint64_t by_rows = 2 * plane_bytes(impl_->file, planes_by_rows(planes), rows_at_once(planes));
  return whole_bytes("depth") + std::max(by_rows, whole_bytes("alpha")) + decoder_bytes(impl_->file, planes);
}

// --- Writing

void check(const WriteOptions& options) { check_compression(options.compression); }

void write_frame(const fs::path& path, const Frame& frame, const WriteOptions& options) {
  check(options);
  use_all_threads();
  write_atomically(path, [&](NewFile& file) { write_exr(file, path.string(), frame, options); });
}

}  // namespace gloam
