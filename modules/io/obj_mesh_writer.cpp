#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "modules/io/byte_buffer.hpp"
#include "modules/io/mesh_writers.hpp"
#include "modules/io/obj_groups.hpp"
#include "modules/io/surface_classes.hpp"

namespace atrium::io {
namespace {

SurfaceClass class_of(const Mesh& mesh, std::size_t t) {
  return mesh.classes.empty() ? SurfaceClass::object : mesh.classes[t];
}
std::int32_t primitive_of(const Mesh& mesh, std::size_t t) {
  return mesh.primitives.empty() ? -1 : std::max(mesh.primitives[t], -1);
}

/// Triangles with those of one group in one run, else in the mesh's order.
std::vector<std::size_t> grouped(const Mesh& mesh) {
  std::vector<std::size_t> order(mesh.triangles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(class_of(mesh, a), primitive_of(mesh, a)) < std::pair(class_of(mesh, b), primitive_of(mesh, b));
  });
  return order;
}

}  // namespace

void write_obj(const Mesh& mesh, const std::string& material_file, AtomicFile& file) {
  ByteBuffer out(file);
  out.text("# Atrium; metres\n");
  if (!mesh.classes.empty()) out.text("mtllib " + material_file + "\n");
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Eigen::Vector3d place = mesh.origin + mesh.vertices[i];
    out.text(fmt::format("v {} {} {}", place.x(), place.y(), place.z()));
    if (!mesh.colours.empty())
      for (const auto c : mesh.colours[i]) out.text(fmt::format(" {:.4f}", c / 255.0));
    out.text("\n");
  }
  bool first = true;
  SurfaceClass surface{};
  std::int32_t primitive = -1;
  for (const std::size_t t : grouped(mesh)) {
    if (!mesh.classes.empty() && (first || class_of(mesh, t) != surface || primitive_of(mesh, t) != primitive)) {
      first = false;
      surface = class_of(mesh, t);
      primitive = primitive_of(mesh, t);
      out.text(fmt::format("g {}\nusemtl {}\n", group_name(surface, primitive), name_of(surface)));
    }
    const auto& [a, b, c] = mesh.triangles[t];
    out.text(fmt::format("f {} {} {}\n", std::uint64_t{a} + 1, std::uint64_t{b} + 1, std::uint64_t{c} + 1));
  }
  out.flush();
}

std::string obj_materials() {
  std::string text = "# Atrium: one material for each class of surface\n";
  for (const SurfaceClass c : all_classes) {
    const Colour colour = class_colour(c);
    text += fmt::format("newmtl {}\nKd {:.4f} {:.4f} {:.4f}\nillum 1\n", name_of(c), colour[0] / 255.0,
                        colour[1] / 255.0, colour[2] / 255.0);
  }
  return text;
}

}  // namespace atrium::io
