#include <fstream>

#include "tests/graph/pipeline_file.hpp"

namespace atrium::pipeline_test {
namespace {

using test::Folder;
using test::PipelineFile;

const char* const small = R"(atrium: 1
summary: A small one.
seed: 18446744073709551615
vars: {distance: 2 cm}
nodes:
  cloud: {type: test.make}
  planes: {type: test.find, in: {cloud: cloud.cloud}, params: {distance: "${distance}", method: hough}}
outputs: {planes: planes.planes}
)";

TEST_F(PipelineFile, IsReadWithDefaultsFilledIn) {
  const LoadResult result = load_text(small);
  ASSERT_TRUE(result.errors.empty()) << messages(result);
  const Pipeline& pipeline = result.pipeline;
  EXPECT_EQ(pipeline[whole].summary, "A small one.");
  EXPECT_EQ(pipeline[whole].seed, 18446744073709551615U);
  EXPECT_EQ(paths(pipeline), (std::vector<std::string>{"cloud", "planes"}));
  EXPECT_EQ(value(pipeline, "planes", "distance"), ParamValue(0.02));
  EXPECT_EQ(value(pipeline, "planes", "angle"), ParamValue(20.0));
  EXPECT_EQ(value(pipeline, "planes", "method"), ParamValue(std::string("hough")));
  ASSERT_EQ(inputs_of(1, pipeline).size(), 1U);
  EXPECT_EQ(inputs_of(1, pipeline)[0].at(0).node, 0U);
  ASSERT_EQ(pipeline[whole].outputs.size(), 1U);
  EXPECT_EQ(pipeline[whole].outputs[0].from.node, 1U);
}

TEST_F(PipelineFile, IsOrderedByItsEdgesThenByTheFile) {
  const LoadResult result = load_text(R"(atrium: 1
nodes:
  last: {type: test.join, in: {clouds: [c.cloud, a.cloud, b.cloud]}}
  a: {type: test.make}
  d: {type: test.make}
  b: {type: test.make}
  c: {type: test.make}
outputs: {last: last.cloud, d: d.cloud}
)");
  ASSERT_TRUE(result.errors.empty()) << messages(result);
  EXPECT_EQ(paths(result.pipeline), (std::vector<std::string>{"c", "a", "b", "last", "d"}));
  const auto edges = inputs_of(3, result.pipeline).at(0);
  ASSERT_EQ(edges.size(), 3U);
  EXPECT_EQ(edges[0].node, 0U);  // a repeated port keeps the order of the file
  EXPECT_EQ(edges[1].node, 1U);
  EXPECT_EQ(edges[2].node, 2U);
}

TEST_F(PipelineFile, FindsInputFilesRelativeToWhatSetsThem) {
  const auto scan = folder.write("pipelines/a.ply", "");
  folder.write("pipelines/sub/b.ply", "");
  folder.write("pipelines/sub/c.ply", "");
  folder.write("pipelines/sub/read.yaml", R"(atrium: 1
vars: {first: , second: b.ply}
nodes:
  first: {type: test.read, params: {path: "${first}"}}
  second: {type: test.read, params: {path: "${second}"}}
  third: {type: test.read, params: {path: c.ply}}
  all: {type: test.join, in: {clouds: [first.cloud, second.cloud, third.cloud]}}
outputs: {cloud: all.cloud}
)");
  const auto file = folder.write("pipelines/p.yaml", R"(atrium: 1
vars: {scan: a.ply}
nodes:
  read: {pipeline: sub/read.yaml, vars: {first: "${scan}"}}
outputs: {cloud: read.cloud}
)");
  LoadResult result = load(file);
  ASSERT_TRUE(result.errors.empty()) << messages(result);
  EXPECT_EQ(value(result.pipeline, "read/first", "path"), ParamValue(text(scan)));
  EXPECT_EQ(value(result.pipeline, "read/second", "path"), ParamValue(text(folder.path() / "pipelines/sub/b.ply")));
  EXPECT_EQ(value(result.pipeline, "read/third", "path"), ParamValue(text(folder.path() / "pipelines/sub/c.ply")));

  folder.write("here/mine.ply", "");
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path() / "here");
  result = load(file, {"scan=mine.ply", "read.second=mine.ply", "read/third.path=mine.ply"});
  std::filesystem::current_path(before);
  ASSERT_TRUE(result.errors.empty()) << messages(result);
  for (const char* path : {"read/first", "read/second", "read/third"})
    EXPECT_EQ(value(result.pipeline, path, "path"), ParamValue(text(folder.path() / "here/mine.ply")));
}

