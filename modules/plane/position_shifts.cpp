#include "modules/plane/position_shifts.hpp"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>

namespace atrium::plane {
namespace {

/// The normal equations of the shifts of all positions but the first, which stays.
struct Equations {
  explicit Equations(std::size_t positions) : blocks(positions, Eigen::Matrix3d::Zero()), right(3 * (positions - 1)) {
    right.setZero();
  }

  void add(const SharedPlane& plane, double weight) {
    const Eigen::Matrix3d nn = weight * plane.normal * plane.normal.transpose();
    blocks[plane.a] += nn;
    blocks[plane.b] += nn;
    const Eigen::Vector3d pull = weight * plane.offset * plane.normal;
    if (plane.a > 0) right.segment<3>(row(plane.a)) += pull;
    if (plane.b > 0) right.segment<3>(row(plane.b)) -= pull;
    if (plane.a == 0 || plane.b == 0) return;
    for (Eigen::Index i = 0; i < 3; ++i)
      for (Eigen::Index k = 0; k < 3; ++k) {
        entries.emplace_back(row(plane.a) + i, row(plane.b) + k, -nn(i, k));
        entries.emplace_back(row(plane.b) + i, row(plane.a) + k, -nn(i, k));
      }
  }

  Eigen::VectorXd solve(const Eigen::VectorXd& guess) {
    // Square metres that keep each position where it is: little beside its walls, much beside what the noise in their
    // normals says about directions along them.
    constexpr double prior = 0.5;
    for (std::size_t p = 1; p < blocks.size(); ++p) {
      const Eigen::Matrix3d own = blocks[p] + prior * Eigen::Matrix3d::Identity();
      for (Eigen::Index i = 0; i < 3; ++i)
        for (Eigen::Index k = 0; k < 3; ++k) entries.emplace_back(row(p) + i, row(p) + k, own(i, k));
    }
    Eigen::SparseMatrix<double> matrix(right.size(), right.size());
    matrix.setFromTriplets(entries.begin(), entries.end());
    Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver(matrix);
    solver.setTolerance(1e-12);
    return solver.solveWithGuess(right, guess);
  }

  static Eigen::Index row(std::size_t position) { return static_cast<Eigen::Index>(3 * (position - 1)); }

  std::vector<Eigen::Matrix3d> blocks;  ///< on the diagonal
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right;
};

}  // namespace

std::vector<Eigen::Vector3d> position_shifts(const std::vector<SharedPlane>& planes, std::size_t positions,
                                             double scale, const Context& context) {
  constexpr int rounds = 10;
  std::vector<Eigen::Vector3d> shifts(positions, Eigen::Vector3d::Zero());
  Eigen::VectorXd x = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(3 * (positions - 1)));
  for (int round = 0; round < rounds; ++round) {
    context.check_cancelled();
    // From wide to narrow, so that the many agree before the few are left out.
    const double width = scale * std::max(1.0, 4.0 - round);
    Equations equations(positions);
    for (const auto& plane : planes) {
      const double u = (plane.normal.dot(shifts[plane.b] - shifts[plane.a]) + plane.offset) / width;
      if (std::abs(u) < 1) equations.add(plane, plane.area * (1 - u * u) * (1 - u * u));
    }
    x = equations.solve(x);
    for (std::size_t p = 1; p < positions; ++p) shifts[p] = x.segment<3>(Equations::row(p));
  }
  return shifts;
}

}  // namespace atrium::plane
