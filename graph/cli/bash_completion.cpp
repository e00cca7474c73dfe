// The program's words for bash, from the parser's own tables; share/packages/completion.bash makes use of them.
#include <fmt/format.h>

#include "graph/cli/command_table.hpp"

namespace atrium::cli {
namespace {

std::string name_of(const CommandOption& option) {
  switch (option.kind) {
    case ValueKind::folder: return "folder";
    case ValueKind::file: return "file";
    case ValueKind::pipeline: return "pipeline";
    case ValueKind::setting: return "setting";
    case ValueKind::node_type: return "node_type";
    case ValueKind::choice: return fmt::format("choice:{}", fmt::join(option.choices, ","));
    default: return "any";
  }
}

/// One branch of the table: what may follow the command.
std::string branch(const Command& command) {
  std::vector<std::string> options, values, words;
  for (const auto& option : command.options) {
    const std::string kind = name_of(option);
    options.insert(options.end(), option.names.begin(), option.names.end());
    for (const auto& name : option.names)
      if (option.kind != ValueKind::none) values.push_back(fmt::format("{}={}", name, kind));
    if (option.names.empty()) words.push_back(kind + (option.repeated ? "+" : ""));
  }
  return fmt::format(
      "    \"{}\")\n      commands=\"{}\"\n      options=\"{}\"\n      values=({})\n      words=\"{}\" ;;\n",
      command.path, fmt::join(command.commands, " "), fmt::join(options, " "), fmt::join(values, " "),
      fmt::join(words, " "));
}

}  // namespace

std::string bash_completion(const CLI::App& app) {
  std::string text = "\n# Made by `atrium generate bash-completion`, do not edit.\n_atrium_table() {\n  case $1 in\n";
  for (const auto& command : commands_of(app)) text += branch(command);
  return text + "  esac\n}\n";
}

}  // namespace atrium::cli
