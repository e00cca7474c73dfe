#include "modules/scene/bake_textures.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>

#include "graph/api/random.hpp"
#include "modules/scene/pull_push.hpp"

namespace atrium::scene::bake_textures_test {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using Colouring = std::function<Colour(double s, double t)>;

class Warnings : public ContextHost {
 public:
  void log(Level level, std::string_view text) override {
    if (level == Level::warning) text_ += std::string(text) + "\n";
  }
  bool contains(const std::string& part) const { return text_.find(part) != std::string::npos; }
  bool empty() const { return text_.empty(); }

 private:
  std::string text_;
};

struct Bake {
  Cloud cloud;
  Mesh mesh;
  BakeTextures::Params params;
  std::shared_ptr<Warnings> warnings = std::make_shared<Warnings>();

  /// A rectangular face of the mesh, seen from the side of a × b.
  void face(std::int32_t primitive, SurfaceClass surface, const Vector3d& corner, const Vector3d& a,
            const Vector3d& b) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Vector3d& p : {corner, Vector3d(corner + a), Vector3d(corner + a + b), Vector3d(corner + b)})
      mesh.vertices.push_back(p);
    for (std::uint32_t i = 2; i < 4; ++i) {
      mesh.triangles.push_back({first, first + i - 1, first + i});
      mesh.classes.push_back(surface);
      mesh.primitives.push_back(primitive);
    }
  }
  /// Points on the rectangle, `height` in front of it; s and t are metres along a and b. Without `keep` all of them.
  void points(const Vector3d& corner, const Vector3d& a, const Vector3d& b, const Colouring& colour, double height = 0,
              double spacing = 0.01, const std::function<bool(double, double)>& keep = {}) {
    const Vector3d normal = a.cross(b).normalized();
    for (double s = spacing / 2; s < a.norm(); s += spacing)
      for (double t = spacing / 2; t < b.norm(); t += spacing) {
        if (keep && !keep(s, t)) continue;
        const Vector3d p = corner + a.normalized() * s + b.normalized() * t + normal * height;
        cloud.points.emplace_back(p.cast<float>());
        cloud.colours.push_back(colour(s, t));
        if (normals) cloud.normals.emplace_back(normal.cast<float>());
      }
  }
  Textures run() {
    Context context(1, warnings);
    return BakeTextures::run({input(cloud), input(mesh)}, params, context).textures;
  }
  bool normals = false;
};

Colour plain(int red, int green, int blue) {
  return {static_cast<std::uint8_t>(red), static_cast<std::uint8_t>(green), static_cast<std::uint8_t>(blue)};
}
Colouring constant(Colour colour) {
  return [colour](double, double) { return colour; };
}
Colour pixel(const FaceTexture& image, int x, int y) {
  const auto i = (static_cast<std::size_t>(y) * image.width + x) * 3;
  return {image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]};
}
Vector3d place(const FaceTexture& image, int x, int y) {
  return image.corner + image.across * ((x + 0.5) / image.width) + image.down * ((y + 0.5) / image.height);
}
/// The image's pixel whose middle is nearest to a place on its plane.
Colour at(const FaceTexture& image, const Vector3d& p) {
  const double x = (p - image.corner).dot(image.across) / image.across.squaredNorm() * image.width;
  const double y = (p - image.corner).dot(image.down) / image.down.squaredNorm() * image.height;
  return pixel(image, std::clamp(static_cast<int>(x), 0, image.width - 1),
               std::clamp(static_cast<int>(y), 0, image.height - 1));
}
const Vector3d wall_corner(1, 2, 0.5), wall_a(3, 0, 0), wall_b(0, 0, 2);  // seen from -y

TEST(BakeTextures, EveryPixelShowsTheColourOfItsPlace) {
  const Colouring slope = [](double s, double t) {
    return plain(static_cast<int>(20 + 60 * s), static_cast<int>(30 + 90 * t), 7);
  };
  const Vector3d a(3, 0, 0), b(0, 2, 0);
  for (const Vector3d& axis : {Vector3d(1, 0, 0), Vector3d(0.3, 0.2, 1), Vector3d(0, 0, 1), Vector3d(1, 0.1, 0)})
    for (const double angle : {0.0, 0.7, 1.5708, 2.4, 3.14159}) {
      const Eigen::AngleAxisd turn(angle, axis.normalized());
      Bake bake;
      bake.face(4, SurfaceClass::wall, Vector3d(5, 6, 7), turn * a, turn * b);
      bake.points(Vector3d(5, 6, 7), turn * a, turn * b, slope);
      const Textures textures = bake.run();
      ASSERT_EQ(textures.faces.size(), 1U);
      const FaceTexture& image = textures.faces[0];
      EXPECT_EQ(image.primitive, 4);
      ASSERT_EQ(image.pixels.size(), static_cast<std::size_t>(image.width) * image.height * 3);
      // Not mirrored, pixels are squares of 1 cm, and the rectangle is not much larger than the face.
      EXPECT_GT(image.across.cross(image.down).dot(-(turn * a).cross(turn * b)), 0);
      EXPECT_NEAR(image.across.norm() / image.width, 0.01, 1e-9);
      EXPECT_NEAR(image.down.norm() / image.height, 0.01, 1e-9);
      EXPECT_LT(image.across.norm() * image.down.norm(), 6.1 / 0.7);
      double worst = 0;
      for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
          const Vector3d p = turn.inverse() * (place(image, x, y) - Vector3d(5, 6, 7));
          if (p.x() < 0.02 || p.x() > 2.98 || p.y() < 0.02 || p.y() > 1.98) continue;
          const Colour wanted = slope(p.x(), p.y()), colour = pixel(image, x, y);
          for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(1.0 * wanted[c] - colour[c]));
        }
      EXPECT_LE(worst, 2) << "axis " << axis.transpose() << ", angle " << angle;
    }
}

