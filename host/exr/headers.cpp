#include "exr/headers.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfStandardAttributes.h>

#include "base/lists.h"
#include "exr/added_parts.h"
#include "exr/attributes.h"
#include "exr/validation.h"

namespace gloam {
namespace {

std::string type_name(Imf::PixelType type) {
  return type == Imf::HALF ? "half" : type == Imf::FLOAT ? "float" : "uint";
}

std::vector<std::string> listed_views_of(const Imf::MultiPartInputFile& file) {
  for (int part = 0; part < file.parts(); ++part)
    if (Imf::hasMultiView(file.header(part))) return Imf::multiView(file.header(part));
  return {};
}

}  // namespace

Headers::Headers(const Imf::MultiPartInputFile& file) : file_(&file), listed_views_(listed_views_of(file)) {
  find_views();
}

/// Uses the names of parts ("left", "beauty_right") if no part has the attribute `view` and both eyes have parts.
void Headers::find_views() {
  std::vector<std::string> eyes;
  bool is_declared = !listed_views_.empty();
  for (int part = 0; part < parts(); ++part) {
    const Imf::Header& header = of_part(part);
    is_declared = is_declared || header.hasView();
    part_views_.push_back(header.hasView() ? header.view() : "");
    eyes.push_back(header.hasName() ? eye_in_name(header.name()) : "");
  }
  has_views_by_part_names_ = !is_declared && contains(eyes, "left") && contains(eyes, "right");
  if (has_views_by_part_names_) part_views_ = eyes;
}

const Imf::Header& Headers::of_view(const std::string& view) const {
  for (int part = 0; part < parts(); ++part)
    if (!view.empty() && view_of_part(part) == view && !is_added_part(of_part(part))) return of_part(part);
  return of_part(0);
}

std::vector<AttributePlace> Headers::places_of(const std::string& view) const {
  std::vector<AttributePlace> places;
  for (int part = 0; part < parts(); ++part) {
    if (!view.empty()) places.push_back({&of_part(part), view + "."});
    const std::string& own = view_of_part(part);
    if (!own.empty() && own != view) continue;
    // Attributes without a view's name are those of the part's view, or of the default view.
    if (own.empty() && !listed_views_.empty() && listed_views_.front() != view) continue;
    places.push_back({&of_part(part), ""});
  }
  return places;
}

std::vector<FileChannel> Headers::channels() const {
  std::vector<FileChannel> channels;
  for (int part = 0; part < parts(); ++part) {
    const Imf::Header& header = of_part(part);
    if (is_deep(header)) continue;
    const std::string name = header.hasName() ? header.name() : "";
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c)
      channels.push_back({part, view_of_part(part), name, c.name(), type_name(c.channel().type)});
  }
  return channels;
}

std::optional<double> Headers::number(const std::string& name) const {
  for (int part = 0; part < parts(); ++part)
    if (const auto value = number_attribute(of_part(part), name)) return value;
  return {};
}

std::string Headers::text(const std::string& name) const {
  for (int part = 0; part < parts(); ++part)
    if (std::string value = text_attribute(of_part(part), name); !value.empty()) return value;
  return "";
}

std::string Headers::text_for_part(int part, const std::string& name) const {
  if (is_added_part(of_part(part))) return text_attribute(of_part(part), name);
  for (int other = 0; other < parts(); ++other) {
    if (is_added_part(of_part(other))) continue;
    if (std::string value = text_attribute(of_part(other), name); !value.empty()) return value;
  }
  return "";
}

bool Headers::has(const std::string& name) const {
  for (int part = 0; part < parts(); ++part)
    if (of_part(part).find(name.c_str()) != of_part(part).end()) return true;
  return false;
}

}  // namespace gloam
