#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>

#include "modules/io/laz_chunk.hpp"
#include "modules/io/laz_fields.hpp"
#include "modules/io/scalar.hpp"

namespace atrium::io {
namespace {

/// What is known of one scanner channel.
struct Channel {
  explicit Channel(const LasPoint& p, unsigned number_of_returns, unsigned number_of_return)
      : point(p), returns(number_of_returns), return_number(number_of_return) {
    heights.fill(p.z);
    intensities.fill(p.intensity);
  }
  LasPoint point;
  unsigned returns, return_number;
  unsigned flags = 0;  ///< of the class (bit 2: withheld), scan direction, edge of flight line
  bool time_changed = false;

  LazModels changes{8, 128}, return_counts{16, 16}, return_numbers{16, 16}, classes{64, 256}, flag_models{64, 64};
  LazModel same_time{13, true}, channels{3, true};
  LazInteger dx{32, 2}, dy{32, 22}, z{32, 20}, intensity{16, 4};
  std::array<LazMedian, 12> median_x, median_y;
  std::array<std::int32_t, 8> heights{};
  std::array<std::uint16_t, 8> intensities{};
};

/// LASzip's items POINT14, RGB14 and RGBNIR14, version 3. Each field has a stream of its own: those that nobody wants
/// (times, angles, sources, near infrared, extra bytes) are not decoded.
class LayeredChunk : public LazChunk {
 public:
  LayeredChunk(const std::byte* data, std::size_t size, int type, std::size_t extra, std::size_t points)
      : record_(las_records[static_cast<std::size_t>(type)]) {
    LasPoint first = las_point(data, record_);
    const auto returns = std::to_integer<unsigned>(data[14]);
    const auto flags = std::to_integer<unsigned>(data[15]);
    channel_ = flags >> 4U & 3U;
    rgb_channel_ = channel_;
    rgb_of_[channel_] = first.rgb;
    rgb_used_[channel_] = true;
    channels_[channel_] = std::make_unique<Channel>(first, returns >> 4U, returns & 15U);
    channels_[channel_]->flags = (flags & 15U) | (flags >> 6U & 3U) << 4U;
    open_layers(data, size, extra, points);
    if (has_rgb()) colours_[channel_].emplace();
  }

  const LasPoint& next() override {
    if (is_first_) {
      is_first_ = false;
      return channels_[channel_]->point;
    }
    const std::uint32_t changes = read_channel();
    Channel& c = *channels_[channel_];
    const bool time_changed = (changes & 16U) != 0;
    read_returns(c, changes, time_changed);
    read_place(c, time_changed);
    read_rest(c, time_changed);
    c.time_changed = time_changed;
    if (has_rgb()) c.point.rgb = rgb();
    return c.point;
  }
  bool exhausted() const override {
    return !is_first_ &&
           (xy_.exhausted() || (z_ && z_->exhausted()) || (class_ && class_->exhausted()) ||
            (flags_ && flags_->exhausted()) || (intensity_ && intensity_->exhausted()) || (rgb_ && rgb_->exhausted()));
  }

 private:
  bool has_rgb() const { return record_.rgb >= 0; }

  void open_layers(const std::byte* data, std::size_t size, std::size_t extra, std::size_t points) {
    constexpr std::size_t point_layers = 9;
    const std::size_t layers = point_layers + (has_rgb() ? 1 : 0) + (record_.nir >= 0 ? 1 : 0) + extra;
    std::size_t at = static_cast<std::size_t>(record_.size) + extra;
    if (size < at || size - at < 4 + 4 * layers) throw std::out_of_range("its layers do not fit into it");
    if (load<std::uint32_t>(data + at) != points)
      throw std::out_of_range("it says that it has another number of points");
    at += 4;
    const std::byte* sizes = data + at;
    at += 4 * layers;
    for (std::size_t l = 0; l < layers; ++l) {
      const std::size_t bytes = load<std::uint32_t>(sizes + 4 * l);
      if (bytes > size - at) throw std::out_of_range("its layers do not fit into it");
      const auto opened = [&] { return bytes == 0 ? std::nullopt : std::optional(LazDecoder(data + at, bytes)); };
      if (l == 0) xy_ = LazDecoder(data + at, bytes);
      if (l == 1) z_ = opened();
      if (l == 2) class_ = opened();
      if (l == 3) flags_ = opened();
      if (l == 4) intensity_ = opened();
      if (l == point_layers && has_rgb()) rgb_ = opened();
      at += bytes;
    }
  }

