#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "modules/io/raw_geometry.hpp"

namespace atrium::io {

/// Some points of a file as columns of doubles, in the file's units; colours are 0 … 255.
struct PointBlock {
  std::size_t size = 0;
  std::size_t misses = 0;                              ///< records left out because they say that they are no points
  std::array<std::vector<double>, role_count> values;  ///< only those that the source has; of `size` numbers at least

  std::vector<double>& of(Role role) { return values[static_cast<std::size_t>(role)]; }
  const std::vector<double>& of(Role role) const { return values[static_cast<std::size_t>(role)]; }
  /// Makes room for so many points in the columns of these roles.
  void resize(std::size_t points, const std::array<bool, role_count>& roles) {
    size = points;
    for (std::size_t r = 0; r < role_count; ++r)
      if (roles[r]) values[r].resize(points);
  }
};

/// The points of a file in blocks that can be read in any order and side by side. The points of block 0, then those of
/// block 1, … are the file's in their order, with any number of threads.
class PointSource {
 public:
  PointSource() = default;
  virtual ~PointSource() = default;
  PointSource(const PointSource&) = delete;
  PointSource& operator=(const PointSource&) = delete;

  virtual std::size_t blocks() const = 0;
  /// The most points that the block can give.
  virtual std::size_t capacity(std::size_t block) const = 0;
  /// Fills `to`, whose vectors are used again. Throws Error with the file and the place in it. Thread-safe.
  virtual void read(std::size_t block, PointBlock& to) const = 0;
  /// How many blocks are worth reading to learn where the points lie: fewer where blocks are large or costly.
  virtual std::size_t samples() const { return 40; }

  bool has(Role role) const { return roles_[static_cast<std::size_t>(role)]; }
  const std::array<bool, role_count>& roles() const { return roles_; }

 protected:
  void provide(Role role) { roles_[static_cast<std::size_t>(role)] = true; }
  void withdraw(Role role) { roles_[static_cast<std::size_t>(role)] = false; }

 private:
  std::array<bool, role_count> roles_{};
};

}  // namespace atrium::io
