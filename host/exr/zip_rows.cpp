#include "exr/zip_rows.h"

#include <OpenEXR/IlmThreadPool.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfPartType.h>
#include <libdeflate.h>

#include <atomic>
#include <bit>
#include <cstring>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>
#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "exr/chunks.h"

namespace gloam {
namespace {

using Bytes = std::vector<uint8_t>;

/// Undoes the predictor of OpenEXR's ZIP: each byte was replaced by its difference from the one before, plus 128.
void add_up(Bytes& bytes) {
  size_t i = 0;
  uint8_t sum = 128;  // the first byte is stored as it is
#ifdef __SSE2__
  const __m128i middle = _mm_set1_epi8(char(128));
  __m128i before = middle;
  for (; i + 16 <= bytes.size(); i += 16) {
    __m128i* const at = reinterpret_cast<__m128i*>(bytes.data() + i);
    __m128i x = _mm_add_epi8(_mm_loadu_si128(at), middle);
    x = _mm_add_epi8(x, _mm_slli_si128(x, 1));
    x = _mm_add_epi8(x, _mm_slli_si128(x, 2));
    x = _mm_add_epi8(x, _mm_slli_si128(x, 4));
    x = _mm_add_epi8(x, _mm_slli_si128(x, 8));
    x = _mm_add_epi8(x, before);
    _mm_storeu_si128(at, x);
    before = _mm_unpackhi_epi8(x, x);  // the last byte, in all places
    before = _mm_shuffle_epi32(_mm_shufflehi_epi16(before, 0xFF), 0xFF);
  }
  if (i > 0) sum = bytes[i - 1];
#endif
  for (; i < bytes.size(); ++i) bytes[i] = sum = uint8_t(sum + bytes[i] + 128);
}

/// Undoes the order of OpenEXR's ZIP: the bytes of even places come first, then those of odd ones.
void interleave(const Bytes& from, Bytes& to) {
  const size_t size = from.size(), odd = (size + 1) / 2;
  const uint8_t* const even_bytes = from.data();
  const uint8_t* const odd_bytes = from.data() + odd;
  size_t i = 0;
#ifdef __SSE2__
  for (; i + 16 <= size / 2; i += 16) {
    const __m128i a = _mm_loadu_si128(reinterpret_cast<const __m128i*>(even_bytes + i)),
                  b = _mm_loadu_si128(reinterpret_cast<const __m128i*>(odd_bytes + i));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to.data() + 2 * i), _mm_unpacklo_epi8(a, b));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to.data() + 2 * i + 16), _mm_unpackhi_epi8(a, b));
  }
#endif
  for (; i < size / 2; ++i) to[2 * i] = even_bytes[i], to[2 * i + 1] = odd_bytes[i];
  if (size % 2 == 1) to[size - 1] = even_bytes[size / 2];
}

/// A channel's place in a row of a chunk.
struct ChannelPlace {
  size_t offset;  ///< bytes from the row's start
  Imf::PixelType type;
  Channel* target;
};

/// Memory for decoding a chunk.
struct Workspace {
  std::unique_ptr<libdeflate_decompressor, void (*)(libdeflate_decompressor*)> inflate{libdeflate_alloc_decompressor(),
                                                                                       libdeflate_free_decompressor};
  Bytes compressed, reordered, pixels;
};

