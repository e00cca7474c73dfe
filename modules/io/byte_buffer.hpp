#pragma once
#include <cstring>
#include <string>

#include "graph/api/context.hpp"

namespace atrium::io {

/// Gathers small pieces and hands them to the file in large ones. Call flush at the end.
class ByteBuffer {
 public:
  explicit ByteBuffer(AtomicFile& file) : file_(file) { bytes_.reserve(limit + 4096); }
  ByteBuffer(const ByteBuffer&) = delete;
  ByteBuffer& operator=(const ByteBuffer&) = delete;

  template <class T>
  void number(T value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    bytes_.append(raw, sizeof(T));
    if (bytes_.size() > limit) flush();
  }
  void text(std::string_view text) {
    bytes_ += text;
    if (bytes_.size() > limit) flush();
  }
  void flush() {
    file_.write(bytes_);
    bytes_.clear();
  }

 private:
  static constexpr std::size_t limit = std::size_t{1} << 20U;
  AtomicFile& file_;
  std::string bytes_;
};

}  // namespace atrium::io
