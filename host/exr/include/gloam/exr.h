// Reading and writing EXR. Opening reads headers only; `read` decodes only the planes asked for.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gloam/conventions.h"
#include "gloam/frame.h"

namespace gloam {

/// What the user states about a file; it overrides what would be found or assumed. Every field may stay empty.
struct ReadOptions {
  std::filesystem::path camera_file;  ///< --camera
  /// The text of a camera JSON at hand, such as one of a list of cameras; `camera_file` then only names it. Empty: the file is read.
  std::string camera_text;
  std::optional<double> fov_degrees;  ///< --fov: horizontal, 1 to 179
  std::string fov_from;               ///< what gave it, where the user did not: "matrix 'K'"
  /// A camera that cannot be used becomes a note instead of an error: for commands that only show a frame.
  bool only_looks = false;
  DepthConvention depth = DepthConvention::automatic;
  std::optional<double> near, far;  ///< --near, --far: for NDC and reversed depth, and the far plane as background
  std::optional<float> background;  ///< --background: depth that means background, instead of 1e10 and more
  std::optional<double> depth_scale,
      depth_offset;  ///< --depth-scale, --depth-offset: stored depth times the scale, plus the offset
  DepthBytes depth_bytes = DepthBytes::automatic;  ///< --depth-bytes
  std::optional<DepthEncoding> depth_encoding;     ///< --depth-encoding
  /// --plane-file: planes in files of their own, of any format that is read. With the frame's own path among them, that file is this plane
  /// and nothing else. A pattern gets the number in the frame's name.
  std::map<std::string, std::filesystem::path> plane_files;
  bool looks_beside = true;  ///< an EXR of one plane is read with the files that its writer puts beside it
  std::filesystem::path calibration_file;  ///< found beside the frame: what states the scale of its disparities
  NormalConvention normals;                ///< --normal-space, --normal-range, --normal-axes
  /// Of a frame of a shot: what was found of the normals for all of its frames (conventions.h), by the path of the frame's file: of two
  /// eyes each has its own. Called where normals are read and something of their convention is not stated; null: the frame's own decide.
  std::function<FoundNormals(const std::filesystem::path& file)> shot_normals;
  /// The same of the depth.
  std::function<FoundDepth(const std::filesystem::path& file)> shot_depth;
  std::vector<std::string> views;  ///< --view, --views: views to read, in this order; empty: all
  bool count_nonfinite = false;    ///< `read` counts NaN and infinite values of the file
  /// Keeps values as in the file: only depth and the space of normals are converted; nothing is clamped, replaced or made unit. For
  /// measuring, which must see what a technique wrote.
  bool as_stored = false;
  /// Converts nothing at all, depth and normals neither: what the file has, for a person to see. No plane is left out, and the
  /// background is not recognised. `survey` does not take it.
  bool unconverted = false;
  /// Largest frame accepted, in pixels; a power of two. Set it lower for files from untrusted sources, whose headers may overstate
  /// their size.
  long long most_pixels = max_pixels;
  /// --plane depth=Layer.Z: plane -> channel, channels (a,b,c), layer, or "none", which hides the plane.
  std::map<std::string, std::string> channels;

  StatedDepth stated_depth() const {
    return {depth, near, far, background, depth_scale, depth_offset, bool(shot_depth), depth_encoding};
  }
};

/// A channel of the file that holds one component of a plane.
struct ChannelSource {
  int part = 0;
  std::string name;  ///< full name in the file
  std::string type;  ///< "half", "float" or "uint"
  float scale = 1;   ///< factor to gloam's convention: -1 for the y of motion vectors that point up
};

/// The convention that a channel's name declares for its values.
/// `made_of_positions`: a depth whose channels are those of the positions, from which `read` makes it. `sum_of_layers`: the channels are those
/// of several layers, one layer after another, and `read` adds them; `sum_times_last`: and multiplies by the last layer.
enum class DeclaredConvention {
  nothing,
  planar,
  ray_distance,
  world_space,
  view_space,
  unsure_motion,
  made_of_positions,
  sum_of_layers,
  sum_times_last
};

/// A plane that can be decoded.
struct PlaneSource {
  std::string plane;  ///< "depth", "normal", ... (planes.h)
  std::string view;
  std::vector<ChannelSource> channels;
  DeclaredConvention said = DeclaredConvention::nothing;
};

/// An open EXR file: its contents, as far as the headers and a camera file beside it tell.
///
/// Throws UsageError if --near is not less than --far. Throws Error (one line, naming the file) for a file that is missing, not an
/// EXR, truncated, deep or larger than `most_pixels`; for an unknown view; for planes or views whose sizes cannot be reconciled;
/// for an unreadable or ambiguous camera file; for a `camera_file` without a camera for the file's views; for near not less than
/// far.
class FrameFile {
 public:
  FrameFile(const std::filesystem::path& path, const ReadOptions& options);
  ~FrameFile();
  FrameFile(FrameFile&&) noexcept;

