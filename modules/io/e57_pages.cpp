#include "modules/io/e57_pages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "graph/api/error.hpp"
#include "modules/io/crc32c.hpp"
#include "modules/io/scalar.hpp"

namespace atrium::io {
namespace {

constexpr std::size_t header_size = 48;
const char* const copy_again = "copy or export the file again";

}  // namespace

E57Pages::E57Pages(std::shared_ptr<const MappedFile> file) : file_(std::move(file)) {
  if (file_->size() < header_size)
    throw Error(fmt::format("{}: truncated: {} bytes are less than the header of an E57 file", path(), file_->size()),
                copy_again);
  if (!file_->text().starts_with("ASTM-E57"))
    throw Error(path() + ": not an E57 file: it does not begin with ASTM-E57");
  const std::byte* head = file_->data();
  const auto major = load<std::uint32_t>(head + 8);
  const auto length = load<std::uint64_t>(head + 16);
  xml_offset_ = load<std::uint64_t>(head + 24);
  xml_size_ = load<std::uint64_t>(head + 32);
  page_ = load<std::uint64_t>(head + 40);
  if (major != 1) throw Error(fmt::format("{}: version {} of E57; 1 is known", path(), major));
  constexpr std::uint64_t smallest = 64, largest = 1U << 20U;
  if (page_ < smallest || page_ > largest)
    throw Error(fmt::format("{}: byte 40: pages of {} bytes; E57's have 1024", path(), page_));
  if (length > file_->size())
    throw Error(
        fmt::format("{}: truncated: the header promises {} bytes, but the file has {}", path(), length, file_->size()),
        copy_again);
  content_ = page_ - 4;
  pages_ = file_->size() / page_;
}

void E57Pages::check(std::uint64_t page) const {
  const std::byte* data = file_->data() + page * page_;
  const std::byte* sum = data + content_;
  std::uint32_t stored = 0;  // the one number that is big-endian
  for (int i = 0; i < 4; ++i) stored = stored << 8U | std::to_integer<std::uint32_t>(sum[i]);
  if (stored != crc32c(data, content_))
    throw Error(
        fmt::format("{}: the page at byte {} is damaged: its checksum (CRC-32C) is wrong", path(), page * page_),
        copy_again);
}

void E57Pages::read(std::uint64_t offset, std::size_t size, std::byte* to) const {
  if (size == 0) return;
  if (offset > this->size() || size > this->size() - offset)
    throw Error(fmt::format("{}: truncated: {} bytes are to follow byte {}, but the file has {}", path(), size,
                            physical(offset), file_->size()),
                copy_again);
  std::uint64_t page = offset / content_;
  std::uint64_t begin = offset % content_;
  while (size > 0) {
    check(page);
    const std::size_t some = std::min<std::size_t>(size, content_ - begin);
    std::memcpy(to, file_->data() + page * page_ + begin, some);
    to += some;
    size -= some;
    ++page;
    begin = 0;
  }
}

std::uint64_t E57Pages::logical(std::uint64_t physical, const std::string& what) const {
  const std::uint64_t page = physical / page_, within = physical % page_;
  if (page >= pages_ || within >= content_)
    throw Error(fmt::format("{}: {} is to be at byte {}, where the file has no data ({} bytes in pages of {})", path(),
                            what, physical, file_->size(), page_));
  return page * content_ + within;
}

std::string E57Pages::xml() const {
  const std::uint64_t begin = logical(xml_offset_, "the XML section");
  if (xml_size_ > size() - begin)
    throw Error(fmt::format("{}: truncated: the XML section at byte {} is to have {} bytes, but the file has {}",
                            path(), xml_offset_, xml_size_, file_->size()),
                copy_again);
  std::string text(xml_size_, '\0');
  read(begin, text.size(), reinterpret_cast<std::byte*>(text.data()));
  return text;
}

}  // namespace atrium::io
