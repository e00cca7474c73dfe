#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "modules/building/corrections_file.hpp"
#include "modules/building/elements.hpp"
#include "modules/building/place_distance.hpp"
#include "modules/building/room_shell.hpp"
#include "modules/types/building.hpp"

namespace atrium::building {

/// A building that is being corrected, with the names that things had before.
class CorrectionDraft {
 public:
  Building building;  ///< each room has vertices of its own
  double max_thickness = 0.6;

  /// `transform` leads from the scan's frame to the building's; `unit`: metres per unit of the scan's file.
  CorrectionDraft(const Building& original, const Transform& transform, double unit, double max_thickness);

  BuildingRoom& room(std::int32_t index) { return building.rooms[static_cast<std::size_t>(index)]; }
  BuildingFace& face(std::int32_t index) { return building.faces[static_cast<std::size_t>(index)]; }
  BuildingOpening& opening(std::int32_t index) { return building.openings[static_cast<std::size_t>(index)]; }

  /// What a correction names. All throw its Error where there is no such thing, with what there is; so they do where
  /// the thing is not at the place that `near` says, and where `near` stands alone and means none or several.
  std::int32_t room_named(const Correction& correction, std::string_view key, const std::string& name) const;
  std::int32_t room_of(const Correction& correction) const;
  /// The rooms that `rooms` and `near` say.
  std::vector<std::int32_t> rooms_of(const Correction& correction) const;
  /// The room's face by `wall`, `face` or `at`.
  std::int32_t face_of(const Correction& correction, std::int32_t room);
  /// The room's face by `face` alone.
  std::int32_t numbered_face(const Correction& correction, std::int32_t room) const;
  std::int32_t opening_of(const Correction& correction) const;

  /// A place of the file in the building's coordinates; of two numbers the place at that height.
  Eigen::Vector3d place(const Correction& correction, std::string_view key, double height) const;
  /// "x 1.20, y 3.40" in the scan's frame and unit.
  std::string told(const Eigen::Vector3d& place) const;

  /// "face 12": its number before all corrections; "a new face".
  std::string face_name(std::int32_t face) const;
  std::string opening_name(std::int32_t opening) const;
  /// Lists the room's faces of walls.
  std::string walls_of(std::int32_t room) const;

  void rename(std::int32_t room, const std::string& name);
  /// The room says that it was corrected.
  void mark(std::int32_t room, const std::string& what);
  void mark_face(std::int32_t index, const std::string& what) { face(index).corrections.push_back(what); }

  void add_opening(BuildingOpening opening) { building.openings.push_back(std::move(opening)); }
  void drop_opening(std::int32_t opening);
  struct NewRoom {
    BuildingRoom room;  ///< without faces
    RoomShell shell;
  };
  /// The rooms go, the others come in their place; openings stay in the faces that are made from theirs, and faces that
  /// are new or have another shape say so. Returns the new rooms' numbers. An opening whose face is no more is the
  /// correction's Error.
  std::vector<std::int32_t> replace(const Correction& correction, const std::vector<std::int32_t>& removed,
                                    std::vector<NewRoom> rooms);

 private:
  /// A key that holds a place, or one of each of several things.
  struct PlaceKey {
    std::string_view name;
    std::size_t thing = 0;
  };
  Eigen::Vector3d place_at(const Correction& correction, std::string_view key, const std::vector<double>& numbers,
                           double height) const;
  NearPlace near_place(const Correction& correction, const PlaceKey& key, double height) const;
  // Of the original, whatever the corrections before this one did.
  void check_opening_place(const Correction& correction, std::size_t named) const;
  void check_face_place(const Correction& correction, std::size_t named, const std::string& called) const;
  std::int32_t opening_at(const Correction& correction) const;
  // Of the rooms that there are, or of the original.
  void check_room_place(const Correction& correction, const PlaceKey& key, std::int32_t index) const;
  bool is_at(const Building& of, const Correction& correction, const PlaceKey& key, std::int32_t index) const;
  std::int32_t room_at(const Correction& correction, const PlaceKey& key) const;
  std::int32_t original_room(std::int32_t index) const;  ///< -1: none has its name

  std::int32_t face_by_wall(const Correction& correction, std::int32_t room);
  std::int32_t face_by_place(const Correction& correction, std::int32_t room) const;
  std::int32_t append(const Correction& correction, NewRoom room, std::vector<std::vector<std::int32_t>>& sources);
  void mark_new_shape(const Correction& correction, BuildingFace& face, const std::vector<std::int32_t>& sources,
                      double area) const;
  void move_openings(const Correction& correction, const std::vector<std::int32_t>& removed,
                     const std::vector<std::int32_t>& rooms, const std::vector<std::vector<std::int32_t>>& sources);
  std::int32_t successor(std::int32_t face, const std::vector<std::int32_t>& rooms,
                         const std::vector<std::vector<std::int32_t>>& sources,
                         const std::vector<Eigen::Vector3d>* outline) const;

  Building original_;
  Transform transform_;
  double unit_;
  std::vector<std::int32_t> faces_now_;     ///< per face of the original; −1: it is no more
  std::vector<std::int32_t> openings_now_;  ///< per opening of the original
  std::vector<std::string> opening_names_;  ///< of the original
  std::map<std::string, std::string> renamed_;
  std::optional<Elements> elements_;  ///< of the original, once a wall is named
};

}  // namespace atrium::building
