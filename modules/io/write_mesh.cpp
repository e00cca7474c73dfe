#include "modules/io/write_mesh.hpp"

#include "modules/io/mesh_writers.hpp"
#include "modules/io/paths.hpp"
#include "modules/types/crs_name.hpp"

namespace atrium::io {
namespace {

/// The .obj comes last: once it is there, so is all that it names.
void write_obj_files(const Mesh& mesh, const FaceImages& images, const std::filesystem::path& target,
                     const Context& context) {
  AtomicFile file(target);
  std::filesystem::path materials = target;
  materials.replace_extension(".mtl");
  const std::string prefix = target.stem().string() + "_";
  write_obj(mesh, images, materials.filename().string(), file);
  const auto write = [&](const std::filesystem::path& path, const void* data, std::size_t size) {
    AtomicFile beside(path);
    beside.write(data, size);
    beside.commit();
    context.wrote(path);
  };
  for (std::size_t i = 0; i < images.size(); ++i)
    write(target.parent_path() / (prefix + images.name(i) + ".png"), images.png(i).data(), images.png(i).size());
  if (!mesh.classes.empty()) {
    const std::string text = obj_materials(images, prefix);
    write(materials, text.data(), text.size());
  }
  file.commit();
}

void write_one(const Mesh& mesh, const FaceImages& images, const Eigen::Vector3d& up, const std::string& extension,
               bool binary, const std::string& crs, const std::filesystem::path& target) {
  AtomicFile file(target);
  if (extension == ".ply")
    write_ply(mesh, binary, file);
  else if (extension == ".stl")
    write_stl(mesh, binary, file);
  else
    write_glb(mesh, images, up, crs, file);
  file.commit();
}

double units_per_metre(WriteMesh::Unit unit) {
  switch (unit) {
    case WriteMesh::Unit::centimetre: return 100;
    case WriteMesh::Unit::millimetre: return 1000;
    case WriteMesh::Unit::inch: return 1 / 0.0254;
    case WriteMesh::Unit::foot: return 1 / 0.3048;
    default: return 1;
  }
}

Mesh scaled(const Mesh& mesh, double factor) {
  Mesh result = mesh;
  result.origin *= factor;
  for (auto& v : result.vertices) v *= factor;
  return result;
}

}  // namespace

void WriteMesh::run(const In& in, const Params& params, Context& context) {
  const std::string extension = extension_of(params.path.path);
  const std::string crs = extension == ".glb" ? crs_of(params.crs, in.scan.get(), context) : crs_name(params.crs);
  if (!params.crs.empty() && extension != ".glb")
    context.warn("only .glb files can name a coordinate reference system: " + params.path.path + " does not");
  if (extension != ".ply" && extension != ".obj" && extension != ".stl" && extension != ".glb")
    throw Error("cannot write a mesh as '" + params.path.path + "'", "known extensions: .ply, .obj, .stl, .glb");
  check_mesh(*in.mesh);
  if (in.mesh->triangles.empty()) context.warn("the mesh is empty: " + params.path.path + " has no faces");
  FaceImages images;
  if (in.textures && (extension == ".glb" || extension == ".obj"))
    images = FaceImages(*in.textures, *in.mesh, context);
  else if (in.textures)
    context.warn("textures are not written to " + extension + " files, only to .glb and .obj");
  const double factor = units_per_metre(params.unit);
  if (extension == ".glb" && factor != 1) throw Error("a .glb file is in metres by its rules", "set `unit: m`");
  if (images.size() > 0 && factor != 1)
    throw Error("images are written with meshes in metres only", "set `unit: m`, or do not wire `textures`");
  const Mesh other = factor != 1 ? scaled(*in.mesh, factor) : Mesh{};
  const Mesh& mesh = factor != 1 ? other : *in.mesh;
  const Eigen::Vector3d up =
      in.transform ? Eigen::Vector3d(in.transform->rotation.transpose().col(2)) : Eigen::Vector3d::UnitZ();
  const auto target = context.output(params.path.path);
  if (extension == ".obj")
    write_obj_files(mesh, images, target, context);
  else
    write_one(mesh, images, up, extension, params.binary, crs, target);
  context.wrote(target);
}

}  // namespace atrium::io
