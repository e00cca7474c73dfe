#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <set>

#include "modules/building/corrections.hpp"

namespace atrium::building {
namespace {

constexpr double same_direction = 0.99999;  // cosine

template <class Visit>
void each_ring_of(const BuildingFace& face, Visit visit) {
  visit(face.outline);
  for (const auto& hole : face.holes) visit(hole);
}

class FaceShift {
 public:
  FaceShift(CorrectionDraft& draft, const Correction& correction, std::map<std::int32_t, double> shifts)
      : draft_(draft), correction_(correction), shifts_(std::move(shifts)) {
    std::set<std::int32_t> rooms;
    for (const auto& [f, by] : shifts_) rooms.insert(draft_.face(f).room);
    for (const auto r : rooms)
      for (const auto f : draft_.room(r).faces)
        each_ring_of(draft_.face(f), [&](const auto& ring) {
          for (const auto v : ring) around_[v].insert(f);
        });
    for (const auto r : rooms) faces_.insert(faces_.end(), draft_.room(r).faces.begin(), draft_.room(r).faces.end());
  }

  void run() {
    take_neighbours_in_plane();
    for (const auto& [v, faces] : around_) move(v, faces);
    check_sides();
    move_openings();
    for (const auto& [v, motion] : motions_) draft_.building.vertices[v] += motion;
    for (const auto& [f, by] : shifts_) {
      draft_.face(f).plane.offset -= by;
      if (by != 0) draft_.mark_face(f, told_shift(draft_.face(f), by));
    }
  }

 private:
  static std::string told_shift(const BuildingFace& face, double by) {
    if (face.surface == SurfaceClass::wall)
      return fmt::format("moved {} by {:.3f} m", by > 0 ? "inwards" : "outwards", std::abs(by));
    return fmt::format("{} by {:.3f} m", by * face.plane.normal.z() > 0 ? "raised" : "lowered", std::abs(by));
  }

  /// Faces in one plane that touch move together.
  void take_neighbours_in_plane() {
    std::vector<std::int32_t> open;
    open.reserve(shifts_.size());
    for (const auto& [f, by] : shifts_) open.push_back(f);
    while (!open.empty()) {
      const std::int32_t f = open.back();
      open.pop_back();
      each_ring_of(draft_.face(f), [&](const auto& ring) {
        for (const auto v : ring)
          for (const auto other : around_.at(v)) {
            if (shifts_.count(other) != 0 ||
                draft_.face(other).plane.normal.dot(draft_.face(f).plane.normal) < same_direction)
              continue;
            shifts_[other] = shifts_.at(f);
            open.push_back(other);
          }
      });
    }
  }

  double shift(std::int32_t face) const {
    const auto found = shifts_.find(face);
    return found == shifts_.end() ? 0 : found->second;
  }

  void move(std::uint32_t v, const std::set<std::int32_t>& faces) {
    std::vector<PlaneShift> planes;
    double most = 0;
    for (const auto f : faces) {
      planes.push_back({draft_.face(f).plane.normal, shift(f)});
      most = std::max(most, std::abs(shift(f)));
    }
    if (most == 0) return;
    constexpr double steepest = 5;  // motions along a wall that is met at a small angle, per metre
    Eigen::Vector3d motion;
    if (motion_of(planes, motion) && motion.norm() <= steepest * most) {
      motions_[v] = motion;
      return;
    }
    std::string names;
    for (const auto f : faces) names += (names.empty() ? "" : ", ") + draft_.face_name(f);
    correction_.fail(
        {}, fmt::format("what meets at {} cannot follow ({})", draft_.told(draft_.building.vertices[v]), names),
        "more than three planes meet there, or two at a small angle: move or drop the others first");
  }

  Eigen::Vector3d motion(std::uint32_t v) const {
    const auto found = motions_.find(v);
    return found == motions_.end() ? Eigen::Vector3d::Zero() : found->second;
  }

