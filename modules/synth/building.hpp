#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "modules/synth/plan.hpp"
#include "modules/types/simulated_scene.hpp"

namespace atrium::synth {

/// A rectangle on a face, in the face's own coordinates: u horizontal (to the right, seen from the room), v upwards; on
/// floors and ceilings u is x. A place's coordinates are its dot products with Building::u and Building::v.
struct Rectangle {
  double left = 0, right = 0, bottom = 0, top = 0;
};

/// Puts a scene together from rooms, openings and objects. Every surface is modelled from the side that can be seen:
/// a wall between two rooms is two faces, its thickness apart. What the scanner sees besides structural faces (reveals
/// of openings, door leaves, furniture, stairs) are objects.
class Building {
 public:
  /// A room without faces yet. `outline`: its floor, counter-clockwise from above.
  int add_room(const std::string& name, int storey, const Ring2& outline, double floor_height);
  /// A planar structural face, counter-clockwise seen from the room. Returns its index.
  int add_face(int room, SurfaceClass surface, const std::vector<Eigen::Vector3d>& outline, const Colour& colour);
  /// A room with upright walls and flat floor and ceiling. Its faces are, in order: floor, ceiling, one wall per side
  /// of the outline (side i runs from corner i to corner i + 1).
  int add_prism(const std::string& name, int storey, const Ring2& outline, double floor_height, double ceiling_height);

  int floor_of(int room) const { return rooms_[room].first_face; }
  int ceiling_of(int room) const { return rooms_[room].first_face + 1; }
  int wall_of(int room, int side) const { return rooms_[room].first_face + 2 + side; }

  /// A rectangle on a wall around the plan point that is nearest to `centre`.
  Rectangle on_wall(int face, const Eigen::Vector2d& centre, double width, double bottom, double top) const;
  /// Cuts a rectangle through face_a and, if there is one, face_b on the other side; builds the reveal between them (of
  /// depth `thickness` where there is no other side). With `closed` a panel fills the far end (a shut door).
  void pierce(const std::string& kind, int face_a, const Rectangle& rectangle, int face_b);
  void pierce_outside(const std::string& kind, int face_a, const Rectangle& rectangle, double thickness,
                      bool closed = false);

  /// Cuts a hole that is no opening through a face: where a column or a box stands. `ring`: on the face, any direction.
  void cut_out(int face, const std::vector<Eigen::Vector3d>& ring);
  /// Keeps furniture and scanners out of the box around a part of the room's plan.
  void leave_out(int room, const Ring2& ring);
  /// A rectangle on a face, 1 cm before it, as an object (a mirror, say).
  void hang(const std::string& name, int face, const Rectangle& rectangle, const Colour& colour);

  /// A thing that is no structure. Returns the number that add_box and the others want.
  int add_object(const std::string& name);
  /// A box on a turned frame: local x, y about `at` turned by yaw (radians), z from `low` to `high` metres.
  void add_box(int object, const Eigen::Vector2d& at, double yaw, const Eigen::Vector3d& low,
               const Eigen::Vector3d& high, const Colour& colour);
  /// A body of revolution about the upright axis through `at`: profile of (radius, height), from the bottom up.
  void add_lathe(int object, const Eigen::Vector2d& at, const std::vector<Eigen::Vector2d>& profile,
                 const Colour& colour);
  /// Corners counter-clockwise seen from outside; convex.
  void add_polygon(std::int32_t surface, const std::vector<Eigen::Vector3d>& corners, const Colour& colour);
  /// Keeps later furniture and scanners of the room away.
  void occupy(int room, const Footprint& footprint) { rooms_[room].furniture.push_back(footprint); }
  /// Keeps what is taller than footprint.height away.
  void limit_height(int room, const Footprint& footprint) { rooms_[room].low_zones.push_back(footprint); }
  /// Where in the room scanners stand, if not anywhere on its floor.
  void stand_within(int room, const Ring2& ring) { rooms_[room].standing = ring; }
  /// A scanner position of no room (on stairs, say).
  void add_position(const Eigen::Vector3d& place) { scene_.positions.push_back({-1, place}); }

  struct Room {
    Ring2 outline;
    double floor_height = 0;
    int first_face = 0;
    std::vector<Footprint> furniture;
    std::vector<Footprint> doors;      ///< where a door needs its way
    std::vector<Footprint> low_zones;  ///< before windows and under slopes: nothing taller than its `height` may stand
    Ring2 standing;                    ///< where a scanner finds headroom; empty: the whole outline
  };
  const Room& room(int index) const { return rooms_[index]; }
  const GroundTruth& truth() const { return scene_.truth; }

  /// Triangulates the faces, places scanners (1.5 m above each room's floor, up to 8 per room).
  SimulatedScene finish();

 private:
  struct Face {
    Eigen::Vector3d u, v, normal, anchor;
    std::vector<Ring2> rings;  ///< outline, then holes
    Colour colour;
    int room;
    Eigen::Vector3d at(const Eigen::Vector2d& p) const;
  };
  void cut(Face& face, const Ring2& hole_ring);
  void add_reveal(const std::vector<Eigen::Vector3d>& front, const Eigen::Vector3d& depth, bool closed);
  void note_opening(const Face& face, const Rectangle& rectangle);
  TrueOpening opening_of(const std::string& kind, int face, const Rectangle& rectangle) const;

  SimulatedScene scene_;
  std::vector<Room> rooms_;
  std::vector<Face> faces_;
};

}  // namespace atrium::synth
