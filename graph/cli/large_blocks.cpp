// Large blocks of memory are asked for in huge pages (2 MiB), where the system gives such to those who ask ("madvise",
// /sys/kernel/mm/transparent_hugepage/enabled). Else every 4 KiB of a scan's columns cost a page fault, together more
// time than reading the file does. Sanitizers have operators of their own, and say so in one of two ways.
#ifdef __has_feature
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define ATRIUM_SANITIZED
#endif
#elif defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define ATRIUM_SANITIZED
#endif
#ifndef ATRIUM_SANITIZED

#include <sys/mman.h>

#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

constexpr std::size_t huge_page = std::size_t{2} << 20U;
constexpr std::size_t large = 8 * huge_page;  // smaller blocks would lose too much between them

void* block_of(std::size_t size) noexcept {
  if (size < large || size > static_cast<std::size_t>(-1) - huge_page) return std::malloc(size == 0 ? 1 : size);
  const std::size_t pages = (size + huge_page - 1) / huge_page * huge_page;
  void* block = std::aligned_alloc(huge_page, pages);
  if (block != nullptr) ::madvise(block, size / huge_page * huge_page, MADV_HUGEPAGE);
  return block;
}

}  // namespace

// Not inlined: the compiler would take free() in them for a mistake.
[[gnu::noinline]] void* operator new(std::size_t size) {
  for (;;) {
    if (void* block = block_of(size); block != nullptr) return block;
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr) throw std::bad_alloc();
    handler();
  }
}
[[gnu::noinline]] void operator delete(void* block) noexcept { std::free(block); }
[[gnu::noinline]] void operator delete(void* block, std::size_t /*size*/) noexcept { std::free(block); }

#endif
