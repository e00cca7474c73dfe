#include "modules/synth/furniture.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <optional>

#include "graph/api/error.hpp"

namespace atrium::synth {
namespace {

constexpr Colour wood{150, 111, 71}, dark_wood{96, 68, 44}, white{232, 232, 228}, cloth{92, 110, 138},
    linen{214, 206, 190}, steel{176, 180, 184}, green{70, 120, 64}, clay{170, 98, 66};

struct Frame {
  Building& building;
  int object;
  Eigen::Vector2d at;
  double yaw;
  double floor;
  /// A box in the piece's frame: x to the right, y to the front (its back is at −depth/2), z above the floor.
  void box(double x0, double x1, double y0, double y1, double z0, double z1, const Colour& colour) const {
    building.add_box(object, at, yaw, {x0, y0, floor + z0}, {x1, y1, floor + z1}, colour);
  }
};

struct Piece {
  std::string_view name;
  double width, depth, height;
  bool against_wall;
  void (*build)(const Frame& f, double w, double d, double h);
};

void legs(const Frame& f, double w, double d, double top, double thick, const Colour& colour) {
  for (const double x : {-w / 2 + thick, w / 2 - thick})
    for (const double y : {-d / 2 + thick, d / 2 - thick})
      f.box(x - thick / 2, x + thick / 2, y - thick / 2, y + thick / 2, 0, top, colour);
}

void build_table(const Frame& f, double w, double d, double h) {
  legs(f, w, d, h - 0.03, 0.05, dark_wood);
  f.box(-w / 2, w / 2, -d / 2, d / 2, h - 0.03, h, wood);
}
void build_chair(const Frame& f, double w, double d, double h) {
  legs(f, w, d, 0.43, 0.035, dark_wood);
  f.box(-w / 2, w / 2, -d / 2, d / 2, 0.43, 0.47, wood);
  f.box(-w / 2, w / 2, -d / 2, -d / 2 + 0.03, 0.52, h, wood);
}
void build_bed(const Frame& f, double w, double d, double h) {
  legs(f, w, d, 0.2, 0.06, dark_wood);
  f.box(-w / 2, w / 2, -d / 2 + 0.05, d / 2, 0.2, 0.48, linen);
  f.box(-w / 2, w / 2, -d / 2, -d / 2 + 0.05, 0.1, h, wood);
  f.box(-w / 2 + 0.1, w / 2 - 0.1, -d / 2 + 0.1, -d / 2 + 0.5, 0.48, 0.58, white);
}
void build_shelf(const Frame& f, double w, double d, double h) {
  f.box(-w / 2, -w / 2 + 0.02, -d / 2, d / 2, 0, h, wood);
  f.box(w / 2 - 0.02, w / 2, -d / 2, d / 2, 0, h, wood);
  const int boards = std::max(2, static_cast<int>(std::round(h / 0.38)) + 1);
  for (int i = 0; i < boards; ++i) {
    const double z = 0.05 + (h - 0.07) * i / (boards - 1);
    f.box(-w / 2 + 0.02, w / 2 - 0.02, -d / 2, d / 2, z, z + 0.02, wood);
    // A row of books fills a part of each board but the topmost.
    const double filled = 0.3 + 0.6 * std::fmod(0.37 * (i + 1) + w, 1.0);
    if (i + 1 < boards)
      f.box(-w / 2 + 0.03, -w / 2 + 0.03 + (w - 0.06) * filled, -d / 2 + 0.02, d / 2 - 0.06, z + 0.02, z + 0.26,
            i % 2 == 0 ? cloth : clay);
  }
}
void build_block(const Frame& f, double w, double d, double h) { f.box(-w / 2, w / 2, -d / 2, d / 2, 0, h, white); }
void build_sofa(const Frame& f, double w, double d, double h) {
  f.box(-w / 2, w / 2, -d / 2, d / 2, 0.08, 0.42, cloth);
  f.box(-w / 2, w / 2, -d / 2, -d / 2 + 0.2, 0.42, h, cloth);
  f.box(-w / 2, -w / 2 + 0.18, -d / 2 + 0.2, d / 2, 0.42, 0.6, cloth);
  f.box(w / 2 - 0.18, w / 2, -d / 2 + 0.2, d / 2, 0.42, 0.6, cloth);
}
void build_counter(const Frame& f, double w, double d, double h) {
  f.box(-w / 2, w / 2, -d / 2, d / 2 - 0.04, 0, 0.1, dark_wood);
  f.box(-w / 2, w / 2, -d / 2, d / 2 - 0.02, 0.1, h - 0.04, white);
  f.box(-w / 2, w / 2, -d / 2, d / 2, h - 0.04, h, steel);
}
void build_workplace(const Frame& f, double w, double d, double h) {
  const double top = h - 0.5;  // a screen stands on the desk, drawers under it
  build_table(f, w, d, top);
  f.box(w / 2 - 0.5, w / 2 - 0.08, -d / 2 + 0.05, d / 2 - 0.08, 0.04, top - 0.06, steel);
  f.box(-0.32, 0.28, -0.1, -0.06, top + 0.1, h, dark_wood);
  f.box(-0.06, 0.02, -0.12, -0.08, top, top + 0.1, dark_wood);
}
void build_lamp(const Frame& f, double w, double /*d*/, double h) {
  f.building.add_lathe(f.object, f.at,
                       {{w / 2, f.floor},
                        {w / 2, f.floor + 0.03},
                        {0.015, f.floor + 0.03},
                        {0.015, f.floor + h - 0.3},
                        {w / 2, f.floor + h - 0.3},
                        {w / 3, f.floor + h},
                        {0, f.floor + h}},
                       linen);
}
void build_plant(const Frame& f, double w, double /*d*/, double h) {
  f.building.add_lathe(f.object, f.at, {{w / 4, f.floor}, {w / 3, f.floor + 0.3}, {0, f.floor + 0.3}}, clay);
  std::vector<Eigen::Vector2d> crown;
  for (int i = 0; i <= 8; ++i) {
    const double angle = std::numbers::pi * i / 8;
    crown.emplace_back(i == 0 || i == 8 ? 0.0 : w / 2 * std::sin(angle),
                       f.floor + 0.3 + (h - 0.3) * (1 - std::cos(angle)) / 2);
  }
  f.building.add_lathe(f.object, f.at, crown, green);
}

constexpr Piece sofa{"sofa", 2.0, 0.9, 0.85, true, build_sofa};
constexpr Piece shelf{"shelf", 1.0, 0.3, 1.9, true, build_shelf};
constexpr Piece low_shelf{"shelf", 1.2, 0.35, 0.8, true, build_shelf};
constexpr Piece dining_table{"table", 1.4, 0.85, 0.75, false, build_table};
constexpr Piece low_table{"table", 0.9, 0.6, 0.42, false, build_table};
constexpr Piece desk{"table", 1.4, 0.7, 0.74, true, build_table};
constexpr Piece chair{"chair", 0.44, 0.46, 0.9, false, build_chair};
constexpr Piece bed{"bed", 1.6, 2.05, 0.95, true, build_bed};
constexpr Piece wardrobe{"wardrobe", 1.8, 0.6, 2.1, true, build_block};
constexpr Piece cabinet{"cabinet", 0.9, 0.45, 1.2, true, build_block};
constexpr Piece nightstand{"nightstand", 0.45, 0.4, 0.5, true, build_block};
constexpr Piece fridge{"refrigerator", 0.6, 0.62, 1.8, true, build_block};
constexpr Piece counter{"counter", 2.2, 0.62, 0.9, true, build_counter};
constexpr Piece workplace{"desk", 1.6, 0.8, 1.22, true, build_workplace};
constexpr Piece cupboard{"cupboard", 1.2, 0.45, 1.95, true, build_block};
constexpr Piece sideboard{"cupboard", 1.6, 0.45, 0.78, true, build_block};
constexpr Piece conference_table{"table", 2.6, 1.2, 0.75, false, build_table};
constexpr Piece lamp{"lamp", 0.34, 0.34, 1.6, false, build_lamp};
constexpr Piece plant{"plant", 0.6, 0.6, 1.1, false, build_plant};

std::vector<Piece> pieces_of(RoomUse use) {
  switch (use) {
    case RoomUse::living:
      return {sofa, shelf, shelf, dining_table, low_shelf, low_table, chair, chair, chair, chair, lamp, plant};
    case RoomUse::kitchen: return {counter, fridge, dining_table, chair, chair, chair, chair};
    case RoomUse::bedroom: return {bed, wardrobe, nightstand, nightstand, low_shelf, chair, lamp};
    case RoomUse::study: return {desk, shelf, shelf, cabinet, chair, chair, plant};
    case RoomUse::office: return {workplace, workplace, cupboard, cupboard, shelf, sideboard, chair, chair, plant};
    case RoomUse::meeting:
      return {conference_table, sideboard, cupboard, chair, chair, chair, chair, chair, chair, chair, chair, plant};
    case RoomUse::hall: return {cabinet, low_shelf, plant};
  }
  return {};
}

bool is_free(const Building::Room& room, const Footprint& place) {
  if (!inside(room.outline, place)) return false;
  for (const auto& f : room.furniture)
    if (overlap(f, place, 0.06)) return false;
  for (const auto& f : room.doors)
    if (overlap(f, place, 0)) return false;
  for (const auto& f : room.low_zones)
    if (f.height < place.height && overlap(f, place, 0)) return false;
  return true;
}

Footprint anywhere(const Ring2& outline, const Piece& piece, Random& random) {
  Eigen::Vector2d low = outline.front(), high = outline.front();
  for (const auto& p : outline) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Eigen::Vector2d at(random.uniform(low.x(), high.x()), random.uniform(low.y(), high.y()));
  // Half of what stands free is set square to the house, the rest as it was left.
  const double quarter = std::numbers::pi / 2 * static_cast<double>(random.index(4));
  const double yaw = random.uniform() < 0.5 ? quarter : random.uniform(0, 2 * std::numbers::pi);
  return {at, {piece.width / 2, piece.depth / 2}, yaw, piece.height};
}

Footprint against_wall(const Ring2& outline, const Piece& piece, Random& random) {
  std::vector<std::size_t> sides;  // the strips of curved walls are no place for it
  for (std::size_t i = 0; i < outline.size(); ++i)
    if ((outline[(i + 1) % outline.size()] - outline[i]).norm() > 0.3) sides.push_back(i);
  if (sides.empty()) return anywhere(outline, piece, random);
  const auto side = sides[random.index(sides.size())];
  const Eigen::Vector2d &a = outline[side], &b = outline[(side + 1) % outline.size()];
  const Eigen::Vector2d along = (b - a).normalized(), inwards(-along.y(), along.x());
  const double gap = random.uniform(0.005, 0.04);
  const double u =
      random.uniform(piece.width / 2 + 0.02, std::max(piece.width / 2 + 0.03, (b - a).norm() - piece.width / 2 - 0.02));
  // The piece's front looks along its +y: into the room.
  return {a + along * u + inwards * (gap + piece.depth / 2),
          {piece.width / 2, piece.depth / 2},
          std::atan2(along.y(), along.x()),
          piece.height};
}

}  // namespace

void furnish(Building& building, int room, RoomUse use, double density, double ceiling, Random& random) {
  for (const Piece& piece : pieces_of(use)) {
    const int copies = static_cast<int>(std::floor(density + random.uniform()));
    for (int copy = 0; copy < copies; ++copy) {
      if (piece.height > ceiling - 0.1) continue;
      for (int attempt = 0; attempt < 80; ++attempt) {
        const auto& outline = building.room(room).outline;
        const Footprint place =
            piece.against_wall ? against_wall(outline, piece, random) : anywhere(outline, piece, random);
        if (!is_free(building.room(room), place)) continue;
        const Frame frame{building, building.add_object(std::string(piece.name)), place.centre, place.yaw,
                          building.room(room).floor_height};
        piece.build(frame, piece.width, piece.depth, piece.height);
        building.occupy(room, place);
        break;
      }
    }
  }
}

void line_walls(Building& building, int room, double share, double ceiling, Random& random) {
  constexpr double width = 0.9, gap = 0.01;
  const Ring2 outline = building.room(room).outline;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d &a = outline[i], &b = outline[(i + 1) % outline.size()];
    const Eigen::Vector2d along = (b - a).normalized(), inwards(-along.y(), along.x());
    for (double u = 0.05; u + width < (b - a).norm() - 0.05; u += width + 0.02) {
      const bool closed = random.uniform() < 0.3, wanted = random.uniform() < share;
      const double height = ceiling - random.uniform(0.05, 0.4), depth = closed ? 0.45 : 0.3;
      const Footprint place{a + along * (u + width / 2) + inwards * (gap + depth / 2),
                            {width / 2, depth / 2},
                            std::atan2(along.y(), along.x()),
                            height};
      Footprint within = place;  // its neighbours touch it almost
      within.half -= Eigen::Vector2d(0.05, 0);
      if (!wanted || !is_free(building.room(room), within)) continue;
      const Frame frame{building, building.add_object(closed ? "cupboard" : "shelf"), place.centre, place.yaw,
                        building.room(room).floor_height};
      (closed ? build_block : build_shelf)(frame, width, depth, height);
      building.occupy(room, place);
    }
  }
}

void add_wardrobe(Building& building, int room, int side, const Eigen::Vector2d& corner, double length, double height) {
  constexpr double depth = 0.6;
  const auto& outline = building.room(room).outline;
  const auto i = static_cast<std::size_t>(side);
  Eigen::Vector2d a = outline[i], b = outline[(i + 1) % outline.size()];
  const Eigen::Vector2d right = (b - a).normalized(), inwards(-right.y(), right.x());
  if ((b - corner).norm() < (a - corner).norm()) std::swap(a, b);
  const Footprint place{a + (b - a).normalized() * (length / 2) + inwards * (depth / 2),
                        {length / 2, depth / 2},
                        std::atan2(right.y(), right.x()),
                        height};
  Footprint within = place;  // its back and its end touch walls
  within.half -= Eigen::Vector2d(1e-9, 1e-9);
  if (!is_free(building.room(room), within))
    throw Error("a wardrobe of " + std::to_string(length) + " m does not fit along its wall",
                "make it shorter: it must leave doors and windows free");
  const Frame frame{building, building.add_object("wardrobe"), place.centre, place.yaw,
                    building.room(room).floor_height};
  build_block(frame, length, depth, height);
  building.occupy(room, place);
}

}  // namespace atrium::synth
