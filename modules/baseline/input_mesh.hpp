#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "modules/types/mesh.hpp"

namespace atrium::baseline {

/// Throws Error unless every vertex is finite, every corner is a vertex and every column is empty or of full length.
void check_mesh(const Mesh& mesh);

/// How many triangles a decimation may leave of `count`: the least of `triangles` and ratio · count, of which 0 means
/// not given. Error: neither is given.
std::size_t target_triangles(std::size_t count, std::int64_t triangles, double ratio);

/// The triangles of `source` with other corners: corners[k] are those of the result's triangle k, which has the class,
/// storey and primitive of the source's triangle sources[k]. A source that is all objects, as a reconstruction of a
/// whole scan is, tells no structure apart: its classes are left out. Vertices and their colours are not set.
Mesh with_columns(const Mesh& source, std::vector<std::array<std::uint32_t, 3>> corners,
                  const std::vector<std::uint32_t>& sources);

/// Gives the mesh, whose corners are indices into `places`, those of them as vertices that a triangle uses, in their
/// order, with their colours (empty: none).
void place_used_vertices(const std::vector<Eigen::Vector3d>& places, const std::vector<Colour>& colours, Mesh& mesh);

/// The mesh without triangles that have a corner twice, and without vertices that no triangle uses.
Mesh without_repeated_corners(const Mesh& mesh);

}  // namespace atrium::baseline