  /// No side may become shorter than nothing.
  void check_sides() const {
    constexpr double shortest = 0.001;  // metres
    double most = 1e300;
    std::int32_t at = -1;
    for (const auto f : faces_)
      each_ring_of(draft_.face(f), [&](const auto& ring) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
          const std::uint32_t a = ring[i], b = ring[(i + 1) % ring.size()];
          const Eigen::Vector3d side = draft_.building.vertices[b] - draft_.building.vertices[a];
          const double shrinks = -side.dot(motion(b) - motion(a)) / side.norm();
          if (shrinks <= 1e-9) continue;
          const double share = (side.norm() - shortest) / shrinks;
          if (share >= most) continue;
          most = share;
          at = f;
        }
      });
    if (most >= 1) return;
    double by = 0;
    for (const auto& [f, shifted] : shifts_) by = std::max(by, std::abs(shifted));
    correction_.fail("by",
                     fmt::format("that is too far: after {:.2f} m {} has no width left", std::max(0.0, most * by),
                                 draft_.face_name(at)),
                     "a smaller value; drop_face takes a face away");
  }

  void move_openings() {
    for (auto& opening : draft_.building.openings) {
      move_opening(opening, opening.face_a, opening.outline_a);
      move_opening(opening, opening.face_b, opening.outline_b);
    }
  }
  void move_opening(const BuildingOpening& opening, std::int32_t f, std::vector<Eigen::Vector3d>& outline) const {
    if (f < 0) return;
    const BuildingFace& face = draft_.face(f);
    for (auto& p : outline) p += face.plane.normal * shift(f);
    if (opening.kind != "door" && opening.kind != "passage") return;
    constexpr double on_floor = 0.03;  // metres
    for (const auto& [other, by] : shifts_) {
      const BuildingFace& floor = draft_.face(other);
      if (floor.surface != SurfaceClass::floor || floor.room != face.room || !shares_side(floor, face)) continue;
      for (auto& p : outline)
        if (std::abs(floor.plane.signed_distance(p)) < on_floor) p.z() += by / floor.plane.normal.z();
    }
  }
  static bool shares_side(const BuildingFace& a, const BuildingFace& b) {
    std::set<std::uint32_t> own;
    each_ring_of(a, [&](const auto& ring) { own.insert(ring.begin(), ring.end()); });
    std::size_t shared = 0;
    each_ring_of(b, [&](const auto& ring) {
      for (const auto v : ring) shared += own.count(v);
    });
    return shared >= 2;
  }

  CorrectionDraft& draft_;
  const Correction& correction_;
  std::map<std::int32_t, double> shifts_;
  std::map<std::uint32_t, std::set<std::int32_t>> around_;  ///< the faces at each corner
  std::vector<std::int32_t> faces_;                         ///< of all rooms concerned
  std::map<std::uint32_t, Eigen::Vector3d> motions_;
};

}  // namespace

bool motion_of(const std::vector<PlaneShift>& planes, Eigen::Vector3d& motion) {
  Eigen::MatrixXd normals(static_cast<Eigen::Index>(planes.size()), 3);
  Eigen::VectorXd shifts(static_cast<Eigen::Index>(planes.size()));
  for (std::size_t i = 0; i < planes.size(); ++i) {
    normals.row(static_cast<Eigen::Index>(i)) = planes[i].normal.transpose();
    shifts(static_cast<Eigen::Index>(i)) = planes[i].by;
  }
  Eigen::JacobiSVD<Eigen::MatrixXd> solver(normals, Eigen::ComputeThinU | Eigen::ComputeThinV);
  solver.setThreshold(1e-4);  // planes that differ by less than this angle are one
  motion = solver.solve(shifts);
  const double most = shifts.cwiseAbs().maxCoeff();
  return (normals * motion - shifts).cwiseAbs().maxCoeff() <= 1e-6 + 1e-3 * most;
}

void shift_faces(CorrectionDraft& draft, const Correction& correction, std::map<std::int32_t, double> shifts) {
  FaceShift(draft, correction, std::move(shifts)).run();
}

}  // namespace atrium::building
