#include <algorithm>
#include <cstdlib>

#include "modules/io/laz_chunk.hpp"
#include "modules/io/laz_fields.hpp"
#include "modules/io/laz_gps_time.hpp"
#include "modules/io/scalar.hpp"

namespace atrium::io {
namespace {

/// LASzip's items POINT10, GPSTIME11, RGB12 and BYTE, version 2. All fields stand in one stream, so that also those
/// that nobody wants are decoded.
class PointwiseChunk : public LazChunk {
 public:
  PointwiseChunk(const std::byte* data, std::size_t size, int type, std::size_t extra)
      : record_(las_records[static_cast<std::size_t>(type)]), extra_(extra, 256), bytes_(extra) {
    point_ = las_point(data, record_);
    flags_ = std::to_integer<unsigned>(data[14]);
    class_byte_ = std::to_integer<std::uint32_t>(data[15]);
    angle_ = std::to_integer<std::uint32_t>(data[16]);
    user_ = std::to_integer<std::uint32_t>(data[17]);
    source_ = load<std::uint16_t>(data + 18);
    if (record_.gps >= 0) gps_.start(load<std::int64_t>(data + record_.gps));
    const std::size_t first = static_cast<std::size_t>(record_.size) + extra;
    for (std::size_t i = 0; i < extra; ++i)
      bytes_[i] = std::to_integer<std::uint8_t>(data[static_cast<std::size_t>(record_.size) + i]);
    decoder_ = LazDecoder(data + first, size - first);
  }

  const LasPoint& next() override {
    if (is_first_) {
      is_first_ = false;
      return point_;
    }
    others();
    coordinates();
    if (record_.gps >= 0) gps_.decode(decoder_);
    if (record_.rgb >= 0) colours_.decode(decoder_, point_.rgb);
    for (std::size_t i = 0; i < bytes_.size(); ++i)
      bytes_[i] = static_cast<std::uint8_t>(bytes_[i] + decoder_.symbol(extra_[i]));
    return point_;
  }
  bool exhausted() const override { return decoder_.exhausted() && !is_first_; }

 private:
  unsigned return_number() const { return flags_ & 7U; }
  unsigned returns() const { return flags_ >> 3U & 7U; }

  void others() {
    const std::uint32_t changes = decoder_.symbol(changes_);
    if ((changes & 32U) != 0) flags_ = decoder_.symbol(flag_models_[flags_]);
    const unsigned m = laz_return_map(returns(), return_number());
    if ((changes & 16U) != 0)
      intensities_[m] = static_cast<std::uint16_t>(intensity_.decode(decoder_, intensities_[m], std::min(m, 3U)));
    point_.intensity = intensities_[m];
    if ((changes & 8U) != 0) {
      class_byte_ = decoder_.symbol(class_models_[class_byte_]);
      point_.classification = static_cast<std::uint8_t>(class_byte_ & 31U);
      point_.withheld = (class_byte_ & 128U) != 0;
    }
    if ((changes & 4U) != 0) angle_ = (angle_ + decoder_.symbol(angle_models_[flags_ >> 6U & 1U])) & 0xFFU;
    if ((changes & 2U) != 0) user_ = decoder_.symbol(user_models_[user_]);
    if ((changes & 1U) != 0) source_ = source_integer_.decode(decoder_, source_);
  }

  void coordinates() {
    const unsigned n = returns(), r = return_number(), m = laz_return_map(n, r);
    const bool single = n == 1;
    const auto add = [](std::int32_t a, std::int32_t b) {  // may wrap around
      return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) + static_cast<std::uint32_t>(b));
    };
    std::int32_t difference = dx_.decode(decoder_, median_x_[m].get(), single ? 1 : 0);
    median_x_[m].add(difference);
    point_.x = add(point_.x, difference);
    difference = dy_.decode(decoder_, median_y_[m].get(), laz_context(dx_.bits(), 20, single));
    median_y_[m].add(difference);
    point_.y = add(point_.y, difference);
    std::int32_t& height = heights_[n > r ? n - r : r - n];
    height = z_.decode(decoder_, height, laz_context((dx_.bits() + dy_.bits()) / 2, 18, single));
    point_.z = height;
  }

  LasRecord record_;
  LasPoint point_;
  bool is_first_ = true;
  unsigned flags_ = 0;
  std::uint32_t class_byte_ = 0, angle_ = 0, user_ = 0;
  std::int32_t source_ = 0;
  LazDecoder decoder_;
  LazModel changes_{64, true};
  LazModels flag_models_{256, 256}, class_models_{256, 256}, user_models_{256, 256}, angle_models_{2, 256}, extra_;
  LazInteger intensity_{16, 4}, source_integer_{16, 1}, dx_{32, 2}, dy_{32, 22}, z_{32, 20};
  std::array<std::uint16_t, 16> intensities_{};
  std::array<LazMedian, 16> median_x_, median_y_;
  std::array<std::int32_t, 8> heights_{};
  LazGpsTime gps_;
  LazColours colours_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace

std::unique_ptr<LazChunk> pointwise_chunk(const std::byte* data, std::size_t size, int type, std::size_t extra) {
  return std::make_unique<PointwiseChunk>(data, size, type, extra);
}

}  // namespace atrium::io
