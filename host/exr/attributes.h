// Attributes of one EXR header, by name.
#pragma once

#include <Imath/ImathMatrix.h>
#include <OpenEXR/ImfHeader.h>

#include <glm/vec3.hpp>
#include <optional>
#include <string>

namespace gloam {

/// A matrix of floats or doubles; none where the header has none of this name.
std::optional<Imath::M44d> matrix_attribute(const Imf::Header& header, const std::string& name);

/// A float or a double.
std::optional<double> number_attribute(const Imf::Header& header, const std::string& name);

/// Empty where the header has no text of this name.
std::string text_attribute(const Imf::Header& header, const std::string& name);

/// `gloamOrigin`, the place in the world that matrices and positions are relative to; none where the header does not have it.
std::optional<glm::dvec3> origin_attribute(const Imf::Header& header, const std::string& prefix);

}  // namespace gloam
