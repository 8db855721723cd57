#include "exr/cryptomatte.h"

#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <cctype>

#include "base/lists.h"
#include "exr/file.h"

namespace gloam {
namespace {

constexpr const char* attribute_prefix = "cryptomatte/";
constexpr const char* name_ending = "/name";

/// Whether a channel is of a layer NAME00, NAME01, ...
bool is_of_layer(const std::string& channel, const std::string& name) {
  const std::string layer = channel.substr(0, channel.rfind('.'));
  if (!layer.starts_with(name) || layer.size() == name.size()) return false;
  return std::all_of(layer.begin() + std::ptrdiff_t(name.size()), layer.end(),
                     [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; });
}

/// The names that a part's attributes state.
void add_names(const Imf::Header& header, std::vector<std::string>& names) {
  for (auto attribute = header.begin(); attribute != header.end(); ++attribute) {
    const std::string name = attribute.name();
    const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute());
    if (text && is_of_cryptomatte(name) && name.ends_with(name_ending)) add_new(names, text->value());
  }
}

}  // namespace

bool is_of_cryptomatte(const std::string& attribute) { return attribute.starts_with(attribute_prefix); }

std::vector<Cryptomatte> cryptomattes_of(const std::filesystem::path& file) {
  const ExrFile opened = open_exr(file, {});
  std::vector<std::string> names;
  for (int part = 0; part < opened.headers.parts(); ++part) add_names(opened.headers.of_part(part), names);
  std::vector<Cryptomatte> found;
  for (const std::string& name : names) {
    Cryptomatte& made = found.emplace_back(Cryptomatte{name, {}, true});
    for (const FileChannel& channel : opened.headers.channels()) {
      if (!is_of_layer(channel.name, name)) continue;
      made.channels.push_back(channel.name);
      made.is_whole &= channel.type == "float";
    }
  }
  return found;
}

}  // namespace gloam
