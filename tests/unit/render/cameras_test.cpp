// Where cameras stand, how large points are, and lines between meshes.
#include <gtest/gtest.h>

#include <cmath>

#include "modules/render/inside_view.hpp"
#include "modules/render/point_spacing.hpp"
#include "modules/render/snapshot.hpp"
#include "modules/types/palette.hpp"
#include "tests/unit/render/pictures.hpp"

namespace atrium::render::cameras_test {
namespace {

/// Points every 5 cm on a box's floor, ceiling and walls.
void add_box(std::vector<Eigen::Vector3f>& points, float x, float y, float width, float depth, float height) {
  for (float u = 0; u <= width; u += 0.05F)
    for (float v = 0; v <= depth; v += 0.05F)
      for (const float z : {0.0F, height}) points.emplace_back(x + u, y + v, z);
  for (float z = 0; z <= height; z += 0.05F) {
    for (float u = 0; u <= width; u += 0.05F)
      for (const float v : {0.0F, depth}) points.emplace_back(x + u, y + v, z);
    for (float v = 0; v <= depth; v += 0.05F)
      for (const float u : {0.0F, width}) points.emplace_back(x + u, y + v, z);
  }
}

TEST(InsideView, StandsInTheLargestRoomAtEyeHeightAndLooksAlongIt) {
  std::vector<Eigen::Vector3f> points;
  add_box(points, 0, 0, 3, 3, 2.6F);
  add_box(points, 4, 0, 4, 8, 2.6F);
  const Viewpoint view = inside_view(points);
  EXPECT_NEAR(view.eye.z(), 1.6, 0.06);
  EXPECT_GT(view.eye.x(), 4.3);
  EXPECT_LT(view.eye.x(), 7.7);
  EXPECT_GT(view.eye.y(), 0.3);
  EXPECT_LT(view.eye.y(), 7.7);
  const Eigen::Vector3d forward = (view.target - view.eye).normalized();
  EXPECT_GT(std::abs(forward.y()), 0.7) << "along the longer side";
  EXPECT_GT(forward.y() * (4 - view.eye.y()), 0) << "towards the farther end";
}

TEST(InsideView, StaysWithinLowAndTinyThings) {
  std::vector<Eigen::Vector3f> low;
  add_box(low, 0, 0, 3, 3, 1.0F);
  EXPECT_LT(inside_view(low).eye.z(), 1.0);
  for (const std::vector<Eigen::Vector3f>& few :
       {std::vector<Eigen::Vector3f>{{1, 2, 3}}, std::vector<Eigen::Vector3f>{{1, 2, 3}, {1, 2, 3}, {4000, 2, 3}}}) {
    const Viewpoint view = inside_view(few);
    EXPECT_TRUE(view.eye.allFinite() && view.target.allFinite());
    EXPECT_GT((view.target - view.eye).norm(), 0.1);
  }
}

TEST(PointSpacing, IsThatOfTheSurfaceAndFindsLonePoints) {
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 200; ++i)
    for (int k = 0; k < 200; ++k) points.emplace_back(0.02F * static_cast<float>(i), 0.02F * static_cast<float>(k), 0);
  points.emplace_back(1, 1, 2);
  const PointSpacing found = point_spacing(points);
  EXPECT_GT(found.spacing, 0.014);
  EXPECT_LT(found.spacing, 0.028);
  EXPECT_EQ(found.lone.back(), 1);
  EXPECT_EQ(std::count(found.lone.begin(), found.lone.end() - 1, 1), 0);
  EXPECT_EQ(point_spacing({}).spacing, 0);
  EXPECT_EQ(point_spacing({{1, 2, 3}}).spacing, 0);
  EXPECT_EQ(point_spacing({{1, 2, 3}, {1, 2, 3}}).spacing, 0);
}

TEST(Snapshot, SparsePointsAreDrawnLarger) {
  auto host = std::make_shared<Folder>();
  Context context(1, host);
  Snapshot::Params params;
  params.width = params.height = 480;
  params.views = {"top"};
  params.cut_below_top = 0;
  params.scale_bar = false;
  params.colour_by = Snapshot::ColourBy::plain;
  const auto covered = [&](int across) {
    Cloud cloud;
    for (int i = 0; i < across; ++i)
      for (int k = 0; k < across; ++k)
        cloud.points.emplace_back(4.0F * static_cast<float>(i) / static_cast<float>(across),
                                  4.0F * static_cast<float>(k) / static_cast<float>(across), 0);
    return share_of(Snapshot::run({.cloud = input(cloud)}, params, context).pictures.pictures[0], {110, 110, 110});
  };
  const double square = std::pow(1 / 1.12, 2);
  EXPECT_NEAR(covered(400), square, 0.02);
  EXPECT_NEAR(covered(150), square, 0.1) << "a third of the points still closes up";
  EXPECT_LT(covered(20), 0.1) << "points do not grow without end";
  params.point_size = 1;
  EXPECT_LT(covered(150), 0.5 * square);
}

TEST(Snapshot, OnePointIsAPictureFromEverySide) {
  auto host = std::make_shared<Folder>();
  Context context(1, host);
  Cloud cloud;
  cloud.origin = {500000, 5400000, 100};
  cloud.points = {{1, 2, 3}};
  cloud.labels = {7};
  Snapshot::Params params;
  params.width = params.height = 64;
  params.scale_bar = params.legend = false;
  params.views = {"isometric", "top", "front", "back", "left", "right"};
  params.cut_below_top = 0;
  for (const auto by : {Snapshot::ColourBy::plain, Snapshot::ColourBy::height, Snapshot::ColourBy::label})
    for (const auto& picture :
         (params.colour_by = by, Snapshot::run({.cloud = input(cloud)}, params, context)).pictures.pictures)
      EXPECT_LT(share_of(picture, {255, 255, 255}), 1) << picture.caption;
  params.views = {"inside"};
  EXPECT_EQ(Snapshot::run({.cloud = input(cloud)}, params, context).pictures.pictures.size(), 1U);
  params.colour_by = Snapshot::ColourBy::distance;
  const auto reference = input(square(cloud.origin));
  EXPECT_EQ(Snapshot::run({.cloud = input(cloud), .reference = reference}, params, context).pictures.pictures.size(),
            1U);
}

/// Pictures of a room of 4 × 3 × 2.5 m from a place outside, high in the south-west.
Picture room_from(const Snapshot::Params& params) {
  Context context(1, std::make_shared<Folder>());
  return Snapshot::run({.meshes = input(room({100, 200, 0}))}, params, context).pictures.pictures.at(0);
}

Snapshot::Params from_outside() {
  Snapshot::Params params;
  params.width = 400;
  params.height = 300;
  params.scale_bar = params.legend = params.edges = false;
  params.eye = {96, 194, 9};
  params.target = {102, 201.5, 1};
  return params;
}

double share_of_class(const Picture& picture, SurfaceClass surface) {
  double share = 0;
  const auto pixels = static_cast<double>(picture.pixels.size() / 3);
  for (std::size_t i = 0; i < picture.pixels.size(); i += 3)
    share += same_hue({picture.pixels[i], picture.pixels[i + 1], picture.pixels[i + 2]}, class_colour(surface)) ? 1 : 0;
  return share / pixels;
}

TEST(Snapshot, AnExplicitCameraHasNoCeilingsUnlessTheyAreWanted) {
  Snapshot::Params params = from_outside();
  EXPECT_EQ(share_of_class(room_from(params), SurfaceClass::ceiling), 0);
  EXPECT_GT(share_of_class(room_from(params), SurfaceClass::floor), 0.001);
  params.ceilings = true;
  EXPECT_GT(share_of_class(room_from(params), SurfaceClass::ceiling), 0.01);
}

TEST(Snapshot, NearWallsAreHiddenOnRequest) {
  Snapshot::Params params = from_outside();
  const double behind_walls = share_of_class(room_from(params), SurfaceClass::floor);
  params.near_walls = Snapshot::NearWalls::hidden;
  const double seen = share_of_class(room_from(params), SurfaceClass::floor);
  EXPECT_GT(seen, 1.5 * behind_walls);
  params.eye = params.target = {};  // a named view hides them, unless they are wanted
  const double named = share_of_class(room_from(params), SurfaceClass::floor);
  params.near_walls = Snapshot::NearWalls::automatic;
  EXPECT_EQ(share_of_class(room_from(params), SurfaceClass::floor), named);
  params.near_walls = Snapshot::NearWalls::drawn;
  EXPECT_LT(share_of_class(room_from(params), SurfaceClass::floor), 0.8 * named);
}

TEST(Snapshot, ANarrowerFieldOfViewShowsThingsLarger) {
  Snapshot::Params params = from_outside();
  const double usual = 1 - share_of(room_from(params), {255, 255, 255});
  params.field_of_view = 62;
  EXPECT_EQ(1 - share_of(room_from(params), {255, 255, 255}), usual);
  params.field_of_view = 40;
  const double ratio = std::pow(std::tan(31 * M_PI / 180) / std::tan(20 * M_PI / 180), 2);
  EXPECT_NEAR((1 - share_of(room_from(params), {255, 255, 255})) / usual, ratio, 0.1 * ratio);
}

TEST(Snapshot, FitMovesTheCameraUntilAllIsSeen) {
  Snapshot::Params params = from_outside();
  params.fit = true;
  const Picture fitted = room_from(params);
  const auto is_white = [&](int x, int y) {
    const auto* p = &fitted.pixels[3 * (static_cast<std::size_t>(y) * 400 + static_cast<std::size_t>(x))];
    return p[0] == 255 && p[1] == 255 && p[2] == 255;
  };
  for (int x = 0; x < 400; ++x) EXPECT_TRUE(is_white(x, 0) && is_white(x, 299)) << x;
  for (int y = 0; y < 300; ++y) EXPECT_TRUE(is_white(0, y) && is_white(399, y)) << y;
  EXPECT_LT(share_of(fitted, {255, 255, 255}), 0.75);
  params.eye = {-5898, -7298.5, 8001};  // the same direction, a thousand times as far
  EXPECT_EQ(room_from(params).pixels, fitted.pixels);
}

TEST(Snapshot, FitLeavesTheColourBarItsPlace) {
  Cloud cloud;  // wide, so that the picture's width decides
  add_box(cloud.points, 0, 0, 8, 1, 1);
  Snapshot::Params params;
  params.width = 400;
  params.height = 300;
  params.text_size = 0.05;  // the bar takes 127 pixels
  params.colour_by = Snapshot::ColourBy::height;
  params.legend = false;
  params.eye = {4, -20, 0.5};
  params.target = {4, 0, 0.5};
  params.fit = true;
  Context context(1, std::make_shared<Folder>());
  // How many pixels of a column are of the box, which stands in the middle of the part that is left.
  const auto rows_at = [&](int x) {
    const Picture picture = Snapshot::run({.cloud = input(cloud)}, params, context).pictures.pictures.at(0);
    int rows = 0;
    for (int y = 0; y < 300; ++y)
      rows += pixel(picture, (x + 0.5) / 400, (y + 0.5) / 300) == Colour{255, 255, 255} ? 0 : 1;
    return rows;
  };
  const int beside_the_bar = rows_at(60);
  params.scale_bar = false;
  const int alone = rows_at(60);
  EXPECT_GT(beside_the_bar, 15);
  EXPECT_NEAR(static_cast<double>(beside_the_bar) / alone, 273.0 / 400, 0.12);
}

TEST(Snapshot, PicturesOfOneViewWidthHaveOneScale) {
  Context context(1, std::make_shared<Folder>());
  Snapshot::Params params;
  params.width = params.height = 300;
  params.views = {"top"};
  params.scale_bar = params.legend = params.edges = false;
  params.view_width = 10;
  const auto covered = [&](double side) {
    Mesh mesh = square({0, 0, 0});
    for (auto& v : mesh.vertices) v *= side / 4;
    return 1 - share_of(Snapshot::run({.mesh = input(mesh)}, params, context).pictures.pictures[0], {255, 255, 255});
  };
  EXPECT_NEAR(covered(4), 0.16, 0.01);
  EXPECT_NEAR(covered(2), 0.04, 0.005);
  params.perspective = true;
  EXPECT_NEAR(covered(4), 0.16, 0.01);
  params.view_width = 0;
  EXPECT_GT(covered(2), 0.3);
}

TEST(Snapshot, TheLegendHidesNothing) {
  Snapshot::Params params;
  params.width = 420;
  params.height = 315;
  params.ceilings = true;
  params.scale_bar = params.edges = false;
  params.text_size = 0.07;
  params.views = {"front"};
  const auto walls_under = [&](const Picture& picture) {
    int found = 0;  // in what the legend covers but for its swatches: 0.5 to 7.2 lines across, 0.5 to 5.7 up
    for (int y = 315 - 125; y < 315 - 11; ++y)
      for (int x = 45; x < 158; ++x) {
        const auto* p = &picture.pixels[3 * (static_cast<std::size_t>(y) * 420 + static_cast<std::size_t>(x))];
        if (p[2] > p[0] + 30) ++found;  // blue, also through the plate
      }
    return found;
  };
  const Picture with = room_from(params);
  EXPECT_EQ(walls_under(with), 0);
  params.legend = false;
  const Picture without = room_from(params);
  EXPECT_GT(walls_under(without), 1000);
  EXPECT_GT(share_of(with, {255, 255, 255}), share_of(without, {255, 255, 255}));
}

TEST(Snapshot, NothingToDrawIsAnErrorOrABlankPicture) {
  Context context(1, std::make_shared<Folder>());
  Snapshot::Params params;
  params.width = 320;
  params.height = 240;
  EXPECT_THROW(Snapshot::run({.objects = input(Mesh{})}, params, context), Error);
  params.empty = Snapshot::Empty::blank;
  const Picture picture = Snapshot::run({.objects = input(Mesh{})}, params, context).pictures.pictures.at(0);
  EXPECT_EQ(picture.width, 320);
  EXPECT_GT(share_of(picture, {255, 255, 255}), 0.9);
  EXPECT_LT(share_of(picture, {255, 255, 255}), 1) << "it says so";
}

TEST(Snapshot, ACameraThatIsNoPlaceIsAnError) {
  auto host = std::make_shared<Folder>();
  Context context(1, host);
  Snapshot::Params params;
  params.target = {0, 0, 1};
  for (const double x : {std::nan(""), HUGE_VAL, 0.0}) {
    params.eye = {x, 0, x == 0 ? 1.0 : 0.0};
    EXPECT_THROW(Snapshot::run({.meshes = input(room(Eigen::Vector3d::Zero()))}, params, context), Error) << x;
  }
  EXPECT_TRUE(fs::is_empty(host->path_)) << "no half-written file";
}

TEST(Snapshot, ManyPointsAreThinnedTheSameWayEveryTime) {
  auto host = std::make_shared<Folder>();
  Context context(1, host);
  Cloud cloud;
  Random random(3);
  for (int i = 0; i < 2100000; ++i)
    cloud.points.emplace_back(static_cast<float>(random.uniform()), static_cast<float>(random.uniform()), 0);
  const Cloud before = cloud;
  Snapshot::Params params;
  params.width = params.height = 128;
  params.views = {"top"};
  params.cut_below_top = 0;
  const auto given = input(std::move(cloud));
  const auto first = Snapshot::run({.cloud = given}, params, context);
  const auto second = Snapshot::run({.cloud = given}, params, context);
  EXPECT_EQ(first.pictures.pictures[0].pixels, second.pictures.pictures[0].pixels);
  EXPECT_EQ(given->points, before.points) << "for drawing only";
}

TEST(Snapshot, AdjacencyIsLinesBetweenTheMiddles) {
  auto host = std::make_shared<Folder>();
  Context context(1, host);
  Snapshot::Params params;
  params.width = params.height = 200;
  params.views = {"top"};
  params.legend = params.scale_bar = params.edges = false;
  const auto meshes = input(room(Eigen::Vector3d::Zero()));
  Adjacency adjacency(6);
  adjacency.connect(2, 3, 0.1);
  const auto line = [&](const Adjacency& graph) {
    const auto out = Snapshot::run({.meshes = meshes, .adjacency = input(graph)}, params, context);
    double most = 0;
    for (int x = 90; x < 110; ++x) {
      const Colour c = pixel(out.pictures.pictures[0], x / 200.0, 0.4);
      most = std::max(most, 1.0 * c[0] - c[1]);
    }
    return most;
  };
  const Adjacency none(6);
  EXPECT_GT(line(adjacency), line(none) + 20);
  EXPECT_THROW(Snapshot::run({.adjacency = input(adjacency)}, params, context), Error) << "without meshes";
  const Adjacency of_others(7);
  EXPECT_THROW(Snapshot::run({.meshes = meshes, .adjacency = input(of_others)}, params, context), Error);
}

}  // namespace
}  // namespace atrium::render::cameras_test
