#include "exr/stream.h"

#include <OpenEXR/Iex.h>
#include <OpenEXR/ImfThreading.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <mutex>
#include <thread>

#include "base/file_ledger.h"
#include "gloam/error.h"
#include "gloam/frame_pattern.h"

namespace gloam {
namespace {
constexpr size_t buffer_size = 64 * 1024;
}

void use_all_threads() {
  static std::once_flag once;
  std::call_once(once, [] { Imf::setGlobalThreadCount(int(std::max(1u, std::thread::hardware_concurrency()))); });
}

ExrInput::ExrInput(const std::filesystem::path& path) : Imf::IStream(path.c_str()) {
  descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);  // does not wait for the other end of a pipe
  if (descriptor_ < 0 && errno == ENOENT && FramePattern::is_pattern(path.string()))
    throw Error(
        "{}: cannot read: no file has this name; only run, auto, info and compare take the files of a shot, so name "
        "one of them",
        path.string());
  if (descriptor_ < 0) throw Error("{}: cannot read: {}", path.string(), std::strerror(errno));
  struct stat about {};
  ::fstat(descriptor_, &about);
  if (S_ISREG(about.st_mode)) {
    size_ = uint64_t(about.st_size);
    opens_file(path);
    return;
  }
  ::close(descriptor_);
  if (S_ISDIR(about.st_mode)) throw Error("{}: is a directory; name an EXR file in it", path.string());
  throw Error("{}: is a device or a pipe; name a regular file", path.string());
}

ExrInput::ExrInput(const std::filesystem::path& path, int descriptor)
    : Imf::IStream(path.c_str()), descriptor_(descriptor) {
  struct stat about {};
  ::fstat(descriptor_, &about);
  size_ = uint64_t(about.st_size);
}

ExrInput::~ExrInput() { ::close(descriptor_); }

void ExrInput::read_at(uint64_t position, char* bytes, size_t count) const {
  for (size_t done = 0; done < count;) {
    const ssize_t got = ::pread(descriptor_, bytes + done, count - done, off_t(position + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw IEX_NAMESPACE::IoExc(std::strerror(errno));
    if (got == 0) throw IEX_NAMESPACE::InputExc("unexpected end of file");
    done += size_t(got);
  }
}

bool ExrInput::has_magic() const {
  char magic[4] = {};
  if (size_ >= sizeof magic) read_at(0, magic, sizeof magic);
  return std::memcmp(magic, "\x76\x2f\x31\x01", sizeof magic) == 0;
}

bool ExrInput::read(char* bytes, int count) {
  const size_t wanted = size_t(std::max(count, 0));
  if (position_ > size_ || wanted > size_ - position_) throw IEX_NAMESPACE::InputExc("unexpected end of file");
  if (wanted >= buffer_size) {
    read_at(position_, bytes, wanted);
  } else {
    if (position_ < buffered_from_ || position_ + wanted > buffered_from_ + buffer_.size()) {
      buffer_.resize(size_t(std::min<uint64_t>(buffer_size, size_ - position_)));
      buffered_from_ = position_;
      read_at(position_, buffer_.data(), buffer_.size());
    }
    std::memcpy(bytes, buffer_.data() + (position_ - buffered_from_), wanted);
  }
  position_ += wanted;
  return position_ < size_;
}

void ExrOutput::fail() {
  error_ = errno;
  throw IEX_NAMESPACE::IoExc(std::strerror(error_));
}

void ExrOutput::flush() {
  for (size_t done = 0; done < buffer_.size();) {
    const ssize_t put =
        ::pwrite(descriptor_, buffer_.data() + done, buffer_.size() - done, off_t(buffered_from_ + done));
    if (put < 0 && errno == EINTR) continue;
    if (put <= 0) {
      buffer_.clear();
      fail();
    }
    done += size_t(put);
  }
  buffered_from_ += buffer_.size();
  buffer_.clear();
}

void ExrOutput::write(const char* bytes, int count) {
  if (error_ != 0) throw IEX_NAMESPACE::IoExc(std::strerror(error_));
  if (buffer_.size() + size_t(count) > buffer_.capacity()) flush();
  buffer_.insert(buffer_.end(), bytes, bytes + count);
  position_ += uint64_t(count);
}

void ExrOutput::seekp(uint64_t position) {
  flush();
  position_ = buffered_from_ = position;
}

void ExrOutput::finish() {
  if (error_ == 0) flush();
  if (error_ != 0) throw Error("{}", std::strerror(error_));
}

}  // namespace gloam
