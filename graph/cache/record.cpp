#include "graph/cache/record.hpp"

#include <nlohmann/json.hpp>

#include "graph/api/fact_json.hpp"
#include "graph/api/json_text.hpp"
#include "graph/cache/places.hpp"

namespace atrium {
namespace {

using Json = nlohmann::ordered_json;
constexpr int version = 3;

Json outputs_json(const CacheRecord& record) {
  Json outputs = Json::array();
  for (const auto& output : record.outputs) {
    Json facts = Json::array();
    for (const auto& fact : output.facts) facts.push_back(fact_json(fact));
    outputs.push_back({{"port", output.port},
                       {"type", output.type},
                       {"bytes", output.bytes},
                       {"hash", output.hash},
                       {"facts", std::move(facts)}});
  }
  return outputs;
}

/// It becomes the name of a file.
std::string hash_at(const Json& json) {
  std::string hash = json.at("hash").get<std::string>();
  if (!is_content_hash(hash)) throw Error("a record names a file by what is no hash");
  return hash;
}

CacheRecord from_json(const Json& json) {
  CacheRecord record;
  record.key = json.at("key").get<std::string>();
  for (const auto& field : json.at("fields"))
    record.fields.push_back({field.at(0).get<std::string>(), field.at(1).get<std::string>()});
  record.node = json.at("node").get<std::string>();
  record.made = json.at("made").get<std::string>();
  for (const auto& json_output : json.at("outputs")) {
    auto& output = record.outputs.emplace_back(CacheRecord::Output{json_output.at("port").get<std::string>(),
                                                                   json_output.at("type").get<std::string>(),
                                                                   json_output.at("bytes").get<std::uint64_t>(),
                                                                   hash_at(json_output),
                                                                   {}});
    for (const auto& fact : json_output.at("facts")) output.facts.push_back(read_fact(fact));
  }
  record.warnings = json.at("warnings").get<std::vector<std::string>>();
  for (const auto& file : json.at("files"))
    record.files.push_back({file.at("path").get<std::string>(), file.at("bytes").get<std::uint64_t>(), hash_at(file)});
  record.wall = json.at("wall_seconds").get<double>();
  record.cpu = json.at("cpu_seconds").get<double>();
  record.peak_memory = json.at("peak_memory").get<std::uint64_t>();
  if (const Json& growth = json.at("growth"); !growth.is_null()) record.growth = growth.get<std::uint64_t>();
  return record;
}

}  // namespace

std::string record_text(const CacheRecord& record) {
  Json fields = Json::array();
  for (const auto& field : record.fields) fields.push_back({field.name, field.value});
  Json files = Json::array();
  for (const auto& file : record.files)
    files.push_back({{"path", file.path}, {"bytes", file.bytes}, {"hash", file.hash}});
  const Json json{{"version", version},
                  {"key", record.key},
                  {"fields", std::move(fields)},
                  {"node", record.node},
                  {"made", record.made},
                  {"outputs", outputs_json(record)},
                  {"warnings", record.warnings},
                  {"files", std::move(files)},
                  {"wall_seconds", record.wall},
                  {"cpu_seconds", record.cpu},
                  {"peak_memory", record.peak_memory},
                  {"growth", record.growth ? Json(*record.growth) : Json()}};
  const std::string text = json_text(json) + "\n";
  return hash_of_text(text) + "\n" + text;
}

std::optional<CacheRecord> read_record(const std::string& text) {
  const std::size_t line = text.find('\n');
  if (line == std::string::npos) return std::nullopt;
  const std::string_view rest = std::string_view(text).substr(line + 1);
  if (hash_of_text(rest) != std::string_view(text).substr(0, line)) return std::nullopt;
  try {
    const Json json = read_json(rest);
    if (json.at("version") != version) return std::nullopt;
    CacheRecord record = from_json(json);
    if (NodeKey{record.fields}.hex() != record.key) return std::nullopt;
    return record;
  } catch (const Json::exception&) {
    return std::nullopt;
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace atrium
