// The JSON schemas in share/schema: what is in the tree and what runs leave is valid, and mistakes are not.
#include <gtest/gtest.h>

#include "tests/pipelines/cache_of_runs.hpp"
#include "tests/pipelines/steps.hpp"
#include "tests/support/lacking.hpp"

namespace atrium::test::schemas_test {
namespace {

struct Mistake {
  std::string find, replace;  ///< in a text that is valid
  std::string place;          ///< where the schema has a complaint, as tests/validate-json writes it
};

class Schemas : public CacheOfRuns {
 protected:
  void SetUp() override {
    const auto usage = run_validator("validate-json", {});
    if (usage.exit_code == 77) ATRIUM_SKIP_LACKING(usage.err);
  }
  static ProcessResult validate(const std::string& schema, std::vector<std::string> files) {
    files.insert(files.begin(), source / "share/schema" / (schema + ".schema.json"));
    return run_validator("validate-json", files);
  }
  static void expect_valid(const std::string& schema, const std::vector<std::string>& files) {
    ASSERT_FALSE(files.empty());
    const auto result = validate(schema, files);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.out, "");
  }
  void expect_refused(const std::string& schema, const std::string& valid, const std::vector<Mistake>& mistakes,
                      const std::string& ending) {
    std::vector<std::string> files{folder / ("valid" + ending)};
    write_text(files[0], valid);
    expect_valid(schema, files);
    files.clear();
    for (const auto& mistake : mistakes) {
      const std::size_t at = valid.find(mistake.find);
      ASSERT_NE(at, std::string::npos) << mistake.find;
      files.push_back(folder / (std::to_string(files.size()) + ending));
      write_text(files.back(), std::string(valid).replace(at, mistake.find.size(), mistake.replace));
    }
    const auto result = validate(schema, files);
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(result.err, "");
    for (std::size_t i = 0; i < files.size(); ++i)
      EXPECT_NE(("\n" + result.out).find("\n" + files[i] + ": " + mistakes[i].place + ": "), std::string::npos)
          << mistakes[i].find << " -> " << mistakes[i].replace << "\n"
          << result.out;
  }
  /// `atrium run step.yaml --out NAME` of three steps, the second of which does what `mode` says.
  ProcessResult run_step(const std::string& name, const std::string& mode, const ProcessOptions& options = {}) {
    write_text(folder / "step.yaml", R"(atrium: 1
nodes:
  first: {type: trial.step, params: {value: 0}}
  second: {type: trial.step, in: {after: first.value}, params: {mode: )" +
                                         mode +
                                         R"(}}
  third: {type: trial.step, in: {after: second.value}}
  write: {type: trial.write, in: {value: first.value}, params: {path: sub/value.txt}}
outputs: {number: first.value, text: third.text}
)");
    return atrium({"run", "step.yaml", "--out", name, "-j", "1"}, options);
  }
  /// Sends SIGINT each time that the program says the next of the texts.
  static ProcessOptions interrupt_at(const std::vector<std::string>& texts) {
    ProcessOptions options;
    options.watch = [texts, sent = std::size_t{0}](pid_t process, const std::string& err) mutable {
      if (sent >= texts.size() || err.find(texts[sent]) == std::string::npos) return;
      ++sent;
      ::kill(process, SIGINT);
    };
    return options;
  }
};

TEST_F(Schemas, PipelinesAndSweepsOfTheTreeAreValid) {
  std::vector<std::string> pipelines, sweeps;
  for (const auto& entry : fs::recursive_directory_iterator(source / "pipelines")) {
    if (entry.path().extension() != ".yaml") continue;
    const bool is_sweep = ("\n" + read_text(entry.path())).find("\nsweep:") != std::string::npos;
    (is_sweep ? sweeps : pipelines).push_back(entry.path());
  }
  EXPECT_GT(pipelines.size(), 10U);
  EXPECT_GT(sweeps.size(), 5U);
  expect_valid("pipeline", pipelines);
  expect_valid("sweep", sweeps);
}

TEST_F(Schemas, MistakesInPipelinesAreFound) {
  expect_refused("pipeline", R"(atrium: 1
seed: 1
vars: {scan: }
nodes:
  scan: {type: io.read_scan, params: {path: "${scan}", unit: auto, spacing: 3 cm}}
  grid: {type: filter.voxel_grid, in: {cloud: scan.cloud}, params: {size: 2 cm}}
  write: {type: io.write_cloud, in: {cloud: grid.cloud}, params: {path: thin.ply}}
  part: {pipeline: part.yaml, in: {cloud: grid.cloud}}
outputs: {cloud: grid.cloud}
)",
                 {{"atrium: 1", "atrium: 2", "atrium"},
                  {"atrium: 1\n", "", "."},
                  {"seed: 1", "seed: -1", "seed"},
                  {"vars:", "variables:", "."},
                  {"filter.voxel_grid", "filter.voxel_gird", "nodes/grid/type"},
                  {"size: 2 cm", "sise: 2 cm", "nodes/grid/params"},
                  {"size: 2 cm", "size: 2 kg", "nodes/grid/params/size"},
                  {"size: 2 cm", "size: -1", "nodes/grid/params/size"},
                  {"size: 2 cm", "size: [1, 2]", "nodes/grid/params/size"},
                  {"unit: auto", "unit: yard", "nodes/scan/params/unit"},
                  {"path: \"${scan}\", ", "", "nodes/scan/params"},
                  {"in: {cloud: scan.cloud}", "in: {clouds: scan.cloud}", "nodes/grid/in"},
                  {", in: {cloud: scan.cloud}", "", "nodes/grid"},
                  {"cloud: scan.cloud", "cloud: scan", "nodes/grid/in/cloud"},
                  {"  grid: {", "  Grid: {", "nodes"},
                  {"pipeline: part.yaml, ", "pipeline: part.yaml, params: {}, ", "nodes/part"},
                  {"outputs: {cloud: grid.cloud}", "outputs: {cloud: grid}", "outputs/cloud"}},
                 ".yaml");
}

TEST_F(Schemas, MistakesInSweepsAreFound) {
  expect_refused("sweep", R"(atrium: 1
sweep: p.yaml
scenes: {flat: {scan: flat.ply}}
grid: {planes.distance: [1 cm, 2 cm]}
random: {samples: 3, of: {planes.angle: {uniform: [1 deg, 5 deg]}}}
seeds: [1, 2]
metrics: {RMSE: {of: distance.rms, unit: mm, digits: 2}}
pictures: {sheet.png: {picture: a.png, columns: 3}}
)",
                 {{"sweep: p.yaml\n", "", "."},
                  {"sweep: p.yaml", "sweep: [p.yaml]", "sweep"},
                  {"seeds:", "seed:", "."},
                  {"[1, 2]", "[]", "seeds"},
                  {"[1, 2]", "[1, -2]", "seeds/1"},
                  {"[1 cm, 2 cm]", "1 cm", "grid/planes.distance"},
                  {"{scan: flat.ply}", "1", "scenes"},
                  {"samples: 3", "samples: 0", "random/samples"},
                  {"samples: 3, ", "", "random"},
                  {"[1 deg, 5 deg]", "[1 deg]", "random/of/planes.angle"},
                  {"digits: 2", "digits: 13", "metrics/RMSE"},
                  {"sheet.png", "sheet.jpg", "pictures"}},
                 ".yaml");
}