  const std::filesystem::path& path() const;
  /// All files that its planes are made of: `path`, and those of planes in files of their own.
  std::vector<std::filesystem::path> parts_in_files() const;
  Window display() const;
  /// Union of the display window and all data windows that hold known planes.
  Window window() const;
  /// The pixels of `window` that the file has of a view's plane; elsewhere `read` gives the plane's value outside (planes.h). All of
  /// `window` for a layer beyond the end of a view's stack.
  Window data_window(const std::string& plane, const std::string& view) const;
  /// The selected views in the options' order; without a selection all, in file order; one empty name if the file names none.
  const std::vector<std::string>& views() const;
  /// Known planes of the selected views.
  const std::vector<PlaneSource>& planes() const;
  /// Names of the planes that every selected view has. If one view's stack (planes.h) has fewer layers than another's, its missing
  /// last layers count as present: they show nothing.
  std::vector<std::string> common_planes() const;
  /// Why `common_planes` lacks a plane that some view has: "view 'right' has no depth"; else empty.
  std::string why_missing(const std::string& plane) const;
  /// Whether the file lists several views but names none in its channels, and --view does not choose: it is read as the first.
  bool view_is_assumed() const;
  /// Notes on assumptions about cameras and views, a sentence each: part of the `Frame::assumed` of what is read.
  const std::vector<std::string>& camera_notes() const;
  /// All channels of the file, for messages.
  std::vector<std::string> all_channels() const;
  /// The camera of a view; none if flags, header and JSON give none, and none has been fitted to positions.
  std::optional<Camera> camera(const std::string& view) const;
  /// Fits cameras and poses that nothing else gives to the positions of the file, if it has any, and compares the others with them.
  /// Decodes a few rows, once. `read` and `survey` do so by themselves where they need cameras. Throws Error for a damaged file.
  void fit_cameras();
  /// Distance in the image of the positions from their pixels, in pixels.
  struct CameraResidual {
    double median = 0, percentile_99 = 0;
    bool is_fitted = false;  ///< the camera, or its pose, was fitted to the positions
  };
  /// None without positions or without a camera, and before cameras were compared with the positions.
  std::optional<CameraResidual> camera_residual(const std::string& view) const;
  /// A float or double attribute of the header ("aoRadius"); none if absent.
  std::optional<double> number_attribute(const std::string& name) const;
  /// A text attribute of the header ("aoDefinition"); empty if absent.
  std::string text_attribute(const std::string& name) const;
  /// The same of the first part that `write_copy` added for `content` (exr_copy.h); empty if there is none.
  std::string text_attribute_of_added(const std::string& content, const std::string& name) const;
  /// Names and values of all attributes of the headers, in words; those of further parts begin with the part's name.
  std::vector<std::pair<std::string, std::string>> attributes() const;

  /// Decodes the named planes of all selected views and brings them to gloam's conventions: depth to planar view-space z, scene
  /// units, with +inf background; normals to unit view space. A plane that a view lacks is skipped; a layer beyond the end of a
  /// view's stack is +inf everywhere. `depth` is decoded as well if a named plane needs it (it marks the background of normals).
  /// Without a known camera, assumes a horizontal field of view of 60 degrees and says so in `Frame::assumed`.
  Frame read(const std::vector<std::string>& planes);

