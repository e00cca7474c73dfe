#pragma once
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace atrium {

/// A seeded random stream with the same numbers on every platform (the distributions of <random> differ between
/// standard libraries, so they are written out here). Not safe to share between threads: give each chunk of work its
/// own stream.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  std::uint64_t bits() { return engine_(); }
  /// Uniform in [0, 1).
  double uniform() { return static_cast<double>(engine_() >> 11U) * 0x1.0p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Uniform in 0 … size-1; size must be above 0.
  std::uint64_t index(std::uint64_t size) {
    return static_cast<std::uint64_t>((static_cast<unsigned __int128>(engine_()) * size) >> 64U);
  }
  /// Gaussian of mean 0 and standard deviation 1 (Box and Muller).
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }

 private:
  std::mt19937_64 engine_;
};

/// Mixes two numbers into a seed whose every bit depends on every bit of both (SplitMix64's finaliser).
constexpr std::uint64_t mix_seed(std::uint64_t a, std::uint64_t b) {
  std::uint64_t x = a + 0x9e3779b97f4a7c15ULL * (b + 1);
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31U);
}

}  // namespace atrium
