#include "modules/filter/sample_mesh.hpp"

#include "modules/geometry/poisson_disk.hpp"

namespace atrium::filter {

SampleMesh::Out SampleMesh::run(const In& in, const Params& params, Context& context) {
  const std::size_t count = params.count > 0 ? static_cast<std::size_t>(params.count) : in.mesh->vertices.size();
  return {sample_poisson_disk(*in.mesh, count, context)};
}

}  // namespace atrium::filter