  /// First step of reading a large frame a few rows at a time, for figures. Decodes the whole depth if these planes or the options
  /// need it, finds what only the whole image tells (the space of normals), and returns the frame with the depth alone and all
  /// assumptions. Needs `ReadOptions::as_stored`. Throws as `read` does.
  Frame survey(const std::vector<std::string>& planes);
  /// Rows [first, last) of the window, for `planes` that were surveyed, without the depth. The frame's window is these rows. Planes
  /// that turned out to be unusable are left out.
  Frame read_rows(const std::vector<std::string>& planes, int first, int last);
  /// Number of rows to ask for at once: no chunk of the file is decoded much more than once, and these planes take about 4 MiB, or
  /// more if one chunk does.
  int rows_at_once(const std::vector<std::string>& planes) const;

  /// Peak memory of `read`, bytes: the planes, and what decoding needs besides.
  unsigned long long bytes_to_read(const std::vector<std::string>& planes) const;
  /// Peak memory of `survey` and `read_rows` with `rows_at_once`, bytes.
  unsigned long long bytes_to_read_by_rows(const std::vector<std::string>& planes) const;

  /// Decodes the channels that belong to no plane as well, and drops them, so that damage anywhere in the file is found (`gloam
  /// info`). Throws as `read` does.
  void verify();

  /// Number of NaN and infinite values that `read` found in a plane inside the data window, before any repair; 0 unless
  /// `count_nonfinite`.
  long long nonfinite(const std::string& plane, const std::string& view) const;

  /// The depth convention in use: "z", "ray", "ndc", "reversed", "negative z"; empty without depth.
  std::string depth_convention() const;
  /// "view" or "world"; empty without normals, and before `read`.
  std::string normal_space() const;
  /// The convention of the normals of the first view that has any, and what was assumed; empty before `read`.
  const FoundNormals& found_normals() const;
  /// How the depth of the first view was read where nothing states it; empty before `read`.
  const FoundDepth& found_depth() const;

 private:
  friend class FrameFiles;
  /// The part of a one-view file in a frame of two eyes.
  struct Eye {
    std::string name, other_name;
    std::filesystem::path other;  ///< the other eye's file
    Window window;                ///< window of the frame's planes
  };
  struct Impl;
  explicit FrameFile(std::unique_ptr<Impl> impl);
  /// Opens views, planes and windows only: an eye's camera can be found once the eye has a name.
  static FrameFile without_cameras(const std::filesystem::path& path, const ReadOptions& options);
  /// Finds the camera of that eye. Throws Error if none with a pose is found.
  void become(const Eye& eye);
  std::unique_ptr<Impl> impl_;
};

/// Attributes of a result: the frame's file, a path from the result's folder, and its size.
inline constexpr const char* frame_attribute = "gloamFrame";
inline constexpr const char* frame_bytes_attribute = "gloamFrameBytes";

/// Options for writing a frame.
struct WriteOptions {
  bool half = false;                     ///< AO and other bounded planes as half; depth stays float
  std::string compression = "zip";       ///< one of `compressions`
  std::vector<std::string> half_planes;  ///< these as half too, whatever they hold
  bool shows_result =
      false;  ///< a result of one value is also luminance, Y, for programs that know no channel of gloam's
  /// The data window is that of the frame; else the part of it that the display window shows, without the margin (margin.h).
  bool keeps_margin = true;
};

/// Names of the lossless compressions that frames can be written with.
std::vector<std::string> compressions();

/// Throws UsageError if the options cannot be used; call it before computing anything.
void check(const WriteOptions& options);

/// Writes all planes of all views as one scanline EXR: gloam's channel names (planes.h); further views in OpenEXR's multi-view form
/// (`right.Z`, `N.right.X`, the `multiView` attribute); cameras as `worldToCamera`, `worldToNDC` and `gloamOrigin` (per further
/// view `<view>.worldToCamera` ...); normals marked by `gloamNormalSpace` = view. Written to a temporary file beside `path` and
/// then renamed, so that a failed or interrupted run leaves nothing half written. Throws Error naming the path if it cannot be
/// written.
void write_frame(const std::filesystem::path& path, const Frame& frame, const WriteOptions& options = {});

}  // namespace gloam
