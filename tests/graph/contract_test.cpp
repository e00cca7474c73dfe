// What a node type's tables must be: the compiler refuses the rest.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <filesystem>
#include <sstream>

#include "graph/api/node.hpp"
#include "tests/graph/test_nodes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace atrium::contract_test {
namespace {

struct PlaneMeshes {
  static constexpr std::string_view port_type = "PlaneMeshes";
  static constexpr auto members() { return std::tuple{}; }
};
struct Adjacency {
  static constexpr std::string_view port_type = "Adjacency";
  static constexpr auto members() { return std::tuple{}; }
};

// clang-format off
  struct VertexTranslation {
    static constexpr std::string_view type = "refine.vertex_translation";
    static constexpr std::string_view summary = "Moves each wall's nearest edge onto its meeting lines.";
    struct In { Input<PlaneMeshes> meshes; Input<Adjacency> adjacency; };
    struct Out { PlaneMeshes meshes; };
    struct Params { double max_separation = 0.5; };
    static constexpr auto inputs = std::tuple{
        port<&In::meshes>("Walls, floors and ceilings."),
        port<&In::adjacency>("Their neighbourhood: vertex i is mesh i.")};
    static constexpr auto outputs = std::tuple{port<&Out::meshes>("The same meshes, walls closed.")};
    static constexpr auto params = std::tuple{
        param<&Params::max_separation>(metres, within(0, 10), "No vertex moves further (the paper's th_sep).")};
    static Out run(const In& in, const Params& params, Context& context);
  };
// clang-format on

VertexTranslation::Out VertexTranslation::run(const In& in, const Params& /*params*/, Context& /*context*/) {
  return {*in.meshes};
}

/// The lines from `struct VertexTranslation` to its end.
std::string example_in(const std::string& file, const std::string& before) {
  std::istringstream text(test::read_text(std::filesystem::path(ATRIUM_SOURCE_DIR) / file));
  std::string example;
  for (std::string line; std::getline(text, line);) {
    if (example.empty() && line != before + "struct VertexTranslation {") continue;
    example += line.substr(before.size()) + "\n";
    if (line == before + "};") break;
  }
  return example;
}

TEST(Contract, TheExampleInTheHeaderCompiles) {
  const std::string example = example_in("graph/api/node.hpp", "///   ");
  EXPECT_GT(example.size(), 500U);
  EXPECT_EQ(example, example_in("tests/graph/contract_test.cpp", "  "));
  const NodeType type = describe_node<VertexTranslation>();
  ASSERT_EQ(type.inputs.size(), 2U);
  EXPECT_EQ(type.inputs[1].name, "adjacency");
  ASSERT_EQ(type.params.size(), 1U);
  EXPECT_EQ(type.params[0].name, "max_separation");
}

struct Fields {
  double width = 2;
  double Height = 1;
  test::Find::Method method = test::Find::Method::hough;
};
struct Lists {
  std::vector<double> sizes = {1, 2};
};

TEST(Contract, EachFieldIsListedOnceByAGoodName) {
  static_assert(detail::names_are_right(std::tuple{}));
  static_assert(
      detail::names_are_right(std::tuple{param<&Fields::width>(metres, unbounded, ""),
                                         param<&Fields::method>({{"hough", test::Find::Method::hough}}, "")}));
  static_assert(!detail::names_are_right(
      std::tuple{param<&Fields::width>(metres, unbounded, ""), param<&Fields::width>(metres, unbounded, "")}));
  static_assert(!detail::names_are_right(std::tuple{param<&Fields::Height>(metres, unbounded, "")}));
  static_assert(detail::is_name("max_2") && !detail::is_name("2d") && !detail::is_name("") && !detail::is_name("é"));
}

TEST(Contract, ADefaultIsInItsBoundsAndOneOfItsChoices) {
  constexpr auto fits = [](const auto& row) {
    Fields fields;
    return detail::fits(row, fields);
  };
  using Method = test::Find::Method;
  static_assert(fits(param<&Fields::width>(metres, within(0, 2), "")));
  static_assert(!fits(param<&Fields::width>(metres, within(0, 1.9), "")));
  static_assert(!fits(param<&Fields::width>(metres, at_least(3), "")));
  EXPECT_TRUE(detail::fits(param<&Lists::sizes>(metres, within(1, 2), ""), Lists{}));
  EXPECT_FALSE(detail::fits(param<&Lists::sizes>(metres, within(1, 1.5), ""), Lists{}));
  static_assert(fits(param<&Fields::method>({{"ransac", Method::ransac}, {"hough", Method::hough}}, "")));
  static_assert(!fits(param<&Fields::method>({{"ransac", Method::ransac}}, "")));
}

/// All that can be left out is.
struct Light {
  static constexpr std::string_view type = "test.light";
  static constexpr std::string_view summary = "Counts its calls.";
  static void run() { ++calls; }
  inline static int calls = 0;
};
struct Half {
  static constexpr std::string_view type = "test.half";
  static constexpr std::string_view summary = "Gives its parameter.";
  struct Out {
    double value = 0;
  };
  struct Params {
    double value = 0.5;
  };
  static constexpr auto outputs = std::tuple{port<&Out::value>("The parameter.")};
  static constexpr auto params = std::tuple{param<&Params::value>(unitless, within(0, 1), "What it gives.")};
  static Out run(const Params& params) { return {params.value}; }
};

TEST(Contract, WhatIsEmptyIsLeftOut) {
  Context context;
  const NodeType light = describe_node<Light>();
  EXPECT_TRUE(light.inputs.empty() && light.outputs.empty() && light.params.empty() && light.sink);
  EXPECT_TRUE(light.run({}, {}, context).empty());
  EXPECT_EQ(Light::calls, 1);
  const NodeType half = describe_node<Half>();
  EXPECT_FALSE(half.sink);
  const auto values = half.run({}, {ParamValue(0.25)}, context);
  ASSERT_EQ(values.size(), 1U);
  EXPECT_EQ(*static_cast<const double*>(values[0].data.get()), 0.25);
}

// A vector of them would be hashed as pointers.
static_assert(!detail::EigenFixed<Eigen::MatrixXd> && !detail::EigenFixed<Eigen::VectorXd>);
static_assert(detail::EigenFixed<Eigen::Vector3d> && detail::EigenFixed<Eigen::Matrix<float, 2, 3>>);
static_assert(!detail::is_flat<Eigen::VectorXd>());

}  // namespace
}  // namespace atrium::contract_test
