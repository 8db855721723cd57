#include "fuzz/exr_damage.h"

#include <algorithm>
#include <cstring>

#include "fuzz/exr_bytes.h"
#include "fuzz/exr_made.h"
#include "fuzz/target.h"
#include "fuzz/words.h"

namespace gloam::fuzz {
namespace {

using Change = void (*)(ExrBytes& file, Random& random);

ExrHeader& any_header(ExrBytes& file, Random& random) { return file.headers[random.below(file.headers.size())]; }

ExrAttribute* find(ExrHeader& header, const std::string& name) {
  const auto found = std::find_if(header.begin(), header.end(), [&](const ExrAttribute& a) { return a.name == name; });
  return found == header.end() ? nullptr : &*found;
}

// --- Attributes

/// Overwrites four or eight bytes of a value at a position where such a number may be.
void set_number_in(std::string& value, const std::string& number, Random& random) {
  if (value.size() >= number.size())
    value.replace(random.below(value.size() / number.size()) * number.size(), number.size(), number);
}

void damage_value(ExrAttribute& attribute, Random& random) {
  const std::string& type = attribute.type;
  if (random.one_in(4)) {
    attribute.value = mutated(attribute.value);
  } else if (type == "string") {
    attribute.value = odd_word(random);
  } else if (type == "m44d" || type == "v3d" || type == "double") {
    set_number_in(attribute.value, bytes_of(odd_number(random)), random);
  } else if (type == "m44f" || type == "v2f" || type == "float") {
    set_number_in(attribute.value, bytes_of(float(odd_number(random))), random);
  } else if (type == "compression" || type == "lineOrder") {
    attribute.value = bytes_of(char(random.below(12)));
  } else {
    set_number_in(attribute.value, bytes_of(odd_whole_number(random)), random);
  }
}

void change_attribute(ExrBytes& file, Random& random) {
  ExrHeader& header = any_header(file, random);
  if (!header.empty()) damage_value(header[random.below(header.size())], random);
}

void remove_attribute(ExrBytes& file, Random& random) {
  ExrHeader& header = any_header(file, random);
  if (!header.empty()) header.erase(header.begin() + std::ptrdiff_t(random.below(header.size())));
}

void rename_attribute(ExrBytes& file, Random& random) {
  ExrHeader& header = any_header(file, random);
  if (header.empty()) return;
  ExrAttribute& attribute = header[random.below(header.size())];
  if (random.one_in(4)) attribute.type = random.pick({"float", "double", "string", "m44f", "box2i", "int", "v3d", ""});
  if (random.one_in(2)) attribute.name = random.pick(view_words()) + "." + attribute.name;
}

/// Files whose attributes others may get.
const std::vector<std::string>& lenders() {
  static const std::vector<std::string> files = [] {
    Random random(2);
    std::vector<std::string> made;
    for (int i = 0; i < 64; ++i) made.push_back(made_exr(random));
    return made;
  }();
  return files;
}

/// Takes an attribute from another file, or from another part.
void take_attribute(ExrBytes& file, Random& random) {
  const std::optional<ExrBytes> other = random.one_in(2) ? take_apart(random.pick(lenders())) : file;
  const ExrHeader& from = random.pick(other->headers);
  if (from.empty()) return;
  const ExrAttribute taken = from[random.below(from.size())];
  ExrHeader& header = any_header(file, random);
  if (ExrAttribute* same = find(header, taken.name); same && !random.one_in(4))
    *same = taken;
  else
    header.push_back(taken);
}

// --- Attributes of all headers

void move_window(ExrBytes& file, Random& random) {
  ExrAttribute* window = find(any_header(file, random), random.pick({"dataWindow", "displayWindow"}));
  if (!window || window->value.size() != 16) return;
  int32_t corners[4];
  std::memcpy(corners, window->value.data(), 16);
  const size_t i = random.below(4);
  corners[i] = random.one_in(2) ? odd_whole_number(random) : int32_t(int64_t(corners[i]) + random.between(-4, 4));
  std::memcpy(window->value.data(), corners, 16);
}

void change_tiles(ExrBytes& file, Random& random) {
  ExrHeader& header = any_header(file, random);
  ExrAttribute* tiles = find(header, "tiles");
  if (!tiles) header.push_back({"tiles", "tiledesc", std::string(9, '\1')}), tiles = &header.back();
  if (tiles->value.size() != 9) return;
  if (random.one_in(4)) tiles->value[8] = char(random.next());
  if (random.one_in(2)) tiles->value.replace(random.below(2) * 4, 4, bytes_of(odd_whole_number(random)));
}

void change_type(ExrBytes& file, Random& random) {
  ExrAttribute* type = find(any_header(file, random), "type");
  const std::string value = random.pick({"scanlineimage", "tiledimage", "deepscanline", "deeptile", "none"});
  if (type)
    type->value = value;
  else
    any_header(file, random).push_back({"type", "string", value});
}

void change_flags(ExrBytes& file, Random& random) {
  if (random.one_in(4))
    file.start = mutated(file.start, 0);
  else if (file.start.size() > 5)
    file.start[5] = char(file.start[5] ^ (2 << random.below(4)));
}

void change_parts(ExrBytes& file, Random& random) {
  const ExrHeader copy = any_header(file, random);
  const auto at = file.headers.begin() + std::ptrdiff_t(random.below(file.headers.size()));
  if (random.one_in(2))
    file.headers.insert(at, copy);
  else if (file.headers.size() > 1)
    file.headers.erase(at);
}

// --- Channels

std::string other_name(const std::string& name, Random& random) {
  const size_t dot = name.rfind('.');
  const std::string layer = dot == std::string::npos ? "" : name.substr(0, dot);
  switch (random.below(4)) {
    case 0:
      return odd_word(random);
    case 1:
      return random.pick(layer_words()) + "." + name;
    case 2:
      return random.pick(view_words()) + "." + name;
    default:
      return (layer.empty() ? "" : layer + ".") + random.pick(channel_words());
  }
}

void change_channels(ExrBytes& file, Random& random) {
  ExrAttribute* list = find(any_header(file, random), "channels");
  if (!list) return;
  std::vector<ExrChannel> channels = channels_of(list->value);
  if (channels.empty()) return;
  const size_t i = random.below(channels.size());
  switch (random.below(6)) {
    case 0:
      channels.erase(channels.begin() + std::ptrdiff_t(i));
      break;
    case 1:
      channels.insert(channels.begin() + std::ptrdiff_t(i), channels[i]);
      break;
    case 2:
      channels[i].type = random.one_in(4) ? odd_whole_number(random) : int(random.below(3));
      break;
    case 3:
      channels[i].rest.replace(4 + 4 * random.below(2), 4, bytes_of(odd_whole_number(random)));
      break;
    default:
      channels[i].name = other_name(channels[i].name, random);
  }
  // OpenEXR writes them sorted by name.
  if (!random.one_in(8))
    std::stable_sort(channels.begin(), channels.end(), [](auto& a, auto& b) { return a.name < b.name; });
  list->value = value_of(channels);
}

// --- The rest

void damage_tables(ExrBytes& file, Random& random) {
  if (random.one_in(2))
    file.tables = mutated(file.tables, 0);
  else
    set_number_in(file.tables, bytes_of(uint64_t(random.one_in(2) ? random.below(4096) : random.next())), random);
}

void damage_chunks(ExrBytes& file, Random& random) {
  if (random.one_in(2))
    file.chunks = mutated(file.chunks, 4);
  else
    set_number_in(file.chunks, bytes_of(odd_whole_number(random)), random);
}

void cut_short(ExrBytes& file, Random& random) { file.chunks.resize(random.below(file.chunks.size() + 1)); }

}  // namespace

std::string damaged_exr(const std::string& bytes, Random& random) {
  if (random.one_in(64)) return made_exr(random);
  std::optional<ExrBytes> file = take_apart(bytes);
  if (!file || random.one_in(8)) return mutated(bytes);
  const Change change =
      random.pick<Change>({change_attribute, change_attribute, change_attribute, remove_attribute, rename_attribute,
                           take_attribute,   take_attribute,   move_window,      move_window,      change_tiles,
                           change_type,      change_flags,     change_parts,     change_channels,  change_channels,
                           change_channels,  damage_tables,    damage_chunks,    damage_chunks,    cut_short});
  change(*file, random);
  return file->text();
}

}  // namespace gloam::fuzz
