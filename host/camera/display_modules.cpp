#include "camera/display_modules.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/constants.hpp>

#include "camera/camera_fields.h"
#include "gloam/error.h"

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

}  // namespace

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

}  // namespace gloam
