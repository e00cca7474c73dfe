#include "modules/io/write_mesh.hpp"

#include "modules/io/mesh_writers.hpp"
#include "modules/io/paths.hpp"

namespace atrium::io {

WriteMesh::Out WriteMesh::run(const In& in, const Params& params, Context& context) {
  const std::string extension = extension_of(params.path.path);
  if (extension != ".ply") throw Error("cannot write a mesh as '" + params.path.path + "'", "known extensions: .ply");
  check_mesh(*in.mesh);
  if (in.mesh->triangles.empty()) context.warn("the mesh is empty: " + params.path.path + " has no faces");
  const auto target = context.output(params.path.path);
  AtomicFile file(target);
  write_ply(*in.mesh, params.binary, file);
  file.commit();
  context.wrote(target);
  return {};
}

}  // namespace atrium::io
