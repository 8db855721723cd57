#include "gloam/display_json.h"

#include <cmath>
#include <glm/matrix.hpp>

#include "base/files.h"
#include "base/json_text.h"
#include "camera/camera_fields.h"
#include "camera/display_fields.h"
#include "camera/display_modules.h"
#include "camera/display_world.h"
#include "gloam/error.h"

namespace gloam {
namespace {

using glm::dmat3;
using glm::dvec3;
using nlohmann::json;

/// A display takes a few kilobytes; a larger JSON is no display.
constexpr std::uintmax_t largest_file = 16 << 20;

bool is_within_range(const dvec3& v) {
  return std::abs(v.x) <= largest_in_display && std::abs(v.y) <= largest_in_display &&
         std::abs(v.z) <= largest_in_display;
}

/// Results from numbers in range may be out of range: they could be written but not read again.
void check_range(const std::string& file, const LightFieldDisplay& display) {
  for (size_t i = 0; i < display.modules.size(); ++i)
    if (!is_within_range(display.modules[i].position))
      throw Error("{}: module {} stands over 1e12 from the screen's middle; expected at most 1e12", file, i);
  if (!display.world) return;
  const dmat3& linear = display.world->linear;
  if (is_within_range(linear[0]) && is_within_range(linear[1]) && is_within_range(linear[2]) &&
      is_within_range(display.world->origin))
    return;
  throw Error("{}: region_of_interest: its boxes differ too much: the transform has numbers over 1e12", file);
}

void check_places(const std::string& file, const LightFieldDisplay& display) {
  if (display.screen_radius && !(*display.screen_radius > 0.5 * display.screen_width))
    throw Error(
        "{}: screen.radius is {:g}, and a screen {:g} wide is no part of such a cylinder's front; expected over {:g}",
        file, *display.screen_radius, display.screen_width, 0.5 * display.screen_width);
  for (size_t i = 0; i < display.modules.size(); ++i) {
    const OpticalModule& module = display.modules[i];
    const double r = display.screen_radius.value_or(0);
    // The sides of a curved screen lie farthest back.
    const double back =
        display.screen_radius ? std::sqrt(r * r - 0.25 * display.screen_width * display.screen_width) - r : 0;
    if (!(module.position.z < back))
      throw Error("{}: module {} stands at z = {:g}, which is not behind the screen; expected less than {:.4g}", file,
                  i, module.position.z, back);
    if (!(std::abs(module.yaw) < 90 && std::abs(module.pitch) < 90))
      throw Error("{}: module {} is turned by {:g} and {:g} degrees, away from the screen; expected less than 90", file,
                  i, module.yaw, module.pitch);
  }
}

LightFieldDisplay display_of(const DisplayFields& document) {
  document.check_fields({"name", "unit", "observer", "screen", "modules", "region_of_interest", "world_to_physical"});
  LightFieldDisplay display;
  display.name = document.value.value("name", std::string("unnamed"));
  const DisplayFields observer = document.needed_object("observer", {"distance", "height"});
  const std::optional<double> distance = observer.number("distance");
  if (!distance) observer.refuse("distance", "is missing", "a number > 0");
  if (!(*distance > 0))
    throw Error("{}: observer.distance is {:g}: the screen would be behind its observers; expected a number > 0",
                document.file, *distance);
  display.observer_distance = *distance;
  display.observer_height = observer.number("height").value_or(0);
  const DisplayFields screen = document.needed_object("screen", {"width", "height", "radius"});
  display.screen_width = screen.positive("width");
  display.screen_height = screen.positive("height");
  if (screen.find("radius")) display.screen_radius = screen.positive("radius");
  read_modules(document, display);
  check_places(document.file, display);
  display.world = read_world(document);
  check_range(document.file, display);
  return display;
}

json list_of(const dvec3& v) { return {v.x, v.y, v.z}; }

}  // namespace

LightFieldDisplay display_from_text(const std::string& text, const std::string& name) {
  const json document = json_of_text(text, name);
  if (!document.is_object())
    throw Error("{}: holds {}, expected an object with observer, screen and modules", name, document.type_name());
  if (const auto field = document.find("name"); field != document.end() && !field->is_string())
    throw Error("{}: name {}; expected a text", name, type_in_words(*field));
  return display_of({name, "", document});
}

LightFieldDisplay read_display(const std::filesystem::path& file) {
  std::error_code failed;
  const std::uintmax_t size = std::filesystem::file_size(file, failed);
  if (!failed && size > largest_file) throw Error("{}: {} bytes, too large for a display", file.string(), size);
  LightFieldDisplay display = display_from_text(read_text(file), file.string());
  if (display.name == "unnamed") display.name = file.stem().string();
  return display;
}

bool is_display_text(const std::string& text) {
  try {
    const json document = json_of_text(text, "");
    return document.is_object() && document.contains("modules");
  } catch (const Error&) {
    return false;
  }
}

std::string text_of(const LightFieldDisplay& display) {
  nlohmann::ordered_json document;
  document["name"] = display.name;
  document["observer"] = {{"distance", display.observer_distance}, {"height", display.observer_height}};
  document["screen"] = {{"width", display.screen_width}, {"height", display.screen_height}};
  if (display.screen_radius) document["screen"]["radius"] = *display.screen_radius;
  document["modules"]["resolution"] = {display.width, display.height};
  json list = json::array();
  for (const OpticalModule& module : display.modules) {
    json entry = {{"position", list_of(module.position)}};
    if (module.yaw != 0) entry["yaw"] = module.yaw;
    if (module.pitch != 0) entry["pitch"] = module.pitch;
    list.push_back(entry);
  }
  document["modules"]["list"] = list;
  if (display.world) {
    const dmat3 rows = glm::transpose(display.world->linear);
    document["world_to_physical"] = {{"linear", {list_of(rows[0]), list_of(rows[1]), list_of(rows[2])}},
                                     {"origin", list_of(display.world->origin)}};
  }
  return document.dump();
}

}  // namespace gloam