TEST_F(PipelineFile, TakesSeveralFilesOnlyInBrackets) {
  const auto b = folder.write("stations/b.e57", ""), a = folder.write("stations/a.e57", "");
  const auto odd = folder.write("odd*.e57", "");
  const auto file = folder.write("p.yaml", R"(atrium: 1
vars: {scan: }
nodes:
  read: {type: test.make}
  all: {type: test.join, in: {clouds: [read.cloud]}, params: {files: "${scan}"}}
outputs: {cloud: all.cloud}
)");
  const auto files = [&](const std::string& given) {
    const LoadResult result = load_pipeline(file, {{"scan=" + given, "here", folder.path()}}, registry);
    return result.errors.empty() ? std::get<std::vector<std::string>>(value(result.pipeline, "all", "files"))
                                 : std::vector<std::string>{messages(result)};
  };
  using Files = std::vector<std::string>;
  EXPECT_EQ(files("[stations/*.e57]"), (Files{text(a), text(b)}));
  EXPECT_EQ(files("[stations/b.e57, \"stations/[a]*\"]"), (Files{text(b), text(a)}));
  EXPECT_EQ(files("[stations]"), (Files{text(folder.path() / "stations")}));
  EXPECT_EQ(files("stations/a.e57"), (Files{text(a)}));
  EXPECT_EQ(files("odd*.e57"), (Files{text(odd)}));  // there is a file of that name
  const auto says = [&](const std::string& given, const std::string& part) {
    const Files result = files(given);
    EXPECT_TRUE(result.size() == 1 && result[0].find(part) != std::string::npos) << result[0];
  };
  says("stations", "'stations' is a folder: which file is 'files'?");
  says("stations", "in brackets all its files are taken together: [stations]; a sweep file's `scenes` makes one scene");
  says("stations/*.e57", "'stations/*.e57' is a pattern");
  says("[stations/*.las]", "no file fits 'stations/*.las' of 'files'");
  says("[lost.e57]", "no such file");
}

TEST_F(PipelineFile, TakesNamesThatBeginWithABracketOrAQuoteFromTheCommandLine) {
  const auto file = folder.write("p.yaml", R"(atrium: 1
vars: {scan: }
nodes:
  read: {type: test.read, params: {path: "${scan}"}}
outputs: {cloud: read.cloud}
)");
  for (const std::string name : {"[hall] 1.ply", "'t Hof.ply", "\"a\".ply", "[all]"}) {
    const auto scan = folder.write(name, "");
    const std::string given = name == "[all]" ? "\"[all]\"" : name;  // what would be a list is put in quotes
    const LoadResult result = load_pipeline(file, {{"scan=" + given, "here", folder.path()}}, registry);
    ASSERT_TRUE(result.errors.empty()) << messages(result);
    EXPECT_EQ(value(result.pipeline, "read", "path"), ParamValue(text(scan)));
  }
}

