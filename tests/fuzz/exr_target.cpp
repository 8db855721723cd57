// The EXR layer: any bytes are either a frame whose planes keep gloam's conventions, or refused in one line.
#include <OpenEXR/ImfThreading.h>

#include <cmath>
#include <functional>
#include <string_view>

#include "exr/stream.h"
#include "fuzz/cameras.h"
#include "fuzz/exr_damage.h"
#include "fuzz/exr_made.h"
#include "fuzz/memory_file.h"
#include "fuzz/promise.h"
#include "fuzz/target.h"
#include "fuzz/words.h"
#include "gloam/exr.h"
#include "gloam/planes.h"

namespace gloam::fuzz {
namespace {

/// Small enough to decode thousands of files in a second, large enough for files of several chunks.
constexpr long long most_pixels = 1 << 14;

/// With one thread: with several, chance would decide which one meets damage first, and what a fuzzer learns.
MemoryFile file_for_one_thread() {
  use_all_threads();
  Imf::setGlobalThreadCount(0);
  return {};
}

// --- Properties of a frame

using PixelCheck = std::function<bool(int x, int y)>;

void require_everywhere(const Layout& layout, const PixelCheck& holds, const char* what) {
  for (int y = 0; y < layout.height; ++y)
    for (int x = 0; x < layout.width; ++x) require(holds(x, y), what);
}

bool is_depth(float depth) { return depth >= 1e-30f; }

void check_normals(const Plane& normal) {
  require(normal.channels.size() == 3, "a normal has three components");
  const auto& n = normal.channels;
  const auto length = [&](int x, int y) {
    return std::hypot(double(n[0].at(x, y)), double(n[1].at(x, y)), double(n[2].at(x, y)));
  };
  require_everywhere(
      n[0].layout(), [&](int x, int y) { return length(x, y) == 0 || std::abs(length(x, y) - 1) < 1e-5; },
      "a normal is unit or zero");
}

void check_padding(const Plane& plane, float outside) {
  for (const Channel& channel : plane.channels) {
    const Layout& layout = channel.layout();
    for (int i = 0; i < Layout::guard; ++i) require(channel.data()[i] == outside, "the guard is outside");
    for (int y = 0; y < layout.height; ++y)
      for (int x = layout.width; x < layout.pitch; ++x) require(channel.at(x, y) == outside, "padding is outside");
  }
}

void check_plane(const std::string& name, const Plane& plane, bool as_stored) {
  const PlaneKind kind = plane_kind(name);
  require(plane.channels.size() == kind.components.size(), "a plane has the components of its kind");
  check_padding(plane, kind.outside);
  if (name == "depth")
    require_everywhere(
        plane.channels[0].layout(), [&](int x, int y) { return is_depth(plane.channels[0].at(x, y)); },
        "a depth is above 0 or infinite");
  if (name == "normal" && !as_stored) check_normals(plane);
}

void check_frame(const Frame& frame, const FrameFile& file, bool as_stored) {
  require(frame.window == file.window() && frame.display == file.display(), "windows are those of the file");
  require(!frame.views.empty(), "a frame has a view");
  for (const std::string& sentence : frame.assumed) require_one_line(sentence);
  for (const View& view : frame.views) {
    require(view.camera.has_value(), "a view has a camera");
    check_camera(*view.camera);
    for (const auto& [name, plane] : view.planes) check_plane(name, plane, as_stored);
  }
}

// --- Reading

std::vector<std::string> all_planes(const FrameFile& file) {
  std::vector<std::string> names = file.common_planes();
  for (const PlaneSource& plane : file.planes()) names.push_back(plane.plane);
  return names;
}

void ask_everything(const FrameFile& file) {
  for (const PlaneKind& kind : plane_kinds()) (void)file.why_missing(kind.name);
  for (const std::string& view : file.views())
    if (const auto camera = file.camera(view)) check_camera(*camera);
  (void)file.all_channels();
  (void)file.number_attribute("aoRadius");
  (void)file.text_attribute("gloamNormalSpace");
  (void)file.depth_convention();
  (void)file.view_is_assumed();
}

void read_everything(const std::string& path, const ReadOptions& options) {
  FrameFile file(path, options);
  ask_everything(file);
  const Frame frame = file.read(all_planes(file));
  check_frame(frame, file, options.as_stored);
  for (const View& view : frame.views) require(file.nonfinite("depth", view.name) >= 0, "a count is not below 0");
  file.verify();
}

ReadOptions plain_options() {
  ReadOptions options;
  options.most_pixels = most_pixels;
  return options;
}

/// Options that a user may give for the file.
ReadOptions other_options(Random& random) {
  ReadOptions options = plain_options();
  options.depth = random.pick({DepthConvention::automatic, DepthConvention::z, DepthConvention::ray,
                               DepthConvention::ndc, DepthConvention::reversed});
  options.normals.space = random.pick({NormalSpace::automatic, NormalSpace::view, NormalSpace::world});
  options.normals.range =
      random.pick({NormalRange::automatic, NormalRange::signed_values, NormalRange::unsigned_values});
  if (random.one_in(4)) options.normals.axes = random.pick({plain_axes, NormalAxes{1, -2, 3}, NormalAxes{-3, 1, 2}});
  options.count_nonfinite = random.one_in(2);
  options.as_stored = random.one_in(4);
  if (random.one_in(4)) options.fov_degrees = random.between(1, 179);
  if (random.one_in(2)) options.near = random.one_in(2) ? 0.1 : std::abs(odd_number(random));
  if (random.one_in(2)) options.far = random.one_in(2) ? 100 : std::abs(odd_number(random));
  if (random.one_in(4)) options.background = float(odd_number(random));
  if (random.one_in(8)) options.views = {random.pick(view_words())};
  if (random.one_in(8)) options.channels["depth"] = random.pick(channel_words());
  if (random.one_in(8)) options.channels["normal"] = random.pick(layer_words());
  return options;
}

}  // namespace

std::vector<std::string> seeds() {
  Random random(1);
  std::vector<std::string> files;
  for (int i = 0; i < 256; ++i) files.push_back(made_exr(random));
  return files;
}

}  // namespace gloam::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace gloam::fuzz;
  static MemoryFile file = file_for_one_thread();
  const std::string& path = file.hold(data, size);
  if (!reads(path, [&] { read_everything(path, plain_options()); })) return 0;
  // Some files are read again with flags, which depend on the bytes.
  gloam::Random random(std::hash<std::string_view>()({reinterpret_cast<const char*>(data), size}));
  if (!random.one_in(4)) return 0;
  reads("", [&] { read_everything(path, other_options(random)); });
  return 0;
}

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t most, unsigned seed) {
  using namespace gloam::fuzz;
  gloam::Random random(seed);
  return put(damaged_exr({reinterpret_cast<const char*>(data), size}, random), data, most);
}
