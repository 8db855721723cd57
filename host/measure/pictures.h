// Pictures of the measured images, for the report.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gloam/frame.h"
#include "measure/measures.h"

namespace gloam::bench {

/// A name that is safe in files and addresses: letters, digits, '.', '_' and '-' stay, '+' becomes "plus", any run of other
/// characters one '-', after which eight digits at the end tell such names apart, unless it was a space alone.
std::string file_name(const std::string& name);

/// "images/gallery_indirect": where the pictures of an effect on a scene lie, below the folder of the results.
std::string picture_folder(const std::string& scene, const std::string& effect);

/// The first view that all of these images have, else the first. Null images do not count.
const View& pictured_view(const Frame& frame, const std::vector<const Image*>& images);

/// Makes the folder of a path that lies below another. Throws Error naming it.
void make_folder_of(const std::filesystem::path& folder, const std::string& path);

/// The mean of a plane's components as an 8-bit PNG of grey and alpha, background transparent: `white` is drawn as white. Throws Error
/// naming `path`.
void write_grey(const std::filesystem::path& path, const Plane& plane, const Channel& depth, double white);

/// The value to draw as white: 1 for shares; of light what 99 of 100 surfaces are below, so that a lamp does not make the rest black.
double white_of(const Plane& plane, const Channel& depth);

}  // namespace gloam::bench
