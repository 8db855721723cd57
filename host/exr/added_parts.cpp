#include "exr/added_parts.h"

namespace gloam {
namespace {

constexpr const char* prefix = "gloam.";

}  // namespace

std::string added_part_name(const std::string& content, const std::string& view) {
  return prefix + content + (view.empty() ? "" : "." + view);
}

bool is_added_part(const Imf::Header& header) { return header.hasName() && header.name().starts_with(prefix); }

bool is_added_for(const Imf::Header& header, const std::string& content) {
  if (!header.hasName()) return false;
  const std::string name = added_part_name(content, "");
  return header.name() == name || header.name().starts_with(name + ".");
}

}  // namespace gloam
