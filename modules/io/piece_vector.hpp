#pragma once
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace atrium::io {

/// A vector that grows by pieces of 1024 elements: what it holds is never moved, and room is left in the last piece
/// only. For small elements; their values are those of T{}.
template <class T>
class PieceVector {
 public:
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T& operator[](std::size_t i) { return pieces_[i >> piece_bits][i & piece_mask]; }
  const T& operator[](std::size_t i) const { return pieces_[i >> piece_bits][i & piece_mask]; }
  void push_back(const T& value) {
    if ((size_ & piece_mask) == 0) pieces_.push_back(std::make_unique<T[]>(piece_mask + 1));
    (*this)[size_++] = value;
  }
  /// Gives its memory back.
  void clear() { *this = {}; }

  PieceVector() = default;
  ~PieceVector() = default;
  PieceVector(const PieceVector&) = delete;
  PieceVector& operator=(const PieceVector&) = delete;
  PieceVector(PieceVector&& other) noexcept : pieces_(std::move(other.pieces_)), size_(std::exchange(other.size_, 0)) {}
  PieceVector& operator=(PieceVector&& other) noexcept {
    pieces_ = std::move(other.pieces_);
    size_ = std::exchange(other.size_, 0);
    return *this;
  }

 private:
  static constexpr unsigned piece_bits = 10;
  static constexpr std::size_t piece_mask = (std::size_t{1} << piece_bits) - 1;

  std::vector<std::unique_ptr<T[]>> pieces_;
  std::size_t size_ = 0;
};

}  // namespace atrium::io
