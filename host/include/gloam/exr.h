// EXR in and out. Opening reads headers only; `read` decodes the planes asked for and nothing else.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gloam/frame.h"

namespace gloam {

/// Largest frame accepted, in pixels: a header that claims more is refused before anything is allocated.
inline constexpr long long max_pixels = 1LL << 28;

enum class DepthConvention { automatic, z, ray, ndc, reversed };
enum class NormalSpace { automatic, view, world };

/// What the user says about the file, instead of what would be found or assumed. Every field may stay empty.
struct ReadOptions {
  std::filesystem::path camera_file;  ///< --camera
  std::optional<double> fov_degrees;  ///< --fov: horizontal, 1 to 179
  /// A camera that cannot be used becomes a note, and none is known: for commands that only look at a frame.
  bool only_looks = false;
  DepthConvention depth = DepthConvention::automatic;
  std::optional<double> near, far;  ///< --near, --far: for NDC and reversed depth, and the far plane as background
  std::optional<float> background;  ///< --background: the value that means background, instead of 1e10 and more
  NormalSpace normal_space = NormalSpace::automatic;
  std::vector<std::string> views;  ///< --view, --views: these, in this order; empty = all
  bool count_nonfinite = false;    ///< have `read` count NaN and infinite values as they stand in the file
  /// Values as they stand in the file: only depth is converted, and the space of normals; nothing is clamped, replaced
  /// or made unit. For measuring, which must see what a technique wrote.
  bool as_stored = false;
  /// Frames of more are refused; a power of two. Who reads many files that may lie about their size sets less.
  long long most_pixels = max_pixels;
  /// --plane depth=Layer.Z: plane -> channel, channels (a,b,c), layer, or "none": as if the file did not have the plane.
  std::map<std::string, std::string> channels;
};

/// One channel of the file that serves as one component of a plane.
struct ChannelSource {
  int part = 0;
  std::string name;  ///< full name in the file
  std::string type;  ///< "half", "float" or "uint"
  float scale = 1;   ///< what brings a value to gloam's meaning: -1 for the y of motion vectors that point up
};

/// What a channel's name declares about its values.
enum class DeclaredConvention { nothing, planar, ray_distance, world_space, view_space, unsure_motion };

/// A plane that could be decoded.
struct PlaneSource {
  std::string plane;  ///< "depth", "normal", ... (planes.h)
  std::string view;
  std::vector<ChannelSource> channels;
  DeclaredConvention said = DeclaredConvention::nothing;
};

/// An open EXR file: what it holds, as far as headers and the camera file beside it tell.
///
/// Throws UsageError for --near that is not less than --far, and Error (one line, naming the file) for: missing, not an EXR, truncated, deep, more than `most_pixels`, unknown
/// view, planes or views of different size that cannot be brought together, unreadable or ambiguous camera file, a `camera_file`
/// that has no camera for the file's views, near that is not less than far.
class FrameFile {
 public:
  FrameFile(const std::filesystem::path& path, const ReadOptions& options);
  ~FrameFile();
  FrameFile(FrameFile&&) noexcept;

  const std::filesystem::path& path() const;
  Window display() const;
  /// Union of the display window and all data windows that hold known planes.
  Window window() const;
  /// The views that the options select, in their order; else all, in file order; one empty name where the file names none.
  const std::vector<std::string>& views() const;
  /// Known planes of the selected views.
  const std::vector<PlaneSource>& planes() const;
  /// Names of the planes that every selected view has. Where one view's stack (planes.h) has fewer layers than
  /// another's, the layers that it lacks at the end count as there: nothing is seen in them.
  std::vector<std::string> common_planes() const;
  /// Why a plane is not among these although some view has it: "view 'right' has no depth"; else empty.
  std::string why_missing(const std::string& plane) const;
  /// The file lists several views, names none in its channels, and is read as the first as --view does not say which.
  bool view_is_assumed() const;
  /// What the headers and the camera file leave to be assumed or said of cameras and views, a sentence each: part of
  /// `Frame::assumed` of what is read.
  const std::vector<std::string>& camera_notes() const;
  /// Every channel of the file, for messages about what it does hold.
  std::vector<std::string> all_channels() const;
  /// The camera of a view; none when neither flags, header nor a JSON give one.
  std::optional<Camera> camera(const std::string& view) const;
  /// A float or double attribute of the header ("aoRadius"); none when absent.
  std::optional<double> number_attribute(const std::string& name) const;
  /// A text attribute of the header ("aoDefinition"); empty when absent.
  std::string text_attribute(const std::string& name) const;

