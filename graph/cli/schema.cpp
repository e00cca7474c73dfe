// atrium schema: a JSON schema (draft 2020-12) of pipeline files, for editors and validators.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "graph/api/files.hpp"
#include "graph/api/json_text.hpp"
#include "graph/api/plugin_data.hpp"
#include "graph/cli/verbs.hpp"
#include "graph/pipeline/registry.hpp"

namespace atrium::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* name_pattern = "^[a-z][a-z0-9_]*$";
constexpr const char* node_pattern = "^[a-z][a-z0-9_]*(/[a-z][a-z0-9_]*)*$";
constexpr const char* port_pattern = "^[a-z][a-z0-9_]*(/[a-z][a-z0-9_]*)*\\.[a-z][a-z0-9_]*$";
constexpr const char* number_pattern = "[+-]?([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][+-]?[0-9]+)?";

/// A bare number in the declared unit, within its bounds, or a number with a unit (whose bounds the program checks).
Json number_schema(const ParamInfo& param) {
  Json number{{"type", param.kind == ParamKind::integer ? "integer" : "number"}};
  if (std::isfinite(param.min)) number["minimum"] = param.min;
  if (std::isfinite(param.max)) number["maximum"] = param.max;
  const auto units = units_of(param.unit);
  if (units.empty()) return number;
  const std::string pattern = units.size() == 1 ? units.front() : fmt::format("({})", fmt::join(units, "|"));
  const Json quantity{{"type", "string"}, {"pattern", fmt::format("^{} *{}$", number_pattern, pattern)}};
  return {{"anyOf", Json::array({number, quantity})}};
}

Json list_schema(const Json& items, std::size_t length) {
  Json list{{"type", "array"}, {"items", items}};
  if (length > 0) list["minItems"] = list["maxItems"] = length;
  return length > 1 ? list : Json{{"anyOf", Json::array({list, items})}};
}

Json value_schema(const ParamInfo& param) {
  Json text{{"type", Json::array({"string", "number", "boolean"})}};  // YAML reads an unquoted 12 as a number
  switch (param.kind) {
    case ParamKind::boolean: return {{"type", "boolean"}};
    case ParamKind::integer:
    case ParamKind::number: return number_schema(param);
    case ParamKind::choice: return {{"enum", param.choices}};
    case ParamKind::numbers: return list_schema(number_schema(param), param.length);
    case ParamKind::texts:
    case ParamKind::input_paths: return list_schema(text, param.length);
    default: return text;
  }
}

Json param_schema(const ParamInfo& param) {
  Json schema{{"description", fmt::format("{} ({})", param.doc, describe_param(param))},
              {"anyOf", Json::array({value_schema(param), Json{{"$ref", "#/$defs/variable"}}})}};
  if (!is_required(param)) schema["default"] = std::visit([](const auto& value) { return Json(value); }, param.initial);
  return schema;
}

Json node_schema(const NodeType& node) {
  Json inputs = Json::object(), params = Json::object();
  Json required_inputs = Json::array(), required_params = Json::array();
  for (const auto& port : node.inputs) {
    const Json edge{{"$ref", "#/$defs/port"}};
    inputs[port.name] = {{"description", fmt::format("{} ({})", port.doc, port.type)}};
    if (port.repeated)
      inputs[port.name]["anyOf"] = Json::array({edge, Json{{"type", "array"}, {"items", edge}, {"minItems", 1}}});
    else
      inputs[port.name]["$ref"] = "#/$defs/port";
    if (!port.optional) required_inputs.push_back(port.name);
  }
  for (const auto& param : node.params) {
    params[param.name] = param_schema(param);
    if (is_required(param)) required_params.push_back(param.name);
  }
  const auto section = [](const Json& properties, const Json& required) {
    Json type = required.empty() ? Json::array({"object", "null"}) : Json("object");
    Json schema{{"type", type}, {"properties", properties}, {"additionalProperties", false}};
    if (!required.empty()) schema["required"] = required;
    return schema;
  };
  Json schema{{"description", node.summary},
              {"properties", {{"in", section(inputs, required_inputs)}, {"params", section(params, required_params)}}}};
  if (!required_inputs.empty()) schema["required"].push_back("in");
  if (!required_params.empty()) schema["required"].push_back("params");
  return schema;
}

