// The subject of a measurement: a frame with its truths, of a built-in scene or the user's own.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gloam/frame.h"
#include "gloam/scene/reference.h"
#include "gloam/scene/tracer.h"
#include "gloam/technique.h"
#include "measure/measures.h"

namespace gloam::bench {

/// A truth, and its distance from the limit of infinitely many rays.
struct Truth {
  Image image;
  std::optional<double> noise, radius, rays;  ///< RMS, scene units, and per pixel, if its file states them
};

/// What a frame of a moving camera has besides: motion from the frame before, and rays of its own.
struct InSequence {
  SceneCamera camera_before;
  std::shared_ptr<const Scene> scene_before;  ///< null: objects stand still
  int seed = 0;                               ///< of the truth's rays
};

/// Where and how frames and truths of a scene are stored.
struct SceneOptions {
  std::filesystem::path folder;
  int width = 960, height = 540;
  int layers = 8;                ///< peeled layers per pixel
  bool peel_light = false;       ///< also what each layer sends
  int rays = 256;                ///< rays per pixel, for a truth
  std::optional<double> radius;  ///< scene units; none: the scene's own
  std::optional<InSequence> in_sequence;
  std::vector<std::string> more_planes;  ///< to read where a frame has them, besides those of the techniques
  /// Called for lengthy steps: "courtyard: truth", 0.25. May be empty.
  std::function<void(const std::string& what, double share_done)> progress;
};

/// A scene with its truths, which are traced when they are asked for and stored as EXR files. All calls use the same frame.
class Truths {
 public:
  /// `name`: prefix of the files.
  Truths(std::string name, Scene scene, SceneOptions options);
  ~Truths();

  const std::string& name() const { return name_; }
  const Scene& scene() const { return scene_; }
  double radius() const { return radius_; }

  /// NAME.exr: the scene from its first camera, with every plane that can be captured; motion only in a sequence. The file is made if it is
  /// missing or shows something else.
  std::filesystem::path frame_file();

  /// Depth and normals of the scene from its first camera, in another size.
  Frame captured(int width, int height);

  /// A plane of `measured_effects` (NAME_PLANE_ref.exr), of `ao` without falloff. Throws as its reference does, and UsageError for one
  /// that needs more than the scene.
  const Truth& truth(const Frame& frame, const std::string& plane);

  /// Ambient occlusion with the technique's own contribution (NAME_ao_ref_TECHNIQUE.exr), shared by techniques of the same contribution.
  const Truth& truth(const Frame& frame, const Technique& technique, const ParameterValues& values);

  /// Names of files that were made, and of earlier files that were reused.
  const std::vector<std::string>& made() const { return made_; }
  const std::vector<std::string>& reused() const { return reused_; }

 private:
  using Contribution = std::function<double(double cosine, double distance)>;
  const Tracer& tracer();
  bool is_there(const std::string& file, const std::string& recipe);
  using Tracing = std::function<Reference()>;
  const Truth& traced(const Frame& frame, const std::string& file, const std::string& plane, std::string recipe,
                      const Tracing& trace);
  const Truth& traced_ao(const Frame& frame, const std::string& file, const Contribution& contribution,
                         const std::string& falloff);
  std::string recipe_for(const Frame& frame) const;
  void tell(const std::string& what, double share) const;

  std::string name_;
  Scene scene_;
  SceneOptions options_;
  double radius_;
  std::string recipe_;  ///< inputs of the scene's files
  std::unique_ptr<Tracer> tracer_;
  std::map<std::string, Truth> truths_;            ///< by file
  std::map<std::string, std::string> own_truths_;  ///< file by contribution
  std::vector<std::string> made_, reused_;
};

/// The planes of `measured_effects` that truths' files hold, in their order.
std::vector<std::string> effects_in(const std::vector<std::string>& paths);

/// One plane of files for the views of a frame; files that hold only other effects are left out. A file of one view is for the view that the file's name ends in, else for
/// the one of the same name, or for the only one. Views without a file are left out, and `notes` says so. Throws Error if size or
/// views do not fit, if two files have the same view, or if they state different radii.
Truth read_truth(const std::vector<std::string>& paths, const std::string& plane, const Frame& frame,
                 std::vector<std::string>& notes);

}  // namespace gloam::bench
