#include "modules/io/write_mesh.hpp"

#include "modules/io/mesh_writers.hpp"
#include "modules/io/paths.hpp"

namespace atrium::io {
namespace {

void write_obj_pair(const Mesh& mesh, const std::filesystem::path& target, const Context& context) {
  std::filesystem::path materials = target;
  materials.replace_extension(".mtl");
  AtomicFile file(target);
  write_obj(mesh, materials.filename().string(), file);
  if (!mesh.classes.empty()) {
    AtomicFile second(materials);
    second.write(obj_materials());
    second.commit();
    context.wrote(materials);
  }
  file.commit();
}

void write_one(const Mesh& mesh, const FaceImages& images, const std::string& extension, bool binary,
               const std::filesystem::path& target) {
  AtomicFile file(target);
  if (extension == ".ply")
    write_ply(mesh, binary, file);
  else if (extension == ".stl")
    write_stl(mesh, binary, file);
  else
    write_glb(mesh, images, file);
  file.commit();
}

}  // namespace

WriteMesh::Out WriteMesh::run(const In& in, const Params& params, Context& context) {
  const std::string extension = extension_of(params.path.path);
  if (extension != ".ply" && extension != ".obj" && extension != ".stl" && extension != ".glb")
    throw Error("cannot write a mesh as '" + params.path.path + "'", "known extensions: .ply, .obj, .stl, .glb");
  check_mesh(*in.mesh);
  if (in.mesh->triangles.empty()) context.warn("the mesh is empty: " + params.path.path + " has no faces");
  FaceImages images;
  if (in.textures && extension == ".glb")
    images = FaceImages(*in.textures, *in.mesh, context);
  else if (in.textures)
    context.warn("textures are not written to " + extension + " files, only to .glb");
  const auto target = context.output(params.path.path);
  if (extension == ".obj")
    write_obj_pair(*in.mesh, target, context);
  else
    write_one(*in.mesh, images, extension, params.binary, target);
  context.wrote(target);
  return {};
}

}  // namespace atrium::io
