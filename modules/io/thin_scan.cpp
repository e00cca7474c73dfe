#include "modules/io/thin_scan.hpp"

#include <fmt/format.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>

#include "graph/api/clocks.hpp"
#include "graph/api/error.hpp"
#include "graph/api/text.hpp"
#include "modules/io/column_source.hpp"
#include "modules/io/decode.hpp"
#include "modules/io/decode_source.hpp"
#include "modules/io/morton_places.hpp"
#include "modules/io/parallel_blocks.hpp"
#include "modules/io/voxel_noise.hpp"
#include "modules/io/voxel_sums.hpp"

namespace atrium::io {
namespace {

constexpr double reading_share = 0.75;  // of the time; the rest is to join the voxels
constexpr std::size_t shard_count = 64, round_blocks = 64;
constexpr std::int64_t voxel_reach = std::int64_t{1} << 20U;  // voxels on either side of the origin
constexpr std::uint64_t axis_mask = (std::uint64_t{1} << 21U) - 1, wild = ~std::uint64_t{0};

/// The voxel's place along each axis in 21 bits; `wild` if it is too far away.
std::uint64_t voxel_key(const Eigen::Vector3f& point, double inverse) {
  std::uint64_t key = 0;
  for (unsigned a = 0; a < 3; ++a) {
    const double at = std::floor(static_cast<double>(point[a]) * inverse) + static_cast<double>(voxel_reach);
    if (!(at >= 0 && at < static_cast<double>(2 * voxel_reach))) return wild;
    key |= static_cast<std::uint64_t>(at) << (21 * a);
  }
  return key;
}

/// The points of a block with their voxels, sorted by shards, in the file's order within each.
struct KeyedBlock {
  LocalBlock local;
  std::vector<std::uint64_t> keys;
  std::vector<std::uint32_t> order;
  std::array<std::uint32_t, shard_count + 2> begins{};  // of shards; the last one is that of wild points

  void sort(double inverse) {
    const auto& points = local.points.points;
    keys.resize(points.size());
    order.resize(points.size());
    begins.fill(0);
    for (std::size_t i = 0; i < points.size(); ++i) {
      keys[i] = voxel_key(points[i], inverse);
      ++begins[shard(keys[i]) + 1];
    }
    for (std::size_t s = 0; s <= shard_count; ++s) begins[s + 1] += begins[s];
    auto next = begins;
    for (std::size_t i = 0; i < points.size(); ++i) order[next[shard(keys[i])]++] = static_cast<std::uint32_t>(i);
  }
  static std::size_t shard(std::uint64_t key) {
    return key == wild ? shard_count : static_cast<std::size_t>((key * 0xbf58476d1ce4e5b9ULL) >> 58U);
  }
};

/// The places of keys, counted from the lowest of all voxels.
class KeyPlaces {
 public:
  explicit KeyPlaces(const std::vector<VoxelSums>& shards) {
    low_.fill(axis_mask);
    for (const auto& shard : shards)
      for (std::size_t v = 0; v < shard.size(); ++v)
        for (unsigned a = 0; a < 3; ++a) {
          const std::uint64_t at = along(shard.key(v), a);
          low_[a] = std::min(low_[a], at);
          high_[a] = std::max(high_[a], at);
        }
  }
  MortonPlaces places() const {
    std::array<unsigned, 3> bits{};
    for (unsigned a = 0; a < 3; ++a)
      bits[a] = high_[a] < low_[a] ? 0 : static_cast<unsigned>(std::bit_width(high_[a] - low_[a]));
    return MortonPlaces(bits);
  }
  VoxelPlace place(std::uint64_t key) const {
    VoxelPlace place{};
    for (unsigned a = 0; a < 3; ++a) place[a] = static_cast<std::uint32_t>(along(key, a) - low_[a]);
    return place;
  }

 private:
  static std::uint64_t along(std::uint64_t key, unsigned axis) { return key >> (21 * axis) & axis_mask; }

  std::array<std::uint64_t, 3> low_{}, high_{};
};

/// A voxel by its number among all places and by its number in the shards, one after the other.
struct [[gnu::packed, gnu::aligned(4)]] Voxel {
  std::uint64_t place;
  std::uint32_t index;
};

class Thinning {
 public:
  Thinning(const RawGeometry& geometry, const PointSource& source, double scale, double voxel, double share,
           const Context& context)
      : geometry_(geometry),
        source_(source),
        scale_(scale),
        voxel_(voxel),
        share_(share),
        context_(context),
        shards_(shard_count) {}

  Cloud run() {
    origin_ = choose_origin(geometry_, scale_);
    const std::size_t blocks = source_.blocks();
    for (std::size_t first = 0; first < blocks;) {
      const std::size_t last = end_of_round(first);
      round(first, last);
      drop_pages(geometry_);  // what was read is not read again
      context_.progress(reading_share * static_cast<double>(last) / static_cast<double>(blocks));
      first = last;
    }
    round_ = {};
    check_wild();
    Cloud cloud = joined();
    cloud.origin = origin_;
    finish_blocks(geometry_, counts_, scale_, cloud, context_);
    return cloud;
  }

