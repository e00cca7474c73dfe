#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "modules/synth/world.hpp"

namespace atrium::synth {
namespace {

using V = Eigen::Vector3d;
constexpr Colour grass{104, 124, 74}, hedge_green{64, 96, 52}, leaf_green{82, 112, 58}, bark{92, 76, 60},
    roof_tile{142, 84, 66};
constexpr std::array<Colour, 4> plasters{{{204, 186, 158}, {190, 196, 198}, {214, 206, 190}, {176, 142, 122}}};
constexpr double reach = 40;  // of the ground beyond the building

// Builds in a frame of one side of the building: x along the side, y away from it, z up.
class Outside {
 public:
  Outside(World& world, const SimulatedScene& scene, Random random)
      : world_(world), label_(outside_label(scene)), random_(random) {
    for (const auto& p : scene.vertices) box_.extend(p);
    double lowest = std::numeric_limits<double>::infinity();
    for (const auto& room : scene.truth.rooms)
      for (const auto& p : room.outline) lowest = std::min(lowest, p.z());
    ground_ = (std::isfinite(lowest) ? lowest : box_.min().z()) - 0.4;
  }

  void build() {
    add_ground();
    for (int side = 0; side < 4; ++side) {
      const double angle = side * std::numbers::pi / 2;
      const V away(std::sin(angle), -std::cos(angle), 0), along(std::cos(angle), std::sin(angle), 0);
      along_ = along;
      away_ = away;
      const V half = box_.sizes() / 2;
      start_ = box_.center() + away * std::abs(away.dot(half));
      start_.z() = ground_;
      add_street(std::abs(along.dot(half)));
    }
  }

 private:
  V at(double x, double y, double z) const { return start_ + x * along_ + y * away_ + V(0, 0, z); }
  void quad(const V& a, const V& b, const V& c, const V& d, const Colour& colour) {
    world_.add({a, b, c, d}, label_, colour, Material::opaque, true);
  }
  void add_block(double x0, double x1, double y0, double y1, double z0, double z1, const Colour& colour) {
    quad(at(x0, y0, z0), at(x1, y0, z0), at(x1, y0, z1), at(x0, y0, z1), colour);
    quad(at(x0, y0, z0), at(x0, y1, z0), at(x0, y1, z1), at(x0, y0, z1), colour);
    quad(at(x1, y0, z0), at(x1, y1, z0), at(x1, y1, z1), at(x1, y0, z1), colour);
    quad(at(x0, y0, z1), at(x1, y0, z1), at(x1, y1, z1), at(x0, y1, z1), colour);
  }

  // Squares of 4 m or more with corners a few centimetres off the level.
  void add_ground() {
    constexpr int cells = 24;
    const V low = box_.min() - V(reach, reach, 0), size = box_.sizes() + V(2 * reach, 2 * reach, 0);
    std::vector<V> corners;
    for (int i = 0; i <= cells; ++i)
      for (int k = 0; k <= cells; ++k)
        corners.emplace_back(low.x() + size.x() * i / cells, low.y() + size.y() * k / cells,
                             ground_ - 0.08 * random_.uniform());
    for (int i = 0; i < cells; ++i)
      for (int k = 0; k < cells; ++k) {
        const auto c = static_cast<std::size_t>(i) * (cells + 1) + static_cast<std::size_t>(k);
        world_.add({corners[c], corners[c + cells + 1], corners[c + 1]}, label_, grass);
        world_.add({corners[c + cells + 1], corners[c + cells + 2], corners[c + 1]}, label_, grass);
      }
  }

  void add_street(double half) {
    for (double x = -half - 25; x < half + 25;) {
      const double width = random_.uniform(8, 14);
      if (random_.uniform() < 0.85) add_house(x, x + width - 0.3);
      x += width + (random_.uniform() < 0.3 ? 4 : 0);
    }
    for (double x = -half; x < half; x += 6)
      if (random_.uniform() < 0.4) add_block(x, x + 5, 3.5, 4.3, 0, random_.uniform(0.9, 1.5), hedge_green);
    for (double x = -half - 6; x < half + 6; x += 7)
      if (random_.uniform() < 0.6) add_tree(at(x + random_.uniform(0, 4), random_.uniform(5, 10), 0));
  }

  // Its front with bays and balconies, and the roof towards the street.
  void add_house(double x0, double x1) {
    const Colour& plaster = plasters[static_cast<std::size_t>(random_.index(plasters.size()))];
    const double front = random_.uniform(13, 17), eaves = random_.uniform(5, 12), depth = 9;
    add_block(x0, x1, front, front + depth, 0, eaves, plaster);
    quad(at(x0, front - 0.4, eaves), at(x1, front - 0.4, eaves), at(x1, front + depth / 2, eaves + 3.5),
         at(x0, front + depth / 2, eaves + 3.5), roof_tile);
    for (double z = 2.8; z + 1 < eaves; z += 2.8)
      for (double x = x0 + 1; x + 2.2 < x1; x += 3.4)
        if (random_.uniform() < 0.4) add_block(x, x + 1.8, front - 1.1, front, z, z + 1, plaster);
  }

  void add_tree(const V& foot) {
    const double crown = random_.uniform(1.2, 2.2), trunk = random_.uniform(1.6, 2.6);
    for (int i = 0; i < 6; ++i) {
      const auto rim = [&](int k) {
        const double angle = k * std::numbers::pi / 3;
        return V(foot + 0.16 * V(std::cos(angle), std::sin(angle), 0));
      };
      quad(rim(i), rim(i + 1), rim(i + 1) + V(0, 0, trunk + crown), rim(i) + V(0, 0, trunk + crown), bark);
    }
    const V middle = foot + V(0, 0, trunk + crown);
    for (int leaf = 0; leaf < 300; ++leaf) {
      const V place = middle + crown * std::cbrt(random_.uniform()) * direction();
      const V a = 0.22 * direction(), b = 0.22 * direction();
      world_.add({place, place + a, place + b}, label_, leaf_green, Material::opaque, true);
    }
  }
  V direction() {
    const double z = random_.uniform(-1, 1), angle = random_.uniform(0, 2 * std::numbers::pi);
    return {std::sqrt(1 - z * z) * std::cos(angle), std::sqrt(1 - z * z) * std::sin(angle), z};
  }

  World& world_;
  std::int32_t label_;
  Random random_;
  Eigen::AlignedBox3d box_;
  double ground_ = 0;
  V along_ = V::UnitX(), away_ = V::UnitY(), start_ = V::Zero();
};

}  // namespace

void add_outside(World& world, const SimulatedScene& scene, Random random) { Outside(world, scene, random).build(); }

}  // namespace atrium::synth
