#include "modules/io/laz_writer.hpp"

#include <algorithm>
#include <array>

#include "modules/io/las_point.hpp"
#include "modules/io/laz_encoder.hpp"
#include "modules/io/laz_fields.hpp"
#include "modules/io/scalar.hpp"

namespace atrium::io {
namespace {

template <class T>
void append(std::string& bytes, T value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

std::uint32_t byte_at(const std::byte* record, std::size_t i) { return std::to_integer<std::uint32_t>(record[i]); }

/// Models that are made when they are first used.
class EncoderModels {
 public:
  EncoderModels(std::size_t models, std::uint32_t symbols) : symbols_(symbols), models_(models) {}
  LazModel& operator[](std::size_t i) {
    if (models_[i].empty()) models_[i] = LazModel(symbols_, false);
    return models_[i];
  }

 private:
  std::uint32_t symbols_;
  std::vector<LazModel> models_;
};

/// The counterpart of the decoder of pointwise chunks, for the items POINT10 and RGB12.
class PointwiseEncoder {
 public:
  explicit PointwiseEncoder(int type) : type_(las_records[static_cast<std::size_t>(type)]) {}

  void first(const std::byte* record) { last_ = record; }
  void add(const std::byte* record) {
    others(record);
    coordinates(record);
    if (type_.rgb >= 0) colours(record + type_.rgb, last_ + type_.rgb);
    last_ = record;
  }
  const std::string& finish() { return encoder_.finish(); }

 private:
  static constexpr std::size_t intensity_at = 12, flags_at = 14, class_at = 15, angle_at = 16, user_at = 17,
                               source_at = 18;

  bool differs(const std::byte* record, std::size_t at) const { return record[at] != last_[at]; }

  void others(const std::byte* record) {
    const std::uint32_t flags = byte_at(record, flags_at);
    const unsigned m = laz_return_map(flags >> 3U & 7U, flags & 7U);
    const auto intensity = load<std::uint16_t>(record + intensity_at);
    const auto source = load<std::uint16_t>(record + source_at), last_source = load<std::uint16_t>(last_ + source_at);
    const std::uint32_t changes = (differs(record, flags_at) ? 32U : 0U) | (intensity != intensities_[m] ? 16U : 0U) |
                                  (differs(record, class_at) ? 8U : 0U) | (differs(record, angle_at) ? 4U : 0U) |
                                  (differs(record, user_at) ? 2U : 0U) | (source != last_source ? 1U : 0U);
    encoder_.symbol(changes_, changes);
    if ((changes & 32U) != 0) encoder_.symbol(flag_models_[byte_at(last_, flags_at)], flags);
    if ((changes & 16U) != 0) {
      intensity_.encode(encoder_, intensities_[m], intensity, std::min(m, 3U));
      intensities_[m] = intensity;
    }
    if ((changes & 8U) != 0) encoder_.symbol(class_models_[byte_at(last_, class_at)], byte_at(record, class_at));
    if ((changes & 4U) != 0)
      encoder_.symbol(angle_models_[flags >> 6U & 1U], (byte_at(record, angle_at) - byte_at(last_, angle_at)) & 0xFFU);
    if ((changes & 2U) != 0) encoder_.symbol(user_models_[byte_at(last_, user_at)], byte_at(record, user_at));
    if ((changes & 1U) != 0) source_.encode(encoder_, last_source, source);
  }

  std::int32_t difference(const std::byte* record, std::size_t at) const {  // may wrap around
    return static_cast<std::int32_t>(load<std::uint32_t>(record + at) - load<std::uint32_t>(last_ + at));
  }

  void coordinates(const std::byte* record) {
    const std::uint32_t flags = byte_at(record, flags_at);
    const unsigned n = flags >> 3U & 7U, r = flags & 7U, m = laz_return_map(n, r);
    const bool single = n == 1;
    const std::int32_t dx = difference(record, 0), dy = difference(record, 4);
    dx_.encode(encoder_, median_x_[m].get(), dx, single ? 1 : 0);
    median_x_[m].add(dx);
    dy_.encode(encoder_, median_y_[m].get(), dy, laz_context(dx_.bits(), 20, single));
    median_y_[m].add(dy);
    std::int32_t& height = heights_[n > r ? n - r : r - n];
    const auto z = load<std::int32_t>(record + 8);
    z_.encode(encoder_, height, z, laz_context((dx_.bits() + dy_.bits()) / 2, 18, single));
    height = z;
  }

  /// Six bytes: red, green, blue, the lower one first. Green and blue are foretold by how red changed.
  void colours(const std::byte* now, const std::byte* before) {
    std::uint32_t changes = 0;
    for (std::size_t i = 0; i < 6; ++i) changes |= now[i] != before[i] ? 1U << i : 0U;
    const bool grey = now[0] == now[2] && now[0] == now[4] && now[1] == now[3] && now[1] == now[5];
    if (!grey) changes |= 64U;
    encoder_.symbol(rgb_changes_, changes);
    const auto encode = [&](std::size_t i, int predicted) {
      if ((changes >> i & 1U) != 0)
        encoder_.symbol(rgb_bytes_[i], (byte_at(now, i) - static_cast<std::uint32_t>(predicted)) & 0xFFU);
    };
    const auto old = [&](std::size_t i) { return static_cast<int>(byte_at(before, i)); };
    const auto change = [&](std::size_t i) { return static_cast<int>(byte_at(now, i)) - old(i); };
    encode(0, old(0));
    encode(1, old(1));
    for (std::size_t half = 0; half < 2 && !grey; ++half) {
      encode(2 + half, std::clamp(change(half) + old(2 + half), 0, 255));
      encode(4 + half, std::clamp((change(half) + change(2 + half)) / 2 + old(4 + half), 0, 255));
    }
  }

  LasRecord type_;
  const std::byte* last_ = nullptr;
  LazEncoder encoder_;
  LazModel changes_{64, false}, rgb_changes_{128, false};
  EncoderModels flag_models_{256, 256}, class_models_{256, 256}, user_models_{256, 256}, angle_models_{2, 256},
      rgb_bytes_{6, 256};
  LazIntegerEncoder intensity_{16, 4}, source_{16, 1}, dx_{32, 2}, dy_{32, 22}, z_{32, 20};
  std::array<std::uint16_t, 16> intensities_{};
  std::array<LazMedian, 16> median_x_, median_y_;
  std::array<std::int32_t, 8> heights_{};
};

std::string chunk_of(const std::byte* records, std::size_t count, int type) {
  const auto size = static_cast<std::size_t>(las_records[static_cast<std::size_t>(type)].size);
  PointwiseEncoder encoder(type);
  encoder.first(records);
  for (std::size_t i = 1; i < count; ++i) encoder.add(records + i * size);
  return std::string(reinterpret_cast<const char*>(records), size) + encoder.finish();
}

}  // namespace

std::string LazWriter::description(int type) {
  struct Item {
    std::uint16_t type, size;
  };
  constexpr Item point{6, 20}, rgb{8, 6};
  const std::vector<Item> items = type == 0 ? std::vector{point} : std::vector{point, rgb};
  std::string bytes;
  append<std::uint16_t>(bytes, 2);  // pointwise, in chunks
  append<std::uint16_t>(bytes, 0);  // arithmetic coder
  append<std::uint8_t>(bytes, 2);   // version 2.2
  append<std::uint8_t>(bytes, 2);
  append<std::uint16_t>(bytes, 0);
  append<std::uint32_t>(bytes, 0);
  append<std::uint32_t>(bytes, points_of_chunk);
  append<std::int64_t>(bytes, -1);
  append<std::int64_t>(bytes, -1);
  append(bytes, static_cast<std::uint16_t>(items.size()));
  for (const auto& item : items) {
    append(bytes, item.type);
    append(bytes, item.size);
    append<std::uint16_t>(bytes, 2);
  }
  return bytes;
}

std::string LazWriter::compressed(const std::string& records, int type, std::uint64_t begin, const Context& context) {
  const auto size = static_cast<std::size_t>(las_records[static_cast<std::size_t>(type)].size);
  const auto* data = reinterpret_cast<const std::byte*>(records.data());
  const std::size_t points = records.size() / size;
  std::vector<std::string> chunks((points + points_of_chunk - 1) / points_of_chunk);
  context.parallel_chunks(points, points_of_chunk, [&](std::size_t c, std::size_t first, std::size_t last) {
    chunks[c] = chunk_of(data + first * size, last - first, type);
  });
  std::size_t total = 8;
  for (const auto& chunk : chunks) total += chunk.size();
  std::string bytes;
  append<std::int64_t>(bytes, static_cast<std::int64_t>(begin + total));
  LazEncoder encoder;
  LazIntegerEncoder integer(32, 2);
  std::int32_t before = 0;
  for (const auto& chunk : chunks) {
    bytes += chunk;
    integer.encode(encoder, before, static_cast<std::int32_t>(chunk.size()), 1);
    before = static_cast<std::int32_t>(chunk.size());
  }
  append<std::uint32_t>(bytes, 0);
  append(bytes, static_cast<std::uint32_t>(chunks.size()));
  return bytes + encoder.finish();
}

}  // namespace atrium::io
