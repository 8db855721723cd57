// What an EXR file holds, as a hash that another compression, or another version of zlib, does not change.
#pragma once

#include <filesystem>
#include <string>

namespace gloam::sets {

/// SHA-256 over the parts of the file in order: names and values of the attributes, sorted by name, but for those of storage
/// (compression, order of lines, chunks, tiles); names and types of the channels; their values, row by row, little-endian. Throws
/// Error naming the file if it is missing or damaged.
std::string content_hash(const std::filesystem::path& file);

}  // namespace gloam::sets
