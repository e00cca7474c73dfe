#pragma once
#include "files.hpp"
#include "modules/io/read_mesh.hpp"
#include "modules/io/read_scan.hpp"

namespace atrium::io {

/// Files whose text stands in the test, read as a scan's points or as a mesh.
class TextFiles : public Files {
 protected:
  Cloud scan(const std::string& name, const std::string& text) {
    ReadScan::Params params;
    params.path = {{file(name, text)}};
    params.mesh = ReadScan::MeshUse::vertices;
    return ReadScan::run(params, context).cloud;
  }
  Mesh mesh(const std::string& name, const std::string& text) {
    return ReadMesh::run({{file(name, text)}}, context).mesh;
  }
};

}  // namespace atrium::io
