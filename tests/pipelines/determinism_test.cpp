// Real nodes, run by the program: the same values with any number of threads, time after time.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace atrium::test::determinism_test {
namespace {

using nlohmann::json;

TEST(Determinism, AScanOfAFlatHasTheSamePlanesWithAnyNumberOfThreads) {
  TemporaryFolder folder;
  write_text(folder / "flat.yaml", R"(atrium: 1
seed: 3
nodes:
  flat: {type: synth.flat}
  scan: {type: synth.scan, in: {scene: flat.scene}, params: {points: 60000, noise: 8 mm, outliers: 1 %}}
  grid: {type: filter.voxel_grid, in: {cloud: scan.cloud}, params: {size: 5 cm}}
  normals: {type: normal.estimate, in: {cloud: grid.cloud}}
  planes: {type: plane.ransac, in: {cloud: normals.cloud}}
outputs: {planes: planes.planes}
)");
  const auto hashes = [&](const std::string& threads) {
    ProcessOptions options;
    options.folder = folder.path();
    const auto result = run_process({ATRIUM_PROGRAM, "run", "flat.yaml", "--out", "r", "-j", threads}, options);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const auto manifest = json::parse(read_text(folder / "r/manifest.json"));
    json list = json::array();
    for (const auto& node : manifest["nodes"]) list.push_back({node["node"], node["outputs"]});
    return list;
  };
  const auto serial = hashes("1");
  ASSERT_EQ(serial.size(), 5U);
  EXPECT_EQ(serial, hashes("2"));
  EXPECT_EQ(serial, hashes("4"));
  EXPECT_EQ(serial, hashes("4"));
}

}  // namespace
}  // namespace atrium::test::determinism_test
