// The flags of gloam capture, its shots and its figures: shared by the files of the command.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/flags/options.h"
#include "cli/flags/scene_flags.h"
#include "gloam/scene/capture.h"
#include "sequence/frame_list.h"

namespace gloam::cli {

struct CaptureCommand {
  std::string out, planes, path, shot, picture, sky, compression = "zip";
  std::string display, modules;
  std::optional<Size> size;
  std::optional<Overscan> overscan;
  int peel = 0;
  bool peel_light = false;
  std::optional<int> stochastic, stochastic_seed;
  std::optional<StochasticSurfaces> stochastic_surfaces;
  std::optional<StochasticSubset> stochastic_subset;
  std::optional<double> alpha, stochastic_radius, stochastic_reach, view2, stereo, convergence, outlines, outline_angle;
  std::optional<OutlineMethod> outline_method;
  bool half = false, toe_in = false, separate = false;
  FrameChoice choice;  ///< frames of the path or the shot
  SceneFlags scene;
  SceneCameraFlags camera;
  JsonFlag json;
  /// The flag that moves the camera; empty for one frame.
  std::string moving() const { return !path.empty() ? "--camera-path" : !shot.empty() ? "--shot" : ""; }
};

/// One moment: the views to capture, and the files to write.
struct CaptureShot {
  std::string file, picture;
  std::vector<CaptureView> views;
  int frame = 1;  ///< of a path
};

/// Number of surfaces under the pixels that show any.
struct LayerCount {
  long long pixels = 0, surfaces = 0;
  int most = 0;
  void add(const Frame& frame) {
    for (const View& view : frame.views) {
      const Plane* count = view.find("peel_count");
      if (!count) continue;
      for (int y = 0; y < frame.height(); ++y) {
        for (int x = 0; x < frame.width(); ++x) {
          const int n = int(count->channels[0].at(x, y));
          pixels += n > 0;
          surfaces += n;
          most = std::max(most, n);
        }
      }
    }
  }
  double mean() const { return pixels == 0 ? 0 : double(surfaces) / double(pixels); }
};

struct CaptureFigures {
  size_t faces = 0, meshes = 0;
  double load = 0, build = 0, trace = 0, stochastic = 0, outlines = 0, write = 0;
  long long rays = 0;
  LayerCount layers;
  std::string camera;                    ///< source of the first view's camera
  long long surfaces = 0;                ///< pixels that show a surface
  std::optional<VisibleDepths> visible;  ///< depths in the second view
  std::optional<Camera> second;          ///< camera of the second view
  double shift = 0;                      ///< shift of each eye's principal point, pixels
  std::optional<double> ao_radius;       ///< that suits the scene, else the first frame; none: no surface is visible
  std::vector<std::string> files;
};

Json capture_document(const Scene& scene, const CaptureOptions& options, const CaptureFigures& figures);
void print_capture(const Scene& scene, const CaptureOptions& options, const CaptureFigures& figures);

}  // namespace gloam::cli