TEST_F(Schemas, MistakesInCorrectionsAreFound) {
  expect_refused("corrections", read_text(source / "share/examples/corrections.yaml"),
                 {{"name: Living", "nam: Living", "corrections/0/rename_room"},
                  {"at: [0, 2.3], by", "at: [0], by", "corrections/1/move_wall/at"},
                  {"at: [0, 6.4], kind", "kind", "corrections/2/add_opening"},
                  {"rename_room", "rename_rom", "corrections/0"}},
                 ".yaml");
}

TEST_F(Schemas, ManifestsOfWhateverBecomesOfARunAreValid) {
  ASSERT_EQ(atrium({"run", "p.yaml", "--out", "cold"}).exit_code, 0);
  ASSERT_EQ(atrium({"run", "p.yaml", "--out", "warm"}).exit_code, 0);
  EXPECT_NE(uses("warm").find(":hit"), std::string::npos);
  write_text(folder / "sweep.yaml", "atrium: 1\nsweep: p.yaml\ngrid: {number: [1, 2]}\n");
  const auto sweep = atrium({"sweep", "run", "sweep.yaml", "--out", "sweep"});
  ASSERT_EQ(sweep.exit_code, 0) << sweep.err;
  EXPECT_EQ(run_step("failed", "fail").exit_code, 1);
  EXPECT_EQ(run_step("cancelled", "wait", interrupt_at({"second: waiting"})).exit_code, 130);
  EXPECT_EQ(run_step("killed", "ignore", interrupt_at({"second: waiting", "once more: end at once"})).exit_code, 130);
  std::vector<std::string> manifests, traces;
  for (const std::string name : {"cold", "warm", "sweep", "failed", "cancelled", "killed"}) {
    manifests.push_back(folder / name / "manifest.json");
    if (name != "killed") traces.push_back(folder / name / "trace.json");
  }
  expect_valid("manifest", manifests);
  expect_valid("trace", traces);
  EXPECT_EQ(manifest("failed")["status"], "failed");
  EXPECT_EQ(manifest("cancelled")["status"], "cancelled");
  EXPECT_EQ(manifest("killed")["status"], "running");
}

TEST_F(Schemas, MistakesInManifestsAreFound) {
  ASSERT_EQ(run_step("failed", "fail").exit_code, 1);
  const std::string valid = read_text(folder / "failed/manifest.json");
  const json nodes = json::parse(valid)["nodes"];
  ASSERT_EQ(nodes.size(), 4U);
  EXPECT_EQ(nodes[1]["status"], "failed");
  EXPECT_EQ(nodes[2]["status"], "skipped");
  expect_refused("manifest", valid,
                 {{"\"status\": \"failed\"", "\"status\": \"done\"", "status"},
                  {"\"status\": \"failed\"", "\"status\": \"running\"", "nodes"},
                  {"\"seed\"", "\"sead\"", "."},
                  {"\"wall_seconds\": ", "\"wall_seconds\": -", "wall_seconds"},
                  {"\"nodes\"", "\"planned\": [], \"nodes\"", "planned"},
                  {"\"node\": \"second\"", "\"name\": \"second\"", "nodes/1"},
                  {"\"message\"", "\"massage\"", "nodes/1"},
                  {"\"because\"", "\"message\"", "nodes/2/message"},
                  {"\"hash\": \"", "\"hash\": \"x", "outputs/number/hash"},
                  {"\"bytes\": ", "\"bytes\": 0.5", "nodes/0/outputs/0/bytes"}},
                 ".json");
}

}  // namespace
}  // namespace atrium::test::schemas_test