TEST_F(PipelineFile, ThatIsResolvedGivesTheSamePipeline) {
  folder.write("scan $.ply", "");
  folder.write("refine.yaml", R"(atrium: 1
inputs: {planes: Planes}
nodes:
  refined: {type: test.refine, in: {planes: inputs.planes}}
  write: {type: test.write, in: {planes: refined.planes}, params: {title: "all: of $${it}"}}
outputs: {planes: refined.planes}
)");
  const LoadResult first = load_text(R"(atrium: 1
summary: "Two: with 'quotes'"
seed: 77
vars: {scan: scan $.ply}
nodes:
  scan: {type: test.read, params: {path: "${scan}"}}
  all: {type: test.join, in: {clouds: [scan.cloud, scan.cloud]}, params: {names: [a, "b, c"], weights: [0.1, 1e-30]}}
  planes: {type: test.find, in: {cloud: all.cloud}, params: {angle: 0.3 rad, distance: 7 mm}}
  shell: {pipeline: refine.yaml, in: {planes: planes.planes}}
outputs: {planes: shell.planes}
)");
  ASSERT_TRUE(first.errors.empty()) << messages(first);
  const std::string resolved = resolved_yaml(first.pipeline);
  const Folder elsewhere;  // nothing in a resolved file depends on where it stands
  const LoadResult second = load(elsewhere.write("resolved.yaml", resolved));
  ASSERT_TRUE(second.errors.empty()) << messages(second) << resolved;
  EXPECT_TRUE(second.warnings.empty());
  EXPECT_EQ(paths(second.pipeline), paths(first.pipeline));
  EXPECT_EQ(second.pipeline[whole].seed, 77U);
  EXPECT_EQ(second.pipeline[whole].summary, "Two: with 'quotes'");
  EXPECT_EQ(value(second.pipeline, "shell/write", "title"), ParamValue(std::string("all: of ${it}")));
  EXPECT_EQ(value(second.pipeline, "shell/write", "path"), ParamValue(std::string("shell/planes.vg")));
  for (std::size_t i = 0; i < node_count(first.pipeline); ++i) {
    EXPECT_EQ(second.pipeline[i].params, first.pipeline[i].params);
    EXPECT_EQ(second.pipeline[i].type, first.pipeline[i].type);
  }
  EXPECT_EQ(resolved_yaml(second.pipeline), resolved);
  EXPECT_TRUE(load(elsewhere.path() / "resolved.yaml", {"shell/write.title=other"}).errors.empty());
}

TEST_F(PipelineFile, TakesSettingsFromTheCommandLine) {
  const LoadResult result =
      load_text(small, {"planes.box=[1 cm, 2, 3]", "distance=1cm", "seed=7", "planes.refit=false"});
  ASSERT_TRUE(result.errors.empty()) << messages(result);
  EXPECT_EQ(result.pipeline[whole].seed, 7U);
  EXPECT_EQ(value(result.pipeline, "planes", "distance"), ParamValue(0.01));
  EXPECT_EQ(value(result.pipeline, "planes", "refit"), ParamValue(false));
  EXPECT_EQ(value(result.pipeline, "planes", "box"), ParamValue(std::vector<double>{0.01, 2, 3}));
  EXPECT_EQ(value(load_text(small, {"planes.distance=3 mm"}).pipeline, "planes", "distance"), ParamValue(0.003));
  EXPECT_EQ(value(load_text(small, {"planes.angle=2"}).pipeline, "planes", "angle"), ParamValue(2.0));
}

TEST_F(PipelineFile, ReplacesANodeTypeAndKeepsItsWiring) {
  const LoadResult result = load_text(small, {"planes.type=test.grow", "planes.voxel=1 cm"});
  ASSERT_TRUE(result.errors.empty()) << messages(result);
  EXPECT_EQ(node(result.pipeline, "planes").type->type, "test.grow");
  EXPECT_EQ(value(result.pipeline, "planes", "distance"), ParamValue(0.02));  // both types have it
  EXPECT_EQ(value(result.pipeline, "planes", "voxel"), ParamValue(0.01));
  ASSERT_EQ(result.warnings.size(), 1U);  // method is test.find's alone
  EXPECT_EQ(result.warnings[0].message, "the parameter 'method' is ignored: test.grow has none of that name");
  EXPECT_TRUE(to_string(result.warnings[0]).find("p.yaml:7:89: warning: ") != std::string::npos)
      << to_string(result.warnings[0]);
}

TEST_F(PipelineFile, KeepsTheFilesParametersWhenATypeIsReplacedByItself) {
  const LoadResult result = load_text(small, {"planes.type=test.find"});
  ASSERT_TRUE(result.errors.empty()) << messages(result);
  EXPECT_TRUE(result.warnings.empty());
}

TEST_F(PipelineFile, MayLeaveWhatItsUserGives) {
  const auto file = folder.write("p.yaml", R"(atrium: 1
vars: {scan: }
inputs: {planes: Planes}
nodes:
  scan: {type: test.read, params: {path: "${scan}"}}
  refined: {type: test.refine, in: {planes: inputs.planes, cloud: scan.cloud}}
outputs: {planes: refined.planes}
)");
  const LoadResult look = load(file, {}, {.allow_missing = true});
  EXPECT_TRUE(look.errors.empty()) << messages(look);
  EXPECT_EQ(look.missing, (std::vector<std::string>{"inputs.planes", "scan"}));
  EXPECT_EQ(node_count(look.pipeline), 2U);
  EXPECT_EQ(load(file).errors.size(), 2U);
  EXPECT_TRUE(load(file, {"scan=" + file.string()}, {.allow_missing = true}).missing ==
              std::vector<std::string>{"inputs.planes"});
}