TEST(BakeTextures, WallsStandUprightAndAreSeenFromTheirFront) {
  Bake bake;
  bake.face(0, SurfaceClass::wall, wall_corner, wall_a, wall_b);
  bake.points(wall_corner, wall_a, wall_b, constant({9, 9, 9}));
  const auto image = bake.run().faces.at(0);
  EXPECT_EQ(image.width, 300);
  EXPECT_EQ(image.height, 200);
  EXPECT_LT((image.corner - Vector3d(1, 2, 2.5)).norm(), 1e-9);  // left and up, for who looks along +y
  EXPECT_LT((image.across - Vector3d(3, 0, 0)).norm(), 1e-9);
  EXPECT_LT((image.down - Vector3d(0, 0, -2)).norm(), 1e-9);
}

TEST(BakeTextures, HolesHaveColoursBetweenThoseAround) {
  Bake bake;
  bake.face(0, SurfaceClass::wall, wall_corner, wall_a, wall_b);
  const auto keep = [](double s, double t) { return std::hypot(s - 1.5, t - 1.0) > 0.7; };
  const Colouring sides = [](double s, double) { return s < 1.5 ? plain(200, 100, 50) : plain(100, 200, 50); };
  bake.points(wall_corner, wall_a, wall_b, sides, 0, 0.01, keep);
  const auto image = bake.run().faces.at(0);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const auto [red, green, blue] = pixel(image, x, y);
      ASSERT_TRUE(red >= 99 && red <= 201 && green >= 99 && green <= 201) << x << ", " << y;
      ASSERT_NEAR(red + green, 300, 2);
      ASSERT_NEAR(blue, 50, 1);
    }
  const auto [red, green, blue] = at(image, wall_corner + Vector3d(1.5, 0, 1));
  EXPECT_NEAR(red, green, 30);
}

TEST(BakeTextures, SparsePointsGiveASmoothImage) {
  Bake bake;
  bake.face(0, SurfaceClass::floor, {0, 0, 0}, {4, 0, 0}, {0, 3, 0});
  bake.points({0, 0, 0}, {4, 0, 0}, {0, 3, 0}, constant({120, 130, 140}), 0, 0.07);
  for (const auto value : bake.run().faces.at(0).pixels) EXPECT_NEAR(value, 130, 11);
}

TEST(BakeTextures, TheLayerNearestToThePlaneWins) {
  Bake bake;
  bake.face(0, SurfaceClass::wall, wall_corner, wall_a, wall_b);
  bake.points(wall_corner, wall_a, wall_b, constant({0, 200, 0}), 0.004);
  bake.points(wall_corner, wall_a, wall_b, constant({200, 0, 0}), 0.04);
  const auto image = bake.run().faces.at(0);
  for (int i = 0; i < 200; ++i) EXPECT_GT(pixel(image, i, 199 - i)[1], 190);
  // What has no other layer is shown, though it stands off the plane: a picture on the wall.
  Bake picture;
  picture.face(0, SurfaceClass::wall, wall_corner, wall_a, wall_b);
  const auto inside = [](double s, double t) { return s > 1 && s < 2 && t > 0.5 && t < 1.5; };
  picture.points(wall_corner, wall_a, wall_b, constant({0, 200, 0}), 0, 0.01,
                 [&](double s, double t) { return !inside(s, t); });
  picture.points(wall_corner, wall_a, wall_b, constant({200, 0, 0}), 0.03, 0.01, inside);
  const auto shown = picture.run().faces.at(0);
  EXPECT_GT(at(shown, wall_corner + Vector3d(1.5, 0, 1))[0], 190);
  EXPECT_GT(at(shown, wall_corner + Vector3d(0.5, 0, 1))[1], 190);
}

