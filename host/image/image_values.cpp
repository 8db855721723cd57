#include "image/image_values.h"

#include <algorithm>

#include "base/words.h"
#include "gloam/error.h"
#include "image/file_bytes.h"
#include "image/float_pictures.h"
#include "image/hdf5.h"
#include "image/npy.h"
#include "image/png_values.h"
#include "image/tiff.h"

namespace gloam {
namespace {

namespace fs = std::filesystem;

std::vector<ImageValues> one(ImageValues image) {
  std::vector<ImageValues> images;
  images.push_back(std::move(image));
  return images;
}

ImageValues image_of_png(const fs::path& file, long long most_pixels) {
  const auto check = [&](const PngSize& size) {
    if ((long long)size.width * size.height > most_pixels)
      throw Error("{}: has {}x{} pixels; {} are read at most", file.string(), size.width, size.height, most_pixels);
  };
  PngValues values = read_png_values(file, check, PngAlpha::kept);
  ImageValues image;
  image.type = values.bits == 16 ? "uint16" : "uint8";
  image.largest = values.largest;
  image.channels = std::move(values.channels);
  return image;
}

using ReadFile = std::vector<ImageValues> (*)(const fs::path&, long long);

struct Format {
  const char* name;
  std::vector<std::string> endings;
  bool holds_arrays;
  ReadFile read;
};

template <ImageValues (*decode)(const std::string&, const std::string&, long long)>
std::vector<ImageValues> decoded(const fs::path& file, long long most_pixels) {
  return one(decode(bytes_of_image(file, most_pixels), file.string(), most_pixels));
}

const std::vector<Format>& formats() {
  static const std::vector<Format> all = {
      {"PNG", {".png"}, false, [](const fs::path& file, long long most) { return one(image_of_png(file, most)); }},
      {"TIFF", {".tif", ".tiff"}, false, decoded<image_of_tiff>},
      {"PFM", {".pfm"}, false, decoded<image_of_pfm>},
      {"Radiance HDR", {".hdr", ".pic"}, false, decoded<image_of_hdr>},
      {"NPY", {".npy"}, false, decoded<image_of_npy>},
      {"NPZ",
       {".npz"},
       true,
       [](const fs::path& file, long long most) {
         return images_of_npz(bytes_of_image(file, most), file.string(), most);
       }},
      {"HDF5", {".hdf5", ".h5"}, true, images_of_hdf5}};
  return all;
}

const Format* format_of(const fs::path& file) {
  const std::string ending = lower(file.extension().string());
  for (const Format& format : formats())
    if (std::count(format.endings.begin(), format.endings.end(), ending)) return &format;
  return nullptr;
}

}  // namespace

void check_image_size(unsigned long long width, unsigned long long height, const std::string& name,
                      long long most_pixels) {
  constexpr unsigned long long longest = 1ull << 30;
  const bool is_sane = width > 0 && height > 0 && width < longest && height < longest;
  const auto most = (unsigned long long)most_pixels;
  // Rows are padded: an image of one column takes the memory of sixteen.
  if (is_sane && width <= most / height && (width + 15) / 16 * 16 <= 4 * most / height) return;
  throw Error("{}: has {}x{} pixels; 1 to {} are read, with rows padded to multiples of 16", name, width, height,
              most_pixels);
}

void check_all_sizes(const std::vector<ImageValues>& images, const std::string& name, long long most_pixels) {
  constexpr size_t most_components = 16;
  size_t all = 0;
  for (const ImageValues& image : images) all += image.channels.size() * image.layout().count();
  if (all > most_components * (size_t(most_pixels) + 4096))
    throw Error("{}: its arrays hold more than {} components of {} pixels; keep those of one frame", name,
                most_components, most_pixels);
}

std::string image_formats() {
  std::vector<std::string> names;
  for (const Format& format : formats()) names.emplace_back(format.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

bool is_image_file(const fs::path& file) { return format_of(file) != nullptr; }

bool holds_arrays(const fs::path& file) {
  const Format* format = format_of(file);
  return format && format->holds_arrays;
}

std::vector<ImageValues> read_images(const fs::path& file, long long most_pixels) {
  const Format* format = format_of(file);
  if (!format) throw Error("{}: ends as no image that is read; EXR, {} are", file.string(), image_formats());
  std::vector<ImageValues> images = format->read(file, most_pixels);
  if (images.empty())
    throw Error("{}: holds no array of numbers that is an image: (height, width), or up to 4 components as well",
                file.string());
  return images;
}

}  // namespace gloam
