#include "modules/geometry/grid_walk.hpp"

namespace atrium {

std::unique_ptr<PointGrid> grid_for_rays(const std::vector<Eigen::Vector3f>& points, double edge,
                                         const Context& context) {
  auto grid = std::make_unique<PointGrid>(points, edge, context);
  for (int doubled = 0; doubled < 3 && 2 * grid->inside() < 3 * grid->cells().size(); ++doubled) {
    edge *= 2;
    grid = std::make_unique<PointGrid>(points, edge, context);
  }
  return grid;
}

}  // namespace atrium
