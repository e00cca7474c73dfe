#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "modules/building/room_shell.hpp"
#include "modules/layout/face_rings.hpp"

namespace atrium::building {

/// Rings with indices in the place of places.
struct WeldedPiece {
  const ShellPiece* piece = nullptr;
  std::vector<layout::Ring> rings;  ///< the outline first
  double area = 0;
};

/// Gives equal places (to half a millimetre) one number, and puts what lies on a ring's side into it. Pieces without
/// area are left out. Refers to its source.
class ShellWelding {
 public:
  std::vector<Eigen::Vector3d> vertices;
  std::vector<WeldedPiece> pieces;

  explicit ShellWelding(const std::vector<ShellPiece>& source);

 private:
  std::uint32_t vertex(const Eigen::Vector3d& place);
  layout::Ring ring_of(const std::vector<Eigen::Vector3d>& places);
  layout::Ring with_places_between(const layout::Ring& ring) const;
  static layout::Ring without_spikes(layout::Ring ring);
};

}  // namespace atrium::building
