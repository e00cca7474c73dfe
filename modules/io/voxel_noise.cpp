#include "modules/io/voxel_noise.hpp"

#include <algorithm>
#include <cmath>

#include "modules/io/key_table.hpp"

namespace atrium::io {
namespace {

using Place = std::array<std::uint32_t, 3>;

Place coarse(const Place& place, unsigned bits) { return {place[0] >> bits, place[1] >> bits, place[2] >> bits}; }

/// Numbers places in the order in which they come.
class PlaceTable {
 public:
  std::uint32_t add(const Place& place) { return keys_.add(key_of(place)); }
  Place place(std::size_t number) const {
    const std::uint64_t key = keys_.key(number);
    return {static_cast<std::uint32_t>(key & mask), static_cast<std::uint32_t>(key >> axis_bits & mask),
            static_cast<std::uint32_t>(key >> 2 * axis_bits)};
  }
  /// Calls work(number) for each place that is there of the 27 around one.
  template <class Work>
  void around(const Place& place, const Work& work) const {
    const auto first = [&](std::size_t a) { return place[a] > 0 ? place[a] - 1 : 0; };
    for (std::uint32_t z = first(2); z <= place[2] + 1; ++z)
      for (std::uint32_t y = first(1); y <= place[1] + 1; ++y)
        for (std::uint32_t x = first(0); x <= place[0] + 1; ++x)
          if (const auto number = keys_.find(key_of({x, y, z}))) work(*number);
  }

 private:
  static constexpr unsigned axis_bits = 21;
  static constexpr std::uint64_t mask = (std::uint64_t{1} << axis_bits) - 1;

  static std::uint64_t key_of(const Place& p) {
    return (p[0] & mask) | (p[1] & mask) << axis_bits | static_cast<std::uint64_t>(p[2] & mask) << 2 * axis_bits;
  }

  KeyTable keys_;
};

/// Points by how many points their voxel holds, in quarters of an octave.
class Histogram {
 public:
  void add(std::uint64_t points) { bins_[bin(points)] += points; }
  void add(const Histogram& other) {
    for (std::size_t i = 0; i < bins_.size(); ++i) bins_[i] += other.bins_[i];
  }
  /// How many points the voxel of the median point holds.
  double median() const {
    std::uint64_t all = 0, below = 0;
    for (const auto points : bins_) all += points;
    std::size_t i = 0;
    while (i + 1 < bins_.size() && 2 * (below + bins_[i]) < all) below += bins_[i++];
    return std::exp2(static_cast<double>(i) / parts);
  }

 private:
  static constexpr double parts = 4;
  static std::size_t bin(std::uint64_t points) {
    return std::min<std::size_t>(127, static_cast<std::size_t>(parts * std::log2(static_cast<double>(points))));
  }
  std::array<std::uint64_t, 128> bins_{};
};

class VoxelNoise {
 public:
  VoxelNoise(const std::vector<VoxelCount>& voxels, double share, const Context& context)
      : voxels_(voxels), share_(share), context_(context) {}

  std::vector<bool> run() {
    number_places();
    std::vector<std::uint64_t> fullest(most_.size());
    context_.parallel_for(fullest.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t b = begin; b < end; ++b)
        blocks_.around(blocks_.place(b), [&](std::uint32_t i) { fullest[b] = std::max(fullest[b], most_[i]); });
    });
    std::vector<double> usual(histograms_.size());
    context_.parallel_for(usual.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t c = begin; c < end; ++c) {
        Histogram all;
        cells_.around(cells_.place(c), [&](std::uint32_t i) { all.add(histograms_[i]); });
        usual[c] = all.median();
      }
    });
    std::vector<char> noise(voxels_.size(), 0);
    context_.parallel_for(noise.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        noise[i] = is_tail(voxels_[i], fullest[block_of_[i]]) || is_stray(voxels_[i], usual[cell_of_[i]]) ? 1 : 0;
    });
    return {noise.begin(), noise.end()};
  }

 private:
  static constexpr unsigned block_bits = 1, cell_bits = 5;

  void number_places() {
    block_of_.reserve(voxels_.size());
    cell_of_.reserve(voxels_.size());
    for (const VoxelCount& voxel : voxels_) {
      numbers_.add(voxel.place);
      const std::uint32_t block = block_of_.emplace_back(blocks_.add(coarse(voxel.place, block_bits)));
      if (block == most_.size()) most_.push_back(0);
      most_[block] = std::max(most_[block], voxel.points);
      const std::uint32_t cell = cell_of_.emplace_back(cells_.add(coarse(voxel.place, cell_bits)));
      if (cell == histograms_.size()) histograms_.emplace_back();
      histograms_[cell].add(voxel.points);
    }
  }

  bool is_tail(const VoxelCount& voxel, std::uint64_t fullest) const {
    return static_cast<double>(voxel.points) < share_ * static_cast<double>(fullest);
  }

  bool is_stray(const VoxelCount& voxel, double usual) const {
    constexpr double surface = 9;  // of 27 voxels
    const double least = share_ * surface * usual;
    if (static_cast<double>(voxel.points) >= least) return false;
    std::uint64_t points = 0;
    numbers_.around(voxel.place, [&](std::uint32_t i) { points += voxels_[i].points; });
    return static_cast<double>(points) < least;
  }

  const std::vector<VoxelCount>& voxels_;
  double share_;
  const Context& context_;
  PlaceTable numbers_, blocks_, cells_;
  std::vector<std::uint32_t> block_of_, cell_of_;  // of a voxel
  std::vector<std::uint64_t> most_;                // points in a voxel of a block
  std::vector<Histogram> histograms_;              // of a cell
};

}  // namespace

std::vector<bool> noise_voxels(const std::vector<VoxelCount>& voxels, double share, const Context& context) {
  return VoxelNoise(voxels, share, context).run();
}

}  // namespace atrium::io
