// atrium nodes [TYPE|MODULE]: what node types there are, from the tables in their headers.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "graph/api/json_text.hpp"
#include "graph/api/suggest.hpp"
#include "graph/api/text.hpp"
#include "graph/cli/verbs.hpp"
#include "graph/pipeline/registry.hpp"

namespace atrium::cli {
namespace {

using Types = std::vector<const NodeType*>;

std::string module_of(const NodeType& node) { return node.type.substr(0, node.type.find('.')); }

std::string port_type(const PortInfo& port) {
  return fmt::format("{}{}{}", port.type, port.repeated ? ", one or more" : "",
                     port.unused     ? ", not used"
                     : port.optional ? ", optional"
                                     : "");
}

nlohmann::ordered_json initial_json(const ParamInfo& param) {
  return std::visit([](const auto& value) { return nlohmann::ordered_json(value); }, param.initial);
}

nlohmann::ordered_json ports_json(const std::vector<PortInfo>& ports) {
  auto list = nlohmann::ordered_json::array();
  for (const auto& port : ports)
    list.push_back({{"name", port.name},
                    {"type", port.type},
                    {"optional", port.optional},
                    {"repeated", port.repeated},
                    {"doc", port.doc}});
  return list;
}

std::string_view kind_name(ParamKind kind) {
  switch (kind) {
    case ParamKind::boolean: return "boolean";
    case ParamKind::integer: return "integer";
    case ParamKind::number: return "number";
    case ParamKind::text: return "text";
    case ParamKind::choice: return "choice";
    case ParamKind::input_path: return "input_path";
    case ParamKind::output_path: return "output_path";
    case ParamKind::numbers: return "numbers";
    case ParamKind::texts: return "texts";
    case ParamKind::input_paths: return "input_paths";
  }
  return "";
}

nlohmann::ordered_json params_json(const std::vector<ParamInfo>& params) {
  auto list = nlohmann::ordered_json::array();
  for (const auto& param : params) {
    nlohmann::ordered_json row{{"name", param.name}, {"kind", kind_name(param.kind)}};
    if (!param.unit.symbol.empty()) row["unit"] = param.unit.symbol;
    if (std::isfinite(param.min)) row["min"] = param.min;
    if (std::isfinite(param.max)) row["max"] = param.max;
    if (param.length > 0) row["length"] = param.length;
    if (!param.choices.empty()) row["choices"] = param.choices;
    row["required"] = is_required(param);
    if (!is_required(param)) row["default"] = initial_json(param);
    row["accepts"] = describe_param(param);
    row["doc"] = param.doc;
    list.push_back(std::move(row));
  }
  return list;
}

void print_json(const Types& types) {
  auto list = nlohmann::ordered_json::array();
  for (const auto* node : types)
    list.push_back({{"type", node->type},
                    {"summary", node->summary},
                    {"version", node->version},
                    {"inputs", ports_json(node->inputs)},
                    {"outputs", ports_json(node->outputs)},
                    {"params", params_json(node->params)}});
  fmt::print("{}\n", json_text(list, 2));
}

std::string cell(const std::string& text) { return replaced(text, "|", "\\|"); }

void print_markdown_ports(std::string_view title, const std::vector<PortInfo>& ports) {
  if (ports.empty()) return;
  fmt::print("\n| {} | type | |\n|---|---|---|\n", title);
  for (const auto& port : ports) fmt::print("| `{}` | {} | {} |\n", port.name, port_type(port), cell(port.doc));
}

void print_markdown(const Types& types) {
  std::string module;
  for (const auto* node : types) {
    if (module_of(*node) != module) {
      fmt::print("{}# {}\n\nMade by `share/regenerate` from the tables in the nodes' headers.\n",
                 module.empty() ? "" : "\n", module_of(*node));
      module = module_of(*node);
    }
    fmt::print("\n## {}\n\n{}\n", node->type, node->summary);
    print_markdown_ports("input", node->inputs);
    print_markdown_ports("output", node->outputs);
    if (node->params.empty()) continue;
    fmt::print("\n| parameter | accepts | |\n|---|---|---|\n");
    for (const auto& param : node->params)
      fmt::print("| `{}` | {} | {} |\n", param.name, cell(describe_param(param)), cell(param.doc));
  }
}

void print_ports(std::string_view title, const std::vector<PortInfo>& ports) {
  if (ports.empty()) return;
  fmt::print("\n{}\n", title);
  for (const auto& port : ports) fmt::print("  {} ({})\n      {}\n", port.name, port_type(port), port.doc);
}

void print_manual(const NodeType& node) {
  fmt::print("{} (version {})\n  {}\n", node.type, node.version, node.summary);
  print_ports("inputs", node.inputs);
  print_ports("outputs", node.outputs);
  if (node.params.empty()) return;
  fmt::print("\nparameters\n");
  for (const auto& param : node.params)
    fmt::print("  {} ({})\n      {}\n", param.name, describe_param(param), param.doc);
}

void print_list(const Types& types) {
  std::vector<std::vector<std::string>> rows;
  rows.reserve(types.size());
  for (const auto* node : types) rows.push_back({node->type, node->summary});
  fmt::print("{}", aligned(rows));
}

/// The types that the word names: one type, a module's, or all.
Types selected(Registry& registry, const std::string& word) {
  if (word.find('.') != std::string::npos) {
    if (const NodeType* node = registry.find(word); node != nullptr) return {node};
  }
  std::vector<std::string> problems, names = registry.modules();
  Types all = registry.all(word.empty() ? nullptr : &problems), types;
  for (const auto* node : all)
    if (word.empty() || module_of(*node) == word) types.push_back(node);
  if (!types.empty() || word.empty()) return types;
  for (const auto* node : all) names.push_back(node->type);
  throw CLI::ValidationError("no node type or module '" + word + "'; " + did_you_mean(word, names));
}

}  // namespace

void add_nodes(CLI::App& app, int& /*exit_code*/) {
  struct Options {
    std::string word;
    bool json = false, markdown = false;
  };
  auto* verb = app.add_subcommand("nodes", "Lists the node types, or shows one: ports, parameters, units, limits.");
  const auto options = std::make_shared<Options>();
  verb->add_option("TYPE", options->word, "a node type (plane.ransac) or a module (plane)")->type_name("");
  auto* json = verb->add_flag("--json", options->json, "machine-readable");
  verb->add_flag("--markdown", options->markdown, "as in share/doc/nodes")->excludes(json);
  verb->callback([options] {
    Registry registry;
    const Types types = selected(registry, options->word);
    if (options->json)
      print_json(types);
    else if (options->markdown)
      print_markdown(types);
    else if (types.size() == 1 && types.front()->type == options->word)
      print_manual(*types.front());
    else
      print_list(types);
  });
}

}  // namespace atrium::cli
