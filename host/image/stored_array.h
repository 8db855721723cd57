// An array of numbers as a file stores it, and the image that it is.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "image/image_values.h"

namespace gloam {

/// Numbers one after another, the last dimension fastest.
struct StoredArray {
  char kind = 'f';   ///< as NumPy names it: 'b' bool, 'i' signed, 'u' unsigned, 'f' floating point
  size_t bytes = 4;  ///< of a number: 1, 2, 4, 8
  bool is_big_endian = false;
  bool is_column_major = false;  ///< the first dimension is the fastest
  std::vector<size_t> shape;
  std::vector<unsigned char> values;
};

/// Whether numbers of this type can be read.
bool is_known_type(char kind, size_t bytes);

/// Whether an array of this shape may be an image: (H, W), (H, W, C) or (C, H, W), C up to 4, besides dimensions of 1.
bool is_image_shape(const std::vector<size_t>& shape);

/// Number of values of a shape; none if it is more than `most`.
bool count_of(const std::vector<size_t>& shape, unsigned long long most, size_t& count);

/// Brings an array to channels. Throws Error, beginning with `name`, if its shape is that of no image or has more than `most_pixels`.
ImageValues image_of(const StoredArray& array, const std::string& name, long long most_pixels);

}  // namespace gloam
