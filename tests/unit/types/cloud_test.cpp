#include "modules/types/cloud.hpp"

#include <gtest/gtest.h>

#include "graph/cache/blob.hpp"
#include "modules/types/plane_primitives.hpp"
#include "tests/support/temporary_folder.hpp"

namespace atrium::cloud_test {
namespace {

Cloud surveyed() {
  Cloud cloud;
  cloud.origin = {500000, 5400000, 0};
  cloud.points = {{0, 0, 0}, {1, 2, 3}, {4, 5, 6}};
  cloud.unit = 0.3048;
  cloud.crs = "EPSG:25832";
  return cloud;
}

TEST(Cloud, SelectedAndTurnedCloudsStillNameTheFilesUnitAndReferenceSystem) {
  Transform turn;
  turn.rotation << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  for (const Cloud& cloud : {select(surveyed(), {2, 0}), transformed(surveyed(), turn)}) {
    EXPECT_EQ(cloud.crs, "EPSG:25832");
    EXPECT_EQ(cloud.unit, 0.3048);
  }
}

TEST(Cloud, TheCacheKeepsTheReferenceSystem) {
  const test::TemporaryFolder folder;
  const Cloud cloud = surveyed();
  Cloud other = cloud;
  other.crs = "EPSG:25833";
  EXPECT_NE(content_hash(cloud), content_hash(other));
  write_blob(folder / "cloud", *flat_type<Cloud>(), &cloud, content_hash(cloud));
  const auto back = read_blob(folder / "cloud", *flat_type<Cloud>(), content_hash(cloud), {});
  EXPECT_EQ(static_cast<const Cloud*>(back.get())->crs, "EPSG:25832");
}

}  // namespace
}  // namespace atrium::cloud_test
