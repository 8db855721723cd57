// Cryptomatte: layers of IDs and coverage, which their header's attributes name (cryptomatte/<id>/name, hash, conversion, manifest). They are
// copied with their file, and read for nothing.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gloam {

/// Whether an attribute describes a Cryptomatte. It is of no use without the channels.
bool is_of_cryptomatte(const std::string& attribute);

struct Cryptomatte {
  std::string name;                   ///< "ViewLayer.CryptoObject"
  std::vector<std::string> channels;  ///< of all its layers: "ViewLayer.CryptoObject00.R"
  bool is_whole = true;               ///< all stored as 32-bit floats: others lose the IDs
};

/// Those that the attributes name, with the channels that the file has of them.
std::vector<Cryptomatte> cryptomattes_of(const std::filesystem::path& file);

}  // namespace gloam
