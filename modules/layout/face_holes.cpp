#include "modules/layout/face_holes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "modules/layout/raster.hpp"
#include "modules/layout/wall_pairs.hpp"

namespace atrium::layout {
namespace {

bool contains(const std::vector<Eigen::Vector3d>& outline, const Eigen::Vector3d& p) {
  bool inside = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector3d &a = outline[i], &b = outline[(i + 1) % outline.size()];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y())) inside = !inside;
  }
  return inside;
}

/// The squares of a face: what of it is a hole.
class Mask {
 public:
  enum : std::uint8_t { outside, solid, hidden, hole };

  Mask(const Eigen::AlignedBox2d& box, double pixel) : box_(box), pixel_(pixel) {
    width_ = std::max(1, static_cast<int>(std::ceil(box.sizes().x() / pixel)));
    height_ = std::max(1, static_cast<int>(std::ceil(box.sizes().y() / pixel)));
    squares_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), outside);
  }
  int width() const { return width_; }
  int height() const { return height_; }
  Eigen::Vector2d centre(int x, int y) const { return box_.min() + Eigen::Vector2d(x + 0.5, y + 0.5) * pixel_; }
  std::uint8_t& at(int x, int y) {
    return squares_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
  }
  void touch(const Eigen::Vector2d& p) {
    const int x = static_cast<int>(std::floor((p.x() - box_.min().x()) / pixel_));
    const int y = static_cast<int>(std::floor((p.y() - box_.min().y()) / pixel_));
    if (x >= 0 && y >= 0 && x < width_ && y < height_) at(x, y) = solid;
  }

  /// Hidden squares that lie in no hidden block of this many squares a side (about) become solid.
  void keep_wide(int side) {
    const int reach = std::max(0, side / 2 - 1);
    std::vector<std::uint8_t> kept(squares_.size(), 0);
    for (int y = reach; y < height_ - reach; ++y)
      for (int x = reach; x < width_ - reach; ++x)
        if (at(x, y) == hidden && block(x, y, reach)) kept[index(x, y)] = 1;
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x)
        if (at(x, y) == hidden && !near(kept, x, y, reach + 1)) at(x, y) = solid;
  }

  /// Takes out one connected part of the hole squares; empty when there is none left.
  std::vector<Eigen::Vector2i> next_part() {
    std::vector<Eigen::Vector2i> part;
    for (; scan_ < squares_.size(); ++scan_) {
      if (squares_[scan_] != hole) continue;
      part.emplace_back(static_cast<int>(scan_) % width_, static_cast<int>(scan_) / width_);
      squares_[scan_] = hidden;
      for (std::size_t i = 0; i < part.size(); ++i) grow(part[i], part);
      return part;
    }
    return part;
  }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  /// Whether nearly all of the block around a square is hidden.
  bool block(int x, int y, int reach) const {
    constexpr double most = 0.7;
    int count = 0;
    for (int v = y - reach; v <= y + reach; ++v)
      for (int u = x - reach; u <= x + reach; ++u) count += squares_[index(u, v)] == hidden ? 1 : 0;
    const int side = 2 * reach + 1;
    return count >= most * side * side;
  }
  bool near(const std::vector<std::uint8_t>& kept, int x, int y, int reach) const {
    for (int v = std::max(0, y - reach); v <= std::min(height_ - 1, y + reach); ++v)
      for (int u = std::max(0, x - reach); u <= std::min(width_ - 1, x + reach); ++u)
        if (kept[index(u, v)] != 0) return true;
    return false;
  }
  void grow(const Eigen::Vector2i& from, std::vector<Eigen::Vector2i>& part) {
    constexpr int ways[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    for (const auto& way : ways) {
      const int x = from.x() + way[0], y = from.y() + way[1];
      if (x < 0 || y < 0 || x >= width_ || y >= height_ || at(x, y) != hole) continue;
      at(x, y) = hidden;
      part.emplace_back(x, y);
    }
  }

  Eigen::AlignedBox2d box_;
  double pixel_;
  int width_ = 0, height_ = 0;
  std::size_t scan_ = 0;
  std::vector<std::uint8_t> squares_;
};

/// The rectangle of a part without its rare outermost rows and columns: each side moves in until a third of the line
/// along it is hole.
std::optional<Eigen::AlignedBox2i> core(const std::vector<Eigen::Vector2i>& part) {
  Eigen::AlignedBox2i box;
  for (const auto& p : part) box.extend(p);
  for (bool changed = true; changed;) {
    changed = false;
    for (int side = 0; side < 4; ++side) {
      if (box.isEmpty()) return std::nullopt;
      const int axis = side / 2;
      const int line = side % 2 == 0 ? box.min()[axis] : box.max()[axis];
      const auto count =
          std::count_if(part.begin(), part.end(), [&](const auto& p) { return p[axis] == line && box.contains(p); });
      if (3 * count >= box.sizes()[1 - axis] + 1) continue;
      (side % 2 == 0 ? box.min()[axis] : box.max()[axis]) += side % 2 == 0 ? 1 : -1;
      changed = true;
    }
  }
  return box;
}

