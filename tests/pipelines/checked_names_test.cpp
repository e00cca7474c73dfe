// Names that are wrong are errors before anything runs.
#include "tests/pipelines/steps.hpp"
#include "tests/pipelines/sweep_case.hpp"

namespace atrium::test::checked_names_test {
namespace {

TEST(CheckedNames, ACoordinateSystemThatIsNoneIsFoundBeforeTheRun) {
  TemporaryFolder folder;
  write_text(folder / "scan.ply", "no scan at all: nothing has read it");
  const std::string scan = "scan=" + (folder / "scan.ply").string();
  for (const std::string verb : {"check", "run"}) {
    std::vector<std::string> words{verb, "pipelines/atrium.yaml", "-s", scan, "-s", "crs=EPSG:25832x"};
    if (verb == "run") words.insert(words.end(), {"--out", (folder / "out").string()});
    const auto wrong = atrium(words);
    EXPECT_EQ(wrong.exit_code, 3) << verb << wrong.err;
    EXPECT_NE(wrong.err.find("'EPSG:25832x' names no coordinate reference system\n  help: write it as EPSG:25832, with "
                             "the number"),
              std::string::npos)
        << wrong.err;
    EXPECT_NE(wrong.err.find("note: set by"), std::string::npos) << wrong.err;
  }
  EXPECT_FALSE(fs::exists(folder / "out/manifest.json"));
  const auto degrees = atrium({"check", "pipelines/atrium.yaml", "-s", scan, "-s", "write_ifc.crs=EPSG:4326"});
  EXPECT_EQ(degrees.exit_code, 3) << degrees.err;
  EXPECT_NE(degrees.err.find("EPSG:4326 counts in degrees, the model in metres"), std::string::npos) << degrees.err;
  const auto right = atrium({"check", "pipelines/atrium.yaml", "-s", scan, "-s", "crs=urn:ogc:def:crs:EPSG::25832"});
  EXPECT_EQ(right.exit_code, 0) << right.err;
}

struct Mistake {
  const char* name;
  const char* rest;
  const char* says;
};
class ShownNames : public Sweep, public testing::WithParamInterface<Mistake> {};

TEST_P(ShownNames, AreCheckedBeforeAnythingRuns) {
  write_text(folder / "drawn.yaml", R"(atrium: 1
nodes:
  room: {type: synth.room}
  scan: {type: synth.scan, in: {scene: room.scene}, params: {points: 20000}}
  look: {type: render.snapshot, in: {cloud: scan.cloud}, params: {path: views/look.png, width: 160, height: 120}}
  plain: {type: trial.step}
outputs: {cloud: scan.cloud, number: plain.value, text: plain.text}
)");
  write_text(folder / "s.yaml", std::string("atrium: 1\nsweep: drawn.yaml\n") + GetParam().rest);
  for (const std::string verb : {"plan", "run"}) {
    const auto result = atrium({verb, "s.yaml", "--out", "out"});
    EXPECT_EQ(result.exit_code, 3) << verb << result.err;
    EXPECT_NE(result.err.find(GetParam().says), std::string::npos) << result.err;
  }
  EXPECT_FALSE(fs::exists(folder / "out/variants"));
}
INSTANTIATE_TEST_SUITE_P(
    Files, ShownNames,
    testing::Values(
        Mistake{"picture", "pictures: {sheet.png: views/lok.png}\n",
                "s.yaml:3:12: error: no variant writes the picture 'views/lok.png'\n  help: did you mean "
                "'views/look.png'?"},
        Mistake{"other_picture", "pictures: {sheet.png: {picture: nothing.png, columns: 2}}\n",
                "no variant writes the picture 'nothing.png'\n  help: their pictures: views/look.png"},
        Mistake{"node", "metrics: {time: {seconds: plian}}\n",
                "a variant has no node 'plian'\n  help: did you mean 'plain'?"},
        Mistake{"single", "metrics: {sum: number.mean}\n",
                "the output 'number' is a single value: it has no metric 'mean'\n  help: write `sum: number`"},
        Mistake{"text", "metrics: {word: text.mean}\n", "the output 'text' is a text: it has no metric 'mean'"},
        Mistake{"unit", "metrics: {size: {of: number, unit: MM}}\n",
                "'size' cannot be shown in 'MM'\n  help: did you mean 'mm'?"},
        Mistake{"unit_of_time", "metrics: {time: {seconds: plain, unit: mm}}\n",
                "'time' cannot be shown in 'mm'\n  help: one of s, ms, min"}),
    [](const auto& mistake) { return mistake.param.name; });

/// Only a computed output shows what it has.
TEST_F(Sweep, AMetricThatNoVariantShowsNamesTheOneThatIsMeant) {
  write_text(folder / "mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write_text(folder / "base.yaml", R"(atrium: 1
nodes:
  mesh: {type: io.read_mesh, params: {path: mesh.obj}}
  sound: {type: metric.validity, in: {mesh: mesh.mesh}}
outputs: {sound: sound.metrics}
)");
  sweep("metrics: {parts: sound.validity.componets}\n");
  const auto result = atrium({"run", "s.yaml", "--out", "out", "--quiet"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("no variant has the metric 'parts' (sound.validity.componets); did you mean "
                            "'sound.validity.components.all'?"),
            std::string::npos)
      << result.err;
}

TEST_F(Sweep, APictureOfSomeVariantsIsEnough) {
  write_text(folder / "base.yaml", R"(atrium: 1
vars: {file: a.png}
nodes:
  room: {type: synth.room}
  scan: {type: synth.scan, in: {scene: room.scene}, params: {points: 20000}}
  look: {type: render.snapshot, in: {cloud: scan.cloud}, params: {path: "${file}", width: 160, height: 120}}
)");
  sweep("grid: {file: [a.png, b.png]}\npictures: {sheet.png: b.png}\n");
  const auto result = atrium({"plan", "s.yaml"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

}  // namespace
}  // namespace atrium::test::checked_names_test
