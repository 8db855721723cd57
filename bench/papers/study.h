// What measuring a paper again is made of: frames of scenes, techniques on them, and what came of it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/measures.h"
#include "bench/papers/panels.h"
#include "bench/papers/paper.h"
#include "bench/plans.h"
#include "gloam/scene/outlines.h"
#include "gloam/scene/reference.h"
#include "gloam/scene/scene.h"
#include "gloam/scene/tracer.h"

namespace gloam::bench {

/// A scene that stands for one of the paper's, which cannot be had here.
struct StandIn {
  const char *scene, *of;
};

/// A technique, and what of it is set.
struct Asked {
  std::string technique;
  Settings settings;
  int resolution = 1;
  std::string plane = "ao_raw";
  std::string mask = {};  ///< as `PlanRequest::mask`
  bool operator==(const Asked&) const = default;
};

Asked with(Asked asked, const std::string& name, const std::string& value);

/// The same after its filter.
Asked filtered(Asked asked);

/// How many pixels a mask names.
double pixels_of(const Mask& mask);

/// A frame of a scene, with what its AO is measured with.
struct Stage {
  Scene scene;
  std::unique_ptr<Tracer> tracer;
  Frame frame;
  double radius = 0;
  Foreground surfaces;
  std::unique_ptr<Outlines> outlines;  ///< where the frame counts them
  double outline_seconds = 0;          ///< that this took
  double capture_seconds = 0;          ///< tracing the frame in all, where that is stated
};

/// "1920x1080"
std::string size_of(const Stage& s);

/// What of a scene is captured: depth, normal, and what is asked for.
struct Shot {
  std::string scene;
  int layers = 0;
  Settings settings = {};  ///< of the scene
  int camera = 0;
  std::optional<double> second_view = {};  ///< degrees
  std::optional<double> eyes_apart = {};   ///< two eyes in the camera's place, scene units
  bool with_outlines = false;              ///< as wide as the scene's radius
  bool with_materials = false;             ///< also what reflections read
};

class Study {
 public:
  Study(Device& device, const PaperOptions& options) : device_(device), options_(options) {}

  PaperResult result;

  Stage stage(const Shot& shot, int width, int height) const;

  /// In the size of tables.
  Stage timed_stage(const Shot& shot) const { return stage(shot, options_.width, options_.height); }

  /// One `divisor`-th of the width and of the height: errors and pictures do not need more.
  Stage small_stage(const Shot& shot, int divisor = 2) const;

  /// Captures a stage's scene anew, with one view, depth, normal, and outlines where it had them.
  void look_from(Stage& s, const SceneCamera& camera) const;

  Plan plan_of(const Stage& s, const Asked& asked) const;

  /// The plane of the first view.
  Plane image(const Stage& s, const Asked& asked) const;

  /// The plane of each view.
  Image images(const Stage& s, const Asked& asked) const;

  /// AO of each view from so many rays per pixel.
  Image traced(const Stage& s, AoReferenceOptions rays) const;

  /// AO of the first view from `PaperOptions::rays`; of `like`, with that technique's own falloff.
  Plane truth(const Stage& s, const Technique* like = nullptr) const;

  /// RMSE over the surfaces of the first view.
  double error(const Stage& s, const Plane& test, const Plane& truth) const;

  /// RMSE over the surfaces of every view.
  double error(const Stage& s, const Image& test, const Image& truth) const { return rmse(test, truth, s.surfaces); }

  /// Mean over the surfaces of the first view of what AO takes away.
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
