#include "modules/render/snapshot.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <Eigen/Geometry>
#include <filesystem>

#include "modules/render/contact_sheet.hpp"
#include "modules/render/png.hpp"
#include "modules/types/palette.hpp"

namespace atrium::render {
namespace {

namespace fs = std::filesystem;

class Folder : public ContextHost {
 public:
  Folder() : path_(fs::temp_directory_path() / ("atrium-render-" + std::to_string(::getpid()))) {
    fs::create_directories(path_);
  }
  ~Folder() override { fs::remove_all(path_); }
  fs::path output_folder() override { return path_; }
  fs::path path_;
};

/// A room of 4 × 3 × 2.5 m, seen from inside, as planar meshes.
PlaneMeshes room(const Eigen::Vector3d& origin) {
  PlaneMeshes meshes;
  meshes.origin = origin;
  const auto add = [&](SurfaceClass surface, std::vector<Eigen::Vector3d> corners) {
    PlaneMesh mesh;
    mesh.primitive = static_cast<std::int32_t>(meshes.meshes.size());
    mesh.surface = surface;
    mesh.plane.normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    mesh.plane.offset = -mesh.plane.normal.dot(corners[0]);
    mesh.corners = std::move(corners);
    meshes.meshes.push_back(mesh);
  };
  add(SurfaceClass::floor, {{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}});
  add(SurfaceClass::ceiling, {{0, 3, 2.5}, {4, 3, 2.5}, {4, 0, 2.5}, {0, 0, 2.5}});
  add(SurfaceClass::wall, {{4, 0, 0}, {0, 0, 0}, {0, 0, 2.5}, {4, 0, 2.5}});
  add(SurfaceClass::wall, {{0, 3, 0}, {4, 3, 0}, {4, 3, 2.5}, {0, 3, 2.5}});
  add(SurfaceClass::wall, {{0, 0, 0}, {0, 3, 0}, {0, 3, 2.5}, {0, 0, 2.5}});
  add(SurfaceClass::wall, {{4, 3, 0}, {4, 0, 0}, {4, 0, 2.5}, {4, 3, 2.5}});
  return meshes;
}

Colour pixel(const Picture& picture, double x, double y) {
  const auto column = static_cast<std::size_t>(x * picture.width);
  const auto row = static_cast<std::size_t>(y * picture.height);
  const auto* p = &picture.pixels[3 * (row * static_cast<std::size_t>(picture.width) + column)];
  return {p[0], p[1], p[2]};
}

bool same_hue(const Colour& a, const Colour& b) {
  const Eigen::Vector3d x(a[0], a[1], a[2]);
  const Eigen::Vector3d y(b[0], b[1], b[2]);
  return x.normalized().dot(y.normalized()) > 0.98 && x.norm() > 60;
}

TEST(Snapshot, LooksIntoARoomFromAbove) {
  auto host = std::make_shared<Folder>();
  Context context(1, host);
  Snapshot::Params params;
  params.width = 320;
  params.height = 240;
  params.views = {"top", "isometric"};
  params.path.path = "room.png";
  const auto out = Snapshot::run({.meshes = input(room({500000, 5400000, 100}))}, params, context);
  ASSERT_EQ(out.pictures.pictures.size(), 2U);
  const Picture& top = out.pictures.pictures[0];
  EXPECT_TRUE(same_hue(pixel(top, 0.5, 0.5), class_colour(SurfaceClass::floor))) << "the ceiling is left out";
  EXPECT_EQ(pixel(top, 0.01, 0.5), (Colour{255, 255, 255}));
  const Picture written = read_png(host->path_ / "room_top.png");
  EXPECT_EQ(written.pixels, top.pixels);
  EXPECT_TRUE(fs::exists(host->path_ / "room_isometric.png"));
}

TEST(Snapshot, GivesTheSamePixelsEveryTime) {
  auto host = std::make_shared<Folder>();
  Context context(1, host);
  Snapshot::Params params;
  params.width = 320;
  params.height = 240;
  params.title = "A room";
  const auto meshes = input(room(Eigen::Vector3d::Zero()));
  const auto first = Snapshot::run({.meshes = meshes}, params, context);
  const auto second = Snapshot::run({.meshes = meshes}, params, context);
  EXPECT_EQ(first.pictures.pictures[0].pixels, second.pictures.pictures[0].pixels);
}

TEST(Snapshot, DrawsPointsWhereTheyAre) {
  auto host = std::make_shared<Folder>();
  Context context(1, host);
  Cloud cloud;
  for (int i = 0; i <= 200; ++i)
    for (int k = 0; k <= 200; ++k)
      if (i <= 100 || k <= 100)
        cloud.points.emplace_back(0.02F * static_cast<float>(i), 0.02F * static_cast<float>(k), 0);
  cloud.colours.assign(cloud.size(), {200, 30, 30});
  Snapshot::Params params;
  params.width = params.height = 240;
  params.views = {"top"};
  params.cut_below_top = 0;
  const auto out = Snapshot::run({.cloud = input(cloud)}, params, context);
  const Picture& top = out.pictures.pictures[0];
  EXPECT_EQ(pixel(top, 0.3, 0.7), (Colour{200, 30, 30}));
  EXPECT_EQ(pixel(top, 0.7, 0.3), (Colour{255, 255, 255})) << "the corner of the L is empty";
}

TEST(ContactSheet, PutsEachPictureInItsCell) {
  auto host = std::make_shared<Folder>();
  Context context(1, host);
  const auto plain = [](Colour colour) {
    Picture picture{200, 100, "a", {}};
    for (int i = 0; i < 200 * 100; ++i) picture.pixels.insert(picture.pixels.end(), colour.begin(), colour.end());
    return input(Pictures{{picture}});
  };
  ContactSheet::Params params;
  params.cell_width = 100;
  const auto out = ContactSheet::run({{plain({255, 0, 0}), plain({0, 255, 0}), plain({0, 0, 255})}}, params, context);
  const Picture& sheet = out.sheet.pictures.at(0);
  EXPECT_EQ(pixel(sheet, 0.3, 0.25), (Colour{255, 0, 0}));
  EXPECT_EQ(pixel(sheet, 0.7, 0.25), (Colour{0, 255, 0}));
  EXPECT_EQ(pixel(sheet, 0.3, 0.7), (Colour{0, 0, 255}));
  EXPECT_EQ(pixel(sheet, 0.7, 0.7), (Colour{255, 255, 255}));
  EXPECT_EQ(read_png(host->path_ / "sheet.png").pixels, sheet.pixels);
  EXPECT_THROW(ContactSheet::run({{input(Pictures{})}}, params, context), Error);
}

TEST(Snapshot, SaysWhatIsWrong) {
  auto host = std::make_shared<Folder>();
  Context context(1, host);
  EXPECT_THROW(Snapshot::run({}, {}, context), Error);
  EXPECT_THROW(Snapshot::run({.cloud = input(Cloud{})}, {}, context), Error);
  Snapshot::Params params;
  params.views = {"bottom"};
  EXPECT_THROW(Snapshot::run({.meshes = input(room(Eigen::Vector3d::Zero()))}, params, context), Error);
  params.views = {"top"};
  params.eye = {1, 2, 3};
  EXPECT_THROW(Snapshot::run({.meshes = input(room(Eigen::Vector3d::Zero()))}, params, context), Error);
  EXPECT_TRUE(fs::is_empty(host->path_)) << "no half-written file";
}

}  // namespace
}  // namespace atrium::render
