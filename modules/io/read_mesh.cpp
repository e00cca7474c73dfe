#include "modules/io/read_mesh.hpp"

#include "modules/io/decode.hpp"
#include "modules/io/read_geometry.hpp"

namespace atrium::io {

ReadMesh::Out ReadMesh::run(const Params& params, Context& context) {
  const RawGeometry geometry = read_geometry(params.path.path, context);
  Mesh mesh = decode_mesh(geometry, params.scale, context);
  warn_of_lost_digits(geometry, mesh.origin, params.scale, context);
  if (mesh.triangles.empty()) context.warn(params.path.path + ": the mesh has no triangles");
  return {std::move(mesh)};
}

}  // namespace atrium::io
