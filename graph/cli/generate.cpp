// atrium generate WHAT: texts that are made of the program's own tables while it is built, and what its completion
// asks.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "graph/cli/command_table.hpp"
#include "graph/pipeline/find_pipeline.hpp"
#include "graph/pipeline/registry.hpp"

namespace atrium::cli {
namespace {

void print_lines(const std::vector<std::string>& lines) {
  for (const auto& line : lines) fmt::print("{}\n", line);
}

std::vector<std::string> node_types() {
  std::vector<std::string> names, problems;
  Registry registry;
  for (const auto* type : registry.all(&problems)) names.push_back(type->type);
  return names;
}

void generate(const CLI::App& app, const std::string& what) {
  if (what == "man")
    fmt::print("{}", manual_page(app));
  else if (what == "bash-completion")
    fmt::print("{}", bash_completion(app));
  else if (what == "pipelines")
    print_lines(installed_pipeline_names());
  else
    print_lines(node_types());
}

}  // namespace

void add_generate(CLI::App& app) {
  auto* verb = app.add_subcommand("generate", "Prints the manual page, the completion of bash, or what that asks for.");
  verb->group("");  // not in --help: it is for the build and for the completion
  const auto what = std::make_shared<std::string>();
  verb->add_option("WHAT", *what, "man, bash-completion, pipelines or node-types")
      ->required()
      ->type_name("")
      ->check(CLI::IsMember({"man", "bash-completion", "pipelines", "node-types"}));
  verb->callback([&app, what] { generate(app, *what); });
}

}  // namespace atrium::cli
