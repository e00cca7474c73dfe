// The form in which the cache stores values: whatever is written comes back, and nothing that is damaged does.
#include "graph/api/flat.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <optional>
#include <set>

#include "graph/cache/blob.hpp"
#include "graph/cache/cache.hpp"
#include "graph/pipeline/registry.hpp"
#include "modules/types/adjacency.hpp"
#include "modules/types/building.hpp"
#include "modules/types/cell_complex.hpp"
#include "modules/types/floor_plan.hpp"
#include "modules/types/metrics.hpp"
#include "modules/types/picture.hpp"
#include "modules/types/plane_meshes.hpp"
#include "modules/types/poses.hpp"
#include "modules/types/simulated_scene.hpp"
#include "modules/types/textures.hpp"
#include "tests/support/temporary_folder.hpp"

namespace atrium::flat_test {
namespace {

/// Fills any value that can be walked with random contents.
template <class T>
void fill(T& value, Random& random) {
  if constexpr (std::is_same_v<T, bool>) {
    value = random.index(2) == 1;
  } else if constexpr (std::is_floating_point_v<T>) {
    value = static_cast<T>(random.normal());
  } else if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
    value = static_cast<T>(random.index(4));
  } else if constexpr (detail::EigenFixed<T>) {
    for (auto& x : value.reshaped()) fill(x, random);
  } else if constexpr (std::is_same_v<T, Adjacency>) {
    value = Adjacency(5);
    for (std::size_t i = 0; i < 4; ++i) value.connect(i + 1, i, random.uniform());
  } else if constexpr (detail::HasMembers<T>) {
    std::apply([&](auto... member) { (fill(value.*member, random), ...); }, T::members());
  } else if constexpr (requires { std::tuple_size<T>::value; }) {
    std::apply([&](auto&... item) { (fill(item, random), ...); }, value);
  } else if constexpr (detail::Range<T>) {
    for (std::uint64_t i = random.index(40); i > 0; --i) {
      detail::ItemOf<T> item{};
      fill(item, random);
      value.insert(value.end(), std::move(item));
    }
  } else if constexpr (detail::IsSharedConst<T>::value) {
    typename detail::IsSharedConst<T>::Type pointee{};
    fill(pointee, random);
    value = std::make_shared<const decltype(pointee)>(std::move(pointee));
  } else {
    typename T::value_type item{};
    fill(item, random);
    if (random.index(2) == 1) value = std::move(item);
  }
}

/// Containers that no port type has today.
struct Odds {
  static constexpr std::string_view port_type = "Odds";
  static constexpr auto members() {
    return std::tuple{&Odds::names, &Odds::set, &Odds::maybe, &Odds::bits, &Odds::pair, &Odds::corners};
  }
  std::map<std::string, std::vector<double>> names;
  std::set<std::int32_t> set;
  std::optional<std::string> maybe;
  std::vector<bool> bits;
  std::pair<bool, std::int64_t> pair;
  std::array<std::string, 3> corners;
};

using PortTypes = testing::Types<bool, std::int64_t, double, std::string, Adjacency, Building, CellComplex, Cloud,
                                 FloorPlan, GroundTruth, Mesh, Metrics, Pictures, PlaneMeshes, PlanePrimitives, Poses,
                                 SimulatedScene, Structure, Textures, Transform, Odds>;

/// Writes the value and all that it shares.
void store(const test::TemporaryFolder& folder, const FlatType& type, const void* value) {
  const std::string hash = type.hash(value);
  for (const auto& shared : write_blob(folder / hash, type, value, hash))
    store(folder, *shared.type, shared.data.get());
}
std::shared_ptr<const void> load(const test::TemporaryFolder& folder, const FlatType& type, const std::string& hash) {
  return read_blob(folder / hash, type, hash,
                   [&](const FlatType& t, const std::string& h) { return load(folder, t, h); });
}

// What is told of every type is compiled once; of each type only how a value of it is made.
using Make = std::shared_ptr<const void> (*)(std::uint64_t seed);
template <class T>
std::shared_ptr<const void> made(std::uint64_t seed) {
  Random random(seed);
  auto value = std::make_shared<T>();
  if (seed > 0) fill(*value, random);
  return value;
}

void expect_it_comes_back(const FlatType& type, Make make) {
  const test::TemporaryFolder folder;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const auto value = make(seed);
    store(folder, type, value.get());
    const std::string hash = type.hash(value.get());
    EXPECT_EQ(type.hash(load(folder, type, hash).get()), hash) << seed;
  }
}

