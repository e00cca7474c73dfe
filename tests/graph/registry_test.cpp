#include "graph/pipeline/registry.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/graph/folder.hpp"
#include "tests/graph/test_nodes.hpp"

namespace atrium::registry_test {
namespace {

const std::filesystem::path plugins = std::filesystem::path(ATRIUM_PROGRAM).parent_path() / "../tests/plugins";
using Folders = std::vector<std::filesystem::path>;

std::string problem(Registry& registry, const std::string& type) {
  try {
    registry.find(type);
  } catch (const PluginError& error) {
    return error.what();
  }
  return "none";
}
bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Registry, LoadsAPluginWhenATypeOfItIsAskedFor) {
  Registry registry(Folders{plugins});
  const NodeType* found = registry.find("test.find");
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(found->type, "test.find");
  EXPECT_EQ(found->version, 2);
  EXPECT_EQ(found->params.size(), 7U);
  EXPECT_EQ(registry.find("test.find"), found);
  EXPECT_EQ(registry.find("test.grow"), nullptr);
  EXPECT_EQ(registry.find("nowhere.find"), nullptr);
  EXPECT_EQ(registry.find("test"), nullptr);
  EXPECT_EQ(registry.find(""), nullptr);
  EXPECT_EQ(registry.find("../test.find"), nullptr);
  EXPECT_EQ(registry.modules(), (std::vector<std::string>{"empty", "lazy", "misnamed", "stranger", "test"}));
}

TEST(Registry, RefusesPluginsThatDoNotFit) {
  Registry registry(Folders{plugins});
  EXPECT_TRUE(contains(problem(registry, "stranger.any"), "was built for another framework"));
  EXPECT_TRUE(contains(problem(registry, "misnamed.make"), "has the node type 'test.make'"));
  EXPECT_TRUE(contains(problem(registry, "empty.any"), "is not an Atrium plugin"));
  test::Folder folder;
  folder.write("libatrium_text.so", "no library");
  Registry other(Folders{folder.path()});
  EXPECT_TRUE(contains(problem(other, "text.any"), "cannot load the plugin 'text'"));
}

TEST(Registry, ListsAllTypesAndWhatCannotBeLoaded) {
  Registry registry(Folders{plugins});
  EXPECT_THROW(registry.all(), PluginError);
  std::vector<std::string> problems;
  const auto types = registry.all(&problems);
  EXPECT_EQ(problems.size(), 3U);
  ASSERT_EQ(types.size(), 7U);
  EXPECT_EQ(types[3]->type, "test.find");
}

TEST(Registry, LoadsTheSecondLibraryOfALazyPluginWhenANodeRuns) {
  Registry registry(Folders{plugins});
  Context context;
  const NodeType* found = registry.find("lazy.double");
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(found->params.at(0).initial, ParamValue(1.0));
  const auto outputs = found->run({}, {ParamValue(21.0)}, context);
  EXPECT_EQ(*static_cast<const double*>(outputs.at(0).data.get()), 42.0);
  EXPECT_THROW(registry.find("lazy.forgotten")->run({}, {}, context), PluginError);
  test::Folder folder;
  std::filesystem::copy(plugins / "libatrium_lazy.so", folder.path());
  Registry alone(Folders{folder.path()});
  EXPECT_THROW(alone.find("lazy.double")->run({}, {ParamValue(1.0)}, context), PluginError);
}

TEST(Registry, SaysWhatIsNotBuilt) {
  EXPECT_EQ(Registry::missing_library(*Registry(Folders{plugins}).find("lazy.double")), "");
  test::Folder folder;
  std::filesystem::copy(plugins / "libatrium_lazy.so", folder.path());
  Registry alone(Folders{folder.path()});
  EXPECT_EQ(Registry::missing_library(*alone.find("lazy.double")), (folder.path() / "libatrium_lazy-run.so").string());
  EXPECT_EQ(Registry::missing_library(*alone.find("lazy.light")), "");
  Context context;
  EXPECT_EQ(*static_cast<const double*>(alone.find("lazy.light")->run({}, {}, context).at(0).data.get()), 1.0);
  EXPECT_TRUE(alone.is_left_out("refine"));
  EXPECT_FALSE(alone.is_left_out("lazy"));
  EXPECT_FALSE(alone.is_left_out("nowhere"));
}

TEST(Registry, TakesTheFirstFolderThatHasTheModule) {
  test::Folder folder;
  folder.write("libatrium_test.so", "no library");
  Registry first(Folders{plugins, folder.path()});
  EXPECT_NE(first.find("test.make"), nullptr);
  Registry second(Folders{folder.path(), plugins});
  EXPECT_THROW(second.find("test.make"), PluginError);
}

TEST(Registry, LooksInThePathOfTheEnvironment) {
  ::setenv("ATRIUM_PLUGIN_PATH", ("/nowhere::" + plugins.string()).c_str(), 1);
  Registry registry;
  ::unsetenv("ATRIUM_PLUGIN_PATH");
  EXPECT_NE(registry.find("test.make"), nullptr);
  EXPECT_EQ(Registry().find("test.make"), nullptr);
}

}  // namespace
}  // namespace atrium::registry_test
