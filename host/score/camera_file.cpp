#include "score/camera_file.h"

#include "base/files.h"
#include "base/json_text.h"
#include "gloam/error.h"
#include "gloam/exr.h"

namespace gloam::score {
namespace {

using Json = nlohmann::ordered_json;

Json camera_document(const Camera& camera, const Window& display) {
  Json document = {{"width", display.width()}, {"height", display.height()}};
  if (camera.orthographic) {
    document["camera_type"] = "ORTHO";
    document["pixels_per_unit"] = camera.fx;
  } else {
    document["fx"] = camera.fx;
    document["fy"] = camera.fy;
  }
  document["cx"] = camera.cx - display.x0;
  document["cy"] = camera.cy - display.y0;
  if (camera.near) document["near"] = *camera.near;
  if (camera.far) document["far"] = *camera.far;
  const Pose pose = camera.pose.value_or(Pose{});
  Json rows = Json::array();
  for (int row = 0; row < 3; ++row) {
    const glm::dvec3 axis = pose.world_to_view[row];  // a column of the rotation is a row of its inverse
    rows.push_back({axis.x, axis.y, axis.z, pose.position[row]});
  }
  rows.push_back({0, 0, 0, 1});
  document["camera_to_world"] = rows;
  return document;
}

}  // namespace

void write_camera_file(const std::filesystem::path& file, const std::filesystem::path& frame) {
  const FrameFile opened(frame, {});
  Json document = {{"views", Json::array()}};
  for (const std::string& view : opened.views()) {
    const std::optional<Camera> camera = opened.camera(view);
    if (!camera) throw Error("{}: has no camera for {{camera}}", frame.string());
    if (camera->slits) throw Error("{}: has the module of a display, which no camera JSON holds", frame.string());
    Json of_view = camera_document(*camera, opened.display());
    if (opened.views().size() == 1) {
      document = std::move(of_view);
      break;
    }
    of_view["view"] = view;
    document["views"].push_back(std::move(of_view));
  }
  write_text(file, document.dump(2) + "\n");
}

}  // namespace gloam::score