 private:
  /// Some blocks that are read at once: blocks of LAZ and of text hold many more points than others.
  std::size_t end_of_round(std::size_t first) const {
    constexpr std::size_t some_points = 8192 * round_blocks;
    std::size_t last = first, points = 0;
    while (last < source_.blocks() && last - first < round_blocks && points < some_points)
      points += source_.capacity(last++);
    return last;
  }

  void round(std::size_t first, std::size_t last) {
    for_blocks(context_, last - first, [&](std::size_t b) {
      PointBlock block;
      source_.read(first + b, block);
      localise(block, source_.roles(), scale_, origin_, round_[b].local);
      round_[b].sort(1 / voxel_);
    });
    context_.parallel_chunks(shard_count, 1, [&](std::size_t s, std::size_t, std::size_t) {
      for (std::size_t b = 0; b < last - first; ++b)
        for (std::size_t k = round_[b].begins[s]; k < round_[b].begins[s + 1]; ++k)
          shards_[s].add(round_[b].keys[round_[b].order[k]], round_[b].local.points, round_[b].order[k]);
    });
    for (std::size_t b = 0; b < last - first; ++b) {
      const KeyedBlock& block = round_[b];
      counts_.misses += block.local.misses;
      counts_.not_finite += block.local.not_finite;
      counts_.bad_normals += block.local.bad_normals;
      counts_.points += block.keys.size();
      for (std::size_t k = block.begins[shard_count]; k < block.begins[shard_count + 1]; ++k) {
        const Cloud one = select(block.local.points, {block.order[k]});
        append(one, wild_);
        ++wild_count_;
      }
    }
    if (wild_count_ > 100 && wild_count_ * 1000 > geometry_.count) check_wild();  // whatever comes yet
  }

  static void append(const Cloud& from, Cloud& to) {
    const auto add = [](const auto& a, auto& b) { b.insert(b.end(), a.begin(), a.end()); };
    add(from.points, to.points);
    add(from.normals, to.normals);
    add(from.colours, to.colours);
    add(from.labels, to.labels);
    add(from.intensities, to.intensities);
    add(from.source, to.source);
  }

  void check_wild() const {
    if (wild_count_ == 0) return;
    const double away = voxel_ * static_cast<double>(voxel_reach);
    if (wild_count_ > 100 && wild_count_ * 1000 > counts_.points)
      throw Error(
          fmt::format("{}: {} of {} points lie more than {:.6g} m from the cloud's middle: too far for voxels of "
                      "{:.6g} m",
                      geometry_.path, wild_count_, counts_.points, away, voxel_),
          "check the unit of the scan, or take larger voxels");
    context_.warn(fmt::format("{}: {} more than {:.6g} m from the cloud's middle: kept as read", geometry_.path,
                              counted(wild_count_, "point lies", "points lie"), away));
  }

  /// Columns are taken and given back one after the other: the cloud and all sums are never there at once.
  Cloud joined() {
    for (auto& shard : shards_) first_.push_back(first_.back() + shard.size());
    context_.parallel_chunks(shard_count, 1, [&](std::size_t s, std::size_t, std::size_t) { shards_[s].close(); });
    const KeyPlaces keys(shards_);
    VoxelCounts counts{keys.places(), {}, {}};
    std::vector<Voxel> voxels = sorted_voxels(keys, counts.places);
    context_.progress((1 + 2 * reading_share) / 3);
    Cloud cloud;
    take(Role::nx, voxels, cloud.normals, &VoxelSums::normal, &VoxelSums::drop_normals);
    take(Role::red, voxels, cloud.colours, &VoxelSums::colour, &VoxelSums::drop_colours);
    take(Role::intensity, voxels, cloud.intensities, &VoxelSums::intensity, &VoxelSums::drop_intensities);
    take(Role::label, voxels, cloud.labels, &VoxelSums::label, &VoxelSums::drop_labels);
    take(Role::source, voxels, cloud.source, &VoxelSums::source, &VoxelSums::drop_sources);
    if (share_ > 0) take(Role::x, voxels, counts.points, &VoxelSums::points, nullptr);
    take(Role::x, voxels, cloud.points, &VoxelSums::point, &VoxelSums::drop_points);
    context_.progress((2 + reading_share) / 3);
    if (share_ > 0) {
      counts.numbers.reserve(voxels.size());
      for (const Voxel& voxel : voxels) counts.numbers.push_back(voxel.place);
      voxels = {};
      leave_out_noise(counts, cloud);
    }
    append(wild_, cloud);
    return cloud;
  }

  std::vector<Voxel> sorted_voxels(const KeyPlaces& keys, const MortonPlaces& places) {
    std::vector<Voxel> voxels(first_.back());
    context_.parallel_chunks(shard_count, 1, [&](std::size_t s, std::size_t, std::size_t) {
      for (std::size_t v = 0; v < shards_[s].size(); ++v)
        voxels[first_[s] + v] = {places.number(keys.place(shards_[s].key(v))),
                                 static_cast<std::uint32_t>(first_[s] + v)};
      shards_[s].drop_keys();
    });
    give_back_memory();
    tbb::parallel_sort(voxels.begin(), voxels.end(), [](const Voxel& a, const Voxel& b) { return a.place < b.place; });
    return voxels;
  }

