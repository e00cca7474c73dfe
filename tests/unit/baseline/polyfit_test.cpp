#include "modules/baseline/polyfit.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <map>
#include <set>

#include "modules/baseline/helper_program.hpp"
#include "tests/support/flat_cloud.hpp"
#include "tests/support/lacking.hpp"
#include "tests/unit/baseline/closed_surface.hpp"

namespace atrium::baseline::polyfit_test {
namespace {

bool have_helper() { return std::filesystem::exists(helper_file("atrium-polyfit")); }
#define NEEDS_POLYFIT() \
  if (!have_helper()) ATRIUM_SKIP_LACKING("atrium-polyfit is not built: needs -DATRIUM_CGAL=ON")

struct Host : ContextHost {
  void log(Level level, std::string_view text) override {
    if (level == Level::warning) warnings.emplace_back(text);
  }
  bool cancelled() override { return cancel; }
  std::vector<std::string> warnings;
  bool cancel = false;
};

/// A primitive per face, from points sampled on the faces.
PlanePrimitives planes_of(const std::vector<test::Face>& faces, std::size_t points, double noise = 0) {
  test::Sampling sampling;
  sampling.points = points;
  sampling.noise = noise;
  sampling.outliers = 0;
  sampling.normal_error = 0;
  PlanePrimitives planes;
  auto cloud = std::make_shared<Cloud>(test::sample(faces, sampling));
  cloud->origin = {500000, 200000, 30};
  planes.primitives.resize(faces.size());
  for (std::uint32_t i = 0; i < cloud->size(); ++i)
    planes.primitives[static_cast<std::size_t>(cloud->labels[i])].inliers.push_back(i);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    planes.primitives[f].plane.normal = faces[f].normal();
    planes.primitives[f].plane.offset = -faces[f].normal().dot(faces[f].corner);
    planes.primitives[f].residual = noise;
  }
  planes.cloud = cloud;
  return planes;
}

/// A room of this outline (counter-clockwise from above), seen from within: walls, then floor and ceiling, given as
/// rectangles of one primitive each.
struct Room {
  std::vector<Eigen::Vector2d> outline;
  std::vector<std::array<double, 4>> rectangles;  ///< low x, low y, high x, high y: together the floor
  double height = 2.5;
};

PlanePrimitives planes_of(const Room& room) {
  std::vector<test::Face> faces;
  const Eigen::Vector3d up(0, 0, room.height);
  for (std::size_t i = 0; i < room.outline.size(); ++i) {
    const Eigen::Vector2d a = room.outline[i];
    const Eigen::Vector2d b = room.outline[(i + 1) % room.outline.size()];
    faces.push_back({{b.x(), b.y(), 0}, {a.x() - b.x(), a.y() - b.y(), 0}, up, {}, true});
    // Into the room: to the left of the direction of travel.
    const Eigen::Vector2d inward(-(b - a).y(), (b - a).x());
    if (faces.back().normal().head<2>().dot(inward) < 0) {
      faces.back().corner = {a.x(), a.y(), 0};
      faces.back().u = -faces.back().u;
    }
  }
  const std::size_t walls = faces.size();
  for (const auto& [x0, y0, x1, y1] : room.rectangles)
    faces.push_back({{x0, y0, 0}, {x1 - x0, 0, 0}, {0, y1 - y0, 0}, {}, true});
  for (const auto& [x0, y0, x1, y1] : room.rectangles)
    faces.push_back({{x0, y0, room.height}, {0, y1 - y0, 0}, {x1 - x0, 0, 0}, {}, true});
  PlanePrimitives parts = planes_of(faces, 12000);
  PlanePrimitives planes;
  planes.cloud = parts.cloud;
  planes.primitives.assign(parts.primitives.begin(), parts.primitives.begin() + static_cast<std::ptrdiff_t>(walls));
  const std::size_t pieces = room.rectangles.size();
  for (std::size_t side = 0; side < 2; ++side) {
    PlanePrimitive whole = parts.primitives[walls + side * pieces];
    for (std::size_t k = 1; k < pieces; ++k) {
      const auto& more = parts.primitives[walls + side * pieces + k].inliers;
      whole.inliers.insert(whole.inliers.end(), more.begin(), more.end());
    }
    std::sort(whole.inliers.begin(), whole.inliers.end());
    planes.primitives.push_back(std::move(whole));
  }
  return planes;
}

double value(const Metrics& metrics, const std::string& name) {
  for (const auto& m : metrics.values)
    if (m.name == name) return m.value;
  ADD_FAILURE() << "no " << name;
  return -1;
}

Polyfit::Out run(const PlanePrimitives& planes, const Polyfit::Params& params = {},
                 const std::shared_ptr<Host>& host = std::make_shared<Host>()) {
  Context context(1, host);
  return Polyfit::run({input(planes)}, params, context);
}

std::string problem(const PlanePrimitives& planes, const Polyfit::Params& params = {}) {
  try {
    run(planes, params);
  } catch (const Error& error) {
    return std::string(error.what()) + " / " + error.help();
  }
  return "none";
}

TEST(Polyfit, ABoxHasTwelveTriangles) {
  NEEDS_POLYFIT();
  const auto faces = test::box_faces({1, 2, 0}, {5, 5, 2.5}, true);
  const PlanePrimitives planes = planes_of(faces, 6000);
  const auto out = run(planes);
  EXPECT_EQ(out.mesh.origin, planes.cloud->origin);
  ASSERT_EQ(out.mesh.vertices.size(), 8U);
  ASSERT_EQ(out.mesh.triangles.size(), 12U);
  EXPECT_TRUE(is_closed(out.mesh));
  // Seen from within the room, so the volume counts negative.
  EXPECT_NEAR(volume(out.mesh), -4 * 3 * 2.5, 1e-4);
  std::map<int, int> triangles;
  ASSERT_EQ(out.mesh.primitives.size(), 12U);
  for (const int p : out.mesh.primitives) ++triangles[p];
  for (int p = 0; p < 6; ++p) EXPECT_EQ(triangles[p], 2) << p;
  for (std::size_t t = 0; t < 12; ++t) {
    const auto& face = faces[static_cast<std::size_t>(out.mesh.primitives[t])];
    for (const std::uint32_t v : out.mesh.triangles[t])
      EXPECT_NEAR(face.normal().dot(out.mesh.vertices[v] - face.corner), 0, 1e-4);
  }
  EXPECT_EQ(value(out.report, "polyfit.planes"), 6);
  EXPECT_EQ(value(out.report, "polyfit.proven"), 1);
  EXPECT_EQ(value(out.report, "polyfit.gap"), 0);
}

TEST(Polyfit, ABoxSeenFromOutsideLooksOutward) {
  NEEDS_POLYFIT();
  const auto out = run(planes_of(test::box_faces({0, 0, 0}, {2, 1, 1}, false), 3000));
  EXPECT_TRUE(is_closed(out.mesh));
  EXPECT_NEAR(volume(out.mesh), 2, 1e-4);
}

TEST(Polyfit, AnLShapedRoomKeepsItsInnerCorner) {
  NEEDS_POLYFIT();
  const Room room{{{0, 0}, {6, 0}, {6, 3}, {3, 3}, {3, 5}, {0, 5}}, {{0, 0, 6, 3}, {0, 3, 3, 5}}};
  const auto out = run(planes_of(room));
  EXPECT_TRUE(is_closed(out.mesh));
  // 4 n − 4 triangles of a room with n corners: no further vertex.
  EXPECT_EQ(out.mesh.vertices.size(), 12U);
  EXPECT_EQ(out.mesh.triangles.size(), 20U);
  EXPECT_NEAR(volume(out.mesh), -(6 * 3 + 3 * 2) * 2.5, 1e-3);
  const std::set<int> primitives(out.mesh.primitives.begin(), out.mesh.primitives.end());
  EXPECT_EQ(primitives, (std::set<int>{0, 1, 2, 3, 4, 5, 6, 7}));
}

/// A room with many corners: a comb of teeth.
Room comb(int teeth) {
  Room room;
  room.outline = {{0, 0}, {2.0 * teeth, 0}};
  room.rectangles = {{0, 0, 2.0 * teeth, 2}};
  for (int i = teeth - 1; i >= 0; --i) {
    const double x = 2.0 * i;
    const double depth = 3 + 0.5 * (i % 3);
    room.outline.insert(room.outline.end(), {{x + 2, 2}, {x + 2, depth}, {x + 1, depth}, {x + 1, 2}});
    room.rectangles.push_back({x + 1, 2, x + 2, depth});
  }
  // The first tooth stands at the end wall; all backs between the teeth are on one line but walls of their own.
  room.outline.erase(room.outline.begin() + 2);
  room.outline.insert(room.outline.end(), {0, 2});
  return room;
}

TEST(Polyfit, TwentyPlanesAreSolved) {
  NEEDS_POLYFIT();
  const PlanePrimitives planes = planes_of(comb(4));
  ASSERT_GE(planes.primitives.size(), 19U);
  const auto out = run(planes);
  EXPECT_TRUE(is_closed(out.mesh));
  EXPECT_EQ(value(out.report, "polyfit.proven"), 1);
  double floor = 16;
  for (int i = 0; i < 4; ++i) floor += 1 + 0.5 * (i % 3);
  EXPECT_NEAR(volume(out.mesh), -floor * 2.5, 1e-2);
}

TEST(Polyfit, GivesTheSameBytesEveryTime) {
  NEEDS_POLYFIT();
  const PlanePrimitives planes = planes_of(comb(3));
  const auto first = run(planes).mesh;
  for (int i = 0; i < 3; ++i) {
    const auto again = run(planes).mesh;
    ASSERT_EQ(first.triangles, again.triangles);
    ASSERT_EQ(first.vertices.size(), again.vertices.size());
    for (std::size_t v = 0; v < first.vertices.size(); ++v)
      EXPECT_EQ(std::memcmp(first.vertices[v].data(), again.vertices[v].data(), 3 * sizeof(double)), 0);
  }
}

TEST(Polyfit, UsesTheLargestPlanesAndSaysSo) {
  NEEDS_POLYFIT();
  PlanePrimitives planes = planes_of(test::box_faces({0, 0, 0}, {4, 3, 2.5}, true), 6000);
  PlanePrimitive small;
  small.inliers.assign(planes.primitives[0].inliers.begin(), planes.primitives[0].inliers.begin() + 5);
  planes.primitives[0].inliers.erase(planes.primitives[0].inliers.begin(), planes.primitives[0].inliers.begin() + 5);
  planes.primitives.push_back(small);
  Polyfit::Params params;
  params.max_planes = 6;
  auto host = std::make_shared<Host>();
  const auto out = run(planes, params, host);
  EXPECT_EQ(out.mesh.triangles.size(), 12U);
  ASSERT_EQ(host->warnings.size(), 1U);
  EXPECT_EQ(host->warnings[0], "6 planes of 7 are used, the largest, as 'max_planes' says");
}

TEST(Polyfit, OpenSurfacesHaveNoAnswer) {
  NEEDS_POLYFIT();
  // Four walls, neither floor nor ceiling: nothing can be closed.
  auto faces = test::box_faces({0, 0, 0}, {4, 3, 2.5}, true);
  faces.erase(faces.begin(), faces.begin() + 2);
  auto host = std::make_shared<Host>();
  const auto out = run(planes_of(faces, 4000), {}, host);
  EXPECT_TRUE(out.mesh.triangles.empty());
  EXPECT_TRUE(out.mesh.vertices.empty());
  ASSERT_EQ(host->warnings.size(), 1U);
  EXPECT_NE(host->warnings[0].find("the mesh is empty"), std::string::npos);
}

TEST(Polyfit, SaysWhenTheTimeIsOver) {
  NEEDS_POLYFIT();
  Polyfit::Params params;
  params.time_limit = 0.01;
  EXPECT_NE(problem(planes_of(comb(6)), params).find("time limit"), std::string::npos);
}

TEST(Polyfit, SaysWhenTheMemoryIsOver) {
  NEEDS_POLYFIT();
  Polyfit::Params params;
  params.memory_limit = 1;  // below the bounds of the table: any program needs more
  EXPECT_NE(problem(planes_of(comb(6)), params).find("memory limit of 1 MiB"), std::string::npos);
}

TEST(Polyfit, EndsWithTheRun) {
  NEEDS_POLYFIT();
  auto host = std::make_shared<Host>();
  host->cancel = true;
  EXPECT_THROW(run(planes_of(comb(6)), {}, host), Cancelled);
}

TEST(Polyfit, RefusesInputThatCannotBeClosed) {
  EXPECT_NE(problem({}).find("at least 4 planes to close a surface, there are 0"), std::string::npos);
  auto faces = test::box_faces({0, 0, 0}, {1, 1, 1}, true);
  faces.resize(3);
  EXPECT_NE(problem(planes_of(faces, 300)).find("there are 3"), std::string::npos);
  PlanePrimitives planes = planes_of(test::box_faces({0, 0, 0}, {1, 1, 1}, true), 600);
  auto bare = std::make_shared<Cloud>(*planes.cloud);
  bare->normals.clear();
  planes.cloud = bare;
  EXPECT_NE(problem(planes).find("has no normals"), std::string::npos);
}

TEST(Polyfit, SaysHowToGetTheHelper) {
  if (have_helper()) GTEST_SKIP() << "atrium-polyfit is built";
  const std::string text = problem(planes_of(test::box_faces({0, 0, 0}, {1, 1, 1}, true), 600));
  EXPECT_NE(text.find("this build has no atrium-polyfit"), std::string::npos);
  EXPECT_NE(text.find("-DATRIUM_CGAL=ON"), std::string::npos);
  EXPECT_NE(text.find("GNU GPL"), std::string::npos);
}

}  // namespace
}  // namespace atrium::baseline::polyfit_test
