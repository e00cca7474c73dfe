#pragma once
#include "graph/api/value.hpp"
#include "modules/types/adjacency.hpp"
#include "modules/types/building.hpp"
#include "modules/types/cell_complex.hpp"
#include "modules/types/cloud.hpp"
#include "modules/types/floor_plan.hpp"
#include "modules/types/ground_truth.hpp"
#include "modules/types/mesh.hpp"
#include "modules/types/metrics.hpp"
#include "modules/types/picture.hpp"
#include "modules/types/plane_meshes.hpp"
#include "modules/types/plane_primitives.hpp"
#include "modules/types/poses.hpp"
#include "modules/types/simulated_scene.hpp"
#include "modules/types/structure.hpp"
#include "modules/types/textures.hpp"

/// How the values on the edges are hashed, measured and stored is compiled once, in modules/types/ports_*.cpp: what
/// would compile it for itself, a plugin's tables, includes this first. A type with no line here works all the same.
// NOLINTBEGIN(bugprone-macro-parentheses): a type in parentheses is none.
#define ATRIUM_PORT(keyword, type)                                        \
  keyword template std::string atrium::content_hash(const atrium::type&); \
  keyword template std::size_t atrium::byte_size(const atrium::type&);    \
  keyword template const atrium::FlatType* atrium::flat_type<atrium::type>()
// NOLINTEND(bugprone-macro-parentheses)

ATRIUM_PORT(extern, Adjacency);
ATRIUM_PORT(extern, Building);
ATRIUM_PORT(extern, CellComplex);
ATRIUM_PORT(extern, Cloud);
ATRIUM_PORT(extern, FloorPlan);
ATRIUM_PORT(extern, GroundTruth);
ATRIUM_PORT(extern, Mesh);
ATRIUM_PORT(extern, Metrics);
ATRIUM_PORT(extern, Pictures);
ATRIUM_PORT(extern, PlaneMeshes);
ATRIUM_PORT(extern, PlanePrimitives);
ATRIUM_PORT(extern, Poses);
ATRIUM_PORT(extern, SimulatedScene);
ATRIUM_PORT(extern, Structure);
ATRIUM_PORT(extern, Textures);
ATRIUM_PORT(extern, Transform);
