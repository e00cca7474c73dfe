// What colours mean: maps, scales, marks, distances, labels, images on faces.
#include <gtest/gtest.h>

#include "modules/render/colour_map.hpp"
#include "modules/render/overlay.hpp"
#include "modules/render/point_colours.hpp"
#include "modules/render/snapshot.hpp"
#include "modules/types/palette.hpp"
#include "tests/unit/render/pictures.hpp"

namespace atrium::render::colours_test {
namespace {

TEST(ColourMap, RampsRunFromDarkToLightSoThatAnyEyeReadsThem) {
  for (const std::string name : {"viridis", "cividis"}) {
    const ColourMap map = load_colour_map(name);
    double last = -1;
    for (int i = 0; i <= 100; ++i) {
      const Colour c = map.at(i / 100.0);
      const double lightness = 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
      EXPECT_GT(lightness, last - 0.5) << name << " at " << i;
      last = lightness;
    }
    EXPECT_GT(last, 180) << name;
    EXPECT_EQ(map.at(-1), map.colours.front());
    EXPECT_EQ(map.at(7), map.colours.back());
  }
  const Colour middle = load_colour_map("cool_warm").at(0.5);
  EXPECT_LE(*std::max_element(middle.begin(), middle.end()) - *std::min_element(middle.begin(), middle.end()), 2)
      << "the middle of a diverging map is grey";
  EXPECT_EQ(load_colour_map("okabe_ito").of_class(9), load_colour_map("okabe_ito").of_class(1));
}

TEST(ColourMap, AnUnknownOneIsAnErrorThatNamesThem) {
  for (const std::string name : {"jet", "../doc/flat", "", "viridis.txt"}) {
    try {
      load_colour_map(name);
      FAIL() << name;
    } catch (const Error& error) {
      EXPECT_NE(error.help().find("cividis, cool_warm, okabe_ito, viridis"), std::string::npos) << name;
    }
  }
}

TEST(PointColours, DistancesHaveTheScaleOfTheirLargerHalf) {
  Cloud cloud;
  cloud.origin = {500000, 5400000, 100};
  for (int i = 0; i <= 100; ++i)
    cloud.points.emplace_back(1 + 0.01F * static_cast<float>(i), 2, 0.0004F * static_cast<float>(i));
  const auto chosen = evenly_chosen(cloud.size(), 1000);
  const ColourMap map = load_colour_map("cividis");
  const Mesh mesh = square({500000, 5400000, 99});
  Mesh at_zero = mesh;
  at_zero.origin.z() = 100;
  const auto near = distance_colours(cloud, chosen, at_zero, false, 0, map, Context());
  EXPECT_DOUBLE_EQ(near.scale->high, 0.05) << "the 95th percentile is 38 mm";
  EXPECT_EQ(near.colours.front(), map.colours.front());
  EXPECT_NEAR(near.colours[50][0], map.at(0.4)[0], 1);
  const auto fixed = distance_colours(cloud, chosen, at_zero, false, 0.02, map, Context());
  EXPECT_EQ(fixed.colours.back(), map.colours.back());
  EXPECT_NEAR(fixed.colours[25][0], map.at(0.5)[0], 1);
  Mesh turned = at_zero;
  for (auto& triangle : turned.triangles) std::swap(triangle[1], triangle[2]);
  const auto before = distance_colours(cloud, chosen, at_zero, true, 0.04, map, Context());
  const auto behind = distance_colours(cloud, chosen, turned, true, 0.04, map, Context());
  EXPECT_EQ(before.colours.back(), map.at(1));
  EXPECT_EQ(behind.colours.back(), map.at(0));
  EXPECT_DOUBLE_EQ(behind.scale->low, -0.04);
  EXPECT_THROW(distance_colours(cloud, chosen, Mesh{}, false, 0, map, Context()), Error);
}

TEST(PointColours, HeightsAreThoseOfTheUprightFrame) {
  Cloud cloud;
  cloud.origin = {0, 100, 0};
  for (int i = 0; i <= 1000; ++i) cloud.points.emplace_back(0, 0.001F * static_cast<float>(i), 0);
  Transform y_up;
  y_up.rotation << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  y_up.translation = {0, 0, 5};
  const auto heights = height_colours(cloud, evenly_chosen(cloud.size(), 5000), y_up, load_colour_map("viridis"));
  EXPECT_NEAR(heights.scale->low, 105.005, 1e-3);
  EXPECT_NEAR(heights.scale->high, 105.995, 1e-3);
  EXPECT_EQ(heights.colours.front(), load_colour_map("viridis").colours.front());
}

TEST(PointColours, LabelsHaveALegendIfThereAreFew) {
  Cloud cloud;
  for (int i = 0; i < 100; ++i) {
    cloud.points.emplace_back(0, 0, 0);
    cloud.labels.push_back(i % 4 - 1);
  }
  const ColourMap map = load_colour_map("okabe_ito");
  const auto few = label_colours(cloud, evenly_chosen(100, 100), map);
  ASSERT_EQ(few.legend.size(), 4U);
  EXPECT_EQ(few.legend[1].first, "1");
  EXPECT_EQ(few.colours[2], map.colours[1]);
  EXPECT_EQ(few.legend[3].first, "none");
  for (int i = 0; i < 100; ++i) cloud.labels[static_cast<std::size_t>(i)] = i;
  EXPECT_TRUE(label_colours(cloud, evenly_chosen(100, 100), map).legend.empty());
}

TEST(PointColours, ThinningIsEvenAndBounded) {
  EXPECT_EQ(evenly_chosen(10, 10).size(), 10U);
  EXPECT_EQ(evenly_chosen(11, 10), (std::vector<std::uint32_t>{0, 2, 4, 6, 8, 10}));
  EXPECT_EQ(evenly_chosen(5000001, 2000000).size(), 1666667U);
  EXPECT_TRUE(evenly_chosen(0, 10).empty());
}

TEST(Overlay, MarksAreRoundAndInAUnitThatSuits) {
  EXPECT_EQ(bar_marks(0, 0.01).unit, "mm");
  EXPECT_EQ(bar_marks(-0.05, 0.05).unit, "cm");
  EXPECT_EQ(bar_marks(3, 5.6).unit, "m");
  EXPECT_EQ(bar_marks(0, 0.05).values.size(), 6U);
  EXPECT_DOUBLE_EQ(bar_marks(3.1, 5.6).values.front(), 3.5);
  for (const double range : {1e-4, 0.013, 0.2, 1.0, 2.7, 31.0, 4000.0}) {
    EXPECT_GE(bar_marks(0, range).values.size(), 3U) << range;
    EXPECT_LE(bar_marks(0, range).values.size(), 7U) << range;
  }
  EXPECT_DOUBLE_EQ(round_up(0.038), 0.05);
  EXPECT_DOUBLE_EQ(round_up(0.05), 0.05);
  EXPECT_DOUBLE_EQ(round_up(0.051), 0.1);
}

/// An image of four quarters on the square: red green above blue yellow.
Textures quarters(const Eigen::Vector3d& origin) {
  FaceTexture face;
  face.primitive = 0;
  face.corner = Eigen::Vector3d(0, 4, 0);
  face.across = Eigen::Vector3d(4, 0, 0);
  face.down = Eigen::Vector3d(0, -4, 0);
  face.width = face.height = 64;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const Colour colour = y < 32 ? (x < 32 ? Colour{255, 0, 0} : Colour{0, 255, 0})
                                   : (x < 32 ? Colour{0, 0, 255} : Colour{255, 255, 0});
      face.pixels.insert(face.pixels.end(), colour.begin(), colour.end());
    }
  return {origin, {face}};
}

TEST(Textures, LieOnTheirFacesTheRightWayRound) {
  auto host = std::make_shared<Folder>();
  Context context(1, host);
  Snapshot::Params params;
  params.width = params.height = 200;
  params.views = {"top"};
  params.legend = params.scale_bar = params.edges = false;
  const Eigen::Vector3d origin(500000, 5400000, 100);
  Textures textures = quarters(origin + Eigen::Vector3d(0, 0, 7));
  textures.faces[0].corner.z() -= 7;
  const Picture top =
      Snapshot::run({.mesh = input(square(origin)), .textures = input(textures)}, params, context).pictures.pictures[0];
  EXPECT_TRUE(same_hue(pixel(top, 0.3, 0.3), {255, 0, 0}));
  EXPECT_TRUE(same_hue(pixel(top, 0.7, 0.3), {0, 255, 0}));
  EXPECT_TRUE(same_hue(pixel(top, 0.3, 0.7), {0, 0, 255}));
  EXPECT_TRUE(same_hue(pixel(top, 0.7, 0.7), {255, 255, 0}));
  textures.faces[0].primitive = 1;
  const Picture other =
      Snapshot::run({.mesh = input(square(origin)), .textures = input(textures)}, params, context).pictures.pictures[0];
  EXPECT_TRUE(same_hue(pixel(other, 0.3, 0.3), class_colour(SurfaceClass::floor))) << "the image is of another face";
}

TEST(Textures, AnImageOfAnotherSizeThanItsPixelsIsAnError) {
  auto host = std::make_shared<Folder>();
  Context context(1, host);
  for (const int height : {0, -1, 63, 65, 2000000000}) {
    Textures textures = quarters(Eigen::Vector3d::Zero());
    textures.faces[0].height = height;
    EXPECT_THROW(
        Snapshot::run({.mesh = input(square(Eigen::Vector3d::Zero())), .textures = input(textures)}, {}, context),
        Error);
  }
  EXPECT_THROW(Snapshot::run({.meshes = input(room(Eigen::Vector3d::Zero())),
                              .textures = input(quarters(Eigen::Vector3d::Zero()))},
                             {}, context),
               Error)
      << "without a mesh";
}

}  // namespace
}  // namespace atrium::render::colours_test