  /// Reads what changed, and makes the point's channel the current one.
  std::uint32_t read_channel() {
    Channel& c = *channels_[channel_];
    const std::size_t context =
        (c.return_number == 1 ? 1 : 0) + (c.return_number >= c.returns ? 2 : 0) + (c.time_changed ? 4 : 0);
    const std::uint32_t changes = xy_.symbol(c.changes[context]);
    if ((changes & 64U) != 0) {
      const unsigned to = (channel_ + xy_.symbol(c.channels) + 1) & 3U;
      if (!channels_[to]) {
        channels_[to] = std::make_unique<Channel>(c.point, c.returns, c.return_number);
        channels_[to]->flags = c.flags;
      }
      channel_ = to;
    }
    return changes;
  }

  void read_returns(Channel& c, std::uint32_t changes, bool time_changed) {
    if ((changes & 4U) != 0) c.returns = xy_.symbol(c.return_counts[c.returns]);
    switch (changes & 3U) {
      case 0: break;
      case 1: c.return_number = (c.return_number + 1) & 15U; break;
      case 2: c.return_number = (c.return_number + 15) & 15U; break;
      default:
        c.return_number = time_changed ? xy_.symbol(c.return_numbers[c.return_number])
                                       : (c.return_number + xy_.symbol(c.same_time) + 2) & 15U;
    }
  }

  void read_place(Channel& c, bool time_changed) {
    const unsigned n = c.returns, r = c.return_number;
    const bool single = n == 1;
    const std::size_t m = 2U * laz_return_map_6(n, r) + (time_changed ? 1 : 0);
    const auto add = [](std::int32_t a, std::int32_t b) {  // may wrap around
      return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) + static_cast<std::uint32_t>(b));
    };
    std::int32_t difference = c.dx.decode(xy_, c.median_x[m].get(), single ? 1 : 0);
    c.median_x[m].add(difference);
    c.point.x = add(c.point.x, difference);
    difference = c.dy.decode(xy_, c.median_y[m].get(), laz_context(c.dx.bits(), 20, single));
    c.median_y[m].add(difference);
    c.point.y = add(c.point.y, difference);
    if (!z_) return;
    std::int32_t& height = c.heights[std::min(n > r ? n - r : r - n, 7U)];
    height = c.z.decode(*z_, height, laz_context((c.dx.bits() + c.dy.bits()) / 2, 18, single));
    c.point.z = height;
  }

  void read_rest(Channel& c, bool time_changed) {
    const unsigned kind = (c.return_number == 1 ? 2 : 0) + (c.return_number >= c.returns ? 1 : 0);
    if (class_)
      c.point.classification = static_cast<std::uint8_t>(
          class_->symbol(c.classes[2U * (c.point.classification & 31U) + (kind == 3 ? 1 : 0)]));
    if (flags_) {
      c.flags = flags_->symbol(c.flag_models[c.flags]);
      c.point.withheld = (c.flags & 4U) != 0;
    }
    if (!intensity_) return;
    std::uint16_t& last = c.intensities[2 * kind + (time_changed ? 1 : 0)];
    last = static_cast<std::uint16_t>(c.intensity.decode(*intensity_, last, kind));
    c.point.intensity = last;
  }

  /// After a change of channels LASzip still predicts from the colour of the channel before, unless the new one is met
  /// for the first time.
  std::array<std::uint16_t, 3> rgb() {
    std::array<std::uint16_t, 3>* last = &rgb_of_[rgb_channel_];
    if (rgb_channel_ != channel_) {
      rgb_channel_ = channel_;
      if (!rgb_used_[channel_]) {
        rgb_used_[channel_] = true;
        rgb_of_[channel_] = *last;
        colours_[channel_].emplace();
        last = &rgb_of_[channel_];
      }
    }
    if (rgb_) colours_[channel_]->decode(*rgb_, *last);
    return *last;
  }

  LasRecord record_;
  bool is_first_ = true;
  unsigned channel_ = 0, rgb_channel_ = 0;
  std::array<std::unique_ptr<Channel>, 4> channels_;
  LazDecoder xy_;
  std::optional<LazDecoder> z_, class_, flags_, intensity_, rgb_;
  std::array<std::optional<LazColours>, 4> colours_;
  std::array<std::array<std::uint16_t, 3>, 4> rgb_of_{};
  std::array<bool, 4> rgb_used_{};
};

}  // namespace

std::unique_ptr<LazChunk> layered_chunk(const std::byte* data, std::size_t size, int type, std::size_t extra,
                                        std::size_t points) {
  return std::make_unique<LayeredChunk>(data, size, type, extra, points);
}

}  // namespace atrium::io
