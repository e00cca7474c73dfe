#include "graph/run/admission.hpp"

#include <gtest/gtest.h>

#include "tests/graph/test_nodes.hpp"

namespace atrium::admission_test {
namespace {

constexpr std::uint64_t much = std::uint64_t{1} << 50U;  // more than the process has by far

class AdmissionTest : public testing::Test {
 protected:
  PipelineNode node(const std::string& path) { return {path, &type, {}, {}}; }
  NodeType type = describe_node<test::Make>();
  std::function<std::optional<std::uint64_t>(const PipelineNode&)> estimate =
      [](const PipelineNode& n) -> std::optional<std::uint64_t> {
    if (n.path == "half") return much / 2;
    if (n.path == "small") return much / 8;
    if (n.path == "huge") return 4 * much;
    return std::nullopt;
  };
};

TEST_F(AdmissionTest, LetsInWhatFits) {
  Admission admission(much, estimate);
  EXPECT_TRUE(admission.admit(0, node("half")));
  EXPECT_FALSE(admission.admit(1, node("half")));
  EXPECT_TRUE(admission.admit(2, node("small")));
  EXPECT_FALSE(admission.admit(3, node("half")));
  EXPECT_EQ(admission.later(), (std::vector<std::size_t>{1, 3}));
  EXPECT_TRUE(admission.later().empty());
  admission.done(0, "test.make", 1);
  EXPECT_TRUE(admission.admit(1, node("half")));
}

TEST_F(AdmissionTest, LetsOneInHoweverLargeItIs) {
  Admission admission(much, estimate);
  EXPECT_TRUE(admission.admit(0, node("huge")));
  EXPECT_FALSE(admission.admit(1, node("small")));
  admission.done(0, "test.make", 1);
  EXPECT_TRUE(admission.admit(1, node("small")));
  EXPECT_FALSE(admission.admit(2, node("huge")));
}

TEST_F(AdmissionTest, WhatIsNotKnownRunsAloneUntilOneOfItsTypeIsDone) {
  Admission admission(much, estimate);
  EXPECT_TRUE(admission.admit(0, node("unknown")));
  EXPECT_FALSE(admission.admit(1, node("unknown")));
  admission.done(0, "test.make", 1000);
  EXPECT_TRUE(admission.admit(1, node("unknown")));
  EXPECT_TRUE(admission.admit(2, node("unknown")));
}

TEST_F(AdmissionTest, WithoutALimitEverythingRuns) {
  Admission admission(0, estimate);
  for (std::size_t n = 0; n < 100; ++n) EXPECT_TRUE(admission.admit(n, node("huge")));
}

}  // namespace
}  // namespace atrium::admission_test
