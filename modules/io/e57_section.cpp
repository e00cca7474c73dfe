#include "modules/io/e57_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "graph/api/error.hpp"
#include "modules/io/scalar.hpp"

namespace atrium::io {
namespace {

constexpr std::uint64_t section_head = 32, data_header = 6;
enum : std::uint8_t { index_kind = 0, data_kind = 1, empty_kind = 2 };

/// Integers of `bits` each, one after the other from the lowest bit of the first byte on. 8 bytes behind the last one
/// are readable.
void unpack(const E57Field& field, std::size_t shift, std::size_t count, const std::byte* from, double* to) {
  const unsigned bits = field.bits;
  const std::uint64_t mask = bits == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
  const auto minimum = static_cast<std::uint64_t>(field.minimum);
  std::size_t at = shift;
  for (std::size_t i = 0; i < count; ++i, at += bits) {
    const std::byte* place = from + (at >> 3U);
    const unsigned low = at & 7U;
    std::uint64_t raw = load<std::uint64_t>(place) >> low;
    if (low + bits > 64) raw |= std::to_integer<std::uint64_t>(place[8]) << (64 - low);
    to[i] = static_cast<double>(static_cast<std::int64_t>((raw & mask) + minimum));
  }
}

}  // namespace

E57Section::E57Section(const E57Pages& pages, const E57Scan& scan, std::vector<int> wanted, const Context& context)
    : pages_(pages), scan_(scan), wanted_(std::move(wanted)) {
  const auto fail = [&](std::uint64_t at, const std::string& what) {
    throw Error(fmt::format("{}: {}: byte {}: {}", pages_.path(), scan_.label, pages_.physical(at), what));
  };
  begin_ = pages_.logical(scan_.section, scan_.label);
  if (pages_.number<std::uint8_t>(begin_) != 1) fail(begin_, "no section of points begins here");
  const auto length = pages_.number<std::uint64_t>(begin_ + 8);
  if (length < section_head || length > pages_.size() - begin_)
    fail(begin_, fmt::format("a section of {} bytes, but the file has {}", length, pages_.file_size()));
  end_ = begin_ + length;
  std::uint64_t at = pages_.logical(pages_.number<std::uint64_t>(begin_ + 16), "the data of " + scan_.label);
  if (at < begin_ + section_head || at > end_) fail(at, "the data of the section lie outside of it");
  constexpr std::size_t some_packets = 512;  // 32 MiB at most
  for (std::size_t walked = 1; at + 4 <= end_; ++walked) {
    const auto type = pages_.number<std::uint8_t>(at);
    const std::uint64_t packet = pages_.number<std::uint16_t>(at + 2) + std::uint64_t{1};
    if (type > empty_kind) fail(at, fmt::format("a packet of the unknown type {}", type));
    if (packet < 4 || packet % 4 != 0 || packet > end_ - at)
      fail(at, fmt::format("a packet of {} bytes, where the section has {} left", packet, end_ - at));
    if (type == data_kind) add_packet(at, packet);
    at += packet;
    if (walked % some_packets != 0) continue;
    pages_.drop_pages();
    context.check_cancelled();
  }
  check_lengths();
}

void E57Section::add_packet(std::uint64_t at, std::uint64_t length) {
  const auto fail = [&](const std::string& what) {
    throw Error(
        fmt::format("{}: {}: the data packet at byte {} {}", pages_.path(), scan_.label, pages_.physical(at), what));
  };
  const std::size_t all = scan_.fields.size();
  if (length < data_header) fail(fmt::format("has {} bytes", length));
  const auto count = pages_.number<std::uint16_t>(at + 4);
  if (count != all) fail(fmt::format("has {} byte streams, but the records have {} fields", count, all));
  if (length < data_header + 2 * all) fail(fmt::format("has {} bytes", length));
  std::vector<std::uint16_t> lengths(all);
  pages_.read(at + data_header, 2 * all, reinterpret_cast<std::byte*>(lengths.data()));
  std::vector<std::uint64_t> places(all);
  std::uint64_t place = at + data_header + 2 * all;
  for (std::size_t f = 0; f < all; ++f) {
    places[f] = place;
    place += lengths[f];
  }
  if (place > at + length) fail(fmt::format("has {} bytes, but its streams need {}", length, place - at));
  for (std::size_t s = 0; s < streams(); ++s) {
    const auto f = static_cast<std::size_t>(wanted_[s]);
    const std::uint64_t before = ends_.size() < streams() ? 0 : ends_[ends_.size() - streams()];
    places_.push_back(places[f]);
    ends_.push_back(before + lengths[f]);
  }
}

void E57Section::check_lengths() const {
  bool any_bits = false;
  for (std::size_t s = 0; s < streams(); ++s) {
    const E57Field& field = scan_.fields[static_cast<std::size_t>(wanted_[s])];
    any_bits = any_bits || field.bits > 0;
    if (field.bits == 0) continue;
    const std::uint64_t bytes = ends_.empty() ? 0 : ends_[ends_.size() - streams() + s];
    const std::uint64_t records = bytes / field.bits * 8 + bytes % field.bits * 8 / field.bits;
    if (records < scan_.records)
      throw Error(fmt::format("{}: {}: truncated: {} points are promised, but the field {} has {} bytes in the section "
                              "at byte {}: {} points",
                              pages_.path(), scan_.label, scan_.records, field.name, bytes, scan_.section, records),
                  "copy or export the file again");
  }
  constexpr std::uint64_t few = 65536;
  if (!any_bits && scan_.records > few)
    throw Error(fmt::format("{}: {}: all of its {} points lie in one place: none of its fields has any bits",
                            pages_.path(), scan_.label, scan_.records));
}

void E57Section::gather(std::size_t which, std::uint64_t begin, std::size_t size, std::byte* to) const {
  // The first packet whose bytes of the stream end behind `begin`.
  std::size_t low = 0, high = ends_.size() / streams();
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (ends_[middle * streams() + which] <= begin)
      low = middle + 1;
    else
      high = middle;
  }
  for (std::size_t p = low; size > 0; ++p) {
    const std::size_t i = p * streams() + which;
    const std::uint64_t first = p == 0 ? 0 : ends_[i - streams()];
    const std::size_t some = std::min<std::uint64_t>(size, ends_[i] - begin);
    pages_.read(places_[i] + (begin - first), some, to);
    to += some;
    begin += some;
    size -= some;
  }
}

void E57Section::read(std::size_t which, std::uint64_t first, std::size_t count, double* to,
                      std::vector<std::byte>& scratch) const {
  const E57Field& field = scan_.fields[static_cast<std::size_t>(wanted_[which])];
  const std::uint64_t begin = first / 8 * field.bits + first % 8 * field.bits / 8;
  const std::size_t shift = first % 8 * field.bits % 8;
  const std::size_t size = (shift + count * field.bits + 7) / 8;
  scratch.resize(size + 16);
  if (field.bits > 0) gather(which, begin, size, scratch.data());
  if (field.kind == E57Field::Kind::f32) {
    for (std::size_t i = 0; i < count; ++i) to[i] = static_cast<double>(load<float>(scratch.data() + 4 * i));
    return;
  }
  if (field.kind == E57Field::Kind::f64) {
    std::memcpy(to, scratch.data(), 8 * count);
    return;
  }
  unpack(field, shift, count, scratch.data(), to);
  if (field.scale == 1 && field.offset == 0) return;
  for (std::size_t i = 0; i < count; ++i) to[i] = to[i] * field.scale + field.offset;
}

}  // namespace atrium::io