/// Where the points around a rectangle begin: the sides are moved by at most a square and a half.
void fit_sides(const std::vector<Eigen::Vector2d>& points, double pixel, Eigen::AlignedBox2d& box) {
  const double reach = 1.5 * pixel;
  const Eigen::AlignedBox2d rough = box;
  for (int side = 0; side < 4; ++side) {
    const int axis = side / 2;
    const bool low = side % 2 == 0;
    const double at = low ? rough.min()[axis] : rough.max()[axis];
    std::vector<double> beside;
    for (const auto& p : points)
      if (std::abs(p[axis] - at) <= reach && p[1 - axis] > rough.min()[1 - axis] && p[1 - axis] < rough.max()[1 - axis])
        beside.push_back(low ? p[axis] : -p[axis]);
    constexpr std::size_t few = 8;
    if (beside.size() < few) continue;
    // Of the points outside of this side the last before the hole, but for outliers.
    const auto rank = beside.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(beside.size() - 1));
    std::nth_element(beside.begin(), rank, beside.end());
    (low ? box.min()[axis] : box.max()[axis]) = low ? *rank : -*rank;
  }
  if (box.isEmpty()) box = rough;
}

/// Turns hidden squares that were in sight into holes. `off`: how far before the face a way begins.
void mark_holes(Mask& mask, const PlaneFrame& frame, const Eigen::Vector3d& normal, double off, const RoomView& view,
                const FreeSpace& space) {
  constexpr double grazing = 0.15;  // such views of a wall see nothing through it
  for (int y = 0; y < mask.height(); ++y)
    for (int x = 0; x < mask.width(); ++x) {
      if (mask.at(x, y) != Mask::hidden) continue;
      const Eigen::Vector3d p = frame.to_space(mask.centre(x, y)) + normal * off;
      std::size_t seen = 0;
      for (const auto& place : view.places) {
        const Eigen::Vector3d way = place - p;
        if (way.dot(normal) < grazing * way.norm() || !space.is_free(p, place)) continue;
        if (++seen >= view.enough) break;
      }
      if (seen >= view.enough) mask.at(x, y) = Mask::hole;
    }
}

/// The rectangle that a part fills well enough.
std::optional<FaceHole> hole_of(const std::vector<Eigen::Vector2i>& part, const Mask& mask,
                                const std::vector<Eigen::Vector2d>& points, double pixel, double min_fill) {
  const auto squares = core(part);
  if (!squares || squares->isEmpty()) return std::nullopt;
  const auto filled = std::count_if(part.begin(), part.end(), [&](const auto& p) { return squares->contains(p); });
  const double all = (squares->sizes().x() + 1.0) * (squares->sizes().y() + 1.0);
  if (static_cast<double>(filled) < min_fill * all) return std::nullopt;
  FaceHole hole;
  const Eigen::Vector2d half = Eigen::Vector2d::Constant(pixel / 2);
  hole.box = {mask.centre(squares->min().x(), squares->min().y()) - half,
              mask.centre(squares->max().x(), squares->max().y()) + half};
  fit_sides(points, pixel, hole.box);
  return hole;
}

/// Says what kind of opening a hole is, within the box of its face; false if it is too small for any.
bool name_hole(const Openings::Params& params, bool wall, const Eigen::AlignedBox2d& face, FaceHole& hole) {
  const Eigen::Vector2d size = hole.box.sizes();
  if (wall ? size.x() < params.min_width || size.y() < params.min_height
           : size.x() < params.min_slab_width || size.y() < params.min_slab_width)
    return false;
  hole.kind = wall ? "window" : "slab";
  if (wall && hole.box.min().y() - face.min().y() <= params.sill_height) {
    hole.kind = "door";
    hole.box.min().y() = face.min().y();
  }
  hole.box = hole.box.intersection(face);
  return true;
}

}  // namespace

HoleFinder::HoleFinder(const Building& building, const Cloud& cloud, const Openings::Params& params, double pixel)
    : building_(building), cloud_(cloud), params_(params), pixel_(pixel), space_(cloud, pixel) {
  for (std::size_t r = 0; r < building.rooms.size(); ++r) views_.push_back(view_of(static_cast<std::int32_t>(r)));
}

