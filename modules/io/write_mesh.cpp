#include "modules/io/write_mesh.hpp"

#include "modules/io/mesh_writers.hpp"
#include "modules/io/paths.hpp"

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
  if (in.textures && (extension == ".glb" || extension == ".obj"))
    images = FaceImages(*in.textures, *in.mesh, context);
  else if (in.textures)
    context.warn("textures are not written to " + extension + " files, only to .glb and .obj");
  const auto target = context.output(params.path.path);
  if (extension == ".obj")
    write_obj_files(*in.mesh, images, target, context);
  else
    write_one(*in.mesh, images, extension, params.binary, target);
  context.wrote(target);
  return {};
}

}  // namespace atrium::io
