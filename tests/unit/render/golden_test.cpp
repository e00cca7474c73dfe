// Pictures of a simulated room, compared with those in tests/golden (its README tells how to make them anew).
#include <gtest/gtest.h>

#include <cstdlib>

#include "modules/render/png.hpp"
#include "modules/render/snapshot.hpp"
#include "modules/synth/room.hpp"
#include "modules/synth/scan.hpp"
#include "tests/unit/render/pictures.hpp"

namespace atrium::render::golden_test {
namespace {

class Golden : public testing::Test {
 protected:
  Golden() {
    const auto scene = input(synth::Room::run({}, context).scene);
    synth::Scan::Params params;
    params.points = 40000;
    params.outside = false;
    params.windows = synth::Scan::Windows::open;
    params.angular_noise = params.mixed_pixels = 0;
    params.yaw = 15;
    params.offset = {500000, 5400000, 100};
    scan = synth::Scan::run({scene}, params, context);
  }
  static Snapshot::Params style(const std::string& view) {
    Snapshot::Params params;
    params.width = 240;
    params.height = 180;
    params.views = {view};
    params.text_size = 0.05;
    return params;
  }
  void compare(const std::string& name, const Snapshot::In& in, const Snapshot::Params& params) {
    const Picture picture = Snapshot::run(in, params, context).pictures.pictures.at(0);
    const fs::path file = fs::path(ATRIUM_SOURCE_DIR "/tests/golden") / (name + ".png");
    const char* mode = std::getenv("ATRIUM_GOLDEN");  // NOLINT(concurrency-mt-unsafe)
    if (mode != nullptr && std::string(mode) == "write") write_png(picture, file);
    const Picture golden = read_png(file);
    ASSERT_EQ(picture.width, golden.width);
    ASSERT_EQ(picture.height, golden.height);
    int largest = 0;
    std::size_t differing = 0;
    for (std::size_t i = 0; i < picture.pixels.size(); i += 3) {
      int difference = 0;
      for (std::size_t k = i; k < i + 3; ++k)
        difference = std::max(difference, std::abs(int{picture.pixels[k]} - int{golden.pixels[k]}));
      largest = std::max(largest, difference);
      differing += difference > 0 ? 1 : 0;
    }
    EXPECT_LE(largest, 2) << name;
    EXPECT_LE(3.0 * static_cast<double>(differing), 1e-4 * static_cast<double>(picture.pixels.size()))
        << name << ": " << differing << " pixels differ";
    const Picture again = Snapshot::run(in, params, context).pictures.pictures.at(0);
    EXPECT_EQ(again.pixels, picture.pixels) << name << " is another picture the second time";
  }
  Context context{1, std::make_shared<Folder>()};
  synth::Scan::Out scan;
};

TEST_F(Golden, ScanByHeight) {
  auto params = style("isometric");
  params.colour_by = Snapshot::ColourBy::height;
  compare("height", {.cloud = input(scan.cloud)}, params);
}
TEST_F(Golden, ScanByDistanceToTheTruth) {
  auto params = style("top");
  params.background = Snapshot::Background::black;
  compare("distance", {.cloud = input(scan.cloud), .reference = input(scan.mesh)}, params);
}
TEST_F(Golden, TruthWithoutItsCeiling) { compare("truth", {.truth = input(scan.truth)}, style("isometric")); }
TEST_F(Golden, TruthFromInside) {
  auto params = style("inside");
  params.title = "Inside";
  compare("inside", {.truth = input(scan.truth)}, params);
}

}  // namespace
}  // namespace atrium::render::golden_test
