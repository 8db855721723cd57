// The values of an image in a file of any format but EXR: PNG, TIFF, PFM, Radiance HDR, NPY, NPZ, HDF5.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "gloam/frame.h"

namespace gloam {

struct ImageValues {
  std::string name;               ///< of an array in a file of several ("depth"); else empty
  std::string type;               ///< of a value: "uint8", "uint16", "float32", ...
  double largest = 0;             ///< what a whole number of 8 or 16 bits without a sign ends at; 0: no such type
  std::vector<Channel> channels;  ///< 1 to 4, row 0 at the top, values as stored
  const Layout& layout() const { return channels.front().layout(); }
};

/// Throws Error, beginning with `name`, for an image without pixels, or of more than `most_pixels`, with the padding of its rows.
void check_image_size(unsigned long long width, unsigned long long height, const std::string& name,
                      long long most_pixels);

/// Throws Error, beginning with `name`, if the images of a file take more together than a few of `most_pixels`.
void check_all_sizes(const std::vector<ImageValues>& images, const std::string& name, long long most_pixels);

/// The formats in words: "PNG, TIFF, ...".
std::string image_formats();

/// Whether a file's name ends as one of these formats does.
bool is_image_file(const std::filesystem::path& file);

/// Whether a file of this name may hold several arrays, each with a name: NPZ, HDF5.
bool holds_arrays(const std::filesystem::path& file);

/// The images of a file: one, or of NPZ and HDF5 every array of 2 or 3 dimensions that may be an image. Arrays may be (H, W), (H, W, C),
/// (C, H, W) with C up to 4, and have further dimensions of 1. The format is told by the ending. Throws Error, one line naming the file,
/// for a file that cannot be read, is damaged, holds no image or one of more than `most_pixels`, and for a format that this build leaves out.
std::vector<ImageValues> read_images(const std::filesystem::path& file, long long most_pixels);

}  // namespace gloam
