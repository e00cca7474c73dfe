// Pipelines in pipelines: their inputs, defaults, variables, and nodes that are swapped for a file.
#include "tests/graph/pipeline_file.hpp"

namespace atrium::sub_pipeline_test {
namespace {

class SubPipeline : public test::PipelineFile {};

TEST_F(SubPipeline, OpensSubPipelines) {
  folder.write("refine.yaml", R"(atrium: 1
vars: {title: inner, unit: 3 cm}
inputs: {planes: Planes, cloud: Cloud}
nodes:
  again: {type: test.find, in: {cloud: inputs.cloud}, params: {distance: "${unit}"}}
  refined: {type: test.refine, in: {planes: inputs.planes}}
  write: {type: test.write, in: {planes: refined.planes}, params: {title: "${title}", path: out/p.vg}}
outputs: {planes: refined.planes, again: again.planes, cloud: inputs.cloud}
)");
  folder.write("twice.yaml", R"(atrium: 1
inputs: {cloud: Cloud}
nodes:
  planes: {type: test.find, in: {cloud: inputs.cloud}}
  one: {pipeline: refine.yaml, in: {planes: planes.planes, cloud: inputs.cloud}, vars: {title: one}}
  two: {pipeline: refine.yaml, in: {planes: one.planes, cloud: one.cloud}}
outputs: {planes: two.planes, again: two.again}
)");
  const LoadResult result = load_text(R"(atrium: 1
nodes:
  all: {pipeline: twice.yaml, in: {cloud: cloud.cloud}}
  cloud: {type: test.make}
  write: {type: test.write, in: {planes: all.again}}
outputs: {planes: all.planes}
)",
                                      {"all/two.unit=4 cm", "all/one.title=first"});
  ASSERT_TRUE(result.errors.empty()) << messages(result);
  const Pipeline& pipeline = result.pipeline;
  // all/one/again is exported by its file, but nobody reads it.
  EXPECT_EQ(paths(pipeline), (std::vector<std::string>{"cloud", "all/planes", "all/one/refined", "all/one/write",
                                                       "all/two/again", "all/two/refined", "all/two/write", "write"}));
  EXPECT_EQ(value(pipeline, "all/one/write", "title"), ParamValue(std::string("first")));
  EXPECT_EQ(value(pipeline, "all/two/write", "title"), ParamValue(std::string("inner")));
  EXPECT_EQ(value(pipeline, "all/two/again", "distance"), ParamValue(0.04));
  EXPECT_EQ(value(pipeline, "all/one/write", "path"), ParamValue(std::string("all/one/out/p.vg")));
  const auto from = [&](const std::string& path) {
    return pipeline[inputs_of(index(pipeline, path), pipeline).at(0).at(0).node].path;
  };
  EXPECT_EQ(from("all/two/again"), "cloud");
  EXPECT_EQ(from("all/two/refined"), "all/one/refined");
  EXPECT_EQ(from("write"), "all/two/again");
  EXPECT_EQ(pipeline[pipeline[whole].outputs[0].from.node].path, "all/two/refined");
}

TEST_F(SubPipeline, WhatOnlyAnUnusedInputWantsIsLeftOut) {
  const std::string text = R"(atrium: 1
nodes:
  cloud: {type: test.make}
  grown: {type: test.grow, in: {cloud: cloud.cloud}}
  first: {type: test.make}
  joined: {type: test.join, in: {clouds: [first.cloud, cloud.cloud]}}
  found: {type: test.find, in: {cloud: joined.cloud}}
outputs: {planes: found.planes, grown: grown.planes}
)";
  const std::vector<std::string> all{"cloud", "grown", "first", "joined", "found"};
  EXPECT_EQ(paths(load_text(text).pipeline), all);
  const LoadResult result = load_text(text, {"found.type=test.leave"});
  ASSERT_TRUE(result.errors.empty()) << messages(result);
  EXPECT_TRUE(result.warnings.empty());
  EXPECT_EQ(paths(result.pipeline), (std::vector<std::string>{"cloud", "grown", "found"}));
  EXPECT_TRUE(inputs_of(index(result.pipeline, "found"), result.pipeline).at(0).empty());

