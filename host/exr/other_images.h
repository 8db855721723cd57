// Frames of images in other formats than EXR: they become an EXR file in memory, which is read as any other.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "exr/stream.h"
#include "gloam/exr.h"

namespace gloam {

/// Opens the file of a frame. An image of another format, and planes of files of their own (`ReadOptions::plane_files`), are brought to one
/// EXR file in memory, with gloam's channels where the plane is known, and with the arrays' names where a file has named arrays. Values stay
/// as stored, but:
/// - whole numbers of planes from 0 to 1 and of unit vectors are divided by their type's largest; so is depth that is stated as a share of
///   the depth range (ndc, reversed);
/// - colours in whole numbers are decoded from sRGB;
/// - depth in three bytes becomes a share of 2^24 - 1.
/// A file that is named for disparities has inverse depth, which `options` then say, unless they state another.
/// `notes` gets a sentence for each of these. Throws Error naming the file that is at fault.
std::unique_ptr<ExrInput> open_input(const std::filesystem::path& path, ReadOptions& options,
                                     std::vector<std::string>& notes);

}  // namespace gloam
