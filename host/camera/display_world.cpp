#include "camera/display_world.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "gloam/error.h"

namespace gloam {
namespace {

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

}  // namespace

std::optional<WorldToPhysical> read_world(const DisplayFields& document) {
  const bool has_matrix = document.find("world_to_physical");
  if (has_matrix && document.find("region_of_interest"))
    document.refuse("world_to_physical", "is given beside region_of_interest", "one of the two");
  return has_matrix ? from_matrix(document) : from_boxes(document);
}

}  // namespace gloam