TEST(BakeTextures, FurnitureBeforeAWallLeavesNoTrace) {
  // A red cupboard, 1 m wide and 0.4 m deep, stands at the wall, which is green and not seen behind it.
  for (const bool normals : {false, true}) {
    Bake bake;
    bake.normals = normals;
    bake.face(0, SurfaceClass::wall, wall_corner, wall_a, wall_b);
    const auto behind = [](double s, double t) { return s > 1 && s < 2 && t < 1.5; };
    bake.points(wall_corner, wall_a, wall_b, constant({0, 200, 0}), 0, 0.01,
                [&](double s, double t) { return !behind(s, t); });
    const Colouring red = constant({200, 0, 0});
    const Vector3d depth(0, -0.4, 0);
    bake.points(wall_corner + Vector3d(1, 0, 0), {0, 0, 1.5}, depth, red);
    bake.points(wall_corner + Vector3d(2, 0, 0), depth, {0, 0, 1.5}, red);
    bake.points(wall_corner + Vector3d(1, 0, 1.5), {1, 0, 0}, depth, red);
    bake.points(wall_corner + Vector3d(1, -0.4, 0), {1, 0, 0}, {0, 0, 1.5}, red);
    const auto image = bake.run().faces.at(0);
    double worst = 0, mean = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        const double value = pixel(image, x, y)[0];
        worst = std::max(worst, value);
        mean += value / (image.width * image.height);
      }
    EXPECT_LT(mean, normals ? 0.5 : 4) << normals;
    EXPECT_LT(worst, normals ? 2 : 100) << normals;
  }
}

TEST(BakeTextures, BothSidesOfAThinWallHaveTheirOwnColours) {
  const Vector3d behind(0, 0.04, 0);  // within `distance` of the front
  for (const bool sensors : {false, true}) {
    Bake bake;
    bake.normals = !sensors;
    bake.face(0, SurfaceClass::wall, wall_corner, wall_a, wall_b);
    bake.face(1, SurfaceClass::wall, wall_corner + behind, wall_b, wall_a);
    // The front's picture has a hole through which only the other side could be seen.
    bake.points(wall_corner, wall_a, wall_b, constant({0, 200, 0}), 0, 0.01, [](double s, double) { return s < 2; });
    const std::size_t front = bake.cloud.size();
    bake.points(wall_corner + behind, wall_b, wall_a, constant({200, 0, 0}));
    if (sensors) {
      bake.cloud.sensors = {{2, 0, 1}, {2, 5, 1}};
      bake.cloud.source.assign(bake.cloud.size(), 1);
      std::fill_n(bake.cloud.source.begin(), front, std::uint16_t{0});
    }
    const auto textures = bake.run();
    ASSERT_EQ(textures.faces.size(), 2U);
    for (const double s : {0.5, 1.5, 2.5}) {
      EXPECT_EQ(at(textures.faces[0], wall_corner + Vector3d(s, 0, 1)), (Colour{0, 200, 0})) << sensors;
      EXPECT_EQ(at(textures.faces[1], wall_corner + Vector3d(s, 0, 1)), (Colour{200, 0, 0})) << sensors;
    }
  }
}

TEST(BakeTextures, SinglePointsOfNoSurfaceAreNotBelieved) {
  Bake bake;
  bake.face(0, SurfaceClass::wall, wall_corner, wall_a, wall_b);
  bake.points(wall_corner, wall_a, wall_b, constant({0, 200, 0}), 0, 0.01, [](double s, double) { return s < 1; });
  bake.cloud.points.emplace_back(2.8F, 2.0F, 1.5F);
  bake.cloud.colours.push_back({255, 0, 0});
  const auto image = bake.run().faces.at(0);
  EXPECT_LT(at(image, {2.8, 2, 1.5})[0], 20);
}

TEST(BakeTextures, GeoreferencedScansGiveTheSameImages) {
  Bake bake;
  bake.face(0, SurfaceClass::wall, wall_corner, wall_a, wall_b);
  bake.points(wall_corner, wall_a, wall_b,
              [](double s, double t) { return plain(static_cast<int>(80 * s), static_cast<int>(100 * t), 0); });
  const auto near = bake.run();
  const Vector3d far(500000.25, 5400000.5, 300);
  bake.cloud.origin = far;
  bake.mesh.origin = far + Vector3d(1, 2, -3);  // the mesh has another origin than the cloud
  for (auto& v : bake.mesh.vertices) v -= Vector3d(1, 2, -3);
  const auto textures = bake.run();
  EXPECT_EQ(textures.origin, bake.mesh.origin);
  EXPECT_EQ(textures.faces.at(0).pixels, near.faces.at(0).pixels);
}

