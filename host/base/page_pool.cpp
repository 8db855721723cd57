#include "base/page_pool.h"

#include <cstdlib>
#include <map>
#include <mutex>
#include <new>
#include <vector>

namespace gloam {
namespace {

constexpr size_t page = 4096;

size_t whole_pages(size_t bytes) { return (bytes + page - 1) / page * page; }

/// Memory kept for reuse, by size.
class Pool {
 public:
  void* take(size_t size) {
    const std::lock_guard lock(mutex_);
    taken_ += size;
    std::vector<void*>& same = kept_[size];
    if (!same.empty()) {
      void* memory = same.back();
      same.pop_back();
      kept_bytes_ -= size;
      return memory;
    }
    if (kept_bytes_ > 0 && taken_ + kept_bytes_ > most_bytes_) release();
    void* memory = std::aligned_alloc(page, size);
    if (!memory) taken_ -= size;
    return memory;
  }

  void give_back(void* memory, size_t size) noexcept {
    const std::lock_guard lock(mutex_);
    taken_ -= size;
    if (taken_ + kept_bytes_ + size > most_bytes_) return std::free(memory);
    try {
      kept_[size].push_back(memory);
      kept_bytes_ += size;
    } catch (const std::bad_alloc&) {
      std::free(memory);
    }
  }

  void keep_up_to(size_t bytes) {
    const std::lock_guard lock(mutex_);
    most_bytes_ = bytes;
    if (bytes == 0) release();
  }

 private:
  void release() noexcept {
    for (auto& [size, blocks] : kept_) {
      for (void* memory : blocks) std::free(memory);
      blocks.clear();
    }
    kept_bytes_ = 0;
  }

  std::mutex mutex_;
  size_t most_bytes_ = 0, taken_ = 0, kept_bytes_ = 0;
  std::map<size_t, std::vector<void*>> kept_;
};

/// Never destroyed: images of static storage are freed last of all.
Pool& pool() {
  static Pool& only = *new Pool;
  return only;
}

}  // namespace

void* take_pages(size_t bytes) {
  void* memory = pool().take(whole_pages(bytes));
  if (!memory) throw std::bad_alloc();
  return memory;
}

void give_back_pages(void* memory, size_t bytes) noexcept {
  if (memory) pool().give_back(memory, whole_pages(bytes));
}

PageReuse::PageReuse(size_t most_bytes) { pool().keep_up_to(most_bytes); }
PageReuse::~PageReuse() { pool().keep_up_to(0); }

}  // namespace gloam
