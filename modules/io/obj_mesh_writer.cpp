#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "modules/io/byte_buffer.hpp"
#include "modules/io/mesh_writers.hpp"
#include "modules/io/obj_groups.hpp"
#include "modules/io/surface_classes.hpp"

namespace atrium::io {
namespace {

SurfaceClass class_of_triangle(const Mesh& mesh, std::size_t t) {
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
    return std::pair(class_of_triangle(mesh, a), primitive_of(mesh, a)) <
           std::pair(class_of_triangle(mesh, b), primitive_of(mesh, b));
  });
  return order;
}

/// A corner's place in an image, from the lower left.
void write_place(const FaceImages& images, std::size_t image, const Eigen::Vector3d& vertex, ByteBuffer& out) {
  const Eigen::Vector2d place = images.place(image, vertex);
  out.text(fmt::format("vt {:.7g} {:.7g}\n", place.x(), 1 - place.y()));
}

void write_faces(const Mesh& mesh, const FaceImages& images, ByteBuffer& out) {
  bool first = true;
  SurfaceClass surface{};
  std::int32_t primitive = -1;
  std::size_t image = FaceImages::none;
  std::uint64_t places = 0;
  for (const std::size_t t : grouped(mesh)) {
    if (!mesh.classes.empty() &&
        (first || class_of_triangle(mesh, t) != surface || primitive_of(mesh, t) != primitive)) {
      first = false;
      surface = class_of_triangle(mesh, t);
      primitive = primitive_of(mesh, t);
      image = images.find(surface, primitive);
      const std::string group = group_name(surface, primitive);
      out.text(
          fmt::format("g {}\nusemtl {}\n", group, image == FaceImages::none ? std::string(name_of(surface)) : group));
    }
    const auto& [a, b, c] = mesh.triangles[t];
    const std::uint64_t i = std::uint64_t{a} + 1, j = std::uint64_t{b} + 1, k = std::uint64_t{c} + 1;
    if (image == FaceImages::none) {
      out.text(fmt::format("f {} {} {}\n", i, j, k));
      continue;
    }
    for (const auto corner : mesh.triangles[t]) write_place(images, image, mesh.vertices[corner], out);
    out.text(fmt::format("f {}/{} {}/{} {}/{}\n", i, places + 1, j, places + 2, k, places + 3));
    places += 3;
  }
}

}  // namespace

void write_obj(const Mesh& mesh, const FaceImages& images, const std::string& material_file, AtomicFile& file) {
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
  write_faces(mesh, images, out);
  out.flush();
}

std::string obj_materials(const FaceImages& images, const std::string& image_prefix) {
  std::string text = "# Atrium: one material for each class of surface\n";
  for (const SurfaceClass c : all_classes) {
    const Colour colour = class_colour(c);
    text += fmt::format("newmtl {}\nKd {:.4f} {:.4f} {:.4f}\nillum 1\n", name_of(c), colour[0] / 255.0,
                        colour[1] / 255.0, colour[2] / 255.0);
  }
  if (images.size() > 0) text += "# and one for each face with an image\n";
  for (std::size_t i = 0; i < images.size(); ++i)
    text += fmt::format("newmtl {0}\nKd 1 1 1\nillum 0\nmap_Kd -clamp on {1}{0}.png\n", images.name(i), image_prefix);
  return text;
}

}  // namespace atrium::io