TEST(BakeTextures, LargeFacesGetLargerPixelsWithAWarning) {
  Bake bake;
  bake.face(0, SurfaceClass::wall, wall_corner, wall_a, wall_b);
  bake.face(1, SurfaceClass::floor, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  bake.points(wall_corner, wall_a, wall_b, constant({1, 2, 3}));
  bake.points({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, constant({1, 2, 3}));
  bake.params.max_side = 150;
  auto textures = bake.run();
  EXPECT_EQ(textures.faces.at(0).width, 150);
  EXPECT_EQ(textures.faces.at(0).height, 100);
  EXPECT_EQ(textures.faces.at(1).width, 100);
  EXPECT_TRUE(bake.warnings->contains("primitive 0 is 3.0 m long: its image has pixels of 0.02 m"));
  bake.params.max_side = 4096;
  bake.params.max_pixels = 10000;
  textures = bake.run();
  const auto size = [&](int i) { return textures.faces.at(i).width * textures.faces.at(i).height; };
  EXPECT_LE(size(0) + size(1), 10400);  // sides are rounded up
  EXPECT_GE(size(0) + size(1), 9500);
  EXPECT_TRUE(bake.warnings->contains("instead of 0.01 m"));
}

TEST(BakeTextures, WithoutColoursOrFacesThereAreNoImagesAndAWarning) {
  Bake bake;
  bake.face(0, SurfaceClass::wall, wall_corner, wall_a, wall_b);
  bake.points(wall_corner, wall_a, wall_b, constant({1, 2, 3}));
  Bake grey = bake, empty = bake, objects = bake, far = bake, columns = bake;
  grey.warnings = empty.warnings = objects.warnings = far.warnings = std::make_shared<Warnings>();
  grey.cloud.colours.clear();
  EXPECT_TRUE(grey.run().faces.empty());
  EXPECT_TRUE(grey.warnings->contains("the cloud has no colours"));
  empty.mesh = {};
  EXPECT_TRUE(empty.run().faces.empty());
  EXPECT_TRUE(empty.warnings->contains("no walls, floors or ceilings"));
  objects.mesh.classes.assign(2, SurfaceClass::object);
  EXPECT_TRUE(objects.run().faces.empty());
  far.face(7, SurfaceClass::floor, {50, 0, 0}, {1, 0, 0}, {0, 1, 0});
  EXPECT_EQ(far.run().faces.size(), 1U);
  EXPECT_TRUE(far.warnings->contains("1 of 2 faces have no points within 0.05 m"));
  columns.mesh.primitives.clear();
  EXPECT_THROW(columns.run(), Error);
  EXPECT_FALSE(bake.run().faces.empty());
  EXPECT_TRUE(bake.warnings->empty());
}

TEST(BakeTextures, SameBytesWithAnyNumberOfThreads) {
  Bake bake;
  bake.face(3, SurfaceClass::wall, wall_corner, wall_a, wall_b);
  bake.face(5, SurfaceClass::floor, {1, 2, 0.5}, wall_a, {0, 3, 0});
  Random random(1);
  for (int i = 0; i < 200000; ++i) {
    const double s = random.uniform(0, 3), t = random.uniform(0, 2), noise = 0.01 * random.normal();
    const Vector3d p = i % 2 == 0 ? Vector3d(1 + s, 2 + noise, 0.5 + t) : Vector3d(1 + s, 2 + 1.5 * t, 0.5 + noise);
    bake.cloud.points.emplace_back(p.cast<float>());
    bake.cloud.colours.push_back(plain(static_cast<int>(random.index(256)), 0, static_cast<int>(80 * s)));
  }
  std::vector<std::string> hashes;
  for (const std::size_t threads : {1, 2, 4}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    hashes.push_back(content_hash(bake.run()));
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

TEST(PullPush, KeepsWhatIsKnownAndFillsTheRest) {
  WeightedImage image;
  image.width = 37;
  image.height = 21;
  image.pixels.assign(37 * 21, WeightedColour::Zero());
  image.confidence.assign(37 * 21, 1.0F);
  WeightedImage unknown = image;
  pull_push(unknown);
  EXPECT_EQ(unknown.pixels[5][3], 0);
  image.pixels[image.index(3, 2)] = WeightedColour(10, 20, 30, 1);
  image.pixels[image.index(30, 20)] = WeightedColour(110, 20, 30, 5);
  pull_push(image);
  EXPECT_FLOAT_EQ(image.pixels[image.index(3, 2)][0], 10);
  EXPECT_FLOAT_EQ(image.pixels[image.index(30, 20)][0], 110);
  for (const auto& pixel : image.pixels) {
    EXPECT_GE(pixel[0], 9.99);
    EXPECT_LE(pixel[0], 110.01);
    EXPECT_NEAR(pixel[1], 20, 1e-3);
    EXPECT_EQ(pixel[3], 1);
  }
}

}  // namespace
}  // namespace atrium::scene::bake_textures_test
