#include "fuzz/exr_bytes.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace gloam::fuzz {
namespace {

constexpr size_t start_size = 8;

/// Reads bytes that may end too early.
class Cursor {
 public:
  explicit Cursor(const std::string& bytes, size_t at = 0) : bytes_(bytes), at_(at) {}

  size_t at() const { return at_; }
  bool ended() const { return at_ >= bytes_.size(); }
  bool read_name(std::string& name) {
    const size_t end = bytes_.find('\0', at_);
    if (end == std::string::npos) return false;
    name = bytes_.substr(at_, end - at_);
    at_ = end + 1;
    return true;
  }
  template <typename Number>
  bool read_number(Number& number) {
    if (bytes_.size() - std::min(at_, bytes_.size()) < sizeof number) return false;
    std::memcpy(&number, &bytes_[at_], sizeof number);
    at_ += sizeof number;
    return true;
  }
  bool read_bytes(size_t count, std::string& bytes) {
    if (bytes_.size() - std::min(at_, bytes_.size()) < count) return false;
    bytes = bytes_.substr(at_, count);
    at_ += count;
    return true;
  }

 private:
  const std::string& bytes_;
  size_t at_;
};

/// Returns false if the header does not end. An empty header ends the headers of several parts.
bool read_header(Cursor& cursor, ExrHeader& header) {
  for (ExrAttribute attribute; cursor.read_name(attribute.name);) {
    if (attribute.name.empty()) return true;
    int32_t size = 0;
    if (!cursor.read_name(attribute.type) || !cursor.read_number(size) || size < 0) return false;
    if (!cursor.read_bytes(size_t(size), attribute.value)) return false;
    header.push_back(attribute);
  }
  return false;
}

/// End of the tables: the first chunk that one of them names.
size_t end_of_tables(const std::string& bytes, size_t begin) {
  Cursor cursor(bytes, begin);
  size_t first = bytes.size();
  for (uint64_t offset = 0; cursor.at() < first && cursor.read_number(offset);)
    if (offset > begin) first = std::min(first, size_t(offset));
  return std::min(first, cursor.at());
}

/// The tables with offsets for chunks that begin elsewhere.
std::string moved(std::string tables, size_t from, size_t to) {
  for (size_t i = 0; i + 8 <= tables.size(); i += 8) {
    uint64_t offset = 0;
    std::memcpy(&offset, &tables[i], 8);
    if (offset < from) continue;
    offset += to - from;
    std::memcpy(&tables[i], &offset, 8);
  }
  return tables;
}

std::string text_of(const ExrHeader& header) {
  std::string text;
  for (const ExrAttribute& a : header)
    text += a.name + '\0' + a.type + '\0' + bytes_of(int32_t(a.value.size())) + a.value;
  return text + '\0';
}

std::string text_of(const ExrBytes& bytes) {
  std::string text = bytes.start;
  for (const ExrHeader& header : bytes.headers) text += text_of(header);
  return bytes.is_multipart() ? text + '\0' : text;
}

}  // namespace

bool ExrBytes::is_multipart() const { return start.size() > 5 && (start[5] & 0x10) != 0; }

std::string ExrBytes::text() const {
  const std::string begin = text_of(*this);
  // The smallest offset tells where the chunks began.
  uint64_t from = UINT64_MAX;
  for (size_t i = 0; i + 8 <= tables.size(); i += 8) {
    uint64_t offset = 0;
    std::memcpy(&offset, &tables[i], 8);
    if (offset > 0) from = std::min(from, offset);
  }
  return begin + moved(tables, size_t(from), begin.size() + tables.size()) + chunks;
}

std::optional<ExrBytes> take_apart(const std::string& bytes) {
  if (bytes.size() < start_size) return {};
  ExrBytes result;
  result.start = bytes.substr(0, start_size);
  Cursor cursor(bytes, start_size);
  do {
    ExrHeader header;
    if (!read_header(cursor, header)) return {};
    if (header.empty()) break;
    result.headers.push_back(header);
  } while (result.is_multipart());
  if (result.headers.empty()) return {};
  const size_t end = end_of_tables(bytes, cursor.at());
  result.tables = bytes.substr(cursor.at(), end - cursor.at());
  result.chunks = bytes.substr(end);
  return result;
}

std::vector<ExrChannel> channels_of(const std::string& value) {
  std::vector<ExrChannel> channels;
  Cursor cursor(value);
  for (ExrChannel channel; cursor.read_name(channel.name) && !channel.name.empty();) {
    if (!cursor.read_number(channel.type) || !cursor.read_bytes(12, channel.rest)) break;
    channels.push_back(channel);
  }
  return channels;
}

std::string value_of(const std::vector<ExrChannel>& channels) {
  std::string value;
  for (const ExrChannel& channel : channels) value += channel.name + '\0' + bytes_of(channel.type) + channel.rest;
  return value + '\0';
}

}  // namespace gloam::fuzz
