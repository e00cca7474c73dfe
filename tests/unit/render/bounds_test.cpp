// What the camera shows: what is drawn, not what a mesh has besides.
#include <gtest/gtest.h>

#include "modules/render/drawn_box.hpp"
#include "modules/render/snapshot.hpp"
#include "modules/types/palette.hpp"
#include "tests/unit/render/pictures.hpp"

namespace atrium::render::bounds_test {
namespace {

Snapshot::Params small(const std::string& view) {
  Snapshot::Params params;
  params.width = params.height = 120;
  params.views = {view};
  params.edges = params.scale_bar = params.legend = false;
  return params;
}

Picture drawn(const Mesh& mesh, const Snapshot::Params& params) {
  Context context(1, std::make_shared<Folder>());
  return Snapshot::run({.mesh = input(mesh)}, params, context).pictures.pictures.at(0);
}

std::string problem(const Snapshot::In& in, const Snapshot::Params& params) {
  Context context(1, std::make_shared<Folder>());
  try {
    Snapshot::run(in, params, context);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// A square of 4 × 4 m of many triangles.
Mesh fine_square() {
  Mesh mesh;
  constexpr std::uint32_t n = 20;
  for (std::uint32_t y = 0; y <= n; ++y)
    for (std::uint32_t x = 0; x <= n; ++x) mesh.vertices.emplace_back(0.2 * x, 0.2 * y, 0);
  for (std::uint32_t y = 0; y < n; ++y)
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t a = y * (n + 1) + x;
      mesh.triangles.push_back({a, a + 1, a + n + 2});
      mesh.triangles.push_back({a, a + n + 2, a + n + 1});
    }
  mesh.classes.assign(mesh.triangles.size(), SurfaceClass::floor);
  mesh.primitives.assign(mesh.triangles.size(), 0);
  return mesh;
}

void add_triangle(Mesh& mesh, const Eigen::Vector3d& at, double size, SurfaceClass surface = SurfaceClass::floor) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back(at);
  mesh.vertices.push_back(at + Eigen::Vector3d(size, 0, 0));
  mesh.vertices.push_back(at + Eigen::Vector3d(0, size, 0));
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.classes.push_back(surface);
  mesh.primitives.push_back(1);
}

TEST(Bounds, AVertexOfNoTriangleDoesNotCount) {
  const Mesh mesh = square({500000, 5400000, 100});
  Mesh with_stray = mesh;
  with_stray.vertices.emplace_back(1e6, -1e6, 1e5);
  for (const std::string view : {"top", "isometric"})
    EXPECT_EQ(drawn(with_stray, small(view)).pixels, drawn(mesh, small(view)).pixels) << view;
}

TEST(Bounds, AFarCeilingThatIsLeftOutDoesNotCount) {
  Mesh mesh = square(Eigen::Vector3d::Zero());
  const Picture before = drawn(mesh, small("front"));
  const Picture top = drawn(mesh, small("top"));
  add_triangle(mesh, {900, 900, 900}, 50, SurfaceClass::ceiling);
  EXPECT_EQ(drawn(mesh, small("front")).pixels, before.pixels);
  EXPECT_EQ(drawn(mesh, small("top")).pixels, top.pixels);
}

TEST(Bounds, OnlyHiddenCeilingsAreNothingToDraw) {
  Mesh mesh = square(Eigen::Vector3d::Zero());
  mesh.classes.assign(2, SurfaceClass::ceiling);
  EXPECT_NE(problem({.mesh = input(mesh)}, small("isometric")).find("nothing to draw"), std::string::npos);
  auto params = small("top");
  params.ceilings = true;
  EXPECT_EQ(problem({.mesh = input(mesh)}, params), "");
  EXPECT_TRUE(same_hue(pixel(drawn(mesh, params), 0.5, 0.5), class_colour(SurfaceClass::ceiling)));
  Mesh vertices_only;
  vertices_only.vertices = mesh.vertices;
  EXPECT_NE(problem({.mesh = input(vertices_only)}, small("isometric")).find("nothing to draw"), std::string::npos);
}

TEST(Bounds, AFewSmallTrianglesFarAwayDoNotMakeTheBuildingAPoint) {
  Mesh mesh = fine_square();
  const Picture before = drawn(mesh, small("top"));
  add_triangle(mesh, {5000, 200, 0}, 0.05);
  add_triangle(mesh, {-900, -8000, 60}, 0.05);
  EXPECT_EQ(drawn(mesh, small("top")).pixels, before.pixels);
  // Not small, or not far: shown.
  Mesh wide = fine_square();
  add_triangle(wide, {40, 0, 0}, 1);
  EXPECT_FALSE(same_hue(pixel(drawn(wide, small("top")), 0.5, 0.5), class_colour(SurfaceClass::floor)));
}

TEST(Bounds, WhatIsNearOrLargeCounts) {
  /// The right end of the box of triangles (left corner, size).
  const auto right_end = [](const std::vector<std::pair<float, float>>& triangles) {
    std::vector<Eigen::Vector3f> vertices;
    std::vector<std::array<std::uint32_t, 3>> corners;
    for (const auto& [x, size] : triangles) {
      const auto first = static_cast<std::uint32_t>(vertices.size());
      corners.push_back({first, first + 1, first + 2});
      for (const Eigen::Vector3f& v :
           {Eigen::Vector3f(x, 0, 0), Eigen::Vector3f(x + size, 0, 0), Eigen::Vector3f(x, size, 0)})
        vertices.push_back(v);
    }
    return drawn_box(vertices, corners).max().x();
  };
  EXPECT_TRUE(drawn_box({}, {}).isEmpty());
  EXPECT_DOUBLE_EQ(right_end({{0, 10}, {13, 0.125F}}), 13.125) << "small, but near";
  EXPECT_DOUBLE_EQ(right_end({{0, 10}, {500, 0.125F}}), 10) << "small and far";
  EXPECT_DOUBLE_EQ(right_end({{0, 10}, {500, 2}}), 502) << "far, but not small";
  EXPECT_DOUBLE_EQ(right_end({{0, 0}, {500, 0}}), 500) << "no area at all";
}

TEST(Bounds, AFlatCloudIsDrawnWhole) {
  Cloud cloud;
  for (int i = 0; i < 100; ++i)
    for (int k = 0; k < 100; ++k)
      cloud.points.emplace_back(0.02F * static_cast<float>(i), 0.02F * static_cast<float>(k), 0);
  cloud.colours.assign(cloud.size(), {200, 30, 30});
  Context context(1, std::make_shared<Folder>());
  const auto out = Snapshot::run({.cloud = input(cloud)}, small("top"), context);
  EXPECT_EQ(pixel(out.pictures.pictures.at(0), 0.5, 0.5), (Colour{200, 30, 30}));
}

TEST(Legend, IsOnlyThereIfThereAreClasses) {
  Mesh mesh = square(Eigen::Vector3d::Zero());
  auto with = small("top");
  with.legend = true;
  EXPECT_NE(drawn(mesh, with).pixels, drawn(mesh, small("top")).pixels);
  mesh.classes.clear();
  EXPECT_EQ(drawn(mesh, with).pixels, drawn(mesh, small("top")).pixels);
}

}  // namespace
}  // namespace atrium::render::bounds_test