Json named(const Json& values) {
  return {{"type", Json::array({"object", "null"})},
          {"patternProperties", {{name_pattern, values}}},
          {"additionalProperties", false}};
}

Json schema_of(const std::vector<const NodeType*>& types) {
  Json names = Json::array(), rules = Json::array(), definitions = Json::object();
  const Json scalar{{"type", Json::array({"string", "number", "boolean"})}};
  const Json value{{"anyOf", Json::array({scalar, Json{{"type", "array"}, {"items", scalar}}})}};
  const Json unset_or_value{{"anyOf", Json::array({value, Json{{"type", "null"}}})}};
  definitions["variable"] = {{"type", "string"}, {"pattern", "^\\$\\{[a-z][a-z0-9_]*\\}$"}};
  definitions["input"] = {{"type", "object"},
                          {"properties", {{"type", {{"type", "string"}}}, {"default", {{"$ref", "#/$defs/port"}}}}},
                          {"required", {"type"}},
                          {"additionalProperties", false}};
  definitions["port"] = {{"type", "string"}, {"pattern", port_pattern}};
  for (const auto* type : types) {
    names.push_back(type->type);
    rules.push_back({{"if", {{"properties", {{"type", {{"const", type->type}}}}}, {"required", {"type"}}}},
                     {"then", {{"$ref", "#/$defs/" + type->type}}}});
    definitions[type->type] = node_schema(*type);
  }
  definitions["node"] = {{"type", "object"},
                         {"properties",
                          {{"type", {{"enum", names}}},
                           {"in", {{"type", Json::array({"object", "null"})}}},
                           {"params", {{"type", Json::array({"object", "null"})}}}}},
                         {"required", {"type"}},
                         {"additionalProperties", false},
                         {"allOf", rules}};
  definitions["sub_pipeline"] = {
      {"type", "object"},
      {"properties",
       {{"pipeline", {{"type", "string"}}}, {"in", named({{"$ref", "#/$defs/port"}})}, {"vars", named(value)}}},
      {"required", {"pipeline"}},
      {"additionalProperties", false}};
  const Json node{{"if", {{"required", {"pipeline"}}}},
                  {"then", {{"$ref", "#/$defs/sub_pipeline"}}},
                  {"else", {{"$ref", "#/$defs/node"}}}};
  return {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
          {"title", "Atrium pipeline"},
          {"type", "object"},
          {"properties",
           {{"atrium", {{"const", 1}}},
            {"summary", {{"type", "string"}}},
            {"seed", {{"type", "integer"}, {"minimum", 0}}},
            {"versions", {{"type", "object"}}},
            {"vars", named(unset_or_value)},
            {"inputs", named({{"anyOf", Json::array({Json{{"type", "string"}}, Json{{"$ref", "#/$defs/input"}}})}})},
            {"nodes",
             {{"type", "object"},
              {"patternProperties", {{node_pattern, node}}},
              {"additionalProperties", false},
              {"minProperties", 1}}},
            {"outputs", named({{"$ref", "#/$defs/port"}})}}},
          {"required", {"atrium", "nodes"}},
          {"additionalProperties", false},
          {"$defs", definitions}};
}

}  // namespace

void add_schema(CLI::App& app, int& /*exit_code*/) {
  auto* verb = app.add_subcommand("schema", "Prints the JSON schema of pipeline files, for editors.");
  const auto sweep = std::make_shared<bool>(false);
  verb->add_flag("--sweep", *sweep, "of sweep files instead");
  verb->callback([sweep] {
    if (*sweep) {
      fmt::print("{}", read_text(data_folder(own_program(), "schema") / "sweep.schema.json"));
      return;
    }
    Registry registry;
    fmt::print("{}\n", json_text(schema_of(registry.all()), 2));
  });
}

}  // namespace atrium::cli
