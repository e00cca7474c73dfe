// The readers of modules/io: a reader gives a value that is right in itself, or throws Error.
#include <cstdlib>

#include "modules/io/read_building.hpp"
#include "modules/io/read_layout.hpp"
#include "modules/io/read_mesh.hpp"
#include "modules/io/read_scan.hpp"
#include "modules/io/read_vg.hpp"
#include "tests/fuzz/targets.hpp"
#include "tests/support/e57_builder.hpp"
#include "tests/support/gltf_builder.hpp"

namespace atrium::fuzz {
namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

template <class F>
void read(F&& reader) {
  try {
    reader();
  } catch (const Error&) {
  }
}

void check(const Cloud& cloud) {
  for (const auto& point : cloud.points) require(point.allFinite());
  for (const std::size_t size :
       {cloud.normals.size(), cloud.colours.size(), cloud.intensities.size(), cloud.labels.size(), cloud.source.size()})
    require(size == 0 || size == cloud.size());
  for (const auto source : cloud.source) require(source < cloud.sensors.size());
}

void check(const Mesh& mesh) {
  for (const auto& triangle : mesh.triangles)
    for (const auto corner : triangle) require(corner < mesh.vertices.size());
  for (const std::size_t size : {mesh.classes.size(), mesh.primitives.size()})
    require(size == 0 || size == mesh.triangles.size());
}

void read_scan(const std::filesystem::path& file, std::size_t size) {
  read([&] {
    Context context;
    io::ReadScan::Params params;
    params.path = {{file}};
    params.mesh = io::ReadScan::MeshUse::vertices;
    // A file's length tells nothing: it is as good as a choice.
    if (size % 2 == 1) params.unit = io::ReadScan::Unit::automatic;
    check(io::ReadScan::run(params, context).cloud);
  });
}

void read_mesh(const std::filesystem::path& file) {
  read([&] {
    Context context;
    check(io::ReadMesh::run({{file}}, context).mesh);
  });
}

void read_scan_and_mesh(const char* name, std::string_view bytes) {
  const auto file = put(name, bytes);
  read_scan(file, bytes.size());
  read_mesh(file);
}

void read_groups(const char* name, std::string_view bytes) {
  const auto file = put(name, bytes);
  read([&] {
    Context context;
    const auto planes = io::ReadVg::run({{file}}, context).planes;
    check(*planes.cloud);
    for (const auto& plane : planes.primitives)
      for (const auto point : plane.inliers) require(point < planes.cloud->size());
  });
}

}  // namespace

void read_ply(std::string_view bytes) { read_scan_and_mesh("fuzz.ply", bytes); }
void read_pcd(std::string_view bytes) { read_scan(put("fuzz.pcd", bytes), bytes.size()); }
void read_obj(std::string_view bytes) { read_scan_and_mesh("fuzz.obj", bytes); }
void read_stl(std::string_view bytes) { read_scan_and_mesh("fuzz.stl", bytes); }
void read_vg(std::string_view bytes) { read_groups("fuzz.vg", bytes); }
void read_bvg(std::string_view bytes) { read_groups("fuzz.bvg", bytes); }

void read_glb(std::string_view bytes) {
  const std::size_t end = bytes.find('\0');
  if (bytes.starts_with("glTF"))
    read_scan_and_mesh("fuzz.glb", bytes);
  else if (end == std::string_view::npos)
    read_scan_and_mesh("fuzz.gltf", bytes);
  else
    read_scan_and_mesh("fuzz.glb",
                       test::glb_file(std::string(bytes.substr(0, end)), std::string(bytes.substr(end + 1))));
}
void read_las(std::string_view bytes) { read_scan(put("fuzz.las", bytes), bytes.size()); }
void read_ptx(std::string_view bytes) { read_scan(put("fuzz.ptx", bytes), bytes.size()); }
void read_e57(std::string_view bytes) {
  read_scan(put("fuzz.e57", test::E57Builder::paged(std::string(bytes))), bytes.size());
}

void read_text_cloud(std::string_view bytes) {
  static const char* const names[] = {"fuzz.xyz", "fuzz.txt",  "fuzz.pts",   "fuzz.csv",
                                      "fuzz.asc", "fuzz.xyzn", "fuzz.xyzrgb"};
  if (bytes.empty()) return;
  const auto which = static_cast<unsigned char>(bytes.front()) % std::size(names);
  read_scan(put(names[which], bytes.substr(1)), bytes.size());
}

void read_building(std::string_view bytes) {
  const auto file = put("building.json", bytes);
  read([&] {
    Context context;
    const Building building = io::ReadBuilding::run({{file}}, context).building;
    for (const auto& face : building.faces)
      for (const auto corner : face.outline) require(corner < building.vertices.size());
  });
}

void read_layout(std::string_view bytes) {
  const auto file = put("layout.json", bytes);
  read([&] {
    Context context;
    check(io::ReadLayout::run({{file}}, context).mesh);
  });
}

}  // namespace atrium::fuzz