TEST_F(PipelineFile, OfTenThousandNodesIsOrdered) {
  std::string nodes = "atrium: 1\nnodes:\n";
  constexpr int size = 10000;
  for (int i = size - 1; i > 0; --i)
    nodes += "  n" + std::to_string(i) + ": {type: test.join, in: {clouds: [n" + std::to_string(i - 1) + ".cloud, n" +
             std::to_string(i / 2) + ".cloud]}}\n";
  nodes += "  n0: {type: test.make}\noutputs: {cloud: n" + std::to_string(size - 1) + ".cloud}\n";
  // n1 reads n0 twice: i / 2 is 0 as well.
  const LoadResult result = load_text(nodes);
  ASSERT_TRUE(result.errors.empty()) << result.errors.size() << to_string(result.errors.front());
  ASSERT_EQ(node_count(result.pipeline), static_cast<std::size_t>(size));
  for (std::size_t i = 0; i < node_count(result.pipeline); ++i)
    for (const auto& edge : edges_into(i, result.pipeline)) ASSERT_LT(boost::source(edge, result.pipeline), i);
}

TEST_F(PipelineFile, FullOfMistakesEndsInGoodTime) {
  std::string nodes = "atrium: 1\nnodes:\n";
  for (int i = 0; i < 10000; ++i)
    nodes += "  node_" + std::to_string(i) + ": {type: test.find, in: {cloud: nod_" + std::to_string(i) + ".cloud}}\n";
  EXPECT_EQ(load_text(nodes).errors.size(), 20000U);  // each: unknown node, and nothing uses it
}

TEST_F(PipelineFile, WithAnyBytesNeverBreaksTheLoader) {
  std::ifstream stream(std::string(ATRIUM_SOURCE_DIR) + "/pipelines/paper.yaml", std::ios::binary);
  const std::string paper((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  ASSERT_FALSE(paper.empty());
  Random random(1);
  const std::string special = "{}[]:,&*!|>'\"%@`#-? \n\t$~<=\x01\xff";
  for (int trial = 0; trial < 3000; ++trial) {
    std::string text = trial % 2 == 0 ? small : paper;
    if (trial % 5 == 0) text.resize(random.index(text.size()));
    for (std::uint64_t edits = random.index(6); edits > 0 && !text.empty(); --edits) {
      const std::size_t at = random.index(text.size());
      switch (random.index(4)) {
        case 0: text[at] = static_cast<char>(random.bits()); break;
        case 1: text[at] = special[random.index(special.size())]; break;
        case 2: text.insert(at, 1, special[random.index(special.size())]); break;
        default: text.erase(at, random.index(20));
      }
    }
    const LoadResult result = load_text(text);
    EXPECT_TRUE(!result.errors.empty() || node_count(result.pipeline) > 0) << text;
  }
}

TEST_F(PipelineFile, TakesAnyTextAsASettingWithoutBreaking) {
  Random random(2);
  const std::string alphabet = "planes.distance=${}[]\"' /1cm\xff\n&*";
  const auto file = folder.write("p.yaml", small);
  for (int trial = 0; trial < 3000; ++trial) {
    std::string text = trial % 2 == 0 ? "planes.distance=" : "";
    for (std::uint64_t i = random.index(12); i > 0; --i) text += alphabet[random.index(alphabet.size())];
    load(file, {text});
  }
}

TEST_F(PipelineFile, SaysWhichPluginsAreNotBuilt) {
  const LoadResult result = load_text(R"(atrium: 1
nodes:
  a: {type: refine.vertex_translation}
)");
  EXPECT_NE(messages(result).find("'refine.vertex_translation' is not built: the plugin 'refine' was left out"),
            std::string::npos);
  EXPECT_NE(messages(result).find("./share/build"), std::string::npos);
}

}  // namespace
}  // namespace atrium::pipeline_test
