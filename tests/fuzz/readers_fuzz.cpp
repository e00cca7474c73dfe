#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>

#include "modules/io/read_mesh.hpp"
#include "modules/io/read_scan.hpp"
#include "modules/io/read_vg.hpp"

/// The first byte chooses the format, the others are the file. A reader gives a value or throws Error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const char* const extensions[] = {".ply", ".pcd", ".obj", ".stl", ".xyz", ".csv", ".vg", ".bvg"};
  if (size == 0) return 0;
  const std::string extension = extensions[data[0] % 8];
  const std::string path =
      (std::filesystem::temp_directory_path() / ("atrium_fuzz_" + std::to_string(::getpid()) + extension)).string();
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(data + 1), static_cast<std::streamsize>(size - 1));
  atrium::Context context;
  try {
    if (extension.ends_with("vg")) {
      atrium::io::ReadVg::run({}, {{path}}, context);
    } else {
      atrium::io::ReadScan::Params params;
      params.path.path = path;
      params.mesh = atrium::io::ReadScan::MeshUse::vertices;
      atrium::io::ReadScan::run({}, params, context);
      atrium::io::ReadMesh::run({}, {{path}}, context);
    }
  } catch (const atrium::Error&) {
  }
  std::filesystem::remove(path);
  return 0;
}
