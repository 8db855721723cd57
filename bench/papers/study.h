// Parts of a paper's reproduction: frames of scenes, techniques on them, and results.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gloam/scene/outlines.h"
#include "gloam/scene/reference.h"
#include "gloam/scene/scene.h"
#include "gloam/scene/tracer.h"
#include "measure/measures.h"
#include "measure/plans.h"
#include "papers/panels.h"
#include "papers/paper.h"

namespace gloam::bench {

/// A scene that stands for one of the paper's, which is not available.
struct StandIn {
  const char *scene, *of;
};

/// A technique, and its settings.
struct Asked {
  std::string technique;
  Settings settings;
  int resolution = 1;
  std::string plane = "ao_raw";
  std::string mask = {};  ///< as in `PlanRequest::only`
  bool operator==(const Asked&) const = default;
};

Asked with(Asked asked, const std::string& name, const std::string& value);

/// The same technique with its filter.
Asked filtered(Asked asked);

/// Number of pixels in a mask.
double pixels_of(const Mask& mask);

/// A frame of a scene, and the data to measure AO with.
struct Stage {
  Scene scene;
  std::unique_ptr<Tracer> tracer;
  Frame frame;
  double radius = 0;
  Foreground surfaces;
  std::unique_ptr<Outlines> outlines;  ///< set if the frame counts them
  double outline_seconds = 0;          ///< time of counting them
  double capture_seconds = 0;          ///< total time of tracing the frame
};

/// "1920x1080"
std::string size_of(const Stage& s);

/// What to capture of a scene: depth, normal, and the options below.
struct Shot {
  std::string scene;
  int layers = 0;
  Settings settings = {};  ///< settings of the scene
  int camera = 0;
  std::optional<double> second_view = {};  ///< degrees
  std::optional<double> eyes_apart = {};   ///< distance of two eyes in place of the camera, scene units
  bool with_outlines = false;              ///< as wide as the scene's radius
  bool with_materials = false;             ///< also what reflections read
};

class Study {
 public:
  Study(Device& device, const PaperOptions& options) : device_(device), options_(options) {}

  PaperResult result;

  Stage stage(const Shot& shot, int width, int height) const;

  /// A stage at the size of the tables.
  Stage timed_stage(const Shot& shot) const { return stage(shot, options_.width, options_.height); }

  /// A stage with one `divisor`-th of the width and of the height: enough for errors and pictures.
  Stage small_stage(const Shot& shot, int divisor = 2) const;

  /// Captures a stage's scene again from another camera, with one view, depth, normal, and outlines if it had them.
  void look_from(Stage& s, const SceneCamera& camera) const;

  Plan plan_of(const Stage& s, const Asked& asked) const;

  /// The plane of the first view.
  Plane image(const Stage& s, const Asked& asked) const;

  /// The plane of each view.
  Image images(const Stage& s, const Asked& asked) const;

  /// AO of each view, traced.
  Image traced(const Stage& s, AoReferenceOptions rays) const;

  /// Traced AO of the first view with `PaperOptions::rays`; with the falloff of `like`, if given.
  Plane truth(const Stage& s, const Technique* like = nullptr) const;

  /// RMSE over the surfaces of the first view.
  double error(const Stage& s, const Plane& test, const Plane& truth) const;

  /// RMSE over the surfaces of every view.
  double error(const Stage& s, const Image& test, const Image& truth) const { return rmse(test, truth, s.surfaces); }

  /// Mean occlusion (1 - AO) over the surfaces of the first view.
  double mean_taken(const Stage& s, const Plane& ao) const;

  void tell(const std::string& what, double share = 0) const;
  void fact(const std::string& figure, const std::string& row, const std::string& column, double value,
            const std::string& unit);
  void picture(const std::string& figure, const std::string& caption, const std::string& file,
               const std::vector<Panel>& panels, int columns);

  const PaperOptions& options() const { return options_; }
  Device& device() const { return device_; }

 private:
  Device& device_;
  const PaperOptions& options_;
};

}  // namespace gloam::bench
