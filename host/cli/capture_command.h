// The flags of gloam capture, and what is captured and written: shared by its files.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/options.h"
#include "cli/scene_flags.h"
#include "gloam/scene/capture.h"

namespace gloam::cli {

struct CaptureCommand {
  std::string out, planes, path, picture, compression = "zip";
  std::string display, modules;
  std::optional<Size> size;
  int peel = 0;
  std::optional<int> stochastic, stochastic_seed;
  std::optional<double> alpha, view2, stereo, convergence, outlines, outline_angle;
  std::optional<OutlineMethod> outline_method;
  bool half = false, toe_in = false, separate = false;
  SceneFlags scene;
  SceneCameraFlags camera;
  JsonFlag json;
};

/// One moment: what is captured, and the file it goes to.
struct CaptureShot {
  std::string file, picture;
  std::vector<CaptureView> views;
};

/// How many surfaces lie under a pixel that shows any.
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
  std::string camera;                    ///< where the first view's camera came from
  long long surfaces = 0;                ///< pixels that show one
  std::optional<VisibleDepths> visible;  ///< what the second view holds
  std::optional<Camera> second;          ///< its camera
  double shift = 0;                      ///< of each eye's principal point, pixels
  std::optional<double> ao_radius;  ///< that suits the scene, else the first frame; none: nothing is in the picture
  std::vector<std::string> files;
};

}  // namespace gloam::cli
