// CGAL's surface reconstruction keeps planes and points in hash tables and sets that are ordered by their addresses, so
// the order of its program's rows and columns, and the last bits of coordinates, depend on where the system happens to
// put the heap. Small objects of this program stand at addresses that are the same in every run: in a range of their
// own, one strip for each size.
#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>

namespace {

constexpr std::uintptr_t range = 0x100000000000;  // nothing else is placed there on 64-bit Linux
constexpr std::size_t grain = 16;
constexpr std::size_t strips = 32;  // sizes 16, 32, … 512
constexpr std::size_t strip_size = std::size_t{1} << 33U;

struct Free {
  Free* next;
};
struct Strip {
  Free* free = nullptr;
  std::size_t used = 0;
};
// The program has one thread.
Strip all_strips[strips];

bool reserve() {
  const int flags = MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_FIXED_NOREPLACE;
  void* wanted = reinterpret_cast<void*>(range);  // NOLINT(performance-no-int-to-ptr)
  return ::mmap(wanted, strips * strip_size, PROT_READ | PROT_WRITE, flags, -1, 0) == wanted;
}

void* take(std::size_t size) {
  static const bool reserved = reserve();
  const std::size_t s = size == 0 ? 0 : (size - 1) / grain;
  if (reserved && s < strips) {
    Strip& strip = all_strips[s];
    if (strip.free != nullptr) {
      Free* item = strip.free;
      strip.free = item->next;
      return item;
    }
    const std::size_t item = (s + 1) * grain;
    if (strip.used + item <= strip_size) {
      const std::uintptr_t place = range + s * strip_size + strip.used;
      strip.used += item;
      return reinterpret_cast<void*>(place);  // NOLINT(performance-no-int-to-ptr)
    }
  }
  void* memory = std::malloc(size == 0 ? 1 : size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void give_back(void* memory) noexcept {
  const auto place = reinterpret_cast<std::uintptr_t>(memory);
  if (place < range || place >= range + strips * strip_size) {
    std::free(memory);
    return;
  }
  Strip& strip = all_strips[(place - range) / strip_size];
  strip.free = new (memory) Free{strip.free};
}

}  // namespace

void* operator new(std::size_t size) { return take(size); }
void* operator new[](std::size_t size) { return take(size); }
void operator delete(void* memory) noexcept { give_back(memory); }
void operator delete[](void* memory) noexcept { give_back(memory); }
void operator delete(void* memory, std::size_t) noexcept { give_back(memory); }
void operator delete[](void* memory, std::size_t) noexcept { give_back(memory); }
