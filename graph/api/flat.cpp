#include "graph/api/flat.hpp"

#include <algorithm>
#include <cstring>

namespace atrium {
namespace {

constexpr std::size_t alignment = 64;
constexpr std::size_t hash_digits = 32;
constexpr std::size_t block = std::size_t{1} << 18U;
constexpr std::size_t window = std::size_t{1} << 16U;

std::size_t padding(std::uint64_t position, std::size_t size) {
  return size < alignment ? 0 : static_cast<std::size_t>((alignment - position % alignment) % alignment);
}

}  // namespace

void FlatWriter::bytes(const void* data, std::size_t size) {
  position_ += size;
  if (buffer_.size() + size > block) finish();
  if (size > block) {
    sink_(data, size);
    return;
  }
  const auto* begin = static_cast<const std::byte*>(data);
  buffer_.insert(buffer_.end(), begin, begin + size);
}

void FlatWriter::array(const void* data, std::size_t size) {
  static constexpr std::byte zeros[alignment] = {};
  bytes(zeros, padding(position_, size));
  if (size > 0) bytes(data, size);
}

void FlatWriter::reference(FlatReference reference) {
  bytes(reference.hash.data(), hash_digits);
  references_.push_back(std::move(reference));
}

void FlatWriter::finish() {
  if (!buffer_.empty()) sink_(buffer_.data(), buffer_.size());
  buffer_.clear();
}

FlatReader::FlatReader(const std::byte* data, std::size_t size, Resolve resolve)
    : FlatReader([data](void* to, std::uint64_t at, std::size_t part) { std::memcpy(to, data + at, part); }, size,
                 std::move(resolve)) {}

void FlatReader::bytes(void* to, std::size_t size) {
  if (size > size_ - position_) throw Error("the flat form of a value ends too early");
  if (size == 0) return;
  if (size >= window) {
    read_(to, position_, size);
  } else {
    if (position_ < window_at_ || position_ + size > window_at_ + window_.size()) {
      window_.resize(std::min(window, size_ - position_));
      window_at_ = position_;
      read_(window_.data(), window_at_, window_.size());
    }
    std::memcpy(to, window_.data() + (position_ - window_at_), size);
  }
  position_ += size;
}

void FlatReader::array(void* to, std::size_t size) {
  const std::size_t skip = padding(position_, size);
  if (skip > size_ - position_) throw Error("the flat form of a value ends too early");
  position_ += skip;
  bytes(to, size);
}

std::size_t FlatReader::count(std::size_t item) {
  std::uint64_t count = 0;
  bytes(&count, sizeof count);
  if (count > (size_ - position_) / item) throw Error("the flat form of a value has more items than bytes");
  return static_cast<std::size_t>(count);
}

std::shared_ptr<const void> FlatReader::reference(const FlatType& type) {
  std::string hash(hash_digits, '\0');
  bytes(hash.data(), hash.size());
  auto value = resolve_(type, hash);
  if (!value) throw Error("a value that this one shares is not there");
  return value;
}

}  // namespace atrium
