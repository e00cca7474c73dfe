#pragma once
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "graph/api/context.hpp"
#include "modules/io/crc32c.hpp"

namespace atrium::io {

/// Writes bytes as E57's pages of 1024 bytes, whose last four are the checksum of the others. Call finish at the end.
class E57PageWriter {
 public:
  static constexpr std::uint64_t page = 1024, content = 1020;
  static std::uint64_t physical(std::uint64_t logical) { return logical / content * page + logical % content; }
  /// Of a file with so many bytes of content.
  static std::uint64_t file_size(std::uint64_t logical) { return (logical + content - 1) / content * page; }

  explicit E57PageWriter(AtomicFile& file) : file_(file) { pages_.reserve(limit + page); }

  void write(const void* data, std::size_t size) {
    const auto* from = static_cast<const char*>(data);
    while (size > 0) {
      const std::size_t some = std::min<std::size_t>(size, content - used_);
      pages_.append(from, some);
      from += some;
      size -= some;
      used_ += some;
      if (used_ == content) close_page();
    }
  }
  template <class T>
  void number(T value) {
    write(&value, sizeof value);
  }
  void text(std::string_view text) { write(text.data(), text.size()); }
  void finish() {
    if (used_ > 0) {
      pages_.append(content - used_, '\0');
      close_page();
    }
    file_.write(pages_);
    pages_.clear();
  }

 private:
  static constexpr std::size_t limit = 1024 * page;

  void close_page() {
    const auto* begin = reinterpret_cast<const std::byte*>(pages_.data() + pages_.size() - content);
    const std::uint32_t sum = crc32c(begin, content);
    for (int i = 3; i >= 0; --i) pages_ += static_cast<char>(sum >> (8 * i) & 0xFFU);  // big-endian
    used_ = 0;
    if (pages_.size() < limit) return;
    file_.write(pages_);
    pages_.clear();
  }

  AtomicFile& file_;
  std::string pages_;
  std::size_t used_ = 0;
};

}  // namespace atrium::io
