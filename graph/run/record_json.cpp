#include "graph/run/record_json.hpp"

#include <nlohmann/json.hpp>

#include "graph/api/fact_json.hpp"

namespace atrium {
namespace {

using Json = nlohmann::ordered_json;

std::string_view name_of(CacheUse::Result result) {
  return result == CacheUse::Result::hit ? "hit" : result == CacheUse::Result::miss ? "miss" : "off";
}

CacheUse::Result read_cache_result(std::string_view text) {
  for (const auto result : {CacheUse::Result::hit, CacheUse::Result::miss})
    if (name_of(result) == text) return result;
  return CacheUse::Result::off;
}

Json cache_use_json(const CacheUse& use) {
  return {{"result", name_of(use.result)},
          {"key", use.key},
          {"why", use.why},
          {"again", use.again},
          {"wall", use.wall},
          {"cpu", use.cpu},
          {"peak_memory", use.peak_memory},
          {"made", use.made}};
}

CacheUse read_cache(const Json& json) {
  return {read_cache_result(json.at("result").get<std::string>()),
          json.at("key").get<std::string>(),
          json.at("why").get<std::string>(),
          json.at("again").get<bool>(),
          json.at("wall").get<double>(),
          json.at("cpu").get<double>(),
          json.at("peak_memory").get<std::uint64_t>(),
          json.at("made").get<std::string>()};
}

}  // namespace

NodeStatus read_node_status(std::string_view text) {
  for (const auto status : {NodeStatus::ok, NodeStatus::failed, NodeStatus::skipped})
    if (name_of(status) == text) return status;
  return NodeStatus::cancelled;
}

Json record_json(const NodeRecord& record) {
  Json json{{"node", record.node},
            {"type", record.type},
            {"status", name_of(record.status)},
            {"message", record.message},
            {"help", record.help},
            {"because", record.because},
            {"start", record.start},
            {"wall", record.wall},
            {"cpu", record.cpu},
            {"hash_start", record.hash_start},
            {"hash_wall", record.hash_wall},
            {"peak_memory", record.peak_memory},
            {"thread", record.thread},
            {"outputs", Json::array()},
            {"facts", Json::array()},
            {"warnings", record.warnings},
            {"files", Json::array()},
            {"cache", cache_use_json(record.cache)}};
  for (const auto& output : record.outputs)
    json["outputs"].push_back({output.port, output.type, output.bytes, output.hash});
  for (const auto& facts : record.facts) {
    Json& list = json["facts"].emplace_back(Json::array());
    for (const auto& fact : facts) list.push_back(fact_json(fact));
  }
  for (const auto& file : record.artefacts) json["files"].push_back({file.path, file.bytes});
  return json;
}

NodeRecord read_record_json(const Json& json) {
  NodeRecord record;
  record.node = json.at("node").get<std::string>();
  record.type = json.at("type").get<std::string>();
  record.status = read_node_status(json.at("status").get<std::string>());
  record.message = json.at("message").get<std::string>();
  record.help = json.at("help").get<std::string>();
  record.because = json.at("because").get<std::string>();
  record.start = json.at("start").get<double>();
  record.wall = json.at("wall").get<double>();
  record.cpu = json.at("cpu").get<double>();
  record.hash_start = json.at("hash_start").get<double>();
  record.hash_wall = json.at("hash_wall").get<double>();
  record.peak_memory = json.at("peak_memory").get<std::uint64_t>();
  record.thread = json.at("thread").get<int>();
  for (const auto& output : json.at("outputs"))
    record.outputs.push_back({output.at(0).get<std::string>(), output.at(1).get<std::string>(),
                              output.at(2).get<std::uint64_t>(), output.at(3).get<std::string>()});
  for (const auto& list : json.at("facts")) {
    auto& facts = record.facts.emplace_back();
    for (const auto& fact : list) facts.push_back(read_fact(fact));
  }
  record.warnings = json.at("warnings").get<std::vector<std::string>>();
  for (const auto& file : json.at("files"))
    record.artefacts.push_back({file.at(0).get<std::string>(), file.at(1).get<std::uint64_t>()});
  record.cache = read_cache(json.at("cache"));
  return record;
}

}  // namespace atrium
