// The program as its user and scripts meet it: exit codes, what goes to stdout, what to stderr.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/graph/folder.hpp"

namespace atrium::cli_test {
namespace {

using Json = nlohmann::json;

class CommandLine : public testing::Test {
 protected:
  struct Result {
    int code;
    std::string out, err;
  };
  const std::string plugins_of_tests =
      std::filesystem::path(ATRIUM_PROGRAM).parent_path().parent_path() / "tests/plugins";
  Result run(const std::string& arguments) { return run(arguments, plugins_of_tests); }
  Result run(const std::string& arguments, const std::string& plugins) {
    const auto err = folder.path() / "stderr";
    const std::string command = "cd '" + folder.path().string() + "' && export ATRIUM_CACHE=off ATRIUM_PLUGIN_PATH='" +
                                plugins + "' && '" + ATRIUM_PROGRAM + "' " + arguments + " 2>'" + err.string() + "'";
    Result result;
    FILE* pipe = ::popen(command.c_str(), "r");
    char block[4096];
    while (const std::size_t got = std::fread(block, 1, sizeof block, pipe)) result.out.append(block, got);
    const int status = ::pclose(pipe);
    result.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    std::ostringstream text;
    text << std::ifstream(err).rdbuf();
    result.err = text.str();
    return result;
  }
  test::Folder folder;
  std::filesystem::path good = folder.write("good.yaml", R"(atrium: 1
vars: {distance: 2 cm}
nodes:
  cloud: {type: test.make}
  planes: {type: test.find, in: {cloud: cloud.cloud}, params: {distance: "${distance}"}}
  shell/write: {type: test.write, in: {planes: planes.planes}}
outputs: {planes: planes.planes}
)");
  std::filesystem::path bad = folder.write("bad.yaml", R"(atrium: 1
nodes:
  cloud: {type: test.mak}
outputs: {planes: cloud.cloud}
)");
};

TEST_F(CommandLine, AWordThatIsNoCommandIsSaid) {
  const auto typo = run("rnu pipeline.yaml");
  EXPECT_EQ(typo.code, 2);
  EXPECT_NE(typo.err.find("unknown command 'rnu'"), std::string::npos) << typo.err;
  EXPECT_NE(typo.err.find("did you mean 'run'?"), std::string::npos) << typo.err;
  const auto option = run("sweep submit --shrads 3");
  EXPECT_EQ(option.code, 2);
  EXPECT_NE(option.err.find("atrium sweep submit --help"), std::string::npos) << option.err;
  const auto version = run("--version");
  EXPECT_EQ(version.code, 0);
  EXPECT_EQ(version.out.rfind("atrium ", 0), 0U) << version.out;
}

TEST_F(CommandLine, CheckSaysOk) {
  const Result result = run("check good.yaml -s planes.angle='3 deg' -s distance=1cm");
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.out, "ok: 3 nodes\n");
  EXPECT_EQ(result.err, "");
}

TEST_F(CommandLine, CheckPutsFindingsOnStderr) {
  const Result result = run("check bad.yaml");
  EXPECT_EQ(result.code, 3);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err, "bad.yaml:3:17: error: unknown node type 'test.mak'\n  help: did you mean 'test.make'?\n");
}

TEST_F(CommandLine, CheckGivesJson) {
  const Result result = run("check bad.yaml --json");
  EXPECT_EQ(result.code, 3);
  EXPECT_EQ(result.err, "");
  const Json report = Json::parse(result.out);
  EXPECT_EQ(report["ok"], false);
  EXPECT_EQ(report["errors"].at(0)["line"], 3);
  EXPECT_EQ(report["errors"].at(0)["help"], "did you mean 'test.make'?");
}

TEST_F(CommandLine, CheckSaysWhatIsLeftToSet) {
  folder.write("template.yaml",
               "atrium: 1\nvars: {d: }\nnodes:\n  cloud: {type: test.make}\n  planes: {type: test.find, "
               "in: {cloud: cloud.cloud}, params: {distance: \"${d}\"}}\noutputs: {p: planes.planes}\n");
  EXPECT_EQ(run("check template.yaml").out, "ok: 2 nodes; to run it, set -s d=…\n");
  EXPECT_EQ(run("check template.yaml -s d=1").out, "ok: 2 nodes\n");
}

