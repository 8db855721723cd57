#include "image/npy.h"

#include <libdeflate.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <memory>
#include <string_view>

#include "gloam/error.h"
#include "image/stored_array.h"

namespace gloam {
namespace {

constexpr std::string_view npy_magic = "\x93NUMPY";
/// Of a header's text: far more than the shape of an image takes.
constexpr size_t longest_header = 1 << 16;
constexpr size_t most_dimensions = 8;

[[noreturn]] void refuse_array(const std::string& name, const std::string& why) {
  throw Error("{}: cannot be read as NPY: {}", name, why);
}

unsigned long long little_endian(std::string_view bytes, size_t at, size_t count) {
  unsigned long long value = 0;
  for (size_t i = 0; i < count; ++i) value |= (unsigned long long)(unsigned char)bytes[at + i] << (8 * i);
  return value;
}

/// What follows a key of the header's dictionary; empty if there is no such key.
std::string_view value_of_key(std::string_view header, const std::string& key) {
  for (const char* quote : {"'", "\""}) {
    const size_t found = header.find(quote + key + quote);
    if (found == std::string_view::npos) continue;
    size_t at = found + key.size() + 2;
    while (at < header.size() && (header[at] == ':' || header[at] == ' ')) ++at;
    return header.substr(at);
  }
  return {};
}

std::vector<size_t> shape_in(std::string_view text, const std::string& name) {
  const size_t end = text.find(')');
  if (text.empty() || text.front() != '(' || end == std::string_view::npos) refuse_array(name, "its shape is none");
  std::vector<size_t> shape;
  for (size_t at = 1; at < end;) {
    if (!std::isdigit((unsigned char)text[at])) {
      ++at;
      continue;
    }
    size_t size = 0;
    for (; at < end && std::isdigit((unsigned char)text[at]); ++at) {
      if (size > (size_t(1) << 40)) refuse_array(name, "its shape is too large");
      size = 10 * size + size_t(text[at] - '0');
    }
    shape.push_back(size);
  }
  if (shape.size() > most_dimensions) refuse_array(name, "it has too many dimensions");
  return shape;
}

void take_type(std::string_view text, const std::string& name, StoredArray& array) {
  const std::string_view word = text.size() > 1 ? text.substr(1, text.find_first_of("'\"", 1) - 1) : text;
  const bool is_plain = word.size() == 3 && std::strchr("<>|=", word[0]) && std::isdigit((unsigned char)word[2]);
  if (is_plain) {
    array.is_big_endian = word[0] == '>';
    array.kind = word[1];
    array.bytes = size_t(word[2] - '0');
  }
  if (!is_plain || !std::strchr("biuf", array.kind) || !is_known_type(array.kind, array.bytes))
    refuse_array(name, fmt::format("its type is {}; bool, whole numbers and floats of 16 to 64 bits are read",
                                   printable(std::string(word.substr(0, 40)))));
}

StoredArray array_in(std::string_view bytes, const std::string& name, long long most_pixels) {
  if (bytes.size() < 12 || bytes.substr(0, npy_magic.size()) != npy_magic) refuse_array(name, "it is none");
  const size_t length_bytes = bytes[6] == 1 ? 2 : 4, begin = 8 + length_bytes;
  const size_t length = size_t(little_endian(bytes, 8, length_bytes));
  if (length > longest_header || length > bytes.size() - begin) refuse_array(name, "its header is cut off");
  const std::string_view header = bytes.substr(begin, length);
  StoredArray array;
  take_type(value_of_key(header, "descr"), name, array);
  array.is_column_major = value_of_key(header, "fortran_order").starts_with("True");
  array.shape = shape_in(value_of_key(header, "shape"), name);
  size_t count = 0;
  const std::string_view values = bytes.substr(begin + length);
  if (!count_of(array.shape, 4 * (unsigned long long)most_pixels, count))
    throw Error("{}: is an array of shape ({}); images of {} pixels are read at most", name,
                fmt::join(array.shape, ", "), most_pixels);
  if (values.size() / array.bytes < count) refuse_array(name, "it ends too early");
  array.values.assign(values.begin(), values.begin() + std::ptrdiff_t(count * array.bytes));
  return array;
}

/// An archive's entry, from the directory at its end (PKWARE, APPNOTE 6.3.10, 4.3.12).
struct ArchiveEntry {
  std::string name;
  unsigned method = 0;
  size_t stored = 0, size = 0, at = 0;
};

[[noreturn]] void refuse_archive(const std::string& name, const char* why) {
  throw Error("{}: cannot be read as NPZ: {}", name, why);
}

std::vector<ArchiveEntry> directory_of(std::string_view bytes, const std::string& name) {
  constexpr size_t end_record = 22, entry_record = 46;
  if (bytes.size() < end_record) refuse_archive(name, "it is no archive");
  const size_t end = bytes.rfind("PK\x05\x06", bytes.size() - end_record);
  if (end == std::string_view::npos) refuse_archive(name, "it is no archive, or is cut off");
  const size_t count = size_t(little_endian(bytes, end + 10, 2));
  size_t at = size_t(little_endian(bytes, end + 16, 4));
  std::vector<ArchiveEntry> entries;
  for (size_t i = 0; i < count; ++i) {
    if (at > bytes.size() || bytes.size() - at < entry_record || bytes.substr(at, 4) != "PK\x01\x02")
      refuse_archive(name, "its directory is damaged");
    const size_t length = size_t(little_endian(bytes, at + 28, 2)), extra = size_t(little_endian(bytes, at + 30, 2)),
                 comment = size_t(little_endian(bytes, at + 32, 2));
    if (bytes.size() - at - entry_record < length) refuse_archive(name, "its directory is damaged");
    entries.push_back({std::string(bytes.substr(at + entry_record, length)), unsigned(little_endian(bytes, at + 10, 2)),
                       size_t(little_endian(bytes, at + 20, 4)), size_t(little_endian(bytes, at + 24, 4)),
                       size_t(little_endian(bytes, at + 42, 4))});
    at += entry_record + length + extra + comment;
  }
  return entries;
}

/// The bytes of an entry. `most`: of what it unpacks to.
std::string unpacked(std::string_view bytes, const ArchiveEntry& entry, size_t most, const std::string& name) {
  constexpr size_t local_record = 30;
  if (entry.at > bytes.size() || bytes.size() - entry.at < local_record) refuse_archive(name, "an entry is cut off");
  const size_t begin = entry.at + local_record + size_t(little_endian(bytes, entry.at + 26, 2)) +
                       size_t(little_endian(bytes, entry.at + 28, 2));
  if (begin > bytes.size() || bytes.size() - begin < entry.stored) refuse_archive(name, "an entry is cut off");
  const std::string_view stored = bytes.substr(begin, entry.stored);
  if (entry.method == 0) return std::string(stored);
  if (entry.method != 8) refuse_archive(name, "an entry is compressed in a way that is not known");
  // No byte of DEFLATE says more than 1032: a size beyond that is a claim.
  if (entry.size > most || entry.size / 1032 > entry.stored + 1) refuse_archive(name, "an entry is too large");
  std::string whole(entry.size, '\0');
  const std::unique_ptr<libdeflate_decompressor, void (*)(libdeflate_decompressor*)> inflate(
      libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
  if (libdeflate_deflate_decompress(inflate.get(), stored.data(), stored.size(), whole.data(), whole.size(), nullptr) !=
      LIBDEFLATE_SUCCESS)
    refuse_archive(name, "an entry is damaged");
  return whole;
}

}  // namespace

ImageValues image_of_npy(const std::string& bytes, const std::string& name, long long most_pixels) {
  return image_of(array_in(bytes, name, most_pixels), name, most_pixels);
}

std::vector<ImageValues> images_of_npz(const std::string& bytes, const std::string& name, long long most_pixels) {
  constexpr std::string_view ending = ".npy";
  std::vector<ImageValues> images;
  for (const ArchiveEntry& entry : directory_of(bytes, name)) {
    if (!entry.name.ends_with(ending)) continue;
    check_all_sizes(images, name, most_pixels);
    const std::string array_name = entry.name.substr(0, entry.name.size() - ending.size());
    const std::string full = fmt::format("{}, array '{}'", name, printable(array_name));
    const std::string whole = unpacked(bytes, entry, size_t(most_pixels) * 32 + longest_header, full);
    const size_t begin = whole.find("'shape'");
    if (begin == std::string::npos || begin > longest_header) continue;  // objects, texts
    // A number, a list, a text beside images: passed over.
    if (!is_image_shape(shape_in(value_of_key(std::string_view(whole).substr(0, longest_header), "shape"), full)))
      continue;
    const std::string_view type = value_of_key(std::string_view(whole).substr(0, longest_header), "descr");
    if (type.size() < 3 || !std::strchr("biuf", type[2])) continue;
    images.push_back(image_of(array_in(whole, full, most_pixels), full, most_pixels));
    images.back().name = array_name;
  }
  return images;
}

}  // namespace gloam
