#include <fmt/format.h>

#include <bit>

#include "modules/io/byte_buffer.hpp"
#include "modules/io/mesh_writers.hpp"
#include "modules/io/surface_classes.hpp"

namespace atrium::io {
namespace {

std::string header_of(const Mesh& mesh, bool binary) {
  const char* format = !binary                                      ? "ascii"
                       : std::endian::native == std::endian::little ? "binary_little_endian"
                                                                    : "binary_big_endian";
  std::string header = fmt::format("ply\nformat {} 1.0\ncomment Atrium; metres\n", format);
  if (!mesh.classes.empty()) {
    header += "comment class:";
    for (const SurfaceClass c : all_classes) header += fmt::format(" {} {}", static_cast<int>(c), name_of(c));
    header += "\n";
  }
  header +=
      fmt::format("element vertex {}\nproperty double x\nproperty double y\nproperty double z\n", mesh.vertices.size());
  const std::string colour = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  if (!mesh.colours.empty()) header += colour;
  header += fmt::format("element face {}\nproperty list uchar uint vertex_indices\n", mesh.triangles.size());
  if (!mesh.classes.empty()) header += "property uchar class\n" + colour;
  if (!mesh.storeys.empty()) header += "property int storey\n";
  if (!mesh.primitives.empty()) header += "property int primitive\n";
  return header + "end_header\n";
}

void write_binary_ply(const Mesh& mesh, ByteBuffer& out) {
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Eigen::Vector3d place = mesh.origin + mesh.vertices[i];
    for (int a = 0; a < 3; ++a) out.number(place[a]);
    if (!mesh.colours.empty()) out.number(mesh.colours[i]);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    out.number(std::uint8_t{3});
    out.number(mesh.triangles[t]);
    if (!mesh.classes.empty()) {
      out.number(static_cast<std::uint8_t>(mesh.classes[t]));
      out.number(class_colour(mesh.classes[t]));
    }
    if (!mesh.storeys.empty()) out.number(mesh.storeys[t]);
    if (!mesh.primitives.empty()) out.number(mesh.primitives[t]);
  }
}

void write_text_ply(const Mesh& mesh, ByteBuffer& out) {
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Eigen::Vector3d place = mesh.origin + mesh.vertices[i];
    out.text(fmt::format("{} {} {}", place.x(), place.y(), place.z()));
    if (!mesh.colours.empty())
      out.text(fmt::format(" {} {} {}", mesh.colours[i][0], mesh.colours[i][1], mesh.colours[i][2]));
    out.text("\n");
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    out.text(fmt::format("3 {} {} {}", a, b, c));
    if (!mesh.classes.empty()) {
      const Colour colour = class_colour(mesh.classes[t]);
      out.text(fmt::format(" {} {} {} {}", static_cast<int>(mesh.classes[t]), colour[0], colour[1], colour[2]));
    }
    if (!mesh.storeys.empty()) out.text(fmt::format(" {}", mesh.storeys[t]));
    if (!mesh.primitives.empty()) out.text(fmt::format(" {}", mesh.primitives[t]));
    out.text("\n");
  }
}

}  // namespace

void write_ply(const Mesh& mesh, bool binary, AtomicFile& file) {
  ByteBuffer out(file);
  out.text(header_of(mesh, binary));
  if (binary)
    write_binary_ply(mesh, out);
  else
    write_text_ply(mesh, out);
  out.flush();
}

}  // namespace atrium::io
