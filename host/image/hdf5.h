// HDF5, by libhdf5.
#pragma once

#include <filesystem>
#include <vector>

#include "image/image_values.h"

namespace gloam {

/// The data sets of a file that may be images. Throws Error naming the file, also where libhdf5 is not installed, or was not when gloam was
/// built.
std::vector<ImageValues> images_of_hdf5(const std::filesystem::path& file, long long most_pixels);

}  // namespace gloam
