#pragma once
#include "graph/api/node.hpp"
#include "modules/types/cloud.hpp"

namespace atrium::pcl_nodes {

/// Writes a cloud with PCL's writers: swaps with io.write_cloud for .pcd and .ply.
///
/// Fields: x y z, and normal_x normal_y normal_z, rgb, intensity, label where the cloud has them. Coordinates are
/// floats with the cloud's origin added, since PCL's point types are: at 5 000 000 m from zero, they step by half a
/// metre. A warning says by how much points are moved where that is more than 0.1 mm (io.write_cloud writes doubles
/// then). Sources and sensors are not written. The file appears whole or not at all. Error: another extension; an empty
/// cloud, which PCL does not write.
struct Write {
  static constexpr std::string_view type = "pcl.write";
  static constexpr std::string_view summary = "Writes a PCD or PLY file (pcl::PCDWriter, pcl::PLYWriter).";
  struct In {
    Input<Cloud> cloud;
  };
  struct Params {
    OutputPath path{"cloud.pcd"};
    bool binary = true;
    bool compressed = false;
  };
  static constexpr auto inputs = std::tuple{port<&In::cloud>("What to write.")};
  static constexpr auto params = std::tuple{param<&Params::path>("The file, in the run's folder: .pcd or .ply."),
                                            param<&Params::binary>("Binary; else text."),
                                            param<&Params::compressed>("Binary and compressed (PCD only).")};
  static void run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::pcl_nodes