TEST_F(CommandLine, WrongUseIsCodeTwo) {
  for (const char* arguments : {"", "chek good.yaml", "check", "check good.yaml --jso", "check good.yaml -s",
                                "nodes test.mak", "nodes nothing", "graph good.yaml --format svg"}) {
    const Result result = run(arguments);
    EXPECT_EQ(result.code, 2) << arguments;
    EXPECT_EQ(result.out, "") << arguments;
    EXPECT_NE(result.err.find("atrium: error: "), std::string::npos) << arguments;
  }
}

TEST_F(CommandLine, AFileThatIsNotThereIsCodeThree) {
  const Result result = run("check nowhere.yaml");
  EXPECT_EQ(result.code, 3);
  EXPECT_EQ(result.err.find("nowhere.yaml: error: no such pipeline file\n  help: looked for "), 0U) << result.err;
}

TEST_F(CommandLine, AnEmptyWordIsSaid) {
  for (const auto& [arguments, what] : std::initializer_list<std::pair<std::string, std::string>>{
           {"run good.yaml --out ''", "the value of --out is empty"},
           {"run good.yaml --out=", "the value of --out is empty"},
           {"check ''", "argument 2 is empty"}}) {
    const Result result = run(arguments);
    EXPECT_EQ(result.code, 2) << arguments;
    EXPECT_EQ(result.err.find("atrium: error: " + what + "\n"), 0U) << result.err;
  }
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "runs"));
}

TEST_F(CommandLine, APipelineComesThroughAPipe) {
  folder.write("pipe.sh", "cat good.yaml | \"$1\" check /dev/stdin && \"$1\" check <(cat good.yaml)\n");
  const Result result = run("--version >/dev/null; bash pipe.sh '" ATRIUM_PROGRAM "'");
  EXPECT_EQ(result.out, "ok: 3 nodes\nok: 3 nodes\n") << result.err;
}

TEST_F(CommandLine, ABrokenLinkIsNamedAsOne) {
  std::filesystem::create_symlink("/nowhere/at/all", folder.path() / "link.yaml");
  std::filesystem::create_symlink("round.xyz", folder.path() / "round.xyz");
  const Result pipeline = run("check link.yaml");
  EXPECT_EQ(pipeline.code, 3);
  EXPECT_NE(pipeline.err.find("no such pipeline file: it is a link to /nowhere/at/all, which is not there"),
            std::string::npos)
      << pipeline.err;
  folder.write("reads.yaml",
               "atrium: 1\nvars: {file: }\nnodes:\n  r: {type: test.read, params: {path: \"${file}\"}}\n"
               "outputs: {cloud: r.cloud}\n");
  const Result scan = run("check reads.yaml -s file=link.yaml");
  EXPECT_NE(scan.err.find("link.yaml is a link to /nowhere/at/all, which is not there"), std::string::npos) << scan.err;
  EXPECT_EQ(scan.err.find("did you mean"), std::string::npos) << scan.err;
  const Result round = run("check reads.yaml -s file=round.xyz");
  EXPECT_NE(round.err.find("is a link to round.xyz, which leads round in a circle"), std::string::npos) << round.err;
}

TEST_F(CommandLine, AWorkingFolderThatIsGoneIsSaid) {
  folder.write("gone.sh",
               "mkdir gone && cd gone && rmdir ../gone && \"$1\" run ../good.yaml --out here\n"
               "\"$1\" run \"$2\" --out here\n");
  const Result result = run("--version >/dev/null; bash gone.sh '" ATRIUM_PROGRAM "' '" + good.string() + "'");
  EXPECT_EQ(result.code, 1);
  EXPECT_NE(result.err.find("atrium: error: the working folder is not there any more"), std::string::npos)
      << result.err;
}

TEST_F(CommandLine, ARunInAFolderWithoutUtf8NameCanBeCompared) {
  folder.write("named.sh",
               "mkdir $'d\\xe4' && cd $'d\\xe4' && cp ../good.yaml . && \"$1\" run good.yaml -q --out o && "
               "\"$1\" diff o o && \"$1\" report o -o page.html\n");
  const Result result = run("--version >/dev/null; bash named.sh '" ATRIUM_PROGRAM "'");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.out.find("the same"), std::string::npos) << result.out;
}

TEST_F(CommandLine, CombinationsOfASweepAreCounted) {
  std::string values = "[1", many = "grid:\n";
  for (int i = 2; i <= 1000; ++i) values += "," + std::to_string(i);
  values += "]\n";
  for (const std::string axis : {"planes.a", "planes.b"}) many += "  " + axis + ": " + values;
  folder.write("sweep.yaml", "atrium: 1\nsweep: good.yaml\nseeds: " + values + many);
  const Result result = run("sweep plan sweep.yaml");
  EXPECT_NE(result.err.find("the sweep has 1000000000 combinations, more than 100000"), std::string::npos)
      << result.err;
}

