// The bytes of a file of an image, all at once.
#pragma once

#include <filesystem>
#include <string>

namespace gloam {

/// Throws Error naming the file if it is missing, no regular file, or larger than an image of `most_pixels` can be.
std::string bytes_of_image(const std::filesystem::path& file, long long most_pixels);

}  // namespace gloam
