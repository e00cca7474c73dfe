#pragma once
#include <map>

#include "modules/building/correction_draft.hpp"

/// The corrections by their names in the file. Each throws the correction's Error, and leaves the draft's rooms
/// measured; walls and storeys follow when all are done.
namespace atrium::building {

void rename_room(CorrectionDraft& draft, const Correction& correction);
void merge_rooms(CorrectionDraft& draft, const Correction& correction);
void split_room(CorrectionDraft& draft, const Correction& correction);
void add_opening(CorrectionDraft& draft, const Correction& correction);
void change_opening(CorrectionDraft& draft, const Correction& correction);
void drop_opening(CorrectionDraft& draft, const Correction& correction);
void move_wall(CorrectionDraft& draft, const Correction& correction);
void set_thickness(CorrectionDraft& draft, const Correction& correction);
void drop_face(CorrectionDraft& draft, const Correction& correction);
void set_ceiling(CorrectionDraft& draft, const Correction& correction);
void set_floor(CorrectionDraft& draft, const Correction& correction);

/// Throws the correction's Error where a wall whose thickness was given reaches into a room by now.
void check_thicknesses(CorrectionDraft& draft, const Correction& correction);

/// All of a file in their order.
void apply_all(CorrectionDraft& draft, const std::vector<Correction>& corrections);

/// Moves faces along their normals (metres per face) with what lies beside them in their planes; corners stay in the
/// planes of the other faces around them. Openings go with their walls, feet of doors with their floors.
void shift_faces(CorrectionDraft& draft, const Correction& correction, std::map<std::int32_t, double> shifts);

/// What of one place moves so that the planes around it do: the least motion with normal · motion = shift for each.
struct PlaneShift {
  Eigen::Vector3d normal;
  double by = 0;
};
/// False if there is none.
bool motion_of(const std::vector<PlaneShift>& planes, Eigen::Vector3d& motion);

/// "wall 3" as the file calls it, else "face 12".
std::string wall_called(const CorrectionDraft& draft, const Correction& correction, std::int32_t face);

}  // namespace atrium::building