RoomView HoleFinder::view_of(std::int32_t index) const {
  constexpr double eye = 1.5, least_step = 0.7, most_places = 50;
  const BuildingRoom& room = building_.rooms[static_cast<std::size_t>(index)];
  RoomView view;
  if (room.outline.empty()) return view;
  const double floor = room.outline[0].z();
  for (const auto& sensor : cloud_.sensors) {
    const Eigen::Vector3d p = sensor.cast<double>();
    if (contains(room.outline, p) && p.z() > floor && p.z() < floor + 2 * std::max(room.height, eye))
      view.places.push_back(p);
  }
  if (!view.places.empty()) return view;
  Eigen::AlignedBox3d box;
  for (const auto& p : room.outline) box.extend(p);
  const double step = std::max(least_step, std::sqrt(room.area / most_places));
  for (double y = box.min().y() + step / 2; y < box.max().y(); y += step)
    for (double x = box.min().x() + step / 2; x < box.max().x(); x += step) {
      const Eigen::Vector3d p(x, y, floor + std::min(eye, room.height / 2));
      if (contains(room.outline, p) && !space_.is_occupied(p)) view.places.push_back(p);
    }
  view.enough = std::max<std::size_t>(1, view.places.size() / 2);
  return view;
}

bool HoleFinder::seen_through(const BuildingFace& face, const FaceHole& hole) const {
  constexpr double depth = 1.0, least_share = 0.02;
  constexpr std::size_t least = 3;
  Eigen::AlignedBox3d around;
  for (const auto& [u, v] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
    const Eigen::Vector3d p = hole.frame.to_space(
        {u == 0 ? hole.box.min().x() : hole.box.max().x(), v == 0 ? hole.box.min().y() : hole.box.max().y()});
    around.extend(p);
    around.extend(p - depth * face.plane.normal);
  }
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(pixel_ / 2);
  const Eigen::AlignedBox2d inside(hole.box.min() - margin, hole.box.max() + margin);
  Mask behind(inside, pixel_);
  space_.each_point_in(around, [&](const Eigen::Vector3d& p) {
    const double distance = face.plane.signed_distance(p);
    if (distance < -params_.tolerance && distance > -depth) behind.touch(hole.frame.to_plane(p));
  });
  std::size_t squares = 0;
  for (int y = 0; y < behind.height(); ++y)
    for (int x = 0; x < behind.width(); ++x) squares += behind.at(x, y) == Mask::solid ? 1 : 0;
  const auto all = static_cast<double>(behind.width()) * behind.height();
  return squares >= least && static_cast<double>(squares) >= least_share * all;
}

std::vector<FaceHole> HoleFinder::holes(std::size_t index) const {
  const BuildingFace& face = building_.faces[index];
  const RoomView& view = views_[static_cast<std::size_t>(face.room)];
  const bool wall = face.surface == SurfaceClass::wall;
  if (view.places.empty() || (!wall && !is_level(face.plane))) return {};
  const PlaneFrame frame = upright_frame(face.plane, building_.vertices[face.outline[0]]);
  Eigen::AlignedBox2d box;
  Eigen::AlignedBox3d around;
  for (const auto v : face.outline) {
    box.extend(frame.to_plane(building_.vertices[v]));
    around.extend(building_.vertices[v]);
  }
  Mask mask(box, pixel_);
  for (int y = 0; y < mask.height(); ++y)
    for (int x = 0; x < mask.width(); ++x)
      if (face_contains(building_, face, frame.to_space(mask.centre(x, y)), 0)) mask.at(x, y) = Mask::hidden;
  around.min().array() -= params_.tolerance;
  around.max().array() += params_.tolerance;
  std::vector<Eigen::Vector2d> points;
  space_.each_point_in(around, [&](const Eigen::Vector3d& p) {
    if (std::abs(face.plane.signed_distance(p)) > params_.tolerance) return;
    points.push_back(frame.to_plane(p));
    mask.touch(points.back());
  });
  // What is too small for an opening need not be looked at.
  mask.keep_wide(
      static_cast<int>((wall ? std::min(params_.min_width, params_.min_height) : params_.min_slab_width) / pixel_));
  mark_holes(mask, frame, face.plane.normal, params_.tolerance + 2 * pixel_, view, space_);
  std::vector<FaceHole> result;
  for (auto part = mask.next_part(); !part.empty(); part = mask.next_part()) {
    auto hole = hole_of(part, mask, points, pixel_, params_.min_fill);
    if (!hole) continue;
    hole->frame = frame;
    if (!name_hole(params_, wall, box, *hole) || !seen_through(face, *hole)) continue;
    for (const auto& [u, v] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
      hole->outline.push_back(frame.to_space(
          {u == 0 ? hole->box.min().x() : hole->box.max().x(), v == 0 ? hole->box.min().y() : hole->box.max().y()}));
    result.push_back(std::move(*hole));
  }
  return result;
}

}  // namespace atrium::layout
