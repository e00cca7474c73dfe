// atrium check FILE: everything that can be wrong with a pipeline, before anything runs.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "graph/api/json_text.hpp"
#include "graph/cli/verbs.hpp"
#include "graph/pipeline/pipeline.hpp"
#include "graph/pipeline/registry.hpp"

namespace atrium::cli {
namespace {

nlohmann::ordered_json to_json(const std::vector<Diagnostic>& findings) {
  auto list = nlohmann::ordered_json::array();
  for (const auto& finding : findings)
    list.push_back({{"file", finding.file},
                    {"line", finding.line},
                    {"column", finding.column},
                    {"message", finding.message},
                    {"help", finding.help},
                    {"notes", finding.notes}});
  return list;
}

void print_json(const LoadResult& result) {
  const nlohmann::ordered_json report{{"ok", result.errors.empty()},
                                      {"nodes", node_count(result.pipeline)},
                                      {"errors", to_json(result.errors)},
                                      {"warnings", to_json(result.warnings)},
                                      {"missing", result.missing}};
  fmt::print("{}\n", json_text(report, 2));
}

void print_check_summary(const LoadResult& result) {
  fmt::print("ok: {}", counted(node_count(result.pipeline), "node"));
  std::string variables, inputs;
  for (const auto& name : result.missing) {
    if (name.starts_with("inputs."))
      inputs += (inputs.empty() ? "" : ", ") + name.substr(7);
    else
      variables += fmt::format(" -s {}=…", name);
  }
  if (!variables.empty()) fmt::print("; to run it, set{}", variables);
  if (!inputs.empty())
    fmt::print("; a sub-pipeline with the input{} {}", inputs.find(',') == std::string::npos ? "" : "s", inputs);
  fmt::print("\n");
}

}  // namespace

void print_findings(const LoadResult& result) {
  for (const auto& warning : result.warnings) say("{}\n", to_string(warning));
  for (const auto& error : result.errors) say("{}\n", to_string(error));
}

void add_check(CLI::App& app, int& exit_code) {
  struct Options {
    std::string file;
    std::vector<std::string> settings;
    bool json = false;
  };
  auto* verb =
      app.add_subcommand("check", "Checks a pipeline file: every mistake with its place, before anything runs.");
  const auto options = std::make_shared<Options>();
  add_pipeline(*verb, options->file, options->settings);
  verb->add_flag("--json", options->json, "findings as JSON on stdout");
  verb->callback([options, &exit_code] {
    Registry registry;
    const LoadResult result =
        load_pipeline(options->file, to_overrides(options->settings), registry, {.allow_missing = true});
    if (options->json)
      print_json(result);
    else
      print_findings(result);
    if (!options->json && result.errors.empty()) print_check_summary(result);
    exit_code = result.errors.empty() ? ok : invalid;
  });
}

}  // namespace atrium::cli
