// OpenEXR streams over file descriptors: errors are kept, not lost, and no byte is copied twice.
#pragma once

#include <OpenEXR/ImfIO.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace gloam {

/// Lets OpenEXR compress and decompress on every core. Only the first call has an effect.
void use_all_threads();

/// Reads a regular file. Small reads (headers come byte by byte) go through a buffer, whole chunks straight to OpenEXR.
/// Not memory-mapped on purpose: if another program truncated a mapped file while it is read, this program would end.
class ExrInput : public Imf::IStream {
 public:
  /// Throws Error naming the path if it is missing, a folder, not readable or not a regular file.
  explicit ExrInput(const std::filesystem::path& path);
  /// Reads a file in memory that stands for `path`, and closes its descriptor at the end.
  ExrInput(const std::filesystem::path& path, int descriptor);
  ~ExrInput() override;
  bool read(char* bytes, int count) override;
  uint64_t tellg() override { return position_; }
  void seekg(uint64_t position) override { position_ = position; }
  uint64_t size() const { return size_; }
  /// Whether the file begins as an EXR does. Leaves the stream where it is.
  bool has_magic() const;
  /// Reads bytes from any place, and leaves the stream where it is. Throws as `read`.
  void read_at(uint64_t position, char* bytes, size_t count) const;

 private:
  int descriptor_ = -1;
  uint64_t position_ = 0, size_ = 0, buffered_from_ = 0;
  std::vector<char> buffer_;
};

/// Writes to a file that the caller opens and closes. OpenEXR writes its last bytes in a destructor that swallows errors: `finish`
/// throws these errors.
class ExrOutput : public Imf::OStream {
 public:
  /// `name` is for messages.
  ExrOutput(int descriptor, const std::string& name) : Imf::OStream(name.c_str()), descriptor_(descriptor) {
    buffer_.reserve(1 << 20);
  }
  void write(const char* bytes, int count) override;
  uint64_t tellp() override { return position_; }
  void seekp(uint64_t position) override;
  void finish();

 private:
  void flush();
  [[noreturn]] void fail();
  int descriptor_;
  int error_ = 0;
  uint64_t position_ = 0, buffered_from_ = 0;
  std::vector<char> buffer_;
};

}  // namespace gloam
