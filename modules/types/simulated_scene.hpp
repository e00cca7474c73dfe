#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "modules/types/cloud.hpp"
#include "modules/types/ground_truth.hpp"

namespace atrium {

/// A place where a scanner may stand.
struct ScannerPosition {
  static constexpr auto members() { return std::tuple{&ScannerPosition::room, &ScannerPosition::place}; }
  std::int32_t room = -1;  ///< index into truth.rooms; -1: of none (on stairs)
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
};

/// A building that a simulated scanner can look at: everything that reflects, and the exact truth about its structure.
/// Metres, z up, near the origin (truth.origin is zero). Triangles run counter-clockwise seen from where they can be
/// seen.
///
/// Surface ids: the index into truth.faces for structural faces (0, 1, …); object_id(k) = −2 − k for objects[k]. −1
/// stays free for what is no surface at all: outliers of a scan.
struct SimulatedScene {
  static constexpr std::string_view port_type = "SimulatedScene";
  static constexpr auto members() {
    return std::tuple{&SimulatedScene::vertices, &SimulatedScene::triangles, &SimulatedScene::surfaces,
                      &SimulatedScene::colours,  &SimulatedScene::objects,   &SimulatedScene::positions,
                      &SimulatedScene::truth};
  }
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::int32_t> surfaces;      ///< per triangle
  std::vector<Colour> colours;             ///< per triangle
  std::vector<std::string> objects;        ///< what they are: "table", "stairs", "reveal", …
  std::vector<ScannerPosition> positions;  ///< the best of each room first
  GroundTruth truth;

  static constexpr std::int32_t object_id(std::size_t object) { return -2 - static_cast<std::int32_t>(object); }
};

}  // namespace atrium