  /// Fills a column of the cloud, if the source has it, and gives back what it was made from.
  template <class T, class Mean>
  void take(Role role, const std::vector<Voxel>& voxels, std::vector<T>& column, Mean mean, void (VoxelSums::*drop)()) {
    if (!source_.has(role)) return;
    column.resize(voxels.size());
    context_.parallel_for(voxels.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const std::size_t voxel = voxels[i].index;
        const auto s =
            static_cast<std::size_t>(std::upper_bound(first_.begin(), first_.end(), voxel) - first_.begin()) - 1;
        column[i] = (shards_[s].*mean)(voxel - first_[s]);
      }
    });
    if (drop != nullptr)
      for (auto& shard : shards_) (shard.*drop)();
    give_back_memory();
  }

  void leave_out_noise(const VoxelCounts& voxels, Cloud& cloud) const {
    const std::vector<std::uint8_t> noise = noise_voxels(voxels, share_, context_);
    const std::size_t all = noise.size();
    std::size_t kept = 0;
    std::uint64_t points = 0;
    for (std::size_t i = 0; i < all; ++i) {
      kept += noise[i] == 0 ? 1 : 0;
      points += noise[i] == 0 ? 0 : voxels.points[i];
    }
    constexpr double usual = 0.05;  // of the points: more than strays and noise are
    const double lost = static_cast<double>(points) / static_cast<double>(counts_.points);
    const auto said = fmt::format("{} of {} voxels are left out as noise: they hold {:.2g} % of the points", all - kept,
                                  all, 100 * lost);
    if (lost > usual)
      context_.warn(said + ", so surfaces seen from far may be among them; `voxel_share: 0` keeps all");
    else if (kept < all)
      context_.info(said);
    constexpr std::size_t least = 3;
    if (kept < std::min(least, all))
      throw Error(fmt::format("{}: `voxel_share` leaves {} of {} voxels", geometry_.path, kept, all),
                  "the scan is too sparse for it: a smaller share, or 0, keeps more");
    if (kept == all) return;
    const auto keep = [&](auto& column) {
      if (column.empty()) return;
      std::size_t next = 0;
      for (std::size_t i = 0; i < all; ++i)
        if (noise[i] == 0) column[next++] = column[i];
      column.resize(kept);
      column.shrink_to_fit();
    };
    keep(cloud.points);
    keep(cloud.normals);
    keep(cloud.colours);
    keep(cloud.labels);
    keep(cloud.intensities);
    keep(cloud.source);
  }

  const RawGeometry& geometry_;
  const PointSource& source_;
  double scale_, voxel_, share_;
  const Context& context_;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  std::vector<VoxelSums> shards_;
  std::vector<std::size_t> first_{0};  // index of each shard's first voxel, and how many there are in all
  std::array<KeyedBlock, round_blocks> round_;
  RecordCounts counts_;
  std::size_t wild_count_ = 0;
  Cloud wild_;
};

}  // namespace

Cloud thinned(const RawGeometry& geometry, double scale, double voxel, double share, const Context& context) {
  check_count(geometry);
  if (geometry.source) return Thinning(geometry, *geometry.source, scale, voxel, share, context).run();
  const ColumnSource source(geometry, context);
  return Thinning(geometry, source, scale, voxel, share, context).run();
}

Cloud sample_of(const RawGeometry& geometry, const Context& context) {
  constexpr std::size_t most_points = 1'000'000;
  check_count(geometry);
  const std::unique_ptr<const ColumnSource> columns =
      geometry.source ? nullptr
                      : std::make_unique<const ColumnSource>(geometry, context, ColumnSource::Wanted::positions);
  const PointSource& source = geometry.source ? *geometry.source : static_cast<const PointSource&>(*columns);
  const std::size_t blocks = source.blocks();
  const std::size_t step = std::max<std::size_t>(1, (geometry.count + most_points - 1) / most_points);
  const Eigen::Vector3d origin = choose_origin(geometry, 1);
  std::vector<Cloud> parts((blocks + step - 1) / step);
  context.parallel_chunks(parts.size(), 1, [&](std::size_t k, std::size_t, std::size_t) {
    PointBlock block;
    LocalBlock local;
    constexpr std::size_t some_blocks = 32;
    if (k % some_blocks == 0) drop_pages(geometry);
    source.read(k * step, block);
    localise(block, source.roles(), 1, origin, local);
    parts[k].points = std::move(local.points.points);
  });
  drop_pages(geometry);
  Cloud cloud;
  cloud.origin = origin;
  for (const auto& part : parts) cloud.points.insert(cloud.points.end(), part.points.begin(), part.points.end());
  return cloud;
}

}  // namespace atrium::io
