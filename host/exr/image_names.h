// What the names of files say of the planes in them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gloam/exr.h"

namespace gloam {

/// The plane that a file's name speaks of: "normal" for "scene_normals_0001.png"; empty if it speaks of none.
std::string plane_in_file_name(const std::filesystem::path& file);

bool is_named_for_disparities(const std::filesystem::path& file);

/// States inverse depth for a file that is named for disparities, unless `options` state what depth is.
void take_name_of_depth(const std::filesystem::path& file, ReadOptions& options, std::vector<std::string>& notes);

/// States the space that the name of a file of normals says, such as WorldNormal or normal_world, unless `options` state one.
void take_space_in_name(const std::filesystem::path& file, ReadOptions& options);

}  // namespace gloam
