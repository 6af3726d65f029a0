/// Memory for large arrays that are read from end to end: asked for in pages of 2 MB, of which the processor's tables
/// hold enough. Where the system gives none, ordinary pages serve.
#pragma once

#include <sys/mman.h>

#include <cstdlib>
#include <new>

namespace titin {

template <class T>
struct LargePages {
  using value_type = T;
  static constexpr std::size_t page = std::size_t(2) << 20;  // [bytes]

  LargePages() = default;
  template <class U>
  LargePages(const LargePages<U>&) {}

  T* allocate(std::size_t count) {
    const std::size_t bytes = (count * sizeof(T) + page - 1) / page * page;
    void* memory = std::aligned_alloc(page, bytes);
    if (!memory) throw std::bad_alloc();
    madvise(memory, bytes, MADV_HUGEPAGE);  // a wish
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t) { std::free(memory); }
  bool operator==(const LargePages&) const { return true; }
};

}  // namespace titin
