// A frame: named planes of floats per view, one camera per view.
#pragma once

#include <cstddef>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gloam/camera.h"

namespace gloam {

/// Largest frame accepted, in pixels. A larger one is refused before memory is allocated: a file by its header.
inline constexpr long long max_pixels = 1LL << 28;

/// Pixel rectangle, ends exclusive. EXR coordinates: y down.
struct Window {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  bool operator==(const Window&) const = default;
};

/// Layout of a channel in memory, the same on the host and on the device.
///
/// `guard` floats, then `height` rows of `pitch` floats of which the first `width` are the image, then `guard` floats.
/// The pitch is a multiple of 16, so that kernels need no tail; the guard allows a row of lanes to be loaded up to `guard` pixels
/// outside the first and the last row.
struct Layout {
  static constexpr int guard = 64;
  int width = 0, height = 0, pitch = 0;
  Layout() = default;
  Layout(int width, int height) : width(width), height(height), pitch((width + 15) / 16 * 16) {}
  size_t count() const { return size_t(pitch) * size_t(height) + 2 * size_t(guard); }
  size_t bytes() const { return count() * sizeof(float); }
  size_t index(int x, int y) const { return size_t(guard) + size_t(y) * size_t(pitch) + size_t(x); }
  bool operator==(const Layout&) const = default;
};

/// Layout of every `scale`-th pixel of every `scale`-th row, beginning with the first.
Layout reduced(const Layout& layout, int scale);

/// One image of floats in the layout above, 4096-byte aligned so that a CPU device can use it in place. Move-only.
class Channel {
 public:
  Channel() = default;
  /// Memory is not initialised.
  explicit Channel(const Layout& layout);
  /// Fills everything, padding and guard included, with `value`.
  Channel(const Layout& layout, float value);
  Channel clone() const;

  const Layout& layout() const { return layout_; }
  float* data() { return data_.get(); }
  const float* data() const { return data_.get(); }
  float* row(int y) { return data_.get() + layout_.index(0, y); }
  const float* row(int y) const { return data_.get() + layout_.index(0, y); }
  float& at(int x, int y) { return data_[layout_.index(x, y)]; }
  float at(int x, int y) const { return data_[layout_.index(x, y)]; }
  /// Sets everything outside the image (row padding and guards) to `value`.
  void fill_padding(float value);

 private:
  struct Free {
    size_t bytes;
    Free() : bytes(0) {}
    explicit Free(size_t bytes) : bytes(bytes) {}
    void operator()(float* p) const;
  };
  Layout layout_;
  std::unique_ptr<float[], Free> data_;
};

/// A named plane: one channel per component, all of one layout.
struct Plane {
  std::string name;
  std::vector<Channel> channels;
  Plane clone() const;
};

/// One eye, one camera.
struct View {
  std::string name;  ///< "" when the file names none
  std::optional<Camera> camera;
  std::optional<Camera> camera_before;  ///< camera of the frame before in a sequence, for techniques with a history
  glm::dvec3 origin{0.0};               ///< origin of the plane `position` (gloamOrigin), in double
  std::optional<glm::dvec3> light;  ///< unit direction towards the scene's sun, in the world (gloamLight), where stated
  std::map<std::string, Plane> planes;
  const Plane* find(const std::string& plane) const;
};

/// Planes as kernels expect them: depth > 0 or +inf, normals unit (or zero where unknown) in view space.
struct Frame {
  Window display;  ///< the image of the camera
  Window window;   ///< the planes: the display window and any data outside it
  std::vector<View> views;
  double pixel_aspect = 1;                        ///< width of a pixel over its height (the file's pixelAspectRatio)
  std::map<std::string, std::string> attributes;  ///< text for the header: how the planes were made
  std::map<std::string, double> numbers;          ///< floats for the header: aoRadius ...
  std::vector<std::string> assumed;               ///< one sentence for each thing that neither file nor flag states

  int width() const { return window.width(); }
  int height() const { return window.height(); }
  View& view(const std::string& name);
  const View& view(const std::string& name) const;
};

/// Copies without planes: of a view its name, cameras and origin; of a frame its windows, texts and numbers, and such views.
View without_planes(const View& view);
Frame without_planes(const Frame& frame);

/// The planes that every view has, in order; none of a frame without views.
std::vector<std::string> common_planes(const Frame& frame);

/// Removes all other planes from every view.
void keep_planes(Frame& frame, const std::vector<std::string>& planes);

/// Throws Error for a frame that cannot be computed on: without views or pixels, with a view whose camera is missing or refused by
/// `check` (camera.h), with a plane whose channels have no memory or not the frame's size.
void check(const Frame& frame);

/// The depth of the background; everything else is a surface.
inline constexpr float infinity = std::numeric_limits<float>::infinity();
bool is_background(float depth);

}  // namespace gloam
