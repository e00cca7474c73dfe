#include "graph/why/why.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "graph/api/json_text.hpp"
#include "graph/api/suggest.hpp"
#include "graph/cache/records.hpp"
#include "graph/run/node_json.hpp"
#include "graph/run/run_folder.hpp"

namespace atrium {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// A JSON object, or nothing if it cannot be read.
Json read_object(const fs::path& path) {
  Json json = read_json_file(path);
  return json.is_object() ? json : Json::object();
}

/// What is recorded of the nodes of one variant, with those that it shares with others and whether or not it was done
/// in the last part.
Json nodes_of_variant(const fs::path& sweep, const std::string& variant) {
  Json result = read_object(sweep / "variants" / variant / "result.json");
  if (result.contains("nodes")) return result.at("nodes");
  std::vector<std::string> names;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(sweep / "variants", none))
    if (fs::exists(entry.path() / "result.json")) names.push_back(entry.path().filename().string());
  const std::string hint = did_you_mean(variant, names);
  throw Error(fmt::format("no variant '{}' of the sweep in {} is done", variant, sweep.string()),
              hint.empty() ? "those that are: " + join_words(names) : hint);
}

/// "oriented.cloud": whose output has that hash.
std::string source_of(const std::vector<NodeRecord>& nodes, const std::string& hash) {
  for (const auto& node : nodes)
    for (const auto& output : node.outputs)
      if (output.hash == hash) return node.node + "." + output.port;
  return {};
}

std::string text_of(const KeyDifference& difference, const std::vector<NodeRecord>& nodes) {
  const auto shown = [](const std::string& value) { return value.empty() ? "(not there)" : value; };
  if (difference.name.starts_with("in ")) {
    const std::string source = source_of(nodes, difference.now);
    return fmt::format("  {}: another value{}\n", difference.name.substr(3),
                       source.empty() ? "" : fmt::format(" (from {}: ask about that node)", source));
  }
  if (difference.name == "build")
    return "  build: the plugin, a library that it is linked with, or the processor differs\n";
  return fmt::format("  {}: {} → {}\n", difference.name, shown(difference.then), shown(difference.now));
}

}  // namespace

Reason reason_of(const fs::path& run, const std::string& node, const fs::path& cache) {
  const Json manifest = read_object(run / "manifest.json");
  const bool sweep = fs::exists(run / sweep_mark);
  const std::size_t slash = node.find('/');
  if (sweep && slash == std::string::npos)
    throw Error(run.string() + " is the folder of a sweep: '" + node + "' does not say of which variant",
                "VARIANT/NODE");
  if (!sweep && !manifest.contains("nodes"))
    throw Error(run.string() + " is not the folder of a run that has ended", "it has no manifest.json with nodes");
  Reason reason;
  reason.node = node;
  for (const auto& json : sweep ? nodes_of_variant(run, node.substr(0, slash)) : manifest.at("nodes"))
    reason.nodes.push_back(read_node(json));
  const std::string name = sweep ? node.substr(slash + 1) : node;
  const auto found =
      std::find_if(reason.nodes.begin(), reason.nodes.end(), [&](const auto& n) { return n.node == name; });
  if (found == reason.nodes.end()) {
    const auto names = words_of(reason.nodes, [](const NodeRecord& n) { return n.node; });
    const std::string hint = did_you_mean(name, names);
    throw Error(fmt::format("the {} has no node '{}'", sweep ? "variant" : "run", name),
                hint.empty() ? "its nodes: " + join_words(names) : hint);
  }
  reason.record = *found;
  fs::path folder = cache;
  if (folder.empty() && manifest.contains("cache"))
    folder = manifest.at("cache").at("folder").get<std::string>();
  else if (folder.empty() && sweep)
    folder = default_cache_folder();
  CacheUse& use = reason.record.cache;
  if (folder.empty()) use = {};
  if (use.result != CacheUse::Result::miss || use.key.empty()) return reason;
  const auto kept = record_of({folder}, reason.record.type, use.key);
  reason.is_kept = kept.has_value();
  if (kept) reason.nearest = nearest_record({folder}, *kept);
  return reason;
}

std::string as_text(const Reason& reason) {
  const CacheUse& use = reason.record.cache;
  if (use.result == CacheUse::Result::off) return fmt::format("{} was run: there was no cache\n", reason.node);
  if (use.result == CacheUse::Result::hit)
    return fmt::format("{} was cached: computed {} in {} s{}\n", reason.node, use.made, use.wall,
                       use.again ? "; " + std::string(run_again) : "");
  std::string text = fmt::format("{} was run: {}\n", reason.node, use.why);
  if (use.key.empty()) return text;
  if (!reason.is_kept)
    return text + (reason.record.status == NodeStatus::ok ? "its record is not in the cache any more\n"
                                                          : "of a node that is not ok nothing is kept\n");
  if (!reason.nearest) return text + fmt::format("the cache had nothing else of {}\n", reason.record.type);
  const auto& [record, differences] = *reason.nearest;
  text += fmt::format("nearest in the cache: '{}' of {}, which differs in\n", record.node, record.made);
  for (const auto& difference : differences) text += text_of(difference, reason.nodes);
  return text;
}

std::string as_json(const Reason& reason) {
  Json json{{"node", reason.node}, {"result", "off"}};
  if (reason.record.cache.result != CacheUse::Result::off) json.update(node_json(reason.record).at("cache"));
  if (reason.nearest) {
    const auto& [record, differences] = *reason.nearest;
    Json list = Json::array();
    for (const auto& d : differences) list.push_back({{"field", d.name}, {"then", d.then}, {"now", d.now}});
    json["nearest"] = {{"key", record.key}, {"node", record.node}, {"made", record.made}, {"differences", list}};
  }
  return json_text(json, 2) + "\n";
}

}  // namespace atrium
