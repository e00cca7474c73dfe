#include "modules/baseline/input_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "graph/api/error.hpp"

namespace atrium::baseline {
namespace {

template <class Column>
void check_length(const Column& column, std::size_t length, const char* name) {
  if (!column.empty() && column.size() != length)
    throw Error(fmt::format("the mesh has {} {} for {} elements", column.size(), name, length),
                "a column is empty or as long as what it describes");
}

template <class Column>
Column taken(const Column& column, const std::vector<std::uint32_t>& sources) {
  Column result;
  if (column.empty()) return result;
  result.reserve(sources.size());
  for (const auto s : sources) result.push_back(column[s]);
  return result;
}

}  // namespace

void check_mesh(const Mesh& mesh) {
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    if (!mesh.vertices[i].allFinite())
      throw Error(fmt::format("vertex {} of the mesh is not finite", i), "every coordinate must be a number");
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (const auto corner : mesh.triangles[i])
      if (corner >= mesh.vertices.size())
        throw Error(fmt::format("triangle {} of the mesh has vertex {} of {}", i, corner, mesh.vertices.size()),
                    "corners are indices of vertices, from 0");
  check_length(mesh.colours, mesh.vertices.size(), "colours");
  check_length(mesh.classes, mesh.triangles.size(), "classes");
  check_length(mesh.storeys, mesh.triangles.size(), "storeys");
  check_length(mesh.primitives, mesh.triangles.size(), "primitives");
}

std::size_t target_triangles(std::size_t count, std::int64_t triangles, double ratio) {
  if (triangles <= 0 && ratio <= 0)
    throw Error("neither 'triangles' nor 'ratio' is given",
                "set one of them above 0: how many triangles are to be left");
  std::size_t target = count;
  if (triangles > 0) target = std::min(target, static_cast<std::size_t>(triangles));
  if (ratio > 0) target = std::min(target, static_cast<std::size_t>(ratio * static_cast<double>(count)));
  return target;
}

Mesh with_columns(const Mesh& source, std::vector<std::array<std::uint32_t, 3>> corners,
                  const std::vector<std::uint32_t>& sources) {
  Mesh mesh;
  mesh.origin = source.origin;
  mesh.triangles = std::move(corners);
  const bool told = std::any_of(source.classes.begin(), source.classes.end(),
                                [](SurfaceClass c) { return c != SurfaceClass::object; });
  if (told) mesh.classes = taken(source.classes, sources);
  mesh.storeys = taken(source.storeys, sources);
  mesh.primitives = taken(source.primitives, sources);
  return mesh;
}

void place_used_vertices(const std::vector<Eigen::Vector3d>& places, const std::vector<Colour>& colours, Mesh& mesh) {
  constexpr std::uint32_t unused = 0xffffffffU;
  std::vector<std::uint32_t> index(places.size(), unused);
  for (const auto& t : mesh.triangles)
    for (const auto corner : t) index[corner] = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (index[i] == unused) continue;
    index[i] = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back(places[i]);
    if (!colours.empty()) mesh.colours.push_back(colours[i]);
  }
  for (auto& t : mesh.triangles)
    for (auto& corner : t) corner = index[corner];
}

Mesh without_repeated_corners(const Mesh& mesh) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> sources;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& c = mesh.triangles[t];
    if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) continue;
    triangles.push_back(c);
    sources.push_back(t);
  }
  Mesh result = with_columns(mesh, std::move(triangles), sources);
  place_used_vertices(mesh.vertices, mesh.colours, result);
  return result;
}

}  // namespace atrium::baseline