TEST_F(CommandLine, APluginThatCannotBeUsedIsCodeFive) {
  folder.write("plugin.yaml", "atrium: 1\nnodes: {a: {type: stranger.any}}\n");
  const Result result = run("check plugin.yaml");
  EXPECT_EQ(result.code, 5);
  EXPECT_NE(result.err.find("was built for another framework"), std::string::npos);
}

TEST_F(CommandLine, NodesShowsOneType) {
  const Result result = run("nodes test.find");
  EXPECT_EQ(result.code, 0);
  EXPECT_NE(result.out.find("distance (length, 0 m to 10 m, default 0.5 m)"), std::string::npos);
  EXPECT_NE(result.out.find("cloud (Cloud)"), std::string::npos);
  const Json list = Json::parse(run("nodes test --json").out);
  ASSERT_EQ(list.size(), 4U);
  EXPECT_EQ(list[0]["params"][0]["unit"], "m");
  EXPECT_EQ(list[0]["params"][0]["max"], 10.0);
  EXPECT_NE(run("nodes test --markdown").out.find("| `distance` | length, 0 m to 10 m, default 0.5 m |"),
            std::string::npos);
}

TEST_F(CommandLine, GraphDrawsNodesAndSubPipelines) {
  const std::string dot = run("graph good.yaml").out;
  EXPECT_NE(dot.find("n1 [label=\"planes\\ntest.find\"];"), std::string::npos);
  EXPECT_NE(dot.find("n0->n1  [label=\"cloud\"];"), std::string::npos);
  EXPECT_NE(dot.find("subgraph \"cluster_shell\""), std::string::npos);
  const std::string mermaid = run("graph good.yaml --format mermaid").out;
  EXPECT_EQ(mermaid.find("flowchart LR\n"), 0U);
  EXPECT_NE(mermaid.find("n0 -- \"cloud\" --> n1"), std::string::npos);
  EXPECT_EQ(run("graph bad.yaml").code, 3);
}

TEST_F(CommandLine, SchemaHasARuleForEachNodeType) {
  EXPECT_EQ(run("schema").code, 5);  // some plugins of the tests are broken on purpose
  std::filesystem::create_directories(folder.path() / "plugins");
  std::filesystem::copy(plugins_of_tests + "/libatrium_test.so", folder.path() / "plugins");
  const Result result = run("schema", folder.path() / "plugins");
  ASSERT_EQ(result.code, 0) << result.err;
  const Json schema = Json::parse(result.out);
  EXPECT_EQ(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
  const Json& find = schema["$defs"]["test.find"]["properties"];
  EXPECT_EQ(find["in"]["required"], Json::array({"cloud"}));
  EXPECT_EQ(find["params"]["additionalProperties"], false);
  EXPECT_EQ(find["params"]["properties"]["distance"]["default"], 0.5);
  EXPECT_EQ(find["params"]["properties"]["distance"]["anyOf"][0]["anyOf"][0]["maximum"], 10.0);
  EXPECT_EQ(schema["$defs"]["node"]["allOf"].size(), schema["$defs"]["node"]["properties"]["type"]["enum"].size());
}

TEST_F(CommandLine, TheSchemaOfSweepsHasTheKeysThatAreRead) {
  const Json keys = Json::parse(run("schema --sweep").out).at("properties");
  folder.write("sweep.yaml", "atrium: 1\nsweep: good.yaml\nqqq: 1\n");
  const std::string said = run("sweep plan sweep.yaml").err;
  std::istringstream list(said.substr(said.find("keys of a sweep file: ") + 22));
  std::set<std::string> read;
  for (std::string word; read.size() < 100 && list >> word && word != "atrium:";) {
    const bool last = word.back() != ',';
    read.insert(last ? word : word.substr(0, word.size() - 1));
    if (last) break;
  }
  EXPECT_EQ(read.size(), keys.size()) << said;
  for (const auto& key : read) EXPECT_TRUE(keys.contains(key)) << key;
}

TEST_F(CommandLine, HelpGoesToStdout) {
  const Result result = run("check --help");
  EXPECT_EQ(result.code, 0);
  EXPECT_NE(result.out.find("-s"), std::string::npos);
  EXPECT_EQ(result.err, "");
}

TEST_F(CommandLine, AFullDiskUnderStdoutIsAFailure) {
  const Result result = run("nodes test >/dev/full");
  EXPECT_EQ(result.code, 1);
}

}  // namespace
}  // namespace atrium::cli_test
