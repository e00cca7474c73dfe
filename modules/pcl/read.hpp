#pragma once
#include "graph/api/node.hpp"
#include "modules/types/cloud.hpp"

namespace atrium::pcl_nodes {

/// Reads a PCD or PLY file with PCL's readers: swaps with io.read_scan for one file in metres, to see
/// what PCL sees. io's own readers take more formats and units, check more, and need no VTK.
///
/// Fields: x y z, normal_x normal_y normal_z, rgb or rgba (packed), intensity, label; others are left out. The
/// scanner's place is PCD's VIEWPOINT, if that is not zero. Coordinates stay what the file has: PCL's clouds of fields
/// keep doubles, and an axis that is further than 1000 m from zero goes into the cloud's origin. Points that are not
/// finite are left out, with a warning; so are all normals if one is zero or not finite. Colours are packed in 32 bits.
/// Error: a file that PCL cannot read, or without x y z.
struct Read {
  static constexpr std::string_view type = "pcl.read";
  static constexpr std::string_view summary = "Reads a PCD or PLY file (pcl::PCDReader, pcl::PLYReader).";
  struct Out {
    Cloud cloud;
  };
  struct Params {
    InputPath path;
  };
  static constexpr auto outputs = std::tuple{port<&Out::cloud>("The points, in the file's frame.")};
  static constexpr auto params = std::tuple{param<&Params::path>("A .pcd or .ply file.")};
  static Out run(const Params& params, Context& context);
};

}  // namespace atrium::pcl_nodes
