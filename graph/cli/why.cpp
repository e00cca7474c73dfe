// atrium why RUN NODE: why a node was run, or where its result came from.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "graph/api/json_text.hpp"
#include "graph/api/suggest.hpp"
#include "graph/cache/nearest.hpp"
#include "graph/cli/verbs.hpp"
#include "graph/run/run_folder.hpp"

namespace atrium::cli {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

struct WhyArguments {
  std::string run, node, folder;
  bool json = false;
};

/// What is recorded of the nodes of a run or of one variant of a sweep.
struct Record {
  Json nodes;
  std::string what = "run";
  std::string folder;  ///< of the cache; empty: there was none
};

/// A JSON object, or nothing if it cannot be read.
Json read_object(const fs::path& path) {
  Json json = read_json_file(path);
  return json.is_object() ? json : Json();
}

/// Of a sweep's variant, with the nodes that it shares with others and whether or not it was done in the last part.
Record read_variant(const fs::path& sweep, const std::string& variant, const Json& manifest) {
  const Json result = read_object(sweep / "variants" / variant / "result.json");
  if (!result.contains("nodes")) {
    std::vector<std::string> names;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(sweep / "variants", none))
      if (fs::exists(entry.path() / "result.json")) names.push_back(entry.path().filename().string());
    const std::string hint = did_you_mean(variant, names);
    throw Error(fmt::format("no variant '{}' of the sweep in {} is done", variant, sweep.string()),
                hint.empty() ? "those that are: " + join_words(names) : hint);
  }
  Record record{result.at("nodes"), "variant"};
  const fs::path cache = default_cache_folder();
  record.folder = manifest.contains("cache") ? manifest.at("cache").at("folder").get<std::string>() : cache.string();
  return record;
}

/// `node` loses the variant that it begins with.
Record read_record(const fs::path& folder, std::string& node) {
  const Json manifest = read_object(folder / "manifest.json");
  const std::size_t slash = node.find('/');
  if (fs::exists(folder / sweep_mark)) {
    if (slash == std::string::npos)
      throw Error(folder.string() + " is the folder of a sweep: '" + node + "' does not say of which variant",
                  "VARIANT/NODE");
    const std::string variant = node.substr(0, slash);
    node.erase(0, slash + 1);
    return read_variant(folder, variant, manifest);
  }
  if (!manifest.contains("nodes"))
    throw Error(folder.string() + " is not the folder of a run that has ended", "it has no manifest.json with nodes");
  Record record{manifest.at("nodes")};
  if (manifest.contains("cache")) record.folder = manifest.at("cache").at("folder").get<std::string>();
  return record;
}

const Json& node_of(const Record& record, const std::string& name) {
  std::vector<std::string> names;
  for (const auto& node : record.nodes) {
    if (node.at("node") == name) return node;
    names.push_back(node.at("node").get<std::string>());
  }
  const std::string hint = did_you_mean(name, names);
  throw Error(fmt::format("the {} has no node '{}'", record.what, name),
              hint.empty() ? "its nodes: " + join_words(names) : hint);
}

/// "oriented.cloud": whose output has that hash.
std::string source_of(const Json& nodes, const std::string& hash) {
  for (const auto& node : nodes)
    for (const auto& output : node.value("outputs", Json::array()))
      if (output.value("hash", "") == hash)
        return node.at("node").get<std::string>() + "." + output.at("port").get<std::string>();
  return {};
}

std::string shown(const std::string& value) { return value.empty() ? "(not there)" : value; }

void print_difference(const Json& nodes, const KeyDifference& difference) {
  if (difference.name.starts_with("in ")) {
    const std::string source = source_of(nodes, difference.now);
    fmt::print("  {}: another value{}\n", difference.name.substr(3),
               source.empty() ? "" : fmt::format(" (from {}: ask about that node)", source));
  } else if (difference.name == "build") {
    fmt::print("  build: the plugin, a library that it is linked with, or the processor differs\n");
  } else {
    fmt::print("  {}: {} → {}\n", difference.name, shown(difference.then), shown(difference.now));
  }
}

Json to_json(const std::vector<KeyDifference>& differences) {
  Json json = Json::array();
  for (const auto& d : differences) json.push_back({{"field", d.name}, {"then", d.then}, {"now", d.now}});
  return json;
}

int explain_miss(const WhyArguments& options, const CachePlaces& places, const Json& nodes, const Json& node) {
  const std::string key = node.at("cache").value("key", "");
  const std::string type = node.at("type");
  const auto record = key.empty() ? std::nullopt : record_of(places, type, key);
  std::optional<NearestRecord> nearest;
  if (record) nearest = nearest_record(places, *record);
  if (options.json) {
    Json json{{"node", options.node}, {"result", "miss"}, {"why", node.at("cache").value("why", "")}};
    if (!key.empty()) json["key"] = key;
    if (nearest)
      json["nearest"] = {{"key", nearest->record.key},
                         {"node", nearest->record.node},
                         {"made", nearest->record.made},
                         {"differences", to_json(nearest->differences)}};
    fmt::print("{}\n", json_text(json, 2));
    return ok;
  }
  fmt::print("{} was run: {}\n", options.node, node.at("cache").value("why", ""));
  if (!record) {
    if (!key.empty())
      fmt::print("{}\n", node.value("status", "") == "ok" ? "its record is not in the cache any more"
                                                          : "of a node that is not ok nothing is kept");
  } else if (!nearest) {
    fmt::print("the cache had nothing else of {}\n", type);
  } else {
    fmt::print("nearest in the cache: '{}' of {}, which differs in\n", nearest->record.node, nearest->record.made);
    for (const auto& difference : nearest->differences) print_difference(nodes, difference);
  }
  return ok;
}

int why(const WhyArguments& options) {
  std::string name = options.node;
  const Record record = read_record(options.run, name);
  const Json& node = node_of(record, name);
  if (!node.contains("cache") || record.folder.empty()) {
    if (options.json)
      fmt::print("{}\n", json_text(Json{{"node", options.node}, {"result", "off"}}, 2));
    else
      fmt::print("{} was run: there was no cache\n", options.node);
    return ok;
  }
  const fs::path folder = options.folder.empty() ? record.folder : options.folder;
  if (node.at("cache").at("result") == "miss") return explain_miss(options, {folder}, record.nodes, node);
  if (options.json) {
    Json json{{"node", options.node}};
    json.update(node.at("cache"));
    fmt::print("{}\n", json_text(json, 2));
    return ok;
  }
  const std::string again = node.at("cache").value("why", "");
  fmt::print("{} was known: computed {} in {} s{}\n", options.node, node.at("cache").value("made", ""),
             node.at("cache").value("computing_wall_seconds", 0.0), again.empty() ? "" : "; " + again);
  return ok;
}

}  // namespace

void add_why(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand("why", "Says why a node of a run was computed, or where its result came from.");
  const auto options = std::make_shared<WhyArguments>();
  verb->add_option("RUN", options->run, "the folder of a run or of a sweep")->required()->type_name("");
  verb->add_option("NODE", options->node, "the node's address (of a sweep: VARIANT/NODE)")->required()->type_name("");
  verb->add_option("--cache", options->folder, "the cache's folder (default: the one of the run)")->type_name("DIR");
  verb->add_flag("--json", options->json, "as JSON on stdout");
  verb->callback([options, &exit_code] { exit_code = why(*options); });
}

}  // namespace atrium::cli
