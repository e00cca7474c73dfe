#include "files.hpp"
#include "modules/geometry/moments.hpp"
#include "modules/io/read_vg.hpp"
#include "modules/io/write_vg.hpp"

namespace atrium::io::vg_test {
namespace {

class Vg : public Files {
 protected:
  PlanePrimitives read(const std::string& name) { return ReadVg::run({{path(name)}}, context).planes; }
  PlanePrimitives parse(const std::string& text) {
    file("a.vg", text);
    return read("a.vg");
  }
  std::string failure(const std::string& bytes, const std::string& name = "a.vg") {
    file(name, bytes);
    return error_of([&] { read(name); });
  }
};

/// Three noisy planes over a cloud with some points of none.
PlanePrimitives sample(const Eigen::Vector3d& origin, bool columns) {
  Cloud cloud;
  cloud.origin = origin;
  PlanePrimitives planes;
  Random random(3);
  const Eigen::Vector3d normals[3] = {{0, 0, 1}, {1, 0, 0}, {0.6, -0.8, 0}};
  for (std::size_t g = 0; g < 3; ++g) {
    PlanePrimitive primitive;
    Moments moments;
    for (std::size_t i = 0; i < 40 - 10 * g; ++i) {
      Eigen::Vector3d p(random.uniform(-4, 4), random.uniform(-4, 4), random.uniform(-4, 4));
      p -= normals[g] * (normals[g].dot(p) - 2.0 - random.normal() * 0.005);
      primitive.inliers.push_back(static_cast<std::uint32_t>(cloud.size()));
      cloud.points.push_back(p.cast<float>());
      moments.add(cloud.points.back().cast<double>());
    }
    const PlaneFit fit = fit_plane(moments);
    primitive.plane = fit.plane;
    primitive.residual = std::sqrt(fit.variances[0]);
    planes.primitives.push_back(primitive);
    cloud.points.emplace_back(9, 9, static_cast<float>(g));  // of no group
  }
  for (std::size_t i = 0; columns && i < cloud.size(); ++i) {
    cloud.normals.emplace_back(0, 0, 1);
    cloud.colours.push_back({static_cast<std::uint8_t>(i), 7, 255});
  }
  planes.cloud = std::make_shared<const Cloud>(std::move(cloud));
  return planes;
}

TEST_F(Vg, BothFormsGiveTheSamePrimitivesBack) {
  for (const bool columns : {false, true}) {
    for (const auto& [name, tolerance] : {std::pair{"p.vg", 1e-12}, std::pair{"p.bvg", 1e-6}}) {
      const PlanePrimitives planes = sample(Eigen::Vector3d::Zero(), columns);
      WriteVg::run({input(planes)}, {{name}}, context);
      const PlanePrimitives back = read(name);
      EXPECT_EQ(back.cloud->points, planes.cloud->points) << name;
      EXPECT_EQ(back.cloud->colours, planes.cloud->colours);
      EXPECT_EQ(back.cloud->normals, planes.cloud->normals);
      ASSERT_EQ(back.primitives.size(), 3U);
      for (std::size_t g = 0; g < 3; ++g) {
        EXPECT_EQ(back.primitives[g].inliers, planes.primitives[g].inliers);
        EXPECT_LT((back.primitives[g].plane.normal - planes.primitives[g].plane.normal).norm(), tolerance);
        EXPECT_NEAR(back.primitives[g].plane.offset, planes.primitives[g].plane.offset, 4 * tolerance);
        EXPECT_NEAR(back.primitives[g].residual, planes.primitives[g].residual, 1e-5);
      }
    }
  }
  EXPECT_TRUE(host->warnings.empty()) << warnings();
}

TEST_F(Vg, GeoreferencedTextStaysExactAndBinarySaysThatItIsRelative) {
  const PlanePrimitives planes = sample({500000, 5400000, 0}, false);
  WriteVg::run({input(planes)}, {{"p.vg"}}, context);
  EXPECT_TRUE(host->warnings.empty()) << warnings();
  const PlanePrimitives back = read("p.vg");
  EXPECT_TRUE(host->warnings.empty()) << warnings();
  for (std::size_t i = 0; i < planes.cloud->size(); ++i)
    EXPECT_LT((back.cloud->origin + back.cloud->points[i].cast<double>() - planes.cloud->origin -
               planes.cloud->points[i].cast<double>())
                  .norm(),
              1e-5);
  for (std::size_t g = 0; g < 3; ++g) {
    // A place on the plane, seen from both origins.
    const Plane& a = planes.primitives[g].plane;
    const Eigen::Vector3d place = planes.cloud->origin - a.normal * a.offset;
    EXPECT_LT(std::abs(back.primitives[g].plane.signed_distance(place - back.cloud->origin)), 1e-6);
  }
  WriteVg::run({input(planes)}, {{"p.bvg"}}, context);
  EXPECT_TRUE(warned("relative to (500000, 5400000, 0)")) << warnings();
  EXPECT_EQ(read("p.bvg").cloud->points, planes.cloud->points);
}

const std::string square =
    "num_points: 8\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n5 0 0\n5 1 0\n5 0 1\n5 1 1\nnum_colors: 0\nnum_normals: 0\n";

std::string group(const std::string& plane, const std::string& points, const std::string& type = "0",
                  const std::string& children = "num_children: 0\n") {
  const auto count = [](const std::string& list) {
    std::istringstream in(list);
    return std::distance(std::istream_iterator<std::string>(in), {});
  };
  return "group_type: " + type + "\nnum_group_parameters: " + std::to_string(count(plane)) +
         "\ngroup_parameters: " + plane +
         "\ngroup_label: unknown\ngroup_color: 0.1 0.2 0.3\ngroup_num_point: " + std::to_string(count(points)) + "\n" +
         points + "\n" + children;
}

TEST_F(Vg, FitsPlanesWhoseParametersAreNoneOrNotTheirs) {
  for (const std::string plane : {"0 0 0 0", "0 0 2 -2", "", "1 2 3", "nan 0 1 -1", "0 0 -1 0.5"}) {
    host->warnings.clear();
    const auto planes = parse(square + "num_groups: 1\n" + group(plane, "3 1 2 0"));
    ASSERT_EQ(planes.primitives.size(), 1U) << plane;
    const Plane& p = planes.primitives[0].plane;
    EXPECT_NEAR(std::abs(p.normal.z()), 1.0, 1e-12);
    EXPECT_NEAR(p.signed_distance({0, 0, 1}), 0.0, 1e-12);
    if (plane == "0 0 -1 0.5") {
      EXPECT_LT(p.normal.z(), 0);
    }
    EXPECT_EQ(planes.primitives[0].inliers, (std::vector<std::uint32_t>{0, 1, 2, 3}));
    EXPECT_TRUE(warned("1 plane fitted to the points")) << plane;
  }
}

TEST_F(Vg, KeepsAGivenNormalsSideAndSortsBySize) {
  const auto planes = parse(square + "num_groups: 2\n" + group("-1 0 0 5", "4 5 6") + group("0 0 -1 1", "0 1 2 3"));
  ASSERT_EQ(planes.primitives.size(), 2U);
  EXPECT_EQ(planes.primitives[0].plane.normal, Eigen::Vector3d(0, 0, -1));
  EXPECT_EQ(planes.primitives[1].plane.normal, Eigen::Vector3d(-1, 0, 0));
  EXPECT_EQ(planes.primitives[1].plane.offset, 5.0);
  EXPECT_TRUE(host->warnings.empty()) << warnings();
}

TEST_F(Vg, ReadsChildrenAndSaysWhatItSkips) {
  const auto planes =
      parse(square + "num_groups: 4\n" +
            group("0 0 1 -1", "0 1 2 3 3", "0", "num_children: 1\n" + group("1 0 0 -5", "4 5 6 2", "0", "")) +
            group("0 0 0 0 1", "5 6 7", "1") + group("0 0 1 -1", "") + group("0 0 0 0", "7"));
  ASSERT_EQ(planes.primitives.size(), 2U) << warnings();
  EXPECT_EQ(planes.primitives[1].inliers, (std::vector<std::uint32_t>{4, 5, 6}));
  EXPECT_TRUE(warned("1 group is no plane"));
  EXPECT_TRUE(warned("1 group has no points of its own"));
  EXPECT_TRUE(warned("1 group states no plane and has too few points"));
  EXPECT_TRUE(warned("2 points are in more than one group"));
}

TEST_F(Vg, ReadsOtherSpellingsOfNamesAndColoursTo255) {
  const auto planes = parse(
      "num_points : 3\n0 0 0\n1 0 0\n0 1 0\nnum_colours: 3\n255 0 0\n0 255 0\n0 0 255\nnormals: 3\n0 0 1\n0 0 1\n0 0 "
      "1\n"
      "num_groups: 1\ngroup_type: 0\nnum_group_parameters: 4\ngroup_parameters: 0 0 1 0\ngroup_label:\n"
      "group_color: 1 1 1\ngroup_num_points: 3\n0 1 2\nnum_children: 0\n");
  EXPECT_EQ(planes.cloud->colours, (std::vector<Colour>{{255, 0, 0}, {0, 255, 0}, {0, 0, 255}}));
  EXPECT_EQ(planes.cloud->normals.size(), 3U);
  EXPECT_EQ(planes.primitives.size(), 1U);
}

TEST_F(Vg, PointsThatAreNotFiniteLeaveTheirGroups) {
  const auto planes =
      parse("num_points: 5\nnan 0 0\n0 0 0\n1 0 0\n0 1 0\n9 9 9\nnum_colors: 0\nnum_normals: 0\nnum_groups: 1\n" +
            group("0 0 1 0", "0 1 2 3"));
  EXPECT_EQ(planes.cloud->size(), 4U);
  EXPECT_EQ(planes.primitives.at(0).inliers, (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST_F(Vg, NamesWhatIsWrongAndWhere) {
  EXPECT_CONTAINS(failure(""), "the file is empty");
  EXPECT_CONTAINS(failure("x", "a.txt"), "unknown format '.txt'");
  EXPECT_CONTAINS(failure("num_points: 99999999999\n1 2 3\n"), "a.vg:1: num_points is 99999999999, more than");
  EXPECT_CONTAINS(failure("num_points: -1\n"), "num_points is -1");
  EXPECT_CONTAINS(failure("num_points: 2\n0 0 0 1 1 1\n"), "2 points");
  EXPECT_CONTAINS(failure("num_points: 3\n0 0 0\n1 0 0\n0 a 0\n"), "a.vg:4: 'a' is not a number");
  EXPECT_CONTAINS(failure("3\n0 0 0\n1 0 0\n0 1 0\n"), "the name 'num_points:' is missing");
  EXPECT_CONTAINS(failure("num_points: 3\n0 0 0\n1 0 0\n0 1 0\nnum_colors: 2\n1 1 1\n0 0 0\n"),
                  "num_colors is 2, but there are 3 points");
  EXPECT_CONTAINS(failure(square + "num_groups: 2\n" + group("0 0 1 -1", "0 1 2")), "truncated");
  EXPECT_CONTAINS(failure(square + "num_groups: 1000\n" + group("0 0 1 -1", "0 1 2")), "num_groups is 1000, more than");
  EXPECT_CONTAINS(failure(square + "num_groups: 1\n" + group("0 0 1 -1", "0 1 8")),
                  "a group has the point 8, but there are 8");
}

TEST_F(Vg, WildBinaryCountsAreErrorsBeforeMemoryIsTaken) {
  std::string bytes;
  put<std::int32_t>(bytes, 0x7FFFFFFF);
  EXPECT_CONTAINS(failure(bytes, "a.bvg"), "num_points is 2147483647, more than the 0 bytes");
  bytes.clear();
  put<std::int32_t>(bytes, -5);
  EXPECT_CONTAINS(failure(bytes, "a.bvg"), "byte 0: num_points is -5");
}

}  // namespace
}  // namespace atrium::io::vg_test
