#include "set/content_hash.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfVersion.h>

#include <bit>
#include <vector>

#include "base/lists.h"
#include "exr/errors.h"
#include "exr/stream.h"
#include "exr/validation.h"
#include "gloam/error.h"
#include "gloam/exr.h"
#include "set/sha256.h"

namespace gloam::sets {
namespace {

static_assert(std::endian::native == std::endian::little, "values are hashed as they lie in memory");

/// Keeps what OpenEXR writes, which is little-endian everywhere.
class InMemory : public Imf::OStream {
 public:
  InMemory() : Imf::OStream("memory") {}
  void write(const char* bytes, int count) override {
    text_.resize(std::max(text_.size(), position_));
    text_.replace(position_, size_t(count), bytes, size_t(count));
    position_ += size_t(count);
  }
  uint64_t tellp() override { return position_; }
  void seekp(uint64_t position) override { position_ = position; }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
  size_t position_ = 0;
};

const std::vector<std::string> of_storage = {"compression", "lineOrder",           "chunkCount",        "tiles",
                                             "version",     "dwaCompressionLevel", "maxSamplesPerPixel"};

/// With its length before it, so that neighbouring texts cannot be confused.
void add_text(Sha256& sum, const std::string& text) {
  sum.add(fmt::format("{}:", text.size()));
  sum.add(text);
}

/// The list of channels is one of the attributes.
void add_header(Sha256& sum, const Imf::Header& header) {
  for (auto attribute = header.begin(); attribute != header.end(); ++attribute) {
    if (contains(of_storage, attribute.name())) continue;
    InMemory value;
    attribute.attribute().writeValueTo(value, Imf::EXR_VERSION);
    add_text(sum, attribute.name());
    add_text(sum, attribute.attribute().typeName());
    add_text(sum, value.text());
  }
}

size_t bytes_of(Imf::PixelType type) { return type == Imf::HALF ? 2 : 4; }

void add_pixels(Sha256& sum, Imf::InputPart& part) {
  const Imath::Box2i window = part.header().dataWindow();
  const size_t width = size_t(window.max.x - window.min.x + 1);
  const Imf::ChannelList& channels = part.header().channels();
  size_t bytes = 0;
  for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
    if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1)
      throw Error("the channel '{}' lacks values for some pixels; every channel of a set has a value for each pixel",
                  channel.name());
    bytes += width * bytes_of(channel.channel().type);
  }
  constexpr int rows_at_once = 16;  // of a chunk of the ZIP compression
  std::vector<char> rows(bytes * rows_at_once);
  for (int y = window.min.y; y <= window.max.y; y += rows_at_once) {
    const int last = std::min(y + rows_at_once - 1, window.max.y);
    Imf::FrameBuffer buffer;
    size_t from = 0;
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
      const size_t size = bytes_of(channel.channel().type);
      buffer.insert(channel.name(), Imf::Slice::Make(channel.channel().type, rows.data() + from, {window.min.x, y},
                                                     int64_t(width), last - y + 1, size, bytes));
      from += width * size;
    }
    part.setFrameBuffer(buffer);
    part.readPixels(y, last);
    sum.add({rows.data(), bytes * size_t(last - y + 1)});
  }
}

}  // namespace

std::string content_hash(const std::filesystem::path& path) {
  return guarded(path, [&] {
    ExrInput stream(path);
    check_headers(path, stream, max_pixels);
    Imf::MultiPartInputFile file(stream);
    check_parts(path, file, max_pixels);
    Sha256 sum;
    for (int i = 0; i < file.parts(); ++i) {
      check_plausible(path, file.header(i), stream.size());
      Imf::InputPart part(file, i);
      add_header(sum, part.header());
      named(path, [&] { add_pixels(sum, part); });
    }
    return sum.digits();
  });
}

}  // namespace gloam::sets