void expect_no_damaged_file_is_read(const FlatType& type, Make make) {
  const test::TemporaryFolder folder;
  Random random(3);
  const auto value = make(3);
  const std::string hash = type.hash(value.get());
  store(folder, type, value.get());
  std::string bytes(std::filesystem::file_size(folder / hash), '\0');
  std::ifstream(folder / hash, std::ios::binary).read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  const auto refuses = [&](const std::string& damaged) {
    std::ofstream(folder / hash, std::ios::binary | std::ios::trunc) << damaged;
    EXPECT_THROW(check_blob(folder / hash), Error);
    EXPECT_THROW(load(folder, type, hash), Error);
  };
  for (int i = 0; i < 40; ++i) {
    std::string damaged = bytes;
    damaged[random.index(damaged.size())] ^= static_cast<char>(1U << random.index(8));
    refuses(damaged);
    refuses(bytes.substr(0, random.index(bytes.size())));
  }
  refuses(bytes + "more");
}

template <class T>
class Flat : public testing::Test {};
TYPED_TEST_SUITE(Flat, PortTypes);

TYPED_TEST(Flat, WhatIsWrittenComesBack) {
  ASSERT_NE(flat_type<TypeParam>(), nullptr);
  expect_it_comes_back(*flat_type<TypeParam>(), made<TypeParam>);
}

TYPED_TEST(Flat, NoDamagedFileIsRead) {
  ASSERT_NE(flat_type<TypeParam>(), nullptr);
  expect_no_damaged_file_is_read(*flat_type<TypeParam>(), made<TypeParam>);
}

TEST(FlatForm, BelievesNothingThatItsBytesDoNotJustify) {
  const auto read = [](const FlatType* type, const std::string& bytes) {
    FlatReader in(reinterpret_cast<const std::byte*>(bytes.data()), bytes.size(), {});
    type->read(in);
  };
  EXPECT_NO_THROW(read(flat_type<bool>(), "\1"));
  EXPECT_THROW(read(flat_type<bool>(), "\2"), Error);
  EXPECT_NO_THROW(read(flat_type<Adjacency>(), std::string(8, '\0')));
  for (const char* many : {"\xff\xff\xff\xff\xff\xff\xff\x7f", "\xff\xff\xff\x7f\0\0\0"})
    EXPECT_THROW(read(flat_type<Adjacency>(), std::string(many, 8) + std::string(16, '\0')), Error);
}

