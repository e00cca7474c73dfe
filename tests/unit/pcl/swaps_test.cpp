// Each node has the ports of the node that it stands in for: `-s node.type=pcl.…` is all that a swap takes.
#include <gtest/gtest.h>

#include <algorithm>

#include "modules/filter/outliers.hpp"
#include "modules/filter/voxel_grid.hpp"
#include "modules/io/read_scan.hpp"
#include "modules/io/write_cloud.hpp"
#include "modules/normal/estimate.hpp"
#include "modules/object/greedy.hpp"
#include "modules/object/poisson.hpp"
#include "modules/pcl/clusters.hpp"
#include "modules/pcl/convex_hull.hpp"
#include "modules/pcl/gicp.hpp"
#include "modules/pcl/greedy.hpp"
#include "modules/pcl/marching_cubes.hpp"
#include "modules/pcl/ndt.hpp"
#include "modules/pcl/normals.hpp"
#include "modules/pcl/outliers.hpp"
#include "modules/pcl/poisson.hpp"
#include "modules/pcl/ransac.hpp"
#include "modules/pcl/read.hpp"
#include "modules/pcl/region_growing.hpp"
#include "modules/pcl/voxel_grid.hpp"
#include "modules/pcl/write.hpp"
#include "modules/plane/ransac.hpp"
#include "modules/plane/region_growing.hpp"
#include "modules/register/gicp.hpp"
#include "modules/types/ports.hpp"

namespace atrium::pcl_nodes::swaps_test {
namespace {

template <class Theirs, class Ours>
struct Pair {
  using Pcl = Theirs;
  using Own = Ours;
};

template <class Pair>
class PclSwap : public testing::Test {};
using Pairs =
    testing::Types<Pair<VoxelGrid, filter::VoxelGrid>, Pair<Outliers, filter::Outliers>,
                   Pair<Clusters, filter::Outliers>, Pair<Normals, normal::Estimate>, Pair<Ransac, plane::Ransac>,
                   Pair<Ransac, plane::RegionGrowing>, Pair<RegionGrowing, plane::RegionGrowing>,
                   Pair<RegionGrowing, plane::Ransac>, Pair<ConvexHull, object::Poisson>,
                   Pair<Poisson, object::Poisson>, Pair<Greedy, object::Greedy>, Pair<MarchingCubes, object::Poisson>,
                   Pair<Gicp, registration::Gicp>, Pair<Ndt, registration::Gicp>, Pair<Read, io::ReadScan>,
                   Pair<Write, io::WriteCloud>>;
TYPED_TEST_SUITE(PclSwap, Pairs);

bool has(const std::vector<PortInfo>& ports, const PortInfo& wanted) {
  return std::any_of(ports.begin(), ports.end(), [&](const PortInfo& port) {
    return port.name == wanted.name && port.type == wanted.type && port.repeated == wanted.repeated;
  });
}

TYPED_TEST(PclSwap, HasThePortsOfOurs) {
  const NodeType theirs = describe_tables<typename TypeParam::Pcl>(), ours = describe_tables<typename TypeParam::Own>();
  for (const auto& port : ours.inputs) EXPECT_TRUE(port.optional || has(theirs.inputs, port)) << port.name;
  for (const auto& port : ours.outputs) EXPECT_TRUE(has(theirs.outputs, port)) << port.name;
  for (const auto& port : theirs.inputs) EXPECT_TRUE(port.optional || has(ours.inputs, port)) << port.name;
}

TYPED_TEST(PclSwap, ParametersOfOneNameTakeTheSameValues) {
  const NodeType theirs = describe_tables<typename TypeParam::Pcl>(), ours = describe_tables<typename TypeParam::Own>();
  if (theirs.type == "pcl.read") return;  // one file, not several
  for (const auto& t : theirs.params)
    for (const auto& o : ours.params)
      if (t.name == o.name && t.name != "method") {
        EXPECT_EQ(t.kind, o.kind) << t.name;
        EXPECT_EQ(t.unit.dimension, o.unit.dimension) << t.name;
      }
}

}  // namespace
}  // namespace atrium::pcl_nodes::swaps_test
