#include "graph/cli/sweep_schema.hpp"

#include <nlohmann/json.hpp>

namespace atrium::cli {
namespace {

using Json = nlohmann::ordered_json;

Json mapping_of(const Json& values, const char* description) {
  return {{"type", "object"}, {"description", description}, {"additionalProperties", values}, {"minProperties", 1}};
}

Json object_of(const Json& properties, const Json& required = Json::array()) {
  Json schema{{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
  if (!required.empty()) schema["required"] = required;
  return schema;
}

Json reference(const char* name) { return {{"$ref", std::string("#/$defs/") + name}}; }

Json either(const Json& a, const Json& b) { return {{"anyOf", Json::array({a, b})}}; }

Json definitions() {
  const Json text{{"type", "string"}};
  const Json scalar{{"type", Json::array({"string", "number", "boolean"})}};
  const Json bound{{"type", Json::array({"string", "number"})}};
  const Json range{{"type", "array"}, {"items", bound}, {"minItems", 2}, {"maxItems", 2}};
  const Json whole_number{{"type", "integer"}, {"minimum", 0}};
  return {
      {"value", either(scalar, {{"type", "array"}, {"items", scalar}})},
      {"settings",
       mapping_of(reference("value"), "What is set: NODE.PARAMETER, NODE.type, NODE.pipeline or a variable.")},
      {"named",
       mapping_of(either(reference("settings"), {{"type", Json::array({"object", "null"})}, {"maxProperties", 0}}),
                  "Settings by name.")},
      {"values", {{"type", "array"}, {"items", reference("value")}, {"minItems", 1}}},
      {"columns", mapping_of(reference("values"), "Values by what they set.")},
      {"distribution",
       {{"anyOf",
         Json::array({object_of({{"uniform", range}}, {"uniform"}), object_of({{"loguniform", range}}, {"loguniform"}),
                      object_of({{"integers", range}}, {"integers"}),
                      object_of({{"choice", {{"type", "array"}, {"items", scalar}, {"minItems", 1}}}}, {"choice"})})}}},
      {"metric", either(text, object_of({{"of", text},
                                         {"seconds", {{"type", Json::array({"string", "null"})}}},
                                         {"memory", {{"type", Json::array({"string", "null"})}}},
                                         {"unit", text},
                                         {"digits", {{"type", "integer"}, {"minimum", 0}, {"maximum", 12}}}}))},
      {"sheet", either(text, object_of({{"picture", text},
                                        {"columns", {{"type", "integer"}, {"minimum", 1}, {"maximum", 20}}},
                                        {"cell_width", {{"type", "integer"}, {"minimum", 64}, {"maximum", 4096}}}},
                                       {"picture"}))},
      {"random", object_of({{"samples", {{"type", "integer"}, {"minimum", 1}, {"maximum", 100000}}},
                            {"seed", whole_number},
                            {"of", mapping_of(reference("distribution"), "What is drawn.")}},
                           {"samples", "of"})}};
}

}  // namespace

Json sweep_schema() {
  const Json text{{"type", "string"}};
  Json sheets = mapping_of(reference("sheet"), "One picture of every variant, by the sheet's file.");
  sheets["propertyNames"] = {{"pattern", "^[^/]+\\.png$"}};
  Json properties{
      {"atrium", {{"const", 1}}},
      {"sweep", {{"type", "string"}, {"description", "The pipeline that is varied."}}},
      {"summary", text},
      {"set", reference("settings")},
      {"scenes", either(reference("named"), {{"type", "object"},
                                             {"description", "A scene for each file of a folder or pattern."},
                                             {"additionalProperties", text},
                                             {"minProperties", 1},
                                             {"maxProperties", 1}})},
      {"list", reference("named")},
      {"ablate", reference("named")},
      {"grid", reference("columns")},
      {"zip", reference("columns")},
      {"random", reference("random")},
      {"seeds", {{"type", "array"}, {"items", {{"type", "integer"}, {"minimum", 0}}}, {"minItems", 1}}},
      {"exclude", {{"type", "array"}, {"items", reference("settings")}}},
      {"metrics", mapping_of(reference("metric"), "Columns of the table.")},
      {"pictures", std::move(sheets)}};
  Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "Atrium sweep"}};
  schema.update(object_of(properties, {"atrium", "sweep"}));
  schema["$defs"] = definitions();
  return schema;
}

}  // namespace atrium::cli
