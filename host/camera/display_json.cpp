#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/matrix.hpp>

#include "base/files.h"
#include "base/json_text.h"
#include "base/lists.h"
#include "gloam/error.h"
#include "gloam/light_field.h"

namespace gloam {
namespace {

using glm::dmat3;
using glm::dvec3;
using nlohmann::json;

/// A display takes a few kilobytes; a larger JSON is no display.
constexpr std::uintmax_t largest_file = 16 << 20;
constexpr int most_modules = 4096, most_pixels = 16384;
constexpr double largest = 1e12;  // absolute value of any number

// --- Fields

/// An object of the document, and its name in messages: "screen", "modules.list[3]"; empty for the document itself.
struct Object {
  const std::string& file;
  std::string name;
  const json& value;

  std::string name_of(const std::string& field) const { return name.empty() ? field : name + "." + field; }
};

[[noreturn]] void refuse(const Object& object, const std::string& field, const std::string& fault,
                         const std::string& expected) {
  throw Error("{}: {} {}; expected {}", object.file, object.name_of(field), fault, expected);
}

std::string type_of(const json& value) { return fmt::format("is of type {}", value.type_name()); }

/// The field, or nullptr if it is missing or null.
const json* find(const Object& object, const std::string& field) {
  const auto found = object.value.find(field);
  return found == object.value.end() || found->is_null() ? nullptr : &*found;
}

/// Throws Error for unknown fields: a misspelt field would count as missing.
void check_fields(const Object& object, const std::vector<std::string>& known) {
  for (const auto& [field, unused] : object.value.items()) {
    if (!contains(known, field))
      throw Error("{}: {} is no field of a display{}; there are {}", object.file, object.name_of(field),
                  suggestion(field, known), enumerate(known));
  }
}

std::optional<Object> object(const Object& from, const std::string& field, const std::vector<std::string>& known) {
  const json* value = find(from, field);
  if (!value) return {};
  if (!value->is_object()) refuse(from, field, type_of(*value), "an object with " + enumerate(known));
  Object result{from.file, from.name_of(field), *value};
  check_fields(result, known);
  return result;
}

Object needed_object(const Object& from, const std::string& field, const std::vector<std::string>& known) {
  const std::optional<Object> found = object(from, field, known);
  if (!found) refuse(from, field, "is missing", "an object with " + enumerate(known));
  return *found;
}

double finite(const Object& object, const std::string& field, const json& value) {
  if (is_nonfinite_literal(value)) refuse(object, field, "is not finite", "a number");
  if (!value.is_number()) refuse(object, field, type_of(value), "a number");
  const double number = value.get<double>();
  if (!std::isfinite(number) || std::abs(number) > largest)
    refuse(object, field, fmt::format("is {:g}", number), "a number of at most 1e12");
  return number;
}

std::optional<double> number(const Object& object, const std::string& field) {
  const json* value = find(object, field);
  return value ? std::optional(finite(object, field, *value)) : std::nullopt;
}

double positive(const Object& object, const std::string& field) {
  const std::optional<double> value = number(object, field);
  if (!value) refuse(object, field, "is missing", "a number > 0");
  if (!(*value > 0)) refuse(object, field, fmt::format("is {:g}", *value), "a number > 0");
  return *value;
}

int whole(const Object& object, const std::string& field, const json& value, int most) {
  const double number = finite(object, field, value);
  if (!(number >= 1 && number <= most) || number != std::floor(number))
    refuse(object, field, fmt::format("is {:g}", number), fmt::format("a whole number, 1 to {}", most));
  return int(number);
}

std::optional<dvec3> point(const Object& object, const std::string& field) {
  const json* value = find(object, field);
  if (!value) return {};
  if (!value->is_array() || value->size() != 3) refuse(object, field, "is no list of 3", "[x, y, z]");
  dvec3 result;
  for (int i = 0; i < 3; ++i) result[i] = finite(object, fmt::format("{}[{}]", field, i), (*value)[size_t(i)]);
  return result;
}

dvec3 needed_point(const Object& object, const std::string& field) {
  const std::optional<dvec3> found = point(object, field);
  if (!found) refuse(object, field, "is missing", "[x, y, z]");
  return *found;
}

// --- Modules

std::vector<dvec3> along_line(const Object& modules, int count) {
  const Object line = needed_object(modules, "line", {"from", "to"});
  const dvec3 from = needed_point(line, "from"), to = needed_point(line, "to");
  std::vector<dvec3> places;
  for (int i = 0; i < count; ++i) places.push_back(glm::mix(from, to, count > 1 ? double(i) / (count - 1) : 0.5));
  return places;
}

std::vector<dvec3> along_arc(const Object& modules, int count) {
  const Object arc = needed_object(modules, "arc", {"centre", "radius", "angle"});
  const dvec3 centre = needed_point(arc, "centre");
  const double radius = positive(arc, "radius"), degrees = positive(arc, "angle");
  if (degrees > 180) refuse(arc, "angle", fmt::format("is {:g}", degrees), "at most 180 degrees");
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

std::vector<OpticalModule> evenly_placed(const Object& modules) {
  const json* field = find(modules, "count");
  if (!field) refuse(modules, "count", "is missing", "a whole number, with line or arc; or a list of modules");
  if (field->is_number() && field->get<double>() == 0)
    throw Error("{}: modules.count is 0: a display without modules shows nothing; give 1 or more", modules.file);
  const int count = whole(modules, "count", *field, most_modules);
  if (find(modules, "line") && find(modules, "arc")) refuse(modules, "arc", "is given beside line", "one of the two");
  const std::vector<dvec3> places = find(modules, "arc") ? along_arc(modules, count) : along_line(modules, count);
  const json* facing = find(modules, "facing");
  if (facing && *facing != "ahead" && *facing != "middle")
    refuse(modules, "facing", "is " + facing->dump(), "\"ahead\" or \"middle\" (of the screen)");
  std::vector<OpticalModule> result;
  for (const dvec3& place : places)
    result.push_back(facing && *facing == "middle" ? facing_the_middle(place) : OpticalModule{place});
  return result;
}

std::vector<OpticalModule> listed(const Object& modules, const json& list) {
  if (!list.is_array()) refuse(modules, "list", type_of(list), "a list of modules");
  if (list.empty())
    throw Error("{}: modules.list is empty: a display without modules shows nothing; give 1 or more", modules.file);
  if (list.size() > size_t(most_modules))
    refuse(modules, "list", fmt::format("has {} modules", list.size()), fmt::format("1 to {}", most_modules));
  const std::vector<std::string> known = {"position", "yaw", "pitch"};
  std::vector<OpticalModule> result;
  for (size_t i = 0; i < list.size(); ++i) {
    const std::string name = fmt::format("list[{}]", i);
    if (!list[i].is_object()) refuse(modules, name, type_of(list[i]), "an object with " + enumerate(known));
    const Object module{modules.file, modules.name_of(name), list[i]};
    check_fields(module, known);
    result.push_back(
        {needed_point(module, "position"), number(module, "yaw").value_or(0), number(module, "pitch").value_or(0)});
  }
  return result;
}

void read_modules(const Object& document, LightFieldDisplay& display) {
  if (!find(document, "modules"))
    throw Error(
        "{}: has no modules: a display without them shows nothing; give modules.count with line or arc, or "
        "modules.list",
        document.file);
  const Object modules = needed_object(document, "modules", {"resolution", "count", "line", "arc", "facing", "list"});
  const json* resolution = find(modules, "resolution");
  if (!resolution) refuse(modules, "resolution", "is missing", "[width, height] in pixels");
  if (!resolution->is_array() || resolution->size() != 2)
    refuse(modules, "resolution", "is no list of 2", "[width, height] in pixels");
  display.width = whole(modules, "resolution[0]", (*resolution)[0], most_pixels);
  display.height = whole(modules, "resolution[1]", (*resolution)[1], most_pixels);
  const json* list = find(modules, "list");
  for (const char* field : {"count", "line", "arc", "facing"})
    if (list && find(modules, field)) refuse(modules, field, "is given beside list", "one of the two");
  display.modules = list ? listed(modules, *list) : evenly_placed(modules);
}

// --- World to physical

dmat3 matrix(const Object& object, const std::string& field) {
  const json* value = find(object, field);
  const auto is_row = [](const json& row) { return row.is_array() && row.size() == 3; };
  if (!value) refuse(object, field, "is missing", "3 rows of 3 numbers");
  if (!value->is_array() || value->size() != 3 || !std::all_of(value->begin(), value->end(), is_row))
    refuse(object, field, "is not 3 rows of 3", "3 rows of 3 numbers");
  dmat3 m;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      m[column][row] =
          finite(object, fmt::format("{}[{}][{}]", field, row, column), (*value)[size_t(row)][size_t(column)]);
  return m;
}

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

Box box_of(const Object& object) {
  const Box box{point(object, "centre").value_or(dvec3(0)), needed_point(object, "size")};
  for (int i = 0; i < 3; ++i) {
    if (box.size[i] < 0)
      refuse(object, fmt::format("size[{}]", i), fmt::format("is {:g}", box.size[i]), "a number > 0");
    if (box.size[i] == 0)
      throw Error("{}: {}.size[{}] is 0: the transform to physical space would be singular; expected a number > 0",
                  object.file, object.name, i);
  }
  return box;
}

/// The map from one box to the other.
std::optional<WorldToPhysical> from_boxes(const Object& document) {
  const std::optional<Object> region = object(document, "region_of_interest", {"physical", "world"});
  if (!region) return {};
  const Object physical = needed_object(*region, "physical", {"centre", "size"}),
               world = needed_object(*region, "world", {"centre", "size", "right", "up"});
  const Box to = box_of(physical), from = box_of(world);
  const dvec3 right = point(world, "right").value_or(dvec3(1, 0, 0)), up = point(world, "up").value_or(dvec3(0, 1, 0));
  const dvec3 ahead = glm::cross(right, up);
  if (!(glm::length(ahead) > 1e-9 * glm::length(right) * glm::length(up)))
    throw Error("{}: {}: right and up lie on one line: the transform to physical space would be singular",
                document.file, world.name);
  if (std::abs(glm::dot(right, up)) > 1e-6 * glm::length(right) * glm::length(up))
    refuse(world, "up", "is not at a right angle to right", "the box's edges at right angles");
  const dvec3 scale = to.size / from.size;
  const dmat3 rows(scale.x * glm::normalize(right), scale.y * glm::normalize(up), scale.z * glm::normalize(ahead));
  WorldToPhysical map{glm::transpose(rows), {}};
  // The sizes may differ by as much as doubles can.
  check_transform(document.file, "region_of_interest", map.linear);
  map.origin = from.centre - glm::inverse(map.linear) * to.centre;
  return map;
}

std::optional<WorldToPhysical> from_matrix(const Object& document) {
  const std::optional<Object> map = object(document, "world_to_physical", {"linear", "origin"});
  if (!map) return {};
  WorldToPhysical result{matrix(*map, "linear"), point(*map, "origin").value_or(dvec3(0))};
  check_transform(document.file, "world_to_physical.linear", result.linear);
  return result;
}

// --- The whole

bool is_within_range(const dvec3& v) {
  return std::abs(v.x) <= largest && std::abs(v.y) <= largest && std::abs(v.z) <= largest;
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

LightFieldDisplay display_of(const Object& document) {
  check_fields(document, {"name", "unit", "observer", "screen", "modules", "region_of_interest", "world_to_physical"});
  LightFieldDisplay display;
  display.name = document.value.value("name", std::string("unnamed"));
  const Object observer = needed_object(document, "observer", {"distance", "height"});
  const std::optional<double> distance = number(observer, "distance");
  if (!distance) refuse(observer, "distance", "is missing", "a number > 0");
  if (!(*distance > 0))
    throw Error("{}: observer.distance is {:g}: the screen would be behind its observers; expected a number > 0",
                document.file, *distance);
  display.observer_distance = *distance;
  display.observer_height = number(observer, "height").value_or(0);
  const Object screen = needed_object(document, "screen", {"width", "height", "radius"});
  display.screen_width = positive(screen, "width");
  display.screen_height = positive(screen, "height");
  if (find(screen, "radius")) display.screen_radius = positive(screen, "radius");
  read_modules(document, display);
  check_places(document.file, display);
  if (find(document, "world_to_physical") && find(document, "region_of_interest"))
    refuse(document, "world_to_physical", "is given beside region_of_interest", "one of the two");
  display.world = find(document, "world_to_physical") ? from_matrix(document) : from_boxes(document);
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
    throw Error("{}: name {}; expected a text", name, type_of(*field));
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
