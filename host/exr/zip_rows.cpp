#include "exr/zip_rows.h"

#include <OpenEXR/IlmThreadPool.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfThreading.h>
#include <libdeflate.h>
#include <sys/mman.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstring>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <vector>
#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "exr/chunks.h"

namespace gloam {
namespace {

/// Memory of the system's own: in the heap, the blocks of one chunk after another would leave gaps among the planes.
class Pages {
 public:
  explicit Pages(size_t bytes)
      : bytes_(bytes), data_(::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0)) {
    if (data_ == MAP_FAILED) throw std::bad_alloc();
  }
  ~Pages() { ::munmap(data_, bytes_); }
  Pages(const Pages&) = delete;
  Pages& operator=(const Pages&) = delete;

  uint8_t* data() const { return static_cast<uint8_t*>(data_); }
  size_t size() const { return bytes_; }

 private:
  size_t bytes_;
  void* data_;
};

/// Undoes the predictor of OpenEXR's ZIP: each byte was replaced by its difference from the one before, plus 128.
void add_up(uint8_t* bytes, size_t size) {
  size_t i = 0;
  uint8_t sum = 128;  // the first byte is stored as it is
#ifdef __SSE2__
  const __m128i middle = _mm_set1_epi8(char(128)), zero = _mm_setzero_si128();
  __m128i before = middle;
  for (; i + 16 <= size; i += 16) {
    __m128i* const at = reinterpret_cast<__m128i*>(bytes + i);
    __m128i x = _mm_add_epi8(_mm_loadu_si128(at), middle);
    // Sums of 8 bytes each; then the second half adds the last sum of the first.
    x = _mm_add_epi8(x, _mm_slli_epi64(x, 8));
    x = _mm_add_epi8(x, _mm_slli_epi64(x, 16));
    x = _mm_add_epi8(x, _mm_slli_epi64(x, 32));
    const __m128i first_half = _mm_shufflehi_epi16(_mm_unpacklo_epi8(x, x), 0xFF);
    x = _mm_add_epi8(x, _mm_unpackhi_epi64(zero, first_half));
    x = _mm_add_epi8(x, before);
    _mm_storeu_si128(at, x);
    before = _mm_unpackhi_epi8(x, x);  // the last byte, in all places
    before = _mm_shuffle_epi32(_mm_shufflehi_epi16(before, 0xFF), 0xFF);
  }
  if (i > 0) sum = bytes[i - 1];
#endif
  for (; i < size; ++i) bytes[i] = sum = uint8_t(sum + bytes[i] + 128);
}

/// Undoes the order of OpenEXR's ZIP, which puts the bytes of even places first and those of odd ones after them: `pairs` of both.
void interleave(const uint8_t* even, const uint8_t* odd, uint8_t* to, size_t pairs) {
  size_t i = 0;
#ifdef __SSE2__
  for (; i + 16 <= pairs; i += 16) {
    const __m128i a = _mm_loadu_si128(reinterpret_cast<const __m128i*>(even + i)),
                  b = _mm_loadu_si128(reinterpret_cast<const __m128i*>(odd + i));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to + 2 * i), _mm_unpacklo_epi8(a, b));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to + 2 * i + 16), _mm_unpackhi_epi8(a, b));
  }
#endif
  for (; i < pairs; ++i) to[2 * i] = even[i], to[2 * i + 1] = odd[i];
}

/// A channel's place in a row of a chunk.
struct ChannelPlace {
  size_t offset;  ///< bytes from the row's start; even, as all sizes are
  Imf::PixelType type;
  Channel* target;
};

/// A chunk, and memory for decoding it.
struct Workspace {
  std::unique_ptr<libdeflate_decompressor, void (*)(libdeflate_decompressor*)> inflate{libdeflate_alloc_decompressor(),
                                                                                       libdeflate_free_decompressor};
  Pages compressed, reordered;
  size_t compressed_size = 0, size = 0;  ///< of the chunk
  bool is_stored = false;                ///< `compressed` holds the pixels as they are
  std::vector<half> halves;

  Workspace(size_t chunk_bytes, size_t width) : compressed(chunk_bytes), reordered(chunk_bytes), halves(width) {}

  /// Bytes of a chunk in order, from an even place on.
  void copy(size_t place, uint8_t* to, size_t bytes) const {
    if (is_stored)
      std::memcpy(to, compressed.data() + place, bytes);
    else
      interleave(reordered.data() + place / 2, reordered.data() + (size + place) / 2, to, bytes / 2);
  }
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
    const int64_t rows = rows_per_chunk(input_->header()), from = (first - data_.y0) / rows,
                  chunks = (last - 1 - data_.y0) / rows + 1 - from;
    const int64_t spaces = std::min<int64_t>(chunks, std::max(Imf::globalThreadCount(), 1));
    for (int64_t i = 0; i < spaces; ++i)
      shared_->spaces.push_back(std::make_unique<Workspace>(chunk_bytes(), size_t(width())));
    {
      IlmThread::TaskGroup group;  // its destructor waits for the tasks
      for (int64_t y = data_.y0 + from * rows; y < last; y += rows)
        IlmThread::ThreadPool::addGlobalTask(new Task(&group, *this, y, std::min(y + rows, data_.y1), first, last));
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

  size_t chunk_bytes() const { return size_t(rows_per_chunk(input_->header())) * row_bytes_; }
  int64_t width() const { return data_.x1 - data_.x0; }

  std::unique_ptr<Workspace> take_space() {
    const std::lock_guard lock(shared_->spaces_mutex);
    if (shared_->spaces.empty()) return std::make_unique<Workspace>(chunk_bytes(), size_t(width()));
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
    space->size = size_t(end - begin) * row_bytes_;
    if (!read(begin, *space) || !decompress(*space)) return false;
    for (int64_t y = std::max(begin, first); y < std::min(end, last); ++y)
      copy_row(*space, size_t(y - begin) * row_bytes_, int(y));
    give_back(std::move(space));
    return true;
  }

  bool read(int64_t y, Workspace& space) {
    const std::lock_guard lock(shared_->reading);
    const char* bytes = nullptr;
    int count = 0;
    input_->rawPixelData(int(y), bytes, count);
    if (count < 0 || size_t(count) > space.compressed.size()) return false;
    space.compressed_size = size_t(count);
    std::memcpy(space.compressed.data(), bytes, space.compressed_size);
    return true;
  }

  /// A chunk that compression makes no smaller is stored as it is.
  static bool decompress(Workspace& space) {
    space.is_stored = space.compressed_size >= space.size;
    if (space.is_stored) return space.compressed_size == space.size;
    size_t got = 0;
    const libdeflate_result result = libdeflate_zlib_decompress(
        space.inflate.get(), space.compressed.data(), space.compressed_size, space.reordered.data(), space.size, &got);
    if (result != LIBDEFLATE_SUCCESS || got != space.size) return false;
    add_up(space.reordered.data(), space.size);
    return true;
  }

  void copy_row(Workspace& space, size_t row, int y) const {
    const size_t pixels = size_t(width());
    for (const ChannelPlace& place : places_) {
      float* const to = place.target->row(y - window_.y0) + (data_.x0 - window_.x0);
      if (place.type == Imf::FLOAT) {
        space.copy(row + place.offset, reinterpret_cast<uint8_t*>(to), pixels * sizeof(float));
      } else {
        space.copy(row + place.offset, reinterpret_cast<uint8_t*>(space.halves.data()), pixels * sizeof(half));
        std::copy(space.halves.begin(), space.halves.end(), to);
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
