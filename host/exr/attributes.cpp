#include "exr/attributes.h"

#include <OpenEXR/ImfBoxAttribute.h>
#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfCompressionAttribute.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfEnvmapAttribute.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfRationalAttribute.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfStringVectorAttribute.h>
#include <OpenEXR/ImfTimeCodeAttribute.h>
#include <OpenEXR/ImfVecAttribute.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <optional>

namespace gloam {
namespace {

constexpr size_t longest = 4000;

template <typename Type>
const Type* value_in(const Imf::Attribute& attribute) {
  const auto* typed = dynamic_cast<const Imf::TypedAttribute<Type>*>(&attribute);
  return typed ? &typed->value() : nullptr;
}

template <typename Vector>
std::string numbers_of(const Vector& v, unsigned count) {
  std::vector<std::string> words;
  for (unsigned i = 0; i < count; ++i) words.push_back(fmt::format("{}", v[int(i)]));
  return fmt::format("{}", fmt::join(words, ", "));
}

template <typename Matrix>
std::string rows_of(const Matrix& m, unsigned size) {
  std::vector<std::string> rows;
  for (unsigned i = 0; i < size; ++i) rows.push_back(numbers_of(m[int(i)], size));
  return fmt::format("{}", fmt::join(rows, "; "));
}

std::string compression_name(Imf::Compression compression) {
  static const char* const names[] = {"none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"};
  const auto i = size_t(compression);
  return i < std::size(names) ? names[i] : "unknown";
}

/// A number; none for another type.
std::optional<std::string> number_text(const Imf::Attribute& a) {
  if (const auto* v = value_in<float>(a)) return fmt::format("{}", *v);
  if (const auto* v = value_in<double>(a)) return fmt::format("{}", *v);
  if (const auto* v = value_in<int>(a)) return fmt::format("{}", *v);
  if (const auto* v = value_in<Imf::Rational>(a)) return fmt::format("{}/{}", v->n, v->d);
  return {};
}

/// Several numbers; none for another type.
std::optional<std::string> numbers_text(const Imf::Attribute& a) {
  if (const auto* v = value_in<Imath::V2f>(a)) return numbers_of(*v, 2);
  if (const auto* v = value_in<Imath::V2d>(a)) return numbers_of(*v, 2);
  if (const auto* v = value_in<Imath::V2i>(a)) return numbers_of(*v, 2);
  if (const auto* v = value_in<Imath::V3f>(a)) return numbers_of(*v, 3);
  if (const auto* v = value_in<Imath::V3d>(a)) return numbers_of(*v, 3);
  if (const auto* v = value_in<Imath::V3i>(a)) return numbers_of(*v, 3);
  if (const auto* v = value_in<Imath::M33f>(a)) return rows_of(*v, 3);
  if (const auto* v = value_in<Imath::M33d>(a)) return rows_of(*v, 3);
  if (const auto* v = value_in<Imath::M44f>(a)) return rows_of(*v, 4);
  if (const auto* v = value_in<Imath::M44d>(a)) return rows_of(*v, 4);
  if (const auto* v = value_in<Imath::Box2i>(a))
    return fmt::format("({}, {}) to ({}, {})", v->min.x, v->min.y, v->max.x, v->max.y);
  if (const auto* v = value_in<Imf::Chromaticities>(a))
    return fmt::format("red {}, green {}, blue {}, white {}", numbers_of(v->red, 2), numbers_of(v->green, 2),
                       numbers_of(v->blue, 2), numbers_of(v->white, 2));
  return {};
}

std::optional<std::string> text_of(const Imf::Attribute& a) {
  if (const auto* v = value_in<std::string>(a)) return *v;
  if (const auto* v = value_in<Imf::StringVector>(a)) return fmt::format("{}", fmt::join(*v, ", "));
  if (const auto* v = value_in<Imf::Compression>(a)) return compression_name(*v);
  if (const auto* v = value_in<Imf::Envmap>(a))
    return *v == Imf::ENVMAP_LATLONG ? "latlong" : *v == Imf::ENVMAP_CUBE ? "cube" : "unknown";
  if (const auto* v = value_in<Imf::TimeCode>(a))
    return fmt::format("{:02}:{:02}:{:02}:{:02}", v->hours(), v->minutes(), v->seconds(), v->frame());
  if (const auto number = number_text(a)) return number;
  return numbers_text(a);
}

std::string cut(const std::string& text) {
  return text.size() <= longest ? text : fmt::format("{} ... ({} bytes)", text.substr(0, longest), text.size());
}

std::string part_name(const Imf::Header& header, int part) {
  return header.hasName() ? header.name() : fmt::format("part {}", part);
}

}  // namespace

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

std::vector<std::pair<std::string, std::string>> attribute_texts(const Headers& headers) {
  std::vector<std::pair<std::string, std::string>> texts;
  std::map<std::string, std::string> of_first;
  for (int part = 0; part < headers.parts(); ++part) {
    const Imf::Header& header = headers.of_part(part);
    const std::string before = part > 0 ? part_name(header, part) + ": " : "";
    for (auto a = header.begin(); a != header.end(); ++a) {
      const std::optional<std::string> text = text_of(a.attribute());
      if (!text || (part > 0 && of_first.count(a.name()) && of_first[a.name()] == *text)) continue;
      if (part == 0) of_first[a.name()] = *text;
      texts.emplace_back(before + a.name(), cut(*text));
    }
  }
  return texts;
}

}  // namespace gloam