TEST(FlatForm, HoldsWhatIsSharedByReference) {
  const test::TemporaryFolder folder;
  auto cloud = std::make_shared<Cloud>();
  cloud->points.resize(10'000, Eigen::Vector3f::Ones());
  PlanePrimitives planes;
  planes.cloud = cloud;
  const auto shared = write_blob(folder / "planes", *flat_type<PlanePrimitives>(), &planes, content_hash(planes));
  ASSERT_EQ(shared.size(), 1U);
  EXPECT_EQ(shared[0].data, cloud);
  EXPECT_EQ(shared[0].hash, content_hash(*cloud));
  EXPECT_LT(std::filesystem::file_size(folder / "planes"), 1000U);
  const auto back = read_blob(folder / "planes", *flat_type<PlanePrimitives>(), content_hash(planes),
                              [&](const FlatType& type, const std::string& hash) {
                                EXPECT_EQ(type.name, "Cloud");
                                EXPECT_EQ(hash, content_hash(*cloud));
                                return cloud;
                              });
  EXPECT_EQ(static_cast<const PlanePrimitives*>(back.get())->cloud, cloud);
}

TEST(FlatForm, IsOfOneLayout) {
  struct Two {
    static constexpr auto members() { return std::tuple{&Two::a, &Two::b}; }
    float a;
    std::int32_t b;
  };
  struct Swapped {
    static constexpr auto members() { return std::tuple{&Swapped::a, &Swapped::b}; }
    std::int32_t a;
    float b;
  };
  EXPECT_NE(flat_type<Two>()->layout, flat_type<Swapped>()->layout);
  EXPECT_NE(flat_type<Cloud>()->layout, flat_type<Mesh>()->layout);
  const test::TemporaryFolder folder;
  const std::int64_t integer = 0;
  const double number = 0;
  ASSERT_EQ(content_hash(integer), content_hash(number));
  write_blob(folder / "zero", *flat_type<std::int64_t>(), &integer, content_hash(integer));
  EXPECT_THROW(read_blob(folder / "zero", *flat_type<double>(), content_hash(number), {}), Error);
}

TEST(FlatForm, IsNotMadeOfWhatCannotComeBack) {
  struct Bare {
    static constexpr auto members() { return std::tuple{&Bare::pointer}; }
    const double* pointer = nullptr;
  };
  struct OneWay {
    static std::int64_t contents(const OneWay& /*value*/) { return 1; }
  };
  EXPECT_EQ(flat_type<Bare>(), nullptr);
  EXPECT_EQ(flat_type<OneWay>(), nullptr);
}

TEST(FlatForm, WhatSeveralValuesShareIsStoredOnceAndComesBackAsOne) {
  const test::TemporaryFolder folder;
  auto cloud = std::make_shared<Cloud>();
  cloud->points.resize(20'000, Eigen::Vector3f::Ones());
  PlanePrimitives planes;
  planes.cloud = cloud;
  planes.primitives.resize(3);
  Structure structure;
  structure.primitives = std::make_shared<const PlanePrimitives>(planes);
  const std::string planes_hash = content_hash(planes);
  const std::string structure_hash = content_hash(structure);
  {
    Cache cache({folder.path(), 1'000'000'000, true});
    const auto keep = [&]<class T>(const T& value, const std::string& hash) {
      cache.keep_value(*flat_type<T>(), std::make_shared<const T>(value), hash, byte_size(value), 1);
    };
    keep(planes, planes_hash);
    keep(structure, structure_hash);
    keep(*cloud, content_hash(*cloud));
    cache.finish();
    EXPECT_LT(cache.use().kept, 12U * 20'000 + 2000);
  }
  Cache cache({folder.path()});
  const auto load = [&]<class T>(const T& /*type*/, const std::string& hash) {
    return std::static_pointer_cast<const T>(cache.load(*flat_type<T>(), hash));
  };
  const auto loaded = load(structure, structure_hash);
  ASSERT_NE(loaded, nullptr);
  EXPECT_EQ(loaded->primitives, load(planes, planes_hash));
  EXPECT_EQ(loaded->primitives->cloud, load(*cloud, content_hash(*cloud)));
  EXPECT_EQ(load(*cloud, content_hash(planes)), nullptr);
  EXPECT_TRUE(cache.use().problems.empty());
}

/// The types that have no entry above would not be tested.
template <class... T>
std::set<std::string_view> names_of(testing::Types<T...> /*types*/) {
  return {PortType<T>::name...};
}
TEST(FlatForm, EveryOutputOfEveryNodeTypeHasOne) {
  Registry registry;
  std::vector<std::string> problems;
  const auto types = registry.all(&problems);
  std::set<std::string> modules;
  for (const auto* type : types) modules.insert(type->type.substr(0, type->type.find('.')));
  for (const char* module : {"io", "synth"}) EXPECT_TRUE(modules.contains(module)) << module;  // tests/CMakeLists.txt
  for (const auto& problem : problems) ADD_FAILURE() << problem;
  const auto tested = names_of(PortTypes{});
  for (const auto* type : types)
    for (const auto& output : type->outputs) {
      EXPECT_NE(output.flat, nullptr) << type->type << "." << output.name;
      EXPECT_TRUE(tested.contains(output.type)) << output.type;
    }
}

}  // namespace
}  // namespace atrium::flat_test
