#include "lattice.hpp"

namespace atrium::example {

Lattice::Out Lattice::run(const In& /*in*/, const Params& params, Context& /*context*/) {
  Out out;
  const auto spacing = static_cast<float>(params.spacing);
  for (std::int64_t x = 0; x < params.side; ++x)
    for (std::int64_t y = 0; y < params.side; ++y)
      for (std::int64_t z = 0; z < params.side; ++z)
        out.cloud.points.push_back(spacing * Eigen::Matrix<std::int64_t, 3, 1>(x, y, z).cast<float>());
  out.points = static_cast<std::int64_t>(out.cloud.size());
  return out;
}

}  // namespace atrium::example
