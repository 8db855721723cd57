#include "exr/file_cameras.h"

#include <functional>

#include "base/lists.h"
#include "exr/errors.h"
#include "exr/header_cameras.h"
#include "frame/field_of_view.h"
#include "gloam/error.h"
#include "gloam/option.h"

namespace gloam {
namespace {

/// Finds the cameras of one file, one view after the other.
class Search {
 public:
  Search(const ExrFile& file, const std::optional<EyeOfPair>& eye)
      : file_(file), options_(file.options), eye_(eye), headers_(file.headers, file.display, file.pixel_aspect) {}

  FileCameras all() {
    for (const std::string& view : file_.names.views) add(view);
    return std::move(found_);
  }

 private:
  void add(const std::string& view) {
    std::optional<Pose> pose;
    std::optional<Camera> camera = by_header(view, pose);
    if (!camera) camera = by_json(view);
    if (!camera) camera = lens_by_header(view);
    if (camera && pose) camera->pose = pose;
    if (options_.fov_degrees) camera = by_field_of_view(camera, pose);
    if (!camera && pose) found_.poses.emplace(view, *pose);
    if (!camera) return;
    if (options_.near) camera->near = options_.near;
    if (options_.far) camera->far = options_.far;
    named(file_.path, [&] { check_clipping(*camera); });
    found_.cameras.emplace(view, *camera);
  }

  /// Sets `pose` if the header has a pose but no whole camera.
  std::optional<Camera> by_header(const std::string& view, std::optional<Pose>& pose) {
    std::optional<Camera> camera;
    if (has_camera_flag()) return camera;
    // A flag overrides the header, even if the header describes no valid camera.
    passing_over(options_.fov_degrees || options_.only_looks, [&] {
      named(file_.path, [&] {
        guarded(file_.path, [&] {
          camera = headers_.camera(view, found_.notes);
          if (!camera) pose = headers_.pose(view, found_.notes);
        });
      });
    });
    return camera;
  }

  /// A header that tells the lens and not the place: after a JSON, which tells both.
  std::optional<Camera> lens_by_header(const std::string& view) {
    std::optional<Camera> camera;
    if (has_camera_flag()) return camera;
    passing_over(options_.fov_degrees || options_.only_looks, [&] {
      named(file_.path, [&] { guarded(file_.path, [&] { camera = headers_.lens(view, found_.notes); }); });
    });
    return camera;
  }

  std::optional<Camera> by_json(const std::string& view) {
    std::optional<Camera> camera;
    passing_over(options_.only_looks || (options_.fov_degrees && !has_camera_flag()), [&] {
      if (!json_) {
        json_.emplace();  // stays without cameras if the JSON cannot be read
        *json_ = read_json_cameras(
            {file_.path, options_.camera_file, options_.camera_text, file_.display, eye_, file_.headers.text("Frame")},
            found_.notes);
      }
      camera = of_json(view);
    });
    return camera;
  }

  /// If the JSON has no camera for the view: throws Error if the user named the JSON, else adds a note.
  std::optional<Camera> of_json(const std::string& view) {
    if (json_->cameras.empty()) return {};
    const std::vector<std::string> wanted = eye_ ? std::vector<std::string>{eye_->name} : file_.names.views;
    if (const Camera* camera = json_->find(eye_ ? eye_->name : view, wanted)) return *camera;
    const std::string why = misfit_in_words(*json_, file_.path.filename().string(), wanted);
    if (has_camera_flag())
      throw Error("{}; give a JSON with {}", why,
                  wanted.front().empty() ? "one camera" : "a camera for each of the frame's views");
    found_.json_misfit = why;
    add_new(found_.notes, fmt::format("camera: {}: it is not used", why));
    return {};
  }

  /// The camera by --fov, with all else that is known.
  Camera by_field_of_view(const std::optional<Camera>& known, const std::optional<Pose>& pose) const {
    const std::string source = options_.fov_from.empty() ? option("fov") : options_.fov_from;
    Camera camera = camera_from_fov(*options_.fov_degrees, file_.display, file_.pixel_aspect, source);
    camera.pose = known ? known->pose : pose;
    if (known) camera.near = known->near, camera.far = known->far;
    return camera;
  }

  /// Throws if near and far, one from a flag and the other from the camera, do not go together.
  void check_clipping(const Camera& camera) const {
    if (!camera.near || !camera.far || *camera.near < *camera.far || (!options_.near && !options_.far)) return;
    if (options_.near)
      throw Error("{}: must be less than far, {:g} ({}); give {} as well",
                  option("near", fmt::format("{:g}", *camera.near)), *camera.far, camera.source, option("far"));
    throw Error("{}: must be more than near, {:g} ({}); give {} as well",
                option("far", fmt::format("{:g}", *camera.far)), *camera.near, camera.source, option("near"));
  }

  /// Runs `find`. An Error of it becomes a note if `is_allowed`.
  void passing_over(bool is_allowed, const std::function<void()>& find) {
    try {
      find();
    } catch (const Error& error) {
      if (!is_allowed && !has_camera_flag())
        throw Error("{}; {} or {} gives another", error.what(), option("fov"), option("camera"));
      if (!is_allowed) throw;
      const std::string instead = options_.fov_degrees ? option("fov") + " takes its place"
                                                       : fmt::format("gloam run refuses it; {} or {} gives another",
                                                                     option("fov"), option("camera"));
      add_new(found_.notes, fmt::format("camera: {}: not used; {}", error.what(), instead));
    }
  }

  bool has_camera_flag() const { return !options_.camera_file.empty(); }

  const ExrFile& file_;
  const ReadOptions& options_;
  const std::optional<EyeOfPair>& eye_;
  HeaderCameras headers_;
  std::optional<JsonCameras> json_;  ///< set once the JSON has been looked for
  FileCameras found_;
};

}  // namespace

bool FileCameras::has_pose(const std::string& view) const {
  const auto camera = cameras.find(view);
  return poses.contains(view) || (camera != cameras.end() && camera->second.pose);
}

void check_clipping_flags(const ReadOptions& options) {
  if (options.near && options.far && !(*options.near < *options.far))
    throw UsageError("{} {}: near must be less than far", option("near", fmt::format("{:g}", *options.near)),
                     option("far", fmt::format("{:g}", *options.far)));
}

FileCameras find_cameras(const ExrFile& file, const std::optional<EyeOfPair>& eye) { return Search(file, eye).all(); }

}  // namespace gloam
