#include "graph/api/value.hpp"

#include <xxhash.h>

#include <new>

namespace atrium {

ContentHash::ContentHash() : state_(XXH3_createState()) {
  if (state_ == nullptr) throw std::bad_alloc();
  XXH3_128bits_reset(state_);
}
ContentHash::~ContentHash() { XXH3_freeState(state_); }

void ContentHash::bytes(const void* data, std::size_t size) {
  if (size > 0) XXH3_128bits_update(state_, data, size);
}

std::string ContentHash::hex() const {
  XXH128_canonical_t canonical;
  XXH128_canonicalFromHash(&canonical, XXH3_128bits_digest(state_));
  static constexpr char digits[] = "0123456789abcdef";
  std::string text;
  for (const unsigned char byte : canonical.digest) {
    text += digits[byte >> 4U];
    text += digits[byte & 15U];
  }
  return text;
}

std::string hash_of_text(std::string_view text) {
  ContentHash hash;
  hash.bytes(text.data(), text.size());
  return hash.hex();
}

}  // namespace atrium
