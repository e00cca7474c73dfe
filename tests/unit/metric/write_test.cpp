#include "modules/metric/write.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

namespace atrium::metric::write_test {
namespace {

class Folder : public ContextHost {
 public:
  std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("atrium_metric_write_" + std::to_string(::getpid()));
  std::vector<std::string> warnings;
  std::vector<std::filesystem::path> written;
  ~Folder() override { std::filesystem::remove_all(folder); }
  std::filesystem::path output_folder() override { return folder; }
  void log(Level level, std::string_view text) override {
    if (level == Level::warning) warnings.emplace_back(text);
  }
  void wrote(const std::filesystem::path& file) override { written.push_back(file); }
};

class MetricWrite : public testing::Test {
 protected:
  std::shared_ptr<Folder> host = std::make_shared<Folder>();
  Context context{1, host};

  std::string write(const std::vector<std::vector<Metric>>& inputs) {
    Write::In in;
    for (const auto& values : inputs) in.metrics.push_back(input(Metrics{values}));
    Write::run(in, {}, context);
    std::ifstream file(host->folder / "metrics.json");
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
  }
  std::string error(const std::vector<std::vector<Metric>>& inputs) {
    try {
      write(inputs);
    } catch (const Error& e) {
      EXPECT_FALSE(std::filesystem::exists(host->folder / "metrics.json"));
      return e.what();
    }
    return "no error";
  }
};

TEST_F(MetricWrite, NestsByDotsInOrder) {
  EXPECT_EQ(write({{{"b.x", 0.1, "m"}, {"a", 3, ""}}, {{"b.y.z", 1e-7, "deg"}}}), R"({
  "b": {
    "x": {
      "value": 0.1,
      "unit": "m"
    },
    "y": {
      "z": {
        "value": 1e-07,
        "unit": "deg"
      }
    }
  },
  "a": {
    "value": 3.0,
    "unit": ""
  }
}
)");
  EXPECT_EQ(host->written, std::vector<std::filesystem::path>{host->folder / "metrics.json"});
  EXPECT_TRUE(host->warnings.empty());
}

TEST_F(MetricWrite, LinesForSpreadsheets) {
  Write::In in{
      {input(Metrics{{{"a.b", 0.1, "m"}, {"a.c", std::numeric_limits<double>::infinity(), ""}, {"d,\"e", 3, ""}}})}};
  Write::run(in, {{"curve.csv"}}, context);
  std::ifstream file(host->folder / "curve.csv");
  std::stringstream text;
  text << file.rdbuf();
  EXPECT_EQ(text.str(), "name,value,unit\na.b,0.1,m\na.c,,\n\"d,\"\"e\",3.0,\n");
}

TEST_F(MetricWrite, NumbersReadBackToTheSameDouble) {
  for (const double x : {1.0 / 3, 0.1 + 0.2, 5e-324, 1.7976931348623157e308, 123456789.123456789, -0.0})
    EXPECT_EQ(nlohmann::json::parse(write({{{"x", x, ""}}}))["x"]["value"].get<double>(), x);
}

TEST_F(MetricWrite, WhatIsNotFiniteIsNullAndWarned) {
  const auto json = nlohmann::json::parse(
      write({{{"a.x", std::nan(""), "m"}, {"a.y", std::numeric_limits<double>::infinity(), ""}, {"a.z", 1, ""}}}));
  EXPECT_TRUE(json["a"]["x"]["value"].is_null());
  EXPECT_TRUE(json["a"]["y"]["value"].is_null());
  EXPECT_EQ(json["a"]["x"]["unit"], "m");
  ASSERT_EQ(host->warnings.size(), 2U);
  EXPECT_NE(host->warnings[0].find("a.x"), std::string::npos);
}

TEST_F(MetricWrite, NamesThatExcludeEachOtherAreErrors) {
  const auto twice = error({{{"a.x", 1, ""}}, {{"b", 1, ""}}, {{"a.x", 2, ""}}});
  EXPECT_NE(twice.find("'a.x' of input 3"), std::string::npos) << twice;
  EXPECT_NE(twice.find("input 1"), std::string::npos) << twice;
  EXPECT_NE(error({{{"a", 1, ""}}, {{"a.x", 2, ""}}}).find("'a' of input 1"), std::string::npos);
  EXPECT_NE(error({{{"a.x.y", 1, ""}}, {{"a.x", 2, ""}}}).find("'a.x' of input 2"), std::string::npos);
  for (const char* name : {"", ".", "a.", ".a", "a..b"}) EXPECT_NE(error({{{name, 1, ""}}}), "no error") << name;
}

TEST_F(MetricWrite, NoMetricsIsAnEmptyObject) { EXPECT_EQ(write({{}}), "{}\n"); }

}  // namespace
}  // namespace atrium::metric::write_test
