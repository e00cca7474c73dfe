// `atrium sweep` as its users see it.
#include "graph/api/files.hpp"
#include "tests/pipelines/sweep_case.hpp"

namespace atrium::test::sweep_test {
namespace {

TEST_F(Sweep, RunsAllCombinationsAndPrintsTheirTable) {
  sweep(
      "grid: {second.value: [2, 3]}\nscenes: {near: {start: 1 m}, far: {start: 10 m}}\n"
      "metrics: {sum: number, in cm: {of: number, digits: 2}}\n");
  const auto result = atrium({"run", "s.yaml", "--out", "out", "--quiet"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out,
            "scene  second.value  sum  in cm  status\n"
            "near   2               3   3.00  ok\n"
            "near   3               4   4.00  ok\n"
            "far    2              12  12.00  ok\n"
            "far    3              13  13.00  ok\n");
  EXPECT_EQ(read_text(folder / "out/table.txt"), result.out);
  EXPECT_NE(read_text(folder / "out/table.md").find("| scene | second.value | sum |"), std::string::npos);
  EXPECT_NE(read_text(folder / "out/table.csv").find(",near,2,"), std::string::npos);
}

TEST_F(Sweep, WhatVariantsShareRunsOnceAndEachFolderIsComplete) {
  sweep("grid: {second.value: [2, 3, 4]}\n");
  const auto result = atrium({"run", "s.yaml", "--out", "out", "--quiet"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(executed(), 3U + 3U);  // first, random and write once, second three times
  std::size_t folders = 0;
  for (const auto& variant : fs::directory_iterator(folder / "out/variants")) {
    ++folders;
    EXPECT_EQ(read_text(variant.path() / "sub/value.txt"), "1.000000\n");
    EXPECT_TRUE(fs::exists(variant.path() / "resolved.yaml"));
  }
  EXPECT_EQ(folders, 3U);
}

TEST_F(Sweep, SeedsAreAveragedInTheTable) {
  sweep("seeds: [1, 2, 3]\nmetrics: {random: random, sum: number}\n");
  const auto result = atrium({"run", "s.yaml", "--out", "out", "--quiet"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  // The nodes of the type trial.step say that they draw randomness, and write reads one of them: nothing is shared.
  EXPECT_EQ(executed(), 3U * 4U);
  EXPECT_NE(result.out.find(" ± "), std::string::npos) << result.out;
  EXPECT_EQ(result.out.find("seed"), std::string::npos) << result.out;
  EXPECT_NE(read_text(folder / "out/table.csv").find("seed"), std::string::npos);
}

TEST_F(Sweep, AVariantIsWhatItsOwnFileGives) {
  sweep("grid: {second.value: [2, 3]}\nseeds: [7]\n");
  ASSERT_EQ(atrium({"run", "s.yaml", "--out", "out", "--quiet"}).exit_code, 0);
  for (const auto& variant : fs::directory_iterator(folder / "out/variants")) {
    ProcessOptions options;
    options.folder = folder.path();
    options.environment.push_back("ATRIUM_PLUGIN_PATH=" ATRIUM_TRIAL_PLUGIN);
    const std::string alone = (folder / ("alone-" + variant.path().filename().string())).string();
    const auto result = run_process(
        {ATRIUM_PROGRAM, "run", (variant.path() / "resolved.yaml").string(), "--quiet", "--json", "--out", alone},
        options);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const json recorded = json::parse(read_text(variant.path() / "result.json"));
    const json run = json::parse(result.out).at("outputs");
    ASSERT_EQ(recorded.at("outputs").size(), run.size());
    for (const auto& output : recorded.at("outputs"))
      EXPECT_EQ(output.at("facts")[0].at("value"), run.at(output.at("name").get<std::string>()).at("value"));
    EXPECT_EQ(read_text(variant.path() / "sub/value.txt"), read_text(fs::path(alone) / "sub/value.txt"));
    const json manifest = json::parse(read_text(fs::path(alone) / "manifest.json"));
    ASSERT_EQ(recorded.at("nodes").size(), manifest.at("nodes").size());
    for (std::size_t n = 0; n < manifest.at("nodes").size(); ++n) {
      const json& node = recorded.at("nodes")[n];
      EXPECT_EQ(node.at("node"), manifest.at("nodes")[n].at("node"));
      EXPECT_EQ(node.at("outputs"), manifest.at("nodes")[n].at("outputs"));
      for (const auto& output : node.at("outputs")) EXPECT_EQ(output.at("hash").get<std::string>().size(), 32U);
    }
    EXPECT_EQ(manifest.at("outputs").at("number").at("facts"), recorded.at("outputs")[1].at("facts"));
  }
}

TEST_F(Sweep, TheFolderSaysWhatWasVaried) {
  sweep(
      "summary: Two by two.\ngrid: {second.value: [2, 3]}\nscenes: {near: {start: 1 m}, far: {start: 10 m}}\n"
      "metrics: {sum: number, in cm: {of: number, digits: 2}}\n");
  ASSERT_EQ(atrium({"run", "s.yaml", "--out", "out", "--quiet"}).exit_code, 0);
  const json recorded = json::parse(read_text(folder / "out/sweep.json"));
  EXPECT_EQ(recorded.at("summary"), "Two by two.");
  EXPECT_EQ(recorded.at("axes"),
            json::parse(R"([{"name": "scene", "choices": [{"label": "near", "set": {"start": "1 m"}},
                                                          {"label": "far", "set": {"start": "10 m"}}]},
                            {"name": "second.value", "choices": [{"label": "2", "set": {"second.value": "2"}},
                                                                 {"label": "3", "set": {"second.value": "3"}}]}])"));
  EXPECT_EQ(recorded.at("metrics"), json::parse(R"([{"name": "sum"}, {"name": "in cm", "digits": 2}])"));
}

TEST_F(Sweep, AVariantThatFailsCostsTheOthersNothing) {
  sweep("list: {good: {}, bad: {second.mode: fail}, other: {second.value: 5}}\nmetrics: {sum: number}\n");
  const auto result = atrium({"run", "s.yaml", "--out", "out", "--quiet"});
  EXPECT_EQ(result.exit_code, 4) << result.err;
  EXPECT_NE(result.out.find("good       3  ok"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("bad        –  failed: second:"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("other      6  ok"), std::string::npos) << result.out;
  sweep("list: {bad: {second.mode: fail}}\n");
  EXPECT_EQ(atrium({"run", "s.yaml", "--out", "all-bad", "--quiet"}).exit_code, 1);
}

TEST_F(Sweep, EndsWhenEnoughHaveFailed) {
  sweep("set: {second.mode: fail}\ngrid: {second.value: [1, 2, 3, 4, 5, 6, 7, 8]}\nmetrics: {sum: number}\n");
  const auto result = atrium({"run", "s.yaml", "--out", "out", "--quiet", "-j", "1", "--max-fail", "2"});
  EXPECT_EQ(result.exit_code, 4) << result.err;
  std::size_t cancelled = 0;
  for (std::size_t at = 0; (at = result.out.find("cancelled", at)) != std::string::npos; ++at) ++cancelled;
  EXPECT_EQ(cancelled, 6U) << result.out;
}

TEST_F(Sweep, AxesOfAllKinds) {
  sweep(R"(zip: {first.value: [1, 2], second.value: [3, 4]}
ablate: {no_second: {second.value: 0.5}}
)");
  EXPECT_NE(atrium({"plan", "s.yaml"}).exit_code, 0);  // two axes set the same parameter
  sweep(R"(zip: {first.value: [1, 2], second.value: [3, 4]}
ablate: {off: {random.value: 3}}
random: {samples: 3, seed: 4, of: {write.path: {choice: [a.txt, b.txt]}}}
exclude: [{ablation: off, second.value: 4}]
)");
  const auto plan = atrium({"plan", "s.yaml", "--json"});
  ASSERT_EQ(plan.exit_code, 0) << plan.err;
  const json report = json::parse(plan.out);
  EXPECT_EQ(report.at("excluded"), 3);
  EXPECT_EQ(report.at("variants").size() + report.at("duplicates").get<std::size_t>(), 9U);
  EXPECT_GE(report.at("duplicates"), 3);  // three samples of two choices
}

TEST_F(Sweep, WhatAKilledSweepLeftUnfinishedIsRemoved) {
  sweep("grid: {second.value: [2, 3]}\n");
  ASSERT_EQ(atrium({"run", "s.yaml", "--out", "out", "--quiet"}).exit_code, 0);
  const auto left = folder.path() / "out" / unfinished_file_name("sweep.json"), mine = folder / "out/.mine.part";
  write_text(left, "{");
  write_text(mine, "not of Atrium");
  ASSERT_EQ(atrium({"run", "s.yaml", "--out", "out", "--quiet"}).exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(left));
  EXPECT_TRUE(std::filesystem::exists(mine));
}

TEST_F(Sweep, ListsAreNotDrawnByChance) {
  sweep("random: {samples: 2, of: {second.value: {choice: [[1, 2], [3]]}}}\n");
  const auto plan = atrium({"plan", "s.yaml"});
  EXPECT_EQ(plan.exit_code, 3);
  EXPECT_NE(plan.err.find("a choice that is not a single value"), std::string::npos) << plan.err;
}

TEST_F(Sweep, RandomSamplesStayWhenMoreAreDrawn) {
  const auto of = [](int samples) {
    return "random: {samples: " + std::to_string(samples) + ", of: {second.value: {loguniform: [1 mm, 1000 mm]}}}\n";
  };
  sweep(of(5));
  const auto few = ids();
  sweep(of(8));
  const auto more = ids();
  EXPECT_EQ(few.size(), 5U);
  EXPECT_EQ(more.size(), 8U);
  for (const auto& id : few) EXPECT_TRUE(more.contains(id));
}

struct Mistake {
  std::string name, file, message;
};
class SweepMistake : public Sweep, public testing::WithParamInterface<Mistake> {};
TEST_P(SweepMistake, IsSaidWithItsPlaceBeforeAnythingRuns) {
  sweep(GetParam().file);
  const auto result = atrium({"run", "s.yaml", "--out", "out"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_NE(result.err.find(GetParam().message), std::string::npos) << result.err;
  EXPECT_FALSE(fs::exists(folder / "out"));
}
INSTANTIATE_TEST_SUITE_P(
    Files, SweepMistake,
    testing::Values(
        Mistake{"key", "gird: {second.value: [1]}\n",
                "s.yaml:3:1: error: unknown key 'gird' in a sweep file\n  help: did you mean 'grid'?"},
        Mistake{"parameter", "grid: {second.valeu: [1, 2]}\n", "note: set by s.yaml:3:23"},
        Mistake{"node", "grid: {secnd.value: [1, 2]}\n", "error: unknown node 'secnd'"},
        Mistake{"value", "grid: {second.value: [1, 2 deg]}\n", "'2 deg' is an angle, but 'value' is a length"},
        Mistake{"list", "grid: {second.value: 3}\n", "s.yaml:3:22: error: 'second.value' must be a list of values"},
        Mistake{"zip", "zip: {first.value: [1, 2], second.value: [1]}\n",
                "s.yaml:3:28: error: 'second.value' has 1 values, but the first of the zip has 2"},
        Mistake{"twice", "grid: {second.value: [1]}\nset: {second.value: 2}\n",
                "'second.value' is set by 'set' and by 'second.value'"},
        Mistake{"metric", "metrics: {sum: nmuber}\n",
                "s.yaml:3:11: error: base.yaml has no output 'nmuber'\n  help: did you mean 'number'?"},
        Mistake{"cost", "metrics: {time: {seconds: secnd}}\n", "a variant has no node 'secnd'"},
        Mistake{"exclude", "grid: {second.value: [1]}\nexclude: [{secnd.value: 1}]\n",
                "'exclude' names 'secnd.value', which the sweep does not vary"},
        Mistake{"excludes_nothing", "grid: {second.value: [1]}\nexclude: [{second.value: 7}]\n",
                "this exclusion excludes nothing"},
        Mistake{"all_excluded", "grid: {second.value: [1]}\nexclude: [{second.value: 1}]\n", "no variant is left"},
        Mistake{"distribution", "random: {samples: 2, of: {second.value: {normal: [0, 1]}}}\n",
                "'second.value' is not drawn from a distribution"},
        Mistake{"units", "random: {samples: 2, of: {second.value: {uniform: [1 cm, 1 m]}}}\n",
                "has bounds in different units"},
        Mistake{"pipeline", "nodes: {}\n", "unknown key 'nodes' in a sweep file"},
        Mistake{"sheet", "pictures: {../a.png: b.png}\n", "'../a.png' cannot be the file of a sheet"},
        Mistake{"sheet_name", "pictures: {table.csv: b.png}\n", "'table.csv' cannot be the file of a sheet"},
        Mistake{"base", "grid: {}\n", "'grid' must be a mapping that is not empty"}),
    [](const auto& mistake) { return mistake.param.name; });

TEST_F(Sweep, FilesOfTheOtherKindAreToldApart) {
  sweep("grid: {second.value: [2, 3]}\n");
  EXPECT_NE(atrium({"run", "base.yaml"}).err.find("this is a pipeline, not a sweep file"), std::string::npos);
  ProcessOptions options;
  options.folder = folder.path();
  const auto check = run_process({ATRIUM_PROGRAM, "check", "s.yaml"}, options);
  EXPECT_NE(check.err.find("this is a sweep file, not a pipeline"), std::string::npos) << check.err;
}

TEST_F(Sweep, AScriptReadsNumbersAsNumbers) {
  sweep("grid: {second.value: [2, 3]}\nmetrics: {sum: number, text: text}\n");
  const auto result = atrium({"run", "s.yaml", "--out", "out", "--quiet", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json variants = json::parse(result.out).at("variants");
  ASSERT_EQ(variants.size(), 2U);
  for (const auto& variant : variants) {
    EXPECT_TRUE(variant.at("sum").is_number()) << variant;
    EXPECT_EQ(variant.at("label"), "second.value = " + variant.at("second.value").get<std::string>());
    const fs::path link = folder / "out/by_label" / ("value " + variant.at("second.value").get<std::string>());
    EXPECT_EQ(fs::read_symlink(link), fs::path("../variants") / variant.at("id").get<std::string>());
  }
}

TEST_F(Sweep, EachFileOfAFolderIsAScene) {
  fs::create_directories(folder / "scans");
  for (const char* name : {"b.txt", "a.txt", ".hidden.txt", "c.log"}) write_text(folder / "scans" / name, "");
  const auto scenes = [&](const std::string& files) {
    sweep("scenes: {write.path: " + files + "}\n");
    const auto plan = atrium({"plan", "s.yaml", "--json"});
    std::vector<std::string> labels;
    if (plan.exit_code != 0) return std::vector{plan.err};
    const json report = json::parse(plan.out);
    for (const auto& variant : report.at("variants")) labels.push_back(variant.at("variant"));
    return labels;
  };
  // The base has no input file: what is set is refused, but for each file, and says which it is.
  const auto refused = scenes("scans/*.txt").front();
  EXPECT_NE(refused.find("/scans/a.txt"), std::string::npos) << refused;
  EXPECT_EQ(refused.find("hidden"), std::string::npos) << refused;
  EXPECT_EQ(refused.find("c.log"), std::string::npos) << refused;
  EXPECT_NE(scenes("scans").front().find("/scans/c.log"), std::string::npos);
  EXPECT_NE(scenes("nowhere/*").front().find("no file fits 'nowhere/*'"), std::string::npos);
}

// A variant's id says what it computes: it stays when the sweep grows, and when all of it stands elsewhere.
TEST_F(Sweep, IdsStayWhenACheckoutMoves) {
  const TemporaryFolder other;
  const auto in = [&](const fs::path& place) {
    write_text(place / "scan.xyz", "0 0 0\n");
    write_text(place / "read.yaml",
               "atrium: 1\nvars: {scan: scan.xyz}\nnodes:\n  scan: {type: io.read_scan, params: {path: \"${scan}\"}}\n"
               "outputs: {scan: scan.cloud}\n");
    write_text(place / "ids.yaml", "atrium: 1\nsweep: read.yaml\nseeds: [1, 2]\n");
    ProcessOptions options;
    options.folder = place;
    const auto plan = run_process({ATRIUM_PROGRAM, "sweep", "plan", "ids.yaml", "--json"}, options);
    EXPECT_EQ(plan.exit_code, 0) << plan.err;
    std::vector<std::string> found;
    if (plan.exit_code == 0)
      for (const auto& variant : json::parse(plan.out).at("variants")) found.push_back(variant.at("id"));
    return found;
  };
  EXPECT_EQ(in(folder.path()), in(other.path()));
}

TEST_F(Sweep, ForeignFoldersAreRefusedAndKept) {
  sweep("grid: {second.value: [2, 3]}\n");
  fs::create_directories(folder / "mine");
  write_text(folder / "mine/table.csv", "a,b");
  const auto refused = atrium({"run", "s.yaml", "--out", "mine"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("is not the folder of a sweep"), std::string::npos) << refused.err;
  EXPECT_EQ(read_text(folder / "mine/table.csv"), "a,b");
  // And a run does not take the folder of a sweep.
  ASSERT_EQ(atrium({"run", "s.yaml", "--out", "out", "--quiet"}).exit_code, 0);
  const std::string table = read_text(folder / "out/table.csv");
  ProcessOptions options;
  options.folder = folder.path();
  options.environment.push_back("ATRIUM_PLUGIN_PATH=" ATRIUM_TRIAL_PLUGIN);
  const auto run = run_process({ATRIUM_PROGRAM, "run", "base.yaml", "--out", "out"}, options);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find("is the folder of a sweep"), std::string::npos) << run.err;
  EXPECT_EQ(read_text(folder / "out/table.csv"), table);
}

TEST_F(Sweep, WhatIsVariedCannotBeSet) {
  sweep("grid: {second.value: [2, 3]}\n");
  const auto result = atrium({"run", "s.yaml", "--out", "out", "-s", "second.value=7"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_NE(result.err.find("'second.value' is varied by the sweep and cannot be set"), std::string::npos)
      << result.err;
  EXPECT_EQ(atrium({"run", "s.yaml", "--out", "out", "-q", "-s", "first.value=7"}).exit_code, 0);
}

TEST_F(Sweep, PicturesOfAllVariantsStandOnOneSheet) {
  write_text(folder / "drawn.yaml", R"(atrium: 1
nodes:
  room: {type: synth.room}
  scan: {type: synth.scan, in: {scene: room.scene}, params: {points: 20000}}
  look: {type: render.snapshot, in: {cloud: scan.cloud}, params: {path: look.png, width: 160, height: 120}}
outputs: {cloud: scan.cloud}
)");
  write_text(
      folder / "s.yaml",
      "atrium: 1\nsweep: drawn.yaml\nlist: {white: {}, black: {look.background: black}, broken: {scan.points: 1}}\n"
      "pictures: {sheet.png: {picture: look.png, columns: 2, cell_width: 100}}\n");
  const auto result = atrium({"run", "s.yaml", "--out", "out", "--quiet"});
  EXPECT_TRUE(result.exit_code == 0 || result.exit_code == 4) << result.err;
  EXPECT_GT(read_text(folder / "out/sheet.png").size(), 1000U);
  // Other seeds add no pictures: the sheet keeps its size (bytes 16 to 23 of a PNG).
  write_text(folder / "seeds.yaml", read_text(folder / "s.yaml") + "seeds: [1, 2]\n");
  atrium({"run", "seeds.yaml", "--out", "seeds", "--quiet"});
  const std::string more = read_text(folder / "seeds/sheet.png");
  ASSERT_GT(more.size(), 1000U);
  EXPECT_EQ(more.substr(16, 8), read_text(folder / "out/sheet.png").substr(16, 8));
}

}  // namespace
}  // namespace atrium::test::sweep_test
