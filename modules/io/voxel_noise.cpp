#include "modules/io/voxel_noise.hpp"

#include <algorithm>
#include <cmath>

#include "modules/io/voxel_lookup.hpp"

namespace atrium::io {
namespace {

/// Cubes of 2ⁿ voxels that hold any, in the order of their numbers.
class Cubes {
 public:
  Cubes(const VoxelCounts& voxels, unsigned n)
      : places_(voxels.places.cubes(n)),
        left_out_(voxels.places.left_out(n)),
        numbers_(numbers_of(voxels, left_out_)),
        lookup_(places_, numbers_) {}

  std::size_t size() const { return numbers_.size(); }
  /// Of a voxel, by its number.
  std::size_t index(std::uint64_t voxel) const {
    return static_cast<std::size_t>(std::lower_bound(numbers_.begin(), numbers_.end(), number(voxel)) -
                                    numbers_.begin());
  }
  /// The same for the voxel that follows one of cube `index`, in their order.
  std::size_t index(std::uint64_t voxel, std::size_t index) const {
    return numbers_[index] == number(voxel) ? index : index + 1;
  }
  template <class Work>
  void around(std::size_t index, const Work& work) const {
    lookup_.around(places_.place(numbers_[index]), work);
  }

 private:
  std::uint64_t number(std::uint64_t voxel) const { return voxel >> left_out_; }
  static std::vector<std::uint64_t> numbers_of(const VoxelCounts& voxels, unsigned left_out) {
    std::size_t count = 0;
    const auto& all = voxels.numbers;
    const auto begins = [&](std::size_t i) { return i == 0 || all[i] >> left_out != all[i - 1] >> left_out; };
    for (std::size_t i = 0; i < all.size(); ++i) count += begins(i) ? 1 : 0;
    std::vector<std::uint64_t> numbers;
    numbers.reserve(count);
    for (std::size_t i = 0; i < all.size(); ++i)
      if (begins(i)) numbers.push_back(all[i] >> left_out);
    return numbers;
  }

  MortonPlaces places_;
  unsigned left_out_;
  std::vector<std::uint64_t> numbers_;
  VoxelLookup lookup_;
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
  VoxelNoise(const VoxelCounts& voxels, double share, const Context& context)
      : voxels_(voxels), share_(share), context_(context) {}

  std::vector<std::uint8_t> run() {
    std::vector<std::uint8_t> noise(voxels_.numbers.size(), 0);
    mark_tails(noise);
    mark_strays(noise);
    return noise;
  }

 private:
  /// Calls work(voxel, its cube) for all voxels.
  template <class Work>
  void for_voxels(const Cubes& cubes, const Work& work) const {
    const auto& numbers = voxels_.numbers;
    context_.parallel_for(numbers.size(), [&](std::size_t begin, std::size_t end) {
      std::size_t cube = cubes.index(numbers[begin]);
      for (std::size_t i = begin; i < end; ++i) work(i, cube = cubes.index(numbers[i], cube));
    });
  }

  /// Beside a surface.
  void mark_tails(std::vector<std::uint8_t>& noise) const {
    const Cubes blocks(voxels_, 1);
    std::vector<std::uint32_t> most(blocks.size(), 0), fullest(blocks.size(), 0);
    std::size_t block = 0;
    for (std::size_t i = 0; i < noise.size(); ++i) {
      block = blocks.index(voxels_.numbers[i], block);
      most[block] = std::max(most[block], voxels_.points[i]);
    }
    context_.parallel_for(fullest.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t b = begin; b < end; ++b)
        blocks.around(b, [&](std::uint32_t i) { fullest[b] = std::max(fullest[b], most[i]); });
    });
    for_voxels(blocks, [&](std::size_t i, std::size_t b) {
      const bool tail = static_cast<double>(voxels_.points[i]) < share_ * static_cast<double>(fullest[b]);
      noise[i] = tail ? 1 : 0;
    });
  }

  /// In free space.
  void mark_strays(std::vector<std::uint8_t>& noise) const {
    constexpr double surface = 9;  // of 27 voxels
    constexpr unsigned cell_bits = 5;
    const Cubes cells(voxels_, cell_bits);
    const std::vector<double> usual = usual_points(cells);
    const VoxelLookup lookup(voxels_.places, voxels_.numbers);
    for_voxels(cells, [&](std::size_t i, std::size_t cell) {
      const double least = share_ * surface * usual[cell];
      if (noise[i] != 0 || static_cast<double>(voxels_.points[i]) >= least) return;
      std::uint64_t points = 0;
      lookup.around(voxels_.places.place(voxels_.numbers[i]), [&](std::uint32_t k) { points += voxels_.points[k]; });
      noise[i] = static_cast<double>(points) < least ? 1 : 0;
    });
  }

  /// How many points the voxel of a usual point holds, around each cell.
  std::vector<double> usual_points(const Cubes& cells) const {
    std::vector<Histogram> histograms(cells.size());
    std::size_t cell = 0;
    for (std::size_t i = 0; i < voxels_.numbers.size(); ++i)
      histograms[cell = cells.index(voxels_.numbers[i], cell)].add(voxels_.points[i]);
    std::vector<double> usual(cells.size());
    context_.parallel_for(usual.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t c = begin; c < end; ++c) {
        Histogram all;
        cells.around(c, [&](std::uint32_t i) { all.add(histograms[i]); });
        usual[c] = all.median();
      }
    });
    return usual;
  }

  const VoxelCounts& voxels_;
  double share_;
  const Context& context_;
};

}  // namespace

std::vector<std::uint8_t> noise_voxels(const VoxelCounts& voxels, double share, const Context& context) {
  return VoxelNoise(voxels, share, context).run();
}

}  // namespace atrium::io
