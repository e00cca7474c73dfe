#include <fmt/format.h>

#include <algorithm>

#include "graph/api/error.hpp"
#include "modules/io/byte_buffer.hpp"
#include "modules/io/mesh_writers.hpp"

namespace atrium::io {
namespace {

void write_binary_stl(const Mesh& mesh, ByteBuffer& out) {
  std::string head = "binary STL by Atrium; metres";
  head.resize(80, ' ');
  out.text(head);
  out.number(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Eigen::Vector3f normal = normal_of(mesh, t).cast<float>();
    for (int a = 0; a < 3; ++a) out.number(normal[a]);
    for (const auto corner : mesh.triangles[t]) {
      const Eigen::Vector3f place = (mesh.origin + mesh.vertices[corner]).cast<float>();
      for (int a = 0; a < 3; ++a) out.number(place[a]);
    }
    out.number(std::uint16_t{0});
  }
}

void write_text_stl(const Mesh& mesh, ByteBuffer& out) {
  out.text("solid atrium\n");
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Eigen::Vector3d normal = normal_of(mesh, t);
    out.text(fmt::format("facet normal {:.6g} {:.6g} {:.6g}\n outer loop\n", normal.x(), normal.y(), normal.z()));
    for (const auto corner : mesh.triangles[t]) {
      const Eigen::Vector3d place = mesh.origin + mesh.vertices[corner];
      out.text(fmt::format("  vertex {} {} {}\n", place.x(), place.y(), place.z()));
    }
    out.text(" endloop\nendfacet\n");
  }
  out.text("endsolid atrium\n");
}

}  // namespace

void write_stl(const Mesh& mesh, bool binary, AtomicFile& file) {
  ByteBuffer out(file);
  if (binary) {
    if (mesh.triangles.size() > 0xFFFFFFFFU) throw Error("a binary STL file holds at most 4294967295 triangles");
    double largest = 0;
    for (const auto& v : mesh.vertices) largest = std::max(largest, (mesh.origin + v).cwiseAbs().maxCoeff());
    if (largest > stl_limit)
      throw Error(
          fmt::format("the mesh reaches out to {:.0f} m from zero: the float32 numbers of a binary STL file would "
                      "lose its millimetres",
                      largest),
          "write .ply or .obj, or set binary: false (text has all digits)");
    write_binary_stl(mesh, out);
  } else {
    write_text_stl(mesh, out);
  }
  out.flush();
}

}  // namespace atrium::io
