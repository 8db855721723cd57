// Attributes of one EXR header, by name.
#pragma once

#include <Imath/ImathMatrix.h>
#include <OpenEXR/ImfHeader.h>

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "exr/headers.h"

namespace gloam {

/// A matrix of floats or doubles; none if the header has no such matrix.
std::optional<Imath::M44d> matrix_attribute(const Imf::Header& header, const std::string& name);

/// A float or a double; none if the header has no such number.
std::optional<double> number_attribute(const Imf::Header& header, const std::string& name);

/// A text; empty if the header has none of this name.
std::string text_attribute(const Imf::Header& header, const std::string& name);

/// `gloamOrigin`, the point of the world that matrices and positions are relative to; none if the header lacks it.
std::optional<glm::dvec3> origin_attribute(const Imf::Header& header, const std::string& prefix);

/// `gloamLight`, the direction towards the sun in the world, made unit; none if the header lacks it or it is no direction.
std::optional<glm::dvec3> light_attribute(const Imf::Header& header);

/// Names and values of the attributes of all parts, in file order; of further parts those that the first has not, or otherwise, after
/// the part's name. Long values are cut. Channels, and types that gloam does not know, are left out.
std::vector<std::pair<std::string, std::string>> attribute_texts(const Headers& headers);

}  // namespace gloam
