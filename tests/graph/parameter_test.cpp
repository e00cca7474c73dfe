#include "graph/api/parameter.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <cstdlib>

#include "graph/api/error.hpp"
#include "graph/pipeline/yaml_tree.hpp"

namespace atrium::parameter_test {
namespace {

/// The same cases in every run, unless RC_PARAMS asks for others.
const int fixed_seed = ::setenv("RC_PARAMS", "seed=1", 0);

ParamInfo number(const Unit& unit, double min = -INFINITY, double max = INFINITY) {
  ParamInfo info;
  info.name = "x";
  info.kind = ParamKind::number;
  info.unit = unit;
  info.min = min;
  info.max = max;
  info.initial = 0.5;
  return info;
}
ParamInfo of_kind(ParamKind kind, ParamValue initial) {
  ParamInfo info;
  info.name = "x";
  info.kind = kind;
  info.unit = unitless;
  info.initial = std::move(initial);
  return info;
}

double parsed(const ParamInfo& info, const std::string& text) { return std::get<double>(parse_param(info, {{text}})); }
std::string message(const ParamInfo& info, const RawValue& raw) {
  try {
    parse_param(info, raw);
  } catch (const Error& error) {
    EXPECT_FALSE(error.help().empty());
    return error.what();
  }
  return "accepted";
}

/// The value as a file has it, from its YAML text.
RawValue raw_of(const std::string& yaml) {
  const YamlTree tree = parse_yaml("x: " + yaml + "\n");
  EXPECT_TRUE(tree.root && tree.problems.empty()) << yaml;
  const YamlNode& node = tree.root->entries.front().value;
  RawValue raw{{}, node.is_sequence(), node.quoted};
  if (node.is_scalar()) raw.items.push_back(node.text);
  for (const auto& item : node.items) raw.items.push_back(item.text);
  return raw;
}

struct Conversion {
  const char* text;
  Unit unit;
  double value;
};
class Units : public testing::TestWithParam<Conversion> {};
TEST_P(Units, AreConvertedToTheNearestDouble) {
  EXPECT_EQ(parsed(number(GetParam().unit), GetParam().text), GetParam().value) << GetParam().text;
}
INSTANTIATE_TEST_SUITE_P(All, Units,
                         testing::Values(Conversion{"2 cm", metres, 0.02}, Conversion{"2cm", metres, 0.02},
                                         Conversion{"35 cm", metres, 0.35}, Conversion{"  7   mm ", metres, 0.007},
                                         Conversion{"3 km", metres, 3000}, Conversion{"250 um", metres, 0.00025},
                                         Conversion{"1 in", metres, 0.0254}, Conversion{"10 ft", metres, 3.048},
                                         Conversion{"0.02", metres, 0.02}, Conversion{"+1.5", metres, 1.5},
                                         Conversion{"-1e-3 m", metres, -0.001}, Conversion{".5 m", metres, 0.5},
                                         Conversion{"5. m", metres, 5}, Conversion{"010", metres, 10},
                                         Conversion{"20 deg", degrees, 20}, Conversion{"1 m2", square_metres, 1},
                                         Conversion{"5 cm2", square_metres, 0.0005},
                                         Conversion{"150 ms", seconds, 0.15}, Conversion{"2 min", seconds, 120},
                                         Conversion{"1.5 h", seconds, 5400}, Conversion{"10 %", ratio, 0.1},
                                         Conversion{"10%", ratio, 0.1}, Conversion{"0.25", ratio, 0.25},
                                         Conversion{"1e6", count, 1e6}));

TEST(Parameter, ReadsRadians) {
  EXPECT_DOUBLE_EQ(parsed(number(degrees), "1 rad"), 57.29577951308232);
  EXPECT_EQ(parsed(number(degrees), "3.141592653589793 rad"), 180);
}

TEST(Parameter, ConvertsToAUnitThatIsNotTheBase) {
  EXPECT_EQ(parsed(number({"mm", "length"}), "2 cm"), 20);
  EXPECT_EQ(parsed(number({"mm", "length"}), "3"), 3);
  EXPECT_EQ(parsed(number({"points/m2", "density"}), "3 points/m2"), 3);
  EXPECT_EQ(message(number({"points/m2", "density"}), {{"3 m"}}), "'3 m' is a length, but 'x' is a density");
}

TEST(Parameter, NamesBothDimensions) {
  EXPECT_EQ(message(number(metres), {{"20 deg"}}), "'20 deg' is an angle, but 'x' is a length");
  EXPECT_EQ(message(number(unitless), {{"20 deg"}}), "'20 deg' is an angle, but 'x' is a plain number");
  EXPECT_EQ(message(number(ratio), {{"3 m2"}}), "'3 m2' is an area, but 'x' is a share");
}

TEST(Parameter, RejectsWhatIsNoFiniteDecimalNumber) {
  for (const char* text : {"",    " ",  "nan",   "inf",      "-inf", "infinity", "0x10", "1,5",   "--1", "+-1", "m",
                           "1 2", "1e", "1e999", "1e308 km", "two",  "1_000",    "0b1",  "1.2.3", "e5",  "."})
    EXPECT_NE(message(number(metres), {{text}}), "accepted") << text;
}

TEST(Parameter, KeepsToItsBounds) {
  const ParamInfo info = number(metres, 0, 10);
  EXPECT_EQ(parsed(info, "10 m"), 10);
  EXPECT_EQ(parsed(info, "0"), 0);
  EXPECT_EQ(message(info, {{"10.1"}}), "'x' is 10.1 m, above its greatest value 10 m");
  EXPECT_EQ(message(info, {{"-1 mm"}}), "'x' is -0.001 m, below its least value 0 m");
}

TEST(Parameter, ReadsWholeNumbers) {
  const ParamInfo info = of_kind(ParamKind::integer, std::int64_t{1});
  const auto whole = [&](const char* text) { return std::get<std::int64_t>(parse_param(info, {{text}})); };
  EXPECT_EQ(whole("70"), 70);
  EXPECT_EQ(whole("010"), 10);
  EXPECT_EQ(whole("1e6"), 1000000);
  EXPECT_EQ(whole("2.0"), 2);
  EXPECT_EQ(whole("-3"), -3);
  EXPECT_EQ(whole("9223372036854775807"), 9223372036854775807);
  for (const char* text : {"7.5", "1e-3", "1e30", "9223372036854775808", "true", "0x10", ""})
    EXPECT_NE(message(info, {{text}}), "accepted") << text;
}

TEST(Parameter, DoesNotOverflowTheIntegerOfTheNode) {
  struct Params {
    std::int32_t x = 1;
    std::uint32_t y = 1;
  };
  static constexpr auto x = param<&Params::x>(count, unbounded, "");
  static constexpr auto y = param<&Params::y>(count, unbounded, "");
  EXPECT_NE(message(detail::erase(x, Params{}), {{"3e9"}}), "accepted");
  EXPECT_NE(message(detail::erase(y, Params{}), {{"-1"}}), "accepted");
  EXPECT_EQ(message(detail::erase(y, Params{}), {{"4294967295"}}), "accepted");
  EXPECT_EQ(describe_param(detail::erase(x, Params{})), "count, default 1");
}

TEST(Parameter, KnowsTrueAndFalseOnly) {
  const ParamInfo info = of_kind(ParamKind::boolean, true);
  EXPECT_EQ(parse_param(info, {{"false"}}), ParamValue(false));
  for (const char* text : {"yes", "no", "on", "True", "1", "0", ""})
    EXPECT_NE(message(info, {{text}}), "accepted") << text;
}

TEST(Parameter, SuggestsTheChoiceThatWasMeant) {
  ParamInfo info = of_kind(ParamKind::choice, std::string("knn"));
  info.choices = {"knn", "radius", "voxels"};
  EXPECT_EQ(parse_param(info, {{"radius"}}), ParamValue(std::string("radius")));
  try {
    parse_param(info, {{"raduis"}});
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "'x' cannot be 'raduis'");
    EXPECT_EQ(error.help(), "did you mean 'radius'? one of knn, radius, voxels; default knn");
  }
}

TEST(Parameter, TakesQuotedValuesAsText) {
  EXPECT_EQ(parse_param(of_kind(ParamKind::text, std::string()), raw_of("\"2 cm\"")), ParamValue(std::string("2 cm")));
  EXPECT_EQ(parse_param(of_kind(ParamKind::text, std::string()), raw_of("no")), ParamValue(std::string("no")));
  EXPECT_EQ(message(number(metres), raw_of("'2'")),
            "'x' is a length, and \"2\" in quotes is text; write it without quotes");
  EXPECT_EQ(parse_param(number(metres), raw_of("\"2 cm\"")), ParamValue(0.02));  // JSON has no other way to say it
  EXPECT_NE(message(of_kind(ParamKind::boolean, true), raw_of("\"true\"")), "accepted");
}

TEST(Parameter, ReadsLists) {
  ParamInfo three = of_kind(ParamKind::numbers, std::vector<double>{1, 2, 3});
  three.unit = metres;
  three.length = 3;
  EXPECT_EQ(parse_param(three, raw_of("[1 m, 2 cm, 3]")), ParamValue(std::vector<double>{1, 0.02, 3}));
  EXPECT_EQ(message(three, raw_of("[1, 2]")), "'x' is a list of 3, not of 2");
  EXPECT_EQ(message(three, raw_of("1")), "'x' is a list of 3, not of 1");
  ParamInfo any = of_kind(ParamKind::texts, std::vector<std::string>{});
  EXPECT_EQ(parse_param(any, raw_of("[]")), ParamValue(std::vector<std::string>{}));
  EXPECT_EQ(parse_param(any, raw_of("one")), ParamValue(std::vector<std::string>{"one"}));
  EXPECT_EQ(message(number(metres), raw_of("[1, 2]")), "'x' is one value, not a list");
}

TEST(Parameter, DescribesWhatItAccepts) {
  EXPECT_EQ(describe_param(number(metres, 0, 10)), "length, 0 m to 10 m, default 0.5 m");
  EXPECT_EQ(describe_param(number(degrees, 0)), "angle, at least 0 deg, default 0.5 deg");
  EXPECT_EQ(describe_param(of_kind(ParamKind::boolean, true)), "true or false, default true");
  EXPECT_EQ(describe_param(of_kind(ParamKind::input_path, std::string())), "file that exists, no default");
}

TEST(Parameter, NumbersSurviveBeingWritten) {
  rc::check([](double value) {
    RC_PRE(std::isfinite(value));
    for (const Unit& unit : {metres, degrees, seconds, square_metres, ratio, count, unitless}) {
      const ParamInfo info = number(unit);
      RC_ASSERT(std::get<double>(parse_param(info, raw_of(format_param(info, value)))) == value);
    }
  });
}

TEST(Parameter, WholeNumbersSurviveBeingWritten) {
  rc::check([](std::int64_t value) {
    const ParamInfo info = of_kind(ParamKind::integer, std::int64_t{0});
    RC_ASSERT(std::get<std::int64_t>(parse_param(info, raw_of(format_param(info, value)))) == value);
  });
}

TEST(Parameter, TextSurvivesBeingWritten) {
  const ParamInfo info = of_kind(ParamKind::text, std::string());
  const auto survives = [&](const std::string& text) {
    return std::get<std::string>(parse_param(info, raw_of(format_param(info, text)))) == text;
  };
  for (const char* text :
       {"",      " ", "null", "~",  "a: b", "#",   "- a", "'", "\"", "\\",   "a\nb",   "\t",   "[a]",   "{",
        "wände", "…", "true", "12", "...",  "---", "%",   "@", "`",  "a #b", "a\x01z", "${x}", "C:\\x", "trailing "})
    EXPECT_TRUE(survives(text)) << text;
  rc::check([&](std::string text) {
    for (char& c : text) c = static_cast<char>(c & 0x7f);  // what is no UTF-8 cannot be in a file
    std::replace(text.begin(), text.end(), '\0', ' ');
    RC_ASSERT(survives(text));
  });
}

TEST(Parameter, ListsSurviveBeingWritten) {
  rc::check([](const std::vector<std::int32_t>& values) {
    const ParamInfo info = of_kind(ParamKind::numbers, std::vector<double>{});
    std::vector<double> list;
    for (const auto v : values) list.push_back(v / 64.0);
    RC_ASSERT(std::get<std::vector<double>>(parse_param(info, raw_of(format_param(info, list)))) == list);
  });
  const ParamInfo texts = of_kind(ParamKind::texts, std::vector<std::string>{});
  const std::vector<std::string> list{"a, b", "[c]", "", "d"};
  EXPECT_EQ(parse_param(texts, raw_of(format_param(texts, list))), ParamValue(list));
}

}  // namespace
}  // namespace atrium::parameter_test
