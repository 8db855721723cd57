// An image of a submission as its file stores it.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "gloam/exr.h"
#include "measure/measures.h"

namespace gloam::score {

struct StoredImage {
  bench::Image image;  ///< stored values, by the view's name
  int width = 0, height = 0;
  double largest = 0;  ///< the value that a PNG's type ends at; 0: an EXR, which has no largest
};

/// The views that a file is for: those of the frame, or one of them that the file's name ends in.
struct ImageRequest {
  std::filesystem::path file;
  std::string effect;
  std::vector<std::string> views;
  ReadOptions reading;  ///< channels: --plane
  /// Called before pixels are decoded, with the image's size and the bytes that reading it takes. Throws Error for one that is not read.
  std::function<void(int width, int height, unsigned long long bytes)> check;
};

/// Reads an EXR or a PNG of 8 or 16 bits. An EXR gives the effect's plane, else red, green and blue, Y, or its only channel; for an effect
/// of one value, colours have to be grey. Throws Error naming the file: it cannot be read, holds no such channels or views.
StoredImage read_stored(const ImageRequest& request);

/// Whether a file's name ends in .exr or .png.
bool is_image_name(const std::filesystem::path& file);

}  // namespace gloam::score
