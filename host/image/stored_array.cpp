#include "image/stored_array.h"

#include <Imath/half.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "gloam/error.h"

namespace gloam {
namespace {

constexpr size_t most_components = 4;

/// Height, width and components, and how far apart neighbours of each lie.
struct ImageShape {
  size_t size[3] = {}, step[3] = {};
};

/// The shape without dimensions of 1, but for an image of one row or column: (1, H, W, 1) is (H, W). `kept`: which are left.
std::vector<size_t> kept_dimensions(const std::vector<size_t>& shape) {
  std::vector<size_t> kept;
  for (size_t i = 0; i < shape.size(); ++i) kept.push_back(i);
  for (size_t i = 0; i < kept.size() && kept.size() > 2;) {
    if (shape[kept[i]] == 1)
      kept.erase(kept.begin() + std::ptrdiff_t(i));
    else
      ++i;
  }
  return kept;
}

bool find_shape(const std::vector<size_t>& shape, bool is_column_major, ImageShape& found) {
  std::vector<size_t> steps(shape.size(), 1);
  if (is_column_major)
    for (size_t i = 1; i < shape.size(); ++i) steps[i] = steps[i - 1] * shape[i - 1];
  else
    for (size_t i = shape.size(); i-- > 1;) steps[i - 1] = steps[i] * shape[i];
  std::vector<size_t> kept = kept_dimensions(shape);
  if (kept.size() < 2 || kept.size() > 3) return false;
  const auto set = [&](int to, size_t from) { found.size[to] = shape[from], found.step[to] = steps[from]; };
  if (kept.size() == 2) {
    set(0, kept[0]), set(1, kept[1]);
    found.size[2] = 1;
  } else if (shape[kept[2]] <= most_components) {
    set(0, kept[0]), set(1, kept[1]), set(2, kept[2]);
  } else if (shape[kept[0]] <= most_components) {
    set(0, kept[1]), set(1, kept[2]), set(2, kept[0]);
  } else {
    return false;
  }
  return found.size[0] > 0 && found.size[1] > 0 && found.size[2] > 0;
}

template <typename Integer>
Integer loaded(const unsigned char* from, bool is_big_endian) {
  Integer value = 0;
  for (size_t i = 0; i < sizeof(Integer); ++i) {
    const size_t place = is_big_endian ? sizeof(Integer) - 1 - i : i;
    value = Integer(value | Integer(Integer(from[i]) << (8 * place)));
  }
  return value;
}

template <typename Float, typename Integer>
float as_float(Integer bits) {
  Float value;
  std::memcpy(static_cast<void*>(&value), &bits, sizeof value);
  return float(value);
}

template <typename Integer, typename Signed, typename Float>
void convert(const StoredArray& array, const ImageShape& shape, size_t component, Channel& channel) {
  for (size_t y = 0; y < shape.size[0]; ++y) {
    const unsigned char* from = array.values.data() + (y * shape.step[0] + component * shape.step[2]) * sizeof(Integer);
    float* row = channel.row(int(y));
    for (size_t x = 0; x < shape.size[1]; ++x) {
      const Integer bits = loaded<Integer>(from + x * shape.step[1] * sizeof(Integer), array.is_big_endian);
      row[x] = array.kind == 'f' ? as_float<Float>(bits) : array.kind == 'i' ? float(Signed(bits)) : float(bits);
    }
  }
}

std::string type_name(char kind, size_t bytes) {
  if (kind == 'b') return "bool";
  return fmt::format("{}{}", kind == 'f' ? "float" : kind == 'i' ? "int" : "uint", 8 * bytes);
}

}  // namespace

bool is_known_type(char kind, size_t bytes) {
  if (kind == 'b') return bytes == 1;
  if (kind == 'f') return bytes == 2 || bytes == 4 || bytes == 8;
  return (kind == 'i' || kind == 'u') && (bytes == 1 || bytes == 2 || bytes == 4 || bytes == 8);
}

bool is_image_shape(const std::vector<size_t>& shape) {
  ImageShape found;
  return find_shape(shape, false, found);
}

bool count_of(const std::vector<size_t>& shape, unsigned long long most, size_t& count) {
  count = 1;
  for (size_t size : shape) {
    if (size != 0 && count > most / size) return false;
    count *= size;
  }
  return true;
}

ImageValues image_of(const StoredArray& array, const std::string& name, long long most_pixels) {
  ImageShape shape;
  if (!find_shape(array.shape, array.is_column_major, shape))
    throw Error("{}: is an array of shape ({}); an image is (height, width), or has up to {} components as well", name,
                fmt::join(array.shape, ", "), most_components);
  check_image_size(shape.size[1], shape.size[0], name, most_pixels);
  ImageValues image;
  image.type = type_name(array.kind, array.bytes);
  if (array.kind == 'u' && array.bytes <= 2) image.largest = array.bytes == 1 ? 255 : 65535;
  if (array.kind == 'b') image.largest = 1;
  for (size_t c = 0; c < shape.size[2]; ++c) {
    Channel& channel = image.channels.emplace_back(Layout(int(shape.size[1]), int(shape.size[0])), 0.0f);
    switch (array.bytes) {
      case 1:
        convert<uint8_t, int8_t, uint8_t>(array, shape, c, channel);
        break;
      case 2:
        convert<uint16_t, int16_t, Imath::half>(array, shape, c, channel);
        break;
      case 4:
        convert<uint32_t, int32_t, float>(array, shape, c, channel);
        break;
      default:
        convert<uint64_t, int64_t, double>(array, shape, c, channel);
    }
  }
  return image;
}

}  // namespace gloam
