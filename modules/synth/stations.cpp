#include "modules/synth/stations.hpp"

#include <numbers>

namespace atrium::synth {

std::vector<Station> tripods(const SimulatedScene& scene, const Scan::Params& params, Random random) {
  constexpr double radians = std::numbers::pi / 180;
  std::vector<Station> stations;
  std::vector<std::int64_t> taken(scene.truth.rooms.size() + 1, 0);
  for (const auto& position : scene.positions) {
    if (params.most_positions > 0 && std::ssize(stations) >= params.most_positions) break;
    if (taken[static_cast<std::size_t>(position.room) + 1]++ >= params.positions) continue;
    Eigen::Isometry3d drift = Eigen::Isometry3d::Identity();
    if (!stations.empty()) {
      Eigen::Vector3d shift, turn;
      for (auto& x : shift) x = params.drift * random.normal();
      for (auto& x : turn) x = params.drift_angle * radians * random.normal();
      if (turn.norm() > 0) drift.rotate(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
      drift = Eigen::Translation3d(position.place + shift) * drift * Eigen::Translation3d(-position.place);
    }
    stations.push_back({position.place, drift});
  }
  return stations;
}

}  // namespace atrium::synth
