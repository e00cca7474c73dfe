#include "graph/pipeline/yaml_tree.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

namespace atrium::yaml_tree_test {
namespace {

std::string first_problem(const std::string& text) {
  const YamlTree tree = parse_yaml(text);
  if (tree.problems.empty()) return "none";
  const auto& problem = tree.problems.front();
  return std::to_string(problem.place.line) + ":" + std::to_string(problem.place.column) + " " + problem.message;
}

TEST(YamlTree, KnowsThePlaceOfEveryKeyAndValue) {
  const YamlTree tree = parse_yaml("a: 1\nbb:\n  - x\n  - {c: \"y\", d: }\n");
  ASSERT_TRUE(tree.root);
  EXPECT_TRUE(tree.problems.empty());
  const auto& a = tree.root->entries.at(0);
  EXPECT_EQ(a.key, "a");
  EXPECT_EQ(a.place.line, 1);
  EXPECT_EQ(a.value.place.column, 4);
  const auto& list = tree.root->find("bb")->value;
  ASSERT_EQ(list.items.size(), 2U);
  EXPECT_EQ(list.items[0].place.line, 3);
  EXPECT_EQ(list.items[0].place.column, 5);
  const auto& c = *list.items[1].find("c");
  EXPECT_EQ(c.place.column, 6);
  EXPECT_EQ(c.value.place.column, 9);
  EXPECT_TRUE(c.value.quoted);
  EXPECT_FALSE(a.value.quoted);
  EXPECT_TRUE(list.items[1].find("d")->value.is_null());
  EXPECT_EQ(list.items[1].find("d")->value.place.column, 14);
}

TEST(YamlTree, CountsColumnsInCharacters) {
  const YamlTree tree = parse_yaml("{ä: x, ßß: y}");
  ASSERT_TRUE(tree.root);
  EXPECT_EQ(tree.root->entries.at(1).place.column, 8);
  EXPECT_EQ(tree.root->entries.at(1).value.place.column, 12);
}

TEST(YamlTree, InterpretsNothing) {
  const YamlTree tree = parse_yaml("[010, no, 1e3, 0x1, 'null', null, ~]");
  ASSERT_TRUE(tree.root);
  const auto& items = tree.root->items;
  EXPECT_EQ(items[0].text, "010");
  EXPECT_EQ(items[1].text, "no");
  EXPECT_EQ(items[4].text, "null");
  EXPECT_TRUE(items[5].is_null());
  EXPECT_TRUE(items[6].is_null());
}

TEST(YamlTree, ReadsAllLineEndsAndByteOrderMarks) {
  for (const std::string text : {"a: 1\r\nb: 2\r\n", "a: 1\rb: 2\r", "a: 1\rb: 2\n", "a: 1\nb: 2\r"}) {
    const YamlTree tree = parse_yaml("\xef\xbb\xbf" + text);
    ASSERT_TRUE(tree.root) << tree.problems.front().message;
    EXPECT_EQ(tree.root->find("a")->place.column, 1);
    EXPECT_EQ(tree.root->find("a")->value.text, "1");
    EXPECT_EQ(tree.root->find("b")->place.line, 2);
  }
}

TEST(YamlTree, RejectsWhatYamlCppWouldReadDifferently) {
  EXPECT_EQ(first_problem("a: 1\na: 2\n"), "2:1 duplicate key 'a'");
  EXPECT_EQ(first_problem("a: &x 1\nb: *x\n"), "1:4 YAML anchors are not supported");
  EXPECT_EQ(first_problem("a: {<<: 1}\n"), "1:5 YAML merge keys ('<<') are not supported");
  EXPECT_EQ(first_problem("a: !!str 1\n"), "1:4 YAML tags are not supported ('tag:yaml.org,2002:str')");
  EXPECT_EQ(first_problem("a: 1\n---\nb: 2\n"), "2:1 a second YAML document begins here");
  EXPECT_EQ(first_problem("? [a]\n: 1\n"), "1:3 a key must be a plain word");
  EXPECT_EQ(first_problem("a: 1\x04\nb: 2\n"), "1:5 the byte 0x04 is not UTF-8 text");
  EXPECT_EQ(first_problem(std::string("a: \0b\n", 6)), "1:4 the byte 0x00 is not UTF-8 text");
  EXPECT_EQ(first_problem("a:\n\tb: 1\n"), "2:1 a tab in the indentation");
  EXPECT_EQ(first_problem(""), "0:0 the file is empty");
  EXPECT_EQ(first_problem("\n# nothing\n"), "0:0 the file is empty");
  EXPECT_EQ(first_problem("---\na: 1\n...\n"), "none");
}

TEST(YamlTree, RejectsInvalidUtf8) {
  for (const char* bytes : {"\xff", "\xc0\x80", "\xe0\x80\x80", "\xed\xa0\x80", "\xf5\x80\x80\x80", "\xe2\x82", "\x80"})
    EXPECT_NE(first_problem(std::string("a: ") + bytes + "\n").find("is not UTF-8"), std::string::npos);
  EXPECT_EQ(first_problem("a: \xe2\x82\xac \xf0\x9f\x8f\xa0\n"), "none");
}

TEST(YamlTree, EndsAtThirtyTwoLevels) {
  const auto nested = [](int depth) {
    return std::string(static_cast<std::size_t>(depth), '[') + std::string(static_cast<std::size_t>(depth), ']');
  };
  EXPECT_EQ(first_problem(nested(32)), "none");
  EXPECT_EQ(first_problem(nested(33)), "1:33 nested deeper than 32 levels");
  EXPECT_NE(first_problem(std::string(100000, '[')), "none");
  EXPECT_NE(first_problem(std::string(100000, '{')), "none");
  std::string block;
  for (int i = 0; i < 1000; ++i) block += std::string(static_cast<std::size_t>(i), ' ') + "a:\n";
  EXPECT_NE(first_problem(block), "none");
}

TEST(YamlTree, SaysWhyAFileCannotBeRead) {
  EXPECT_EQ(read_yaml("/nowhere/a.yaml").problems.front().message, "cannot read the file: no such file");
  EXPECT_EQ(read_yaml("/").problems.front().message, "cannot read the file: it is a folder");
  const auto large = std::filesystem::temp_directory_path() / ("atrium-large-" + std::to_string(::getpid()) + ".yaml");
  std::ofstream(large).put('a');
  std::filesystem::resize_file(large, (std::uintmax_t{16} << 20U) + 1);
  EXPECT_EQ(read_yaml(large.string()).problems.front().message,
            "cannot read the file: it is larger than 16 MiB, which no pipeline is");
  std::filesystem::remove(large);
}

}  // namespace
}  // namespace atrium::yaml_tree_test
