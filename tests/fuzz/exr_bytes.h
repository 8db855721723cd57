// An EXR file split into headers, tables and chunks, and joined again, valid or not.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace gloam::fuzz {

struct ExrAttribute {
  std::string name, type, value;
};

using ExrHeader = std::vector<ExrAttribute>;

/// The bytes of a file. Offsets in the tables are moved with the headers when these change their size.
struct ExrBytes {
  std::string start;  ///< magic number and version
  std::vector<ExrHeader> headers;
  std::string tables, chunks;

  bool is_multipart() const;
  std::string text() const;
};

/// None if the headers do not end.
std::optional<ExrBytes> take_apart(const std::string& bytes);

/// One channel of the attribute `channels`.
struct ExrChannel {
  std::string name;
  int type = 0;
  std::string rest;  ///< linear, reserved, xSampling, ySampling: 12 bytes
};

std::vector<ExrChannel> channels_of(const std::string& value);
std::string value_of(const std::vector<ExrChannel>& channels);

/// The bytes of a number as stored in files.
template <typename Number>
std::string bytes_of(Number number) {
  return {reinterpret_cast<const char*>(&number), sizeof number};
}

}  // namespace gloam::fuzz