class ZipRows {
 public:
  /// None if the part holds what this class does not know.
  static std::optional<ZipRows> of(Imf::InputPart& input, const PartDecoding& decoding, const Window& window) {
    const Imf::Header& header = input.header();
    const Imf::Compression compression = header.compression();
    const bool is_zip = compression == Imf::ZIP_COMPRESSION || compression == Imf::ZIPS_COMPRESSION;
    if (!is_zip || header.hasTileDescription() || std::endian::native != std::endian::little) return {};
    ZipRows rows(input, window);
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
      const Imf::Channel& channel = c.channel();
      if (channel.xSampling != 1 || channel.ySampling != 1) return {};
      if (const auto found = decoding.find(c.name()); found != decoding.end()) {
        if (channel.type == Imf::UINT) return {};
        rows.places_.push_back({rows.row_bytes_, channel.type, found->second.targets.front()});
      }
      rows.row_bytes_ += size_t(rows.width()) * (channel.type == Imf::HALF ? 2 : 4);
    }
    return rows.places_.size() == decoding.size() ? std::optional(std::move(rows)) : std::nullopt;
  }

  bool decode(int64_t first, int64_t last) {
    const int64_t rows = rows_per_chunk(input_->header());
    {
      IlmThread::TaskGroup group;  // its destructor waits for the tasks
      for (int64_t chunk = (first - data_.y0) / rows; data_.y0 + chunk * rows < last; ++chunk)
        IlmThread::ThreadPool::addGlobalTask(new Task(&group, *this, data_.y0 + chunk * rows,
                                                      std::min(data_.y0 + (chunk + 1) * rows, data_.y1), first, last));
    }
    return !shared_->has_failed;
  }

 private:
  struct Shared {
    std::mutex reading, spaces_mutex;
    std::vector<std::unique_ptr<Workspace>> spaces;
    std::atomic<bool> has_failed{false};
  };

  class Task : public IlmThread::Task {
   public:
    Task(IlmThread::TaskGroup* group, ZipRows& rows, int64_t begin, int64_t end, int64_t first, int64_t last)
        : IlmThread::Task(group), rows_(rows), begin_(begin), end_(end), first_(first), last_(last) {}
    void execute() override {
      if (rows_.shared_->has_failed) return;
      try {
        if (rows_.decode_chunk(begin_, end_, first_, last_)) return;
      } catch (const std::exception&) {
      }
      rows_.shared_->has_failed = true;
    }

   private:
    ZipRows& rows_;
    int64_t begin_, end_, first_, last_;
  };

  ZipRows(Imf::InputPart& input, const Window& window)
      : input_(&input), window_(window), data_(box_of(input.header().dataWindow())) {}

  int64_t width() const { return data_.x1 - data_.x0; }

  std::unique_ptr<Workspace> take_space() {
    const std::lock_guard lock(shared_->spaces_mutex);
    if (shared_->spaces.empty()) return std::make_unique<Workspace>();
    std::unique_ptr<Workspace> space = std::move(shared_->spaces.back());
    shared_->spaces.pop_back();
    return space;
  }

  void give_back(std::unique_ptr<Workspace> space) {
    const std::lock_guard lock(shared_->spaces_mutex);
    shared_->spaces.push_back(std::move(space));
  }

  /// Rows [begin, end) are the chunk's; those in [first, last) are wanted.
  bool decode_chunk(int64_t begin, int64_t end, int64_t first, int64_t last) {
    std::unique_ptr<Workspace> space = take_space();
    read(begin, *space);
    const size_t size = size_t(end - begin) * row_bytes_;
    if (!decompress(size, *space)) return false;
    for (int64_t y = std::max(begin, first); y < std::min(end, last); ++y)
      copy_row(space->pixels.data() + size_t(y - begin) * row_bytes_, int(y));
    give_back(std::move(space));
    return true;
  }

  void read(int64_t y, Workspace& space) {
    const std::lock_guard lock(shared_->reading);
    const char* bytes = nullptr;
    int count = 0;
    input_->rawPixelData(int(y), bytes, count);
    space.compressed.assign(bytes, bytes + count);
  }

  /// A chunk that compression makes no smaller is stored as it is.
  static bool decompress(size_t size, Workspace& space) {
    if (space.compressed.size() >= size) {
      space.pixels = space.compressed;
      return space.compressed.size() == size;
    }
    space.reordered.resize(size);
    space.pixels.resize(size);
    size_t got = 0;
    const libdeflate_result result = libdeflate_zlib_decompress(
        space.inflate.get(), space.compressed.data(), space.compressed.size(), space.reordered.data(), size, &got);
    if (result != LIBDEFLATE_SUCCESS || got != size) return false;
    add_up(space.reordered);
    interleave(space.reordered, space.pixels);
    return true;
  }

  void copy_row(const uint8_t* row, int y) const {
    for (const ChannelPlace& place : places_) {
      float* const to = place.target->row(y - window_.y0) + (data_.x0 - window_.x0);
      const uint8_t* const from = row + place.offset;
      if (place.type == Imf::FLOAT) {
        std::memcpy(to, from, size_t(width()) * sizeof(float));
        continue;
      }
      for (int64_t x = 0; x < width(); ++x) {
        half value;
        std::memcpy(&value, from + 2 * x, sizeof value);
        to[x] = value;
      }
    }
  }

  Imf::InputPart* input_;
  Window window_;
  Box data_;
  size_t row_bytes_ = 0;
  std::vector<ChannelPlace> places_;
  std::unique_ptr<Shared> shared_ = std::make_unique<Shared>();
};

}  // namespace

bool decode_zip_rows(Imf::InputPart& input, const PartDecoding& decoding, const Window& window, int64_t first,
                     int64_t last) {
  std::optional<ZipRows> rows = ZipRows::of(input, decoding, window);
  return rows && rows->decode(first, last);
}

}  // namespace gloam
