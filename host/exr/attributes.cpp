#include "exr/attributes.h"

#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfVecAttribute.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace gloam {

std::optional<Imath::M44d> matrix_attribute(const Imf::Header& header, const std::string& name) {
  if (const auto* found = header.findTypedAttribute<Imf::M44dAttribute>(name)) return found->value();
  if (const auto* found = header.findTypedAttribute<Imf::M44fAttribute>(name)) return Imath::M44d(found->value());
  return {};
}

std::optional<double> number_attribute(const Imf::Header& header, const std::string& name) {
  if (const auto* found = header.findTypedAttribute<Imf::FloatAttribute>(name)) return found->value();
  if (const auto* found = header.findTypedAttribute<Imf::DoubleAttribute>(name)) return found->value();
  return {};
}

std::string text_attribute(const Imf::Header& header, const std::string& name) {
  const auto* found = header.findTypedAttribute<Imf::StringAttribute>(name);
  return found ? found->value() : "";
}

std::optional<glm::dvec3> origin_attribute(const Imf::Header& header, const std::string& prefix) {
  const auto* found = header.findTypedAttribute<Imf::V3dAttribute>(prefix + "gloamOrigin");
  if (!found) return {};
  return glm::dvec3(found->value().x, found->value().y, found->value().z);
}

std::optional<glm::dvec3> light_attribute(const Imf::Header& header) {
  const auto* found = header.findTypedAttribute<Imf::V3fAttribute>("gloamLight");
  if (!found) return {};
  const glm::dvec3 light(found->value().x, found->value().y, found->value().z);
  const double length = glm::length(light);
  return length > 0 && std::isfinite(length) ? std::optional(light / length) : std::nullopt;
}

}  // namespace gloam
