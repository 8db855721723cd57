// What a written frame was made of, and by what: header attributes by which `--resume` knows it again.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "gloam/frame_files.h"

namespace gloam {

/// All that decides the contents of a frame's file.
struct FrameMaking {
  std::string version;   ///< of the program, and a hash of its kernels
  std::string settings;  ///< technique and flags
  std::string input;     ///< the files read
};

/// "0.1.0 kernels 5d0f...", for the program's own version.
std::string version_with_kernels(const std::string& version);

/// A setting such as "radius=0.5" as it is; one that names a file, "coefficients=FILE", with a hash of what the file holds.
std::string with_hash_of_file(const std::string& setting);

/// "shot.1001.exr, 20511234 bytes, 1764036000.123456789; cameras 1f0c...": name, size and time of the last change of each file,
/// and a hash of the cameras, wherever these come from. Throws Error for a file that is gone.
std::string identity_of(const FrameFiles& files);

/// `gloamVersion`, `gloamSettings` and `gloamInput`.
std::map<std::string, std::string> attributes_of(const FrameMaking& making);

/// Why a frame has to be written again: "it is damaged", "it was made with other settings", ...; empty if the file is whole
/// (every channel decodes) and was made in the same way. "it is not there" for a missing file. `added`: what the file is a copy
/// with (exr_copy.h); empty for a file of its own.
std::string why_again(const std::filesystem::path& file, const FrameMaking& making, const std::string& added = "");

}  // namespace gloam
