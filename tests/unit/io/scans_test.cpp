#include "files.hpp"
#include "modules/io/decode.hpp"
#include "modules/io/read_mesh.hpp"
#include "modules/io/read_scan.hpp"

namespace atrium::io::scans_test {
namespace {

struct Scan {
  const char* file;
  std::size_t vertices, faces;
  bool colours, labels;
};

class Scans : public Files, public ::testing::WithParamInterface<Scan> {};

TEST_P(Scans, HasTheRightCounts) {
  const std::string place = std::string(ATRIUM_SOURCE_DIR "/../shared/scans/") + GetParam().file;
  if (!std::filesystem::exists(place)) GTEST_SKIP() << "the real scans are not beside the checkout: " << place;
  ReadScan::Params params;
  params.path = {{place}};
  params.mesh = ReadScan::MeshUse::vertices;
  const Cloud cloud = ReadScan::run(params, context).cloud;
  EXPECT_EQ(cloud.size(), GetParam().vertices);
  EXPECT_EQ(cloud.colours.size(), GetParam().colours ? cloud.size() : 0);
  EXPECT_EQ(cloud.labels.size(), GetParam().labels ? cloud.size() : 0);
  EXPECT_TRUE(cloud.origin.isZero(0));
  EXPECT_LT(bounds_of(cloud.points, context).extent().maxCoeff(), 60.0F);
  EXPECT_EQ(ReadMesh::run({{place}}, context).mesh.triangles.size(), GetParam().faces);
}

INSTANTIATE_TEST_SUITE_P(Real, Scans,
                         ::testing::Values(Scan{"quest_office_small/mesh.ply", 1895, 3822, false, false},
                                           Scan{"quest_meeting_room/mesh.ply", 8328, 16704, false, false},
                                           Scan{"quest_living_room/mesh.ply", 30933, 62102, false, false},
                                           Scan{"lidar_room/room_scan1.pcd", 112586, 0, false, false},
                                           Scan{"lidar_room/room_scan2.pcd", 112624, 0, false, false},
                                           Scan{"lidar_flat/cloud_0.ply", 36674, 0, false, false},
                                           Scan{"lidar_flat/cloud_1.ply", 36670, 0, false, false},
                                           Scan{"ipad_ceilings/808_db.ply", 47043, 0, true, false},
                                           Scan{"ipad_ceilings/430_db.ply", 52586, 0, true, false},
                                           Scan{"rgbd_frame/office1.pcd", 254456, 0, true, false},
                                           Scan{"objects_only/room1_gt_fine.pcd", 237907, 0, false, true}),
                         [](const auto& scan) {
                           std::string name = scan.param.file;
                           for (char& c : name)
                             if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
                           return name;
                         });

}  // namespace
}  // namespace atrium::io::scans_test