  /// Decodes the named planes of all selected views (a plane that a view lacks is skipped; a layer beyond the end of a
  /// view's stack is +inf everywhere) and brings them to gloam's
  /// conventions: depth to planar view-space z with +inf background, normals to unit view space. `depth` is decoded
  /// too where a named plane needs it (background of the normals is found by depth), never anything else.
  /// Where no camera is known, assumes a horizontal field of view of 60 degrees and says so in `Frame::assumed`.
  Frame read(const std::vector<std::string>& planes);

  /// For figures of frames that are large: the same as `read`, a few rows at a time. The first step decodes the depth whole
  /// where these planes or the options need it, looks through what only the whole image tells (the space of normals), and returns
  /// the frame with the depth alone and all that was assumed. Needs `ReadOptions::as_stored`. Throws as `read` does.
  Frame survey(const std::vector<std::string>& planes);
  /// Rows [first, last) of the window: `planes` of those that were surveyed, without the depth. The frame's window is these
  /// rows. A plane that turned out to be of no use is not there.
  Frame read_rows(const std::vector<std::string>& planes, int first, int last);
  /// How many rows to ask for, so that no chunk of the file is decoded much more than once and all of these planes take some
  /// 4 MiB; more where that is in one chunk.
  int rows_at_once(const std::vector<std::string>& planes) const;

  /// Memory that `read` takes at its peak: the planes, and what decoding them holds beside.
  unsigned long long bytes_to_read(const std::vector<std::string>& planes) const;
  /// The same of `survey` and `read_rows` with `rows_at_once`.
  unsigned long long bytes_to_read_by_rows(const std::vector<std::string>& planes) const;

  /// Decodes the channels that serve as no plane too, and drops them, so that damage anywhere in the file is found. For
  /// looking at a file (`gloam info`), not for work on it. Throws as `read` does.
  void verify();

  /// NaN and infinite values that `read` found in a plane, inside the data window, before anything was repaired; 0 unless `count_nonfinite`.
  long long nonfinite(const std::string& plane, const std::string& view) const;

  /// How the depth will be or was understood: "z", "ray", "ndc", "reversed", "negative z"; empty without depth.
  std::string depth_convention() const;
  /// "view" or "world"; empty without normals or before `read`.
  std::string normal_space() const;

 private:
  friend class FrameFiles;
  /// What a file of one view is in a frame of two.
  struct Eye {
    std::string name, other_name;
    std::filesystem::path other;  ///< the other eye's file
    Window window;                ///< that the frame's planes cover
  };
  struct Impl;
  explicit FrameFile(std::unique_ptr<Impl> impl);
  /// Open as far as views, planes and windows go: which camera is an eye's is known when its name is.
  static FrameFile without_cameras(const std::filesystem::path& path, const ReadOptions& options);
  /// Finds the camera of that eye. Throws Error where none with a pose is found.
  void become(const Eye& eye);
  std::unique_ptr<Impl> impl_;
};

/// How a frame is written.
struct WriteOptions {
  bool half = false;                ///< AO and other bounded planes as half; depth stays float
  std::string compression = "zip";  ///< one of `compressions`
};

/// Names of the lossless ones that frames can be written with.
std::vector<std::string> compressions();

/// Throws UsageError when the options cannot be used, before anything is computed.
void check(const WriteOptions& options);

/// Writes all planes of all views as one scanline EXR: gloam's channel names (planes.h), further views in OpenEXR's
/// multi-view form (`right.Z`, `N.right.X`, the `multiView` attribute), cameras as `worldToCamera`, `worldToNDC` and
/// `gloamOrigin` (per further view
/// `<view>.worldToCamera` ...), normals marked by `gloamNormalSpace` = view. Written to a temporary file beside `path`
/// and renamed, so that a failed or interrupted run leaves nothing half written.
/// Throws Error naming the path when it cannot be written.
void write_frame(const std::filesystem::path& path, const Frame& frame, const WriteOptions& options = {});

}  // namespace gloam
