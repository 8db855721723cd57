// What is measured on: a frame with its truths, of a built-in scene or the user's own.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/measures.h"
#include "gloam/frame.h"
#include "gloam/scene/tracer.h"
#include "gloam/technique.h"

namespace gloam::bench {

/// A truth, and how far it is from the limit of infinitely many rays.
struct Truth {
  Image ao;
  std::optional<double> noise, radius, rays;  ///< RMS, scene units and per pixel, where its file says them
};

/// Where and how frames and truths of a scene are kept.
struct SceneOptions {
  std::filesystem::path folder;
  int width = 960, height = 540;
  int layers = 8;                ///< peeled per pixel
  int rays = 256;                ///< per pixel, for a truth
  std::optional<double> radius;  ///< scene units; none: the scene's own
  /// Told of what takes long: "courtyard: truth", 0.25. May be empty.
  std::function<void(const std::string& what, double share_done)> progress;
};

/// A scene with its truths, traced when they are asked for and kept as EXR files. All are of one frame: `frame` is the same
/// in every call.
class Truths {
 public:
  /// `name`: of the files.
  Truths(std::string name, Scene scene, SceneOptions options);
  ~Truths();

  const std::string& name() const { return name_; }
  const Scene& scene() const { return scene_; }
  double radius() const { return radius_; }

  /// The scene from its first camera, with every plane that can be captured but motion. Returns NAME.exr, which is made
  /// where it is not there or shows something else.
  std::filesystem::path frame_file();

  /// Depth and normals of the scene from its first camera, in another size.
  Frame captured(int width, int height);

  /// Ambient occlusion without falloff (NAME_ao_ref.exr). Throws as `ao_reference` does.
  const Truth& truth(const Frame& frame);

  /// With the technique's own contribution (NAME_ao_ref_TECHNIQUE.exr); techniques of the same contribution share it.
  const Truth& truth(const Frame& frame, const Technique& technique, const ParameterValues& values);

  /// Files that were made, and those of an earlier run that were used again; names only.
  const std::vector<std::string>& made() const { return made_; }
  const std::vector<std::string>& reused() const { return reused_; }

 private:
  using Contribution = std::function<double(double cosine, double distance)>;
  const Tracer& tracer();
  bool is_there(const std::string& file, const std::string& recipe);
  const Truth& traced(const Frame& frame, const std::string& file, const Contribution& contribution,
                      const std::string& falloff);
  void tell(const std::string& what, double share) const;

  std::string name_;
  Scene scene_;
  SceneOptions options_;
  double radius_;
  std::string recipe_;  ///< what the scene's files are made from
  std::unique_ptr<Tracer> tracer_;
  std::map<std::string, Truth> truths_;            ///< by file
  std::map<std::string, std::string> own_truths_;  ///< file by contribution
  std::vector<std::string> made_, reused_;
};

/// The plane `ao` of files for the views of a frame: of a file of one view for the view that the file's name ends in, else of the
/// same name, or the only one of both. Views that no file has are left out, which `notes` says. Throws Error when size or views do
/// not fit, two files have the same view, or say different radii.
Truth read_truth(const std::vector<std::string>& paths, const Frame& frame, std::vector<std::string>& notes);

}  // namespace gloam::bench
