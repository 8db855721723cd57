#include "gloam/display_json.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/matrix.hpp>
#include <optional>

#include "base/files.h"
#include "base/json_text.h"
#include "camera/camera_fields.h"
#include "camera/display_fields.h"
#include "gloam/error.h"
#include "gloam/light_field.h"

namespace gloam {
namespace {

using glm::dvec3;
using nlohmann::json;

constexpr int most_modules = 4096, most_pixels = 16384;

std::vector<dvec3> along_line(const DisplayFields& modules, int count) {
  const DisplayFields line = modules.needed_object("line", {"from", "to"});
  const dvec3 from = line.needed_point("from"), to = line.needed_point("to");
  std::vector<dvec3> places;
  for (int i = 0; i < count; ++i) places.push_back(glm::mix(from, to, count > 1 ? double(i) / (count - 1) : 0.5));
  return places;
}

std::vector<dvec3> along_arc(const DisplayFields& modules, int count) {
  const DisplayFields arc = modules.needed_object("arc", {"centre", "radius", "angle"});
  const dvec3 centre = arc.needed_point("centre");
  const double radius = arc.positive("radius"), degrees = arc.positive("angle");
  if (degrees > 180) arc.refuse("angle", fmt::format("is {:g}", degrees), "at most 180 degrees");
  std::vector<dvec3> places;
  for (int i = 0; i < count; ++i) {
    const double angle = (count > 1 ? double(i) / (count - 1) - 0.5 : 0) * degrees * glm::pi<double>() / 180;
    places.push_back(centre + radius * dvec3(std::sin(angle), 0, -std::cos(angle)));
  }
  return places;
}

/// A module turned from its position to the middle of the screen.
OpticalModule facing_the_middle(const dvec3& place) {
  const double degrees = 180 / glm::pi<double>();
  return {place, std::atan2(-place.x, -place.z) * degrees,
          std::atan2(-place.y, std::hypot(place.x, place.z)) * degrees};
}

std::vector<OpticalModule> evenly_placed(const DisplayFields& modules) {
  const json* field = modules.find("count");
  if (!field) modules.refuse("count", "is missing", "a whole number, with line or arc; or a list of modules");
  if (field->is_number() && field->get<double>() == 0)
    throw Error("{}: modules.count is 0: a display without modules shows nothing; give 1 or more", modules.file);
  const int count = modules.whole("count", *field, most_modules);
  if (modules.find("line") && modules.find("arc")) modules.refuse("arc", "is given beside line", "one of the two");
  const std::vector<dvec3> places = modules.find("arc") ? along_arc(modules, count) : along_line(modules, count);
  const json* facing = modules.find("facing");
  if (facing && *facing != "ahead" && *facing != "middle")
    modules.refuse("facing", "is " + facing->dump(), "\"ahead\" or \"middle\" (of the screen)");
  std::vector<OpticalModule> result;
  for (const dvec3& place : places)
    result.push_back(facing && *facing == "middle" ? facing_the_middle(place) : OpticalModule{place});
  return result;
}

std::vector<OpticalModule> listed(const DisplayFields& modules, const json& list) {
  if (!list.is_array()) modules.refuse("list", type_in_words(list), "a list of modules");
  if (list.empty())
    throw Error("{}: modules.list is empty: a display without modules shows nothing; give 1 or more", modules.file);
  if (list.size() > size_t(most_modules))
    modules.refuse("list", fmt::format("has {} modules", list.size()), fmt::format("1 to {}", most_modules));
  const std::vector<std::string> known = {"position", "yaw", "pitch"};
  std::vector<OpticalModule> result;
  for (size_t i = 0; i < list.size(); ++i) {
    const std::string name = fmt::format("list[{}]", i);
    if (!list[i].is_object()) modules.refuse(name, type_in_words(list[i]), "an object with " + enumerate(known));
    const DisplayFields module{modules.file, modules.name_of(name), list[i]};
    module.check_fields(known);
    result.push_back(
        {module.needed_point("position"), module.number("yaw").value_or(0), module.number("pitch").value_or(0)});
  }
  return result;
}

/// Reads the field "modules" of the document. Throws Error for fields that describe no modules.
void read_modules(const DisplayFields& document, LightFieldDisplay& display) {
  if (!document.find("modules"))
    throw Error(
        "{}: has no modules: a display without them shows nothing; give modules.count with line or arc, or "
        "modules.list",
        document.file);
  const DisplayFields modules =
      document.needed_object("modules", {"resolution", "count", "line", "arc", "facing", "list"});
  const json* resolution = modules.find("resolution");
  if (!resolution) modules.refuse("resolution", "is missing", "[width, height] in pixels");
  if (!resolution->is_array() || resolution->size() != 2)
    modules.refuse("resolution", "is no list of 2", "[width, height] in pixels");
  display.width = modules.whole("resolution[0]", (*resolution)[0], most_pixels);
  display.height = modules.whole("resolution[1]", (*resolution)[1], most_pixels);
  const json* list = modules.find("list");
  for (const char* field : {"count", "line", "arc", "facing"})
    if (list && modules.find(field)) modules.refuse(field, "is given beside list", "one of the two");
  display.modules = list ? listed(modules, *list) : evenly_placed(modules);
}

using glm::dmat3;
using glm::dvec3;

/// Volume of the rows relative to the product of their lengths: 1 at right angles, 0 if one lies in the plane of the others.
double volume_share(const dmat3& m) {
  const dmat3 rows = glm::transpose(m);
  const double most = glm::length(rows[0]) * glm::length(rows[1]) * glm::length(rows[2]);
  return most > 0 ? glm::determinant(m) / most : 0;
}

void check_transform(const std::string& file, const std::string& name, const dmat3& linear) {
  const double share = volume_share(linear);
  if (!(std::abs(share) > 1e-9))
    throw Error(
        "{}: {} is a singular transform: it takes the world to a plane or less; expected one that can be inverted",
        file, name);
  if (share < 0)
    throw Error("{}: {} mirrors the world (determinant {:.3g}); expected a positive one", file, name,
                glm::determinant(linear));
}

struct Box {
  dvec3 centre, size;
};

Box box_of(const DisplayFields& object) {
  const Box box{object.point("centre").value_or(dvec3(0)), object.needed_point("size")};
  for (int i = 0; i < 3; ++i) {
    if (box.size[i] < 0) object.refuse(fmt::format("size[{}]", i), fmt::format("is {:g}", box.size[i]), "a number > 0");
    if (box.size[i] == 0)
      throw Error("{}: {}.size[{}] is 0: the transform to physical space would be singular; expected a number > 0",
                  object.file, object.name, i);
  }
  return box;
}

/// The map from one box to the other.
std::optional<WorldToPhysical> from_boxes(const DisplayFields& document) {
  const std::optional<DisplayFields> region = document.object("region_of_interest", {"physical", "world"});
  if (!region) return {};
  const DisplayFields physical = region->needed_object("physical", {"centre", "size"}),
                      world = region->needed_object("world", {"centre", "size", "right", "up"});
  const Box to = box_of(physical), from = box_of(world);
  const dvec3 right = world.point("right").value_or(dvec3(1, 0, 0)), up = world.point("up").value_or(dvec3(0, 1, 0));
  const dvec3 ahead = glm::cross(right, up);
  if (!(glm::length(ahead) > 1e-9 * glm::length(right) * glm::length(up)))
    throw Error("{}: {}: right and up lie on one line: the transform to physical space would be singular",
                document.file, world.name);
  if (std::abs(glm::dot(right, up)) > 1e-6 * glm::length(right) * glm::length(up))
    world.refuse("up", "is not at a right angle to right", "the box's edges at right angles");
  const dvec3 scale = to.size / from.size;
  const dmat3 rows(scale.x * glm::normalize(right), scale.y * glm::normalize(up), scale.z * glm::normalize(ahead));
  WorldToPhysical map{glm::transpose(rows), {}};
  // The sizes may differ by as much as doubles can.
  check_transform(document.file, "region_of_interest", map.linear);
  map.origin = from.centre - glm::inverse(map.linear) * to.centre;
  return map;
}

std::optional<WorldToPhysical> from_matrix(const DisplayFields& document) {
  const std::optional<DisplayFields> map = document.object("world_to_physical", {"linear", "origin"});
  if (!map) return {};
  WorldToPhysical result{map->needed_matrix("linear"), map->point("origin").value_or(dvec3(0))};
  check_transform(document.file, "world_to_physical.linear", result.linear);
  return result;
}

/// From the field "world_to_physical" or "region_of_interest"; none if the document has neither. Throws Error for a transform that
/// is singular or mirrors.
std::optional<WorldToPhysical> read_world(const DisplayFields& document) {
  const bool has_matrix = document.find("world_to_physical");
  if (has_matrix && document.find("region_of_interest"))
    document.refuse("world_to_physical", "is given beside region_of_interest", "one of the two");
  return has_matrix ? from_matrix(document) : from_boxes(document);
}

using glm::dmat3;
using glm::dvec3;
using nlohmann::json;

/// A display takes a few kilobytes; a larger JSON is no display.
constexpr std::uintmax_t largest_display = 16 << 20;

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
  if (!failed && size > largest_display) throw Error("{}: {} bytes, too large for a display", file.string(), size);
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
