#include "cli/camera_facts.h"

#include <cmath>

#include "gloam/display_json.h"
#include "gloam/light_field.h"
#include "gloam/projection.h"

namespace gloam::cli {
namespace {

/// A module of a light-field display, in the display's units.
Json module_document(const Camera& camera) {
  const TwoSlits& slits = *camera.slits;
  return {{"source", camera.source},
          {"type", "two slits"},
          {"display", display_from_text(*slits.display, "gloamDisplay").name},
          {"module", {slits.module.x, slits.module.y, slits.module.z}},
          {"observer_distance", slits.observer_distance},
          {"depth_of_slit", depth_of_slit(camera)}};
}

}  // namespace

Json camera_document(const Camera& camera, const Window& display) {
  if (camera.slits) return module_document(camera);
  Json document = {{"source", camera.source}, {"type", camera.orthographic ? "orthographic" : "perspective"},
                   {"fx", camera.fx},         {"fy", camera.fy},
                   {"cx", camera.cx},         {"cy", camera.cy}};
  if (!camera.orthographic) {
    const double left = std::atan((camera.cx - display.x0) / camera.fx),
                 right = std::atan((display.x1 - camera.cx) / camera.fx);
    document["hfov_deg"] = (left + right) * 57.29577951308232;
  }
  document["near"] = camera.near ? Json(*camera.near) : Json();
  document["far"] = camera.far ? Json(*camera.far) : Json();
  document["position"] =
      camera.pose ? Json{camera.pose->position.x, camera.pose->position.y, camera.pose->position.z} : Json();
  return document;
}

std::string camera_line(const Json& camera) {
  if (camera.contains("display"))
    return fmt::format("module of display '{}', {}", camera["display"].get<std::string>(),
                       camera["source"].get<std::string>());
  std::string line = fmt::format("{}, {}", camera["type"].get<std::string>(), camera["source"].get<std::string>());
  if (camera.contains("hfov_deg")) line += fmt::format(", hfov {:.2f} deg", camera["hfov_deg"].get<double>());
  line += fmt::format(", fx {:.2f} fy {:.2f} cx {:.2f} cy {:.2f}", camera["fx"].get<double>(),
                      camera["fy"].get<double>(), camera["cx"].get<double>(), camera["cy"].get<double>());
  for (const char* plane : {"near", "far"}) {
    if (!camera[plane].is_null()) line += fmt::format(", {} {:g}", plane, camera[plane].get<double>());
  }
  return line;
}

}  // namespace gloam::cli
