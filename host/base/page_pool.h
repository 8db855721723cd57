// Memory for images, in whole pages.
#pragma once

#include <cstddef>

namespace gloam {

/// Uninitialised memory at the start of a page. Throws std::bad_alloc.
void* take_pages(size_t bytes);
/// Frees memory from `take_pages` of as many bytes; null is allowed. While a `PageReuse` lives, it may be kept for later.
void give_back_pages(void* memory, size_t bytes) noexcept;

/// While one lives, memory given back is kept and taken again for as many bytes: the operating system clears every page that it
/// hands out, which for the images of a frame takes as long as a filter. What is taken and kept together stays within
/// `most_bytes` if what is taken does. One at a time.
class PageReuse {
 public:
  explicit PageReuse(size_t most_bytes);
  ~PageReuse();
  PageReuse(const PageReuse&) = delete;
  PageReuse& operator=(const PageReuse&) = delete;
};

}  // namespace gloam
