#pragma once
#include <string>

#include "graph/api/context.hpp"
#include "modules/io/json_fields.hpp"
#include "modules/types/floor_plan.hpp"
#include "modules/types/ground_truth.hpp"

namespace atrium::io {

/// truth.json, as io.write_truth documents it.
std::string truth_to_json(const GroundTruth& truth);
GroundTruth truth_from_json(const JsonField& root);

/// A layout of labelled rectangles, as headsets give it ("planes": label, corners, normal_out).
GroundTruth truth_from_planes(const JsonField& root, const std::string& path, const Context& context);

/// Rooms by their corners: {"rooms": [{"name", "storey", "corners", "floor", "height"}]} or a bare list of corner
/// lists.
GroundTruth truth_from_rooms(const JsonField& root);

/// The faces as triangles with their holes left out (GroundTruth::mesh). Corners stay exactly what they are.
Mesh mesh_of(const GroundTruth& truth);

/// A face of a ring in space, its plane fitted to the ring's area vector.
TrueFace face_of(SurfaceClass surface, std::int32_t room, std::int32_t storey, std::vector<Eigen::Vector3d> outline);

/// The truth's rooms, floors, ceilings and walls seen from above.
FloorPlan plan_of(const GroundTruth& truth);

}  // namespace atrium::io
