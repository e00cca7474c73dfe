#include "graph/cli/command_table.hpp"

#include <CLI/CLI.hpp>
#include <map>
#include <sstream>

namespace atrium::cli {
namespace {

/// CLI11 puts a type and its validators into one text: "INT:INT in [1 - 1024]", "TEXT:{dot,mermaid}".
void read_type(const std::string& text, CommandOption& option) {
  const std::size_t colon = std::min(text.find(':'), text.size());
  if (option.value.empty()) option.value = text.substr(0, colon);
  const std::string limits = text.substr(std::min(colon + 1, text.size()));
  if (!limits.starts_with("{") || !limits.ends_with("}")) {
    option.limits = limits;
    return;
  }
  std::istringstream words(limits.substr(1, limits.size() - 2));
  for (std::string word; std::getline(words, word, ',');) option.choices.push_back(word);
}

ValueKind kind_of(const CommandOption& option) {
  static const std::map<std::string, ValueKind> kinds{
      {"DIR", ValueKind::folder},   {"FOLDER", ValueKind::folder},         {"RUN", ValueKind::folder},
      {"OTHER", ValueKind::folder}, {"ADDRESS=VALUE", ValueKind::setting}, {"TYPE", ValueKind::node_type},
  };
  if (!option.choices.empty()) return ValueKind::choice;
  if (option.value == "FILE") return option.names.empty() ? ValueKind::pipeline : ValueKind::file;
  const auto known = kinds.find(option.value);
  return known == kinds.end() ? ValueKind::any : known->second;
}

CommandOption read_option(const CLI::Option& option) {
  CommandOption result;
  for (const auto& name : option.get_snames()) result.names.push_back("-" + name);
  for (const auto& name : option.get_lnames()) result.names.push_back("--" + name);
  result.text = option.get_description();
  result.default_value = option.get_default_str();
  result.required = option.get_required();
  if (result.names.empty()) result.value = option.get_name(true);
  if (option.get_items_expected_max() == 0) return result;
  result.repeated = option.get_items_expected_max() > 1;
  read_type(option.get_type_name(), result);
  result.kind = kind_of(result);
  return result;
}

void add(const CLI::App& app, const std::string& path, std::vector<Command>& commands) {
  const auto shown = app.get_subcommands([](const CLI::App* sub) { return !sub->get_group().empty(); });
  Command command{path, app.get_description(), {}, {}};
  for (const auto* sub : shown) command.commands.push_back(sub->get_name());
  const auto options = app.get_options([](const CLI::Option* o) { return !o->get_group().empty(); });
  for (const bool named : {true, false})
    for (const auto* option : options)
      if (option->nonpositional() == named) command.options.push_back(read_option(*option));
  commands.push_back(std::move(command));
  for (const auto* sub : shown) add(*sub, path.empty() ? sub->get_name() : path + " " + sub->get_name(), commands);
}

}  // namespace

std::vector<Command> commands_of(const CLI::App& app) {
  std::vector<Command> commands;
  add(app, "", commands);
  return commands;
}

}  // namespace atrium::cli
