#include "modules/io/thin_scan.hpp"

#include <fmt/format.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>

#include "graph/api/error.hpp"
#include "graph/api/text.hpp"
#include "modules/io/column_source.hpp"
#include "modules/io/decode.hpp"
#include "modules/io/decode_source.hpp"
#include "modules/io/voxel_noise.hpp"
#include "modules/io/voxel_sums.hpp"

namespace atrium::io {
namespace {

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

/// Interleaves the bits of the axes as PointGrid does: those that no voxel has are left out.
class MortonOrder {
 public:
  explicit MortonOrder(const std::vector<VoxelSums>& shards) {
    std::array<std::uint64_t, 3> high{};
    low_.fill(axis_mask);
    for (const auto& shard : shards)
      for (std::size_t v = 0; v < shard.size(); ++v)
        for (unsigned a = 0; a < 3; ++a) {
          const std::uint64_t at = shard.key(v) >> (21 * a) & axis_mask;
          low_[a] = std::min(low_[a], at);
          high[a] = std::max(high[a], at);
        }
    for (unsigned a = 0; a < 3; ++a)
      bits_[a] = high[a] < low_[a] ? 2 : std::max(2U, static_cast<unsigned>(std::bit_width(high[a] - low_[a])));
  }
  /// A voxel's place along each axis, counted from the lowest.
  std::array<std::uint32_t, 3> place_of(std::uint64_t key) const {
    std::array<std::uint32_t, 3> place{};
    for (unsigned a = 0; a < 3; ++a) place[a] = static_cast<std::uint32_t>((key >> (21 * a) & axis_mask) - low_[a]);
    return place;
  }
  std::uint64_t of(std::uint64_t key) const {
    std::uint64_t morton = 0;
    unsigned next = 0;
    for (unsigned bit = 0; bit < 21; ++bit)
      for (unsigned a = 0; a < 3; ++a) {
        if (bit >= bits_[a]) continue;
        const std::uint64_t at = (key >> (21 * a) & axis_mask) - low_[a];
        morton |= (at >> bit & 1U) << next++;
      }
    return morton;
  }

 private:
  std::array<std::uint64_t, 3> low_{};
  std::array<unsigned, 3> bits_{};
};

struct VoxelPlace {
  std::uint64_t morton;
  std::uint32_t shard, voxel;
  bool operator<(const VoxelPlace& other) const { return morton < other.morton; }
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
    for (std::size_t first = 0; first < blocks; first += round_blocks) {
      round(first, std::min(blocks, first + round_blocks));
      context_.progress(static_cast<double>(std::min(blocks, first + round_blocks)) / static_cast<double>(blocks));
    }
    check_wild();
    Cloud cloud = joined();
    cloud.origin = origin_;
    finish_blocks(geometry_, counts_, scale_, cloud, context_);
    return cloud;
  }

 private:
  void round(std::size_t first, std::size_t last) {
    context_.parallel_chunks(last - first, 1, [&](std::size_t b, std::size_t, std::size_t) {
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

  Cloud joined() const {
    const MortonOrder order(shards_);
    std::vector<std::size_t> first(shard_count + 1, 0);
    for (std::size_t s = 0; s < shard_count; ++s) first[s + 1] = first[s] + shards_[s].size();
    std::vector<VoxelPlace> places(first.back());
    context_.parallel_chunks(shard_count, 1, [&](std::size_t s, std::size_t, std::size_t) {
      for (std::size_t v = 0; v < shards_[s].size(); ++v)
        places[first[s] + v] = {order.of(shards_[s].key(v)), static_cast<std::uint32_t>(s),
                                static_cast<std::uint32_t>(v)};
    });
    tbb::parallel_sort(places.begin(), places.end());
    if (share_ > 0) leave_out_noise(order, places);
    Cloud cloud;
    const auto room = [&](Role role) { return source_.has(role) ? places.size() : 0; };
    cloud.points.resize(places.size());
    cloud.normals.resize(room(Role::nx));
    cloud.colours.resize(room(Role::red));
    cloud.intensities.resize(room(Role::intensity));
    cloud.labels.resize(room(Role::label));
    cloud.source.resize(room(Role::source));
    context_.parallel_for(places.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) shards_[places[i].shard].put(places[i].voxel, cloud, i);
    });
    append(wild_, cloud);
    return cloud;
  }

  void leave_out_noise(const MortonOrder& order, std::vector<VoxelPlace>& places) const {
    std::vector<VoxelCount> voxels;
    voxels.reserve(places.size());
    for (const auto& p : places)
      voxels.push_back({order.place_of(shards_[p.shard].key(p.voxel)), shards_[p.shard].points(p.voxel)});
    const std::vector<bool> noise = noise_voxels(voxels, share_, context_);
    std::size_t kept = 0;
    std::uint64_t points = 0;
    for (std::size_t i = 0; i < places.size(); ++i)
      if (noise[i])
        points += voxels[i].points;
      else
        places[kept++] = places[i];
    constexpr double usual = 0.05;  // of the points: more than strays and noise are
    const double lost = static_cast<double>(points) / static_cast<double>(counts_.points);
    const auto said = fmt::format("{} of {} voxels are left out as noise: they hold {:.2g} % of the points",
                                  places.size() - kept, places.size(), 100 * lost);
    if (lost > usual)
      context_.warn(said + ", so surfaces seen from far may be among them; `voxel_share: 0` keeps all");
    else if (kept < places.size())
      context_.info(said);
    constexpr std::size_t least = 3;
    if (kept < std::min(least, places.size()))
      throw Error(fmt::format("{}: `voxel_share` leaves {} of {} voxels", geometry_.path, kept, places.size()),
                  "the scan is too sparse for it: a smaller share, or 0, keeps more");
    places.resize(kept);
  }

  const RawGeometry& geometry_;
  const PointSource& source_;
  double scale_, voxel_, share_;
  const Context& context_;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  std::vector<VoxelSums> shards_;
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
      geometry.source ? nullptr : std::make_unique<const ColumnSource>(geometry, context);
  const PointSource& source = geometry.source ? *geometry.source : static_cast<const PointSource&>(*columns);
  const std::size_t blocks = source.blocks();
  const std::size_t step = std::max<std::size_t>(1, (geometry.count + most_points - 1) / most_points);
  const Eigen::Vector3d origin = choose_origin(geometry, 1);
  std::vector<Cloud> parts((blocks + step - 1) / step);
  context.parallel_chunks(parts.size(), 1, [&](std::size_t k, std::size_t, std::size_t) {
    PointBlock block;
    LocalBlock local;
    source.read(k * step, block);
    localise(block, source.roles(), 1, origin, local);
    parts[k].points = std::move(local.points.points);
  });
  Cloud cloud;
  cloud.origin = origin;
  for (const auto& part : parts) cloud.points.insert(cloud.points.end(), part.points.begin(), part.points.end());
  return cloud;
}

}  // namespace atrium::io
