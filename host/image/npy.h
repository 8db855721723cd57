// NumPy's files: NPY, one array, and NPZ, a ZIP archive of some.
#pragma once

#include <string>
#include <vector>

#include "image/image_values.h"

namespace gloam {

/// https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html. Throws Error, one line beginning with `name`.
ImageValues image_of_npy(const std::string& bytes, const std::string& name, long long most_pixels);

/// The arrays of an archive, stored or deflated, that may be images. Throws Error, one line beginning with `name`.
std::vector<ImageValues> images_of_npz(const std::string& bytes, const std::string& name, long long most_pixels);

}  // namespace gloam