  // It is checked all the same, and what is set of a node that does not run is told.
  EXPECT_FALSE(load_text("atrium: 1\nnodes:\n  a: {type: test.make}\n  b: {type: test.grow, in: {cloud: a.cloud}}\n"
                         "  c: {type: test.leave, in: {cloud: b.planes}}\noutputs: {planes: c.planes}\n")
                   .errors.empty());
  const LoadResult set = load_text(text, {"found.type=test.leave", "joined.weights=[1, 2]"});
  ASSERT_TRUE(set.errors.empty()) << messages(set);
  ASSERT_EQ(set.warnings.size(), 1U);
  EXPECT_NE(to_string(set.warnings[0]).find("'joined' does not run"), std::string::npos);

  const LoadResult again = load(folder.write("again.yaml", resolved_yaml(result.pipeline)));
  ASSERT_TRUE(again.errors.empty()) << messages(again);
  EXPECT_EQ(paths(again.pipeline), paths(result.pipeline));
}

TEST_F(SubPipeline, WhoseSubPipelinesMultiplyEnds) {
  std::string open = "atrium: 1\nnodes:\n";
  for (int i = 0; i < 20; ++i)
    folder.write("level" + std::to_string(i) + ".yaml",
                 "atrium: 1\nnodes:\n  a: {pipeline: level" + std::to_string(i + 1) + ".yaml}\n  b: {pipeline: level" +
                     std::to_string(i + 1) + ".yaml}\noutputs: {a: a.a, b: b.a}\n");
  folder.write("level20.yaml", "atrium: 1\nnodes: {c: {type: test.make}}\noutputs: {a: c.cloud}\n");
  const LoadResult result = load(folder.path() / "level0.yaml");
  ASSERT_FALSE(result.errors.empty());
  EXPECT_NE(messages(result).find("the pipeline has more than 20000 sub-pipelines"), std::string::npos);
}

/// Whatever is in a file: the loader comes back, and says something about it or gives a pipeline.
constexpr const char* with_default = R"(atrium: 1
vars: {scan: }
inputs: {cloud: {type: Cloud, default: scan.cloud}}
nodes:
  scan: {type: test.read, params: {path: "${scan}"}}
  planes: {type: test.find, in: {cloud: inputs.cloud}}
outputs: {planes: planes.planes}
)";

TEST_F(SubPipeline, AnInputWithADefaultLetsTheFileRunOnItsOwn) {
  folder.write("sub.yaml", with_default);
  const LoadResult alone = load(folder.path() / "sub.yaml", {"scan=" + (folder.path() / "sub.yaml").string()});
  ASSERT_TRUE(alone.errors.empty()) << messages(alone);
  ASSERT_EQ(node_count(alone.pipeline), 2U);
  EXPECT_EQ(inputs_of(1, alone.pipeline)[0][0].node, 0U);
  EXPECT_FALSE(load(folder.path() / "sub.yaml").errors.empty());  // scan has no value
}

TEST_F(SubPipeline, TheDefaultOfAWiredInputIsLeftOut) {
  folder.write("sub.yaml", with_default);
  const LoadResult loaded = load(folder.write("p.yaml", R"(atrium: 1
nodes:
  cloud: {type: test.make}
  sub: {pipeline: sub.yaml, in: {cloud: cloud.cloud}}
outputs: {planes: sub.planes}
)"));
  ASSERT_TRUE(loaded.errors.empty()) << messages(loaded);
  ASSERT_EQ(node_count(loaded.pipeline), 2U);
  EXPECT_EQ(loaded.pipeline[0].path, "cloud");
  EXPECT_EQ(loaded.pipeline[1].path, "sub/planes");
}

TEST_F(SubPipeline, ANodeIsSwappedForASubPipeline) {
  const auto sub = folder.write("sub.yaml", with_default);
  const auto file = folder.write("p.yaml", R"(atrium: 1
nodes:
  cloud: {type: test.make}
  found: {type: test.find, in: {cloud: cloud.cloud}, params: {distance: 3 cm}}
outputs: {planes: found.planes}
)");
  const LoadResult loaded = load(file, {"found.pipeline=" + sub.string(), "found/planes.distance=4 cm"});
  ASSERT_TRUE(loaded.errors.empty()) << messages(loaded);
  ASSERT_EQ(node_count(loaded.pipeline), 2U);
  EXPECT_EQ(loaded.pipeline[1].path, "found/planes");
  // Relative paths of a setting are meant from its own folder.
  const LoadResult again = load_pipeline(file, {{"found.pipeline=sub.yaml", "here", folder.path()}}, registry);
  EXPECT_TRUE(again.errors.empty()) << messages(again);
}

}  // namespace
}  // namespace atrium::sub_pipeline_test
