// Large arrays in large pages. A cloud's columns are fresh memory each time: in pages of 4 KiB the kernel's work for
// each new page costs as much as filling it. Where the system grants large pages on request (madvise, the usual
// setting), the program asks for them.
#include <sys/mman.h>

#include <cstdlib>
#include <new>

namespace {

constexpr std::size_t large_page = std::size_t{1} << 21U;
constexpr std::size_t least = 2 * large_page;

void* allocate(std::size_t size) noexcept {
  if (size < least) return std::malloc(size > 0 ? size : 1);
  const std::size_t whole = (size + large_page - 1) / large_page * large_page;
  void* const memory = whole < size ? nullptr : std::aligned_alloc(large_page, whole);
  if (memory != nullptr) ::madvise(memory, whole, MADV_HUGEPAGE);  // a wish: if it fails, the pages are small
  return memory;
}

}  // namespace

// Those of the standard library call these; free() suits all of them.
void* operator new(std::size_t size) {
  while (true) {
    if (void* const memory = allocate(size); memory != nullptr) return memory;
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr) throw std::bad_alloc();
    handler();
  }
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t /*size*/) noexcept { std::free(memory); }
