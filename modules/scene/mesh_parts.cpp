#include "modules/scene/mesh_parts.hpp"

#include "modules/types/palette.hpp"

namespace atrium::scene {
namespace {

template <class T>
void extend(std::vector<T>& column, const std::vector<T>& more) {
  column.insert(column.end(), more.begin(), more.end());
}

}  // namespace

Mesh objects_of(const Mesh& objects, bool colours) {
  Mesh result = objects;
  result.classes.assign(result.triangles.size(), SurfaceClass::object);
  result.storeys.assign(result.triangles.size(), -1);
  result.primitives.assign(result.triangles.size(), -1);
  if (colours && result.colours.empty())
    result.colours.assign(result.vertices.size(), class_colour(SurfaceClass::object));
  if (!colours) result.colours.clear();
  return result;
}

Mesh joined(Mesh a, const Mesh& b) {
  const auto first = static_cast<std::uint32_t>(a.vertices.size());
  if (a.vertices.empty()) a.origin = b.origin;
  const Eigen::Vector3d shift = b.origin - a.origin;
  for (const auto& v : b.vertices) a.vertices.emplace_back(v + shift);
  for (const auto& t : b.triangles) a.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  extend(a.colours, b.colours);
  extend(a.classes, b.classes);
  extend(a.storeys, b.storeys);
  extend(a.primitives, b.primitives);
  return a;
}

}  // namespace atrium::scene
