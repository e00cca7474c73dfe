// atrium cache stat|gc|verify: what is kept of earlier runs.
#include "graph/cache/cache.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "graph/api/json_text.hpp"
#include "graph/api/text.hpp"
#include "graph/cache/cache_folder.hpp"
#include "graph/cache/upkeep.hpp"
#include "graph/cli/verbs.hpp"

namespace atrium::cli {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

struct CacheArguments {
  CacheChoice cache;
  bool json = false;
};

CachePlaces places_of(const CacheChoice& choice) {
  const fs::path folder = choice.folder.empty() ? default_cache_folder() : fs::path(choice.folder);
  if (folder.empty()) throw Error("there is no cache: ATRIUM_CACHE is 'off'", "name one: --cache DIR");
  CachePlaces places{fs::absolute(folder).lexically_normal()};
  check_cache_folder(places);
  return places;
}

int stat(const CacheArguments& options) {
  const CachePlaces places = places_of(options.cache);
  const CacheContents contents = contents_of(places);
  const std::pair<const char*, CacheContents::Share> shares[] = {{"records", contents.records},
                                                                 {"values", contents.values},
                                                                 {"files", contents.files},
                                                                 {"hashes", contents.hashes},
                                                                 {"all", contents.all()}};
  if (options.json) {
    Json json{{"folder", places.folder.string()}};
    for (const auto& [name, share] : shares) json[name] = {{"files", share.files}, {"bytes", share.bytes}};
    json["types"] = Json::object();
    for (const auto& [type, records] : contents.of_type) json["types"][type] = records;
    fmt::print("{}\n", json_text(json, 2));
    return ok;
  }
  fmt::print("{}\n", places.folder.string());
  std::vector<std::vector<std::string>> rows, types;
  for (const auto& [name, share] : shares) rows.push_back({name, std::to_string(share.files), size_text(share.bytes)});
  for (const auto& [type, records] : contents.of_type) types.push_back({type, std::to_string(records)});
  fmt::print("{}{}", aligned(rows, {false, true, true}), aligned(types, {false, true}, "  "));
  return ok;
}

int gc(const CacheArguments& options) {
  const CachePlaces places = places_of(options.cache);
  const auto removed = collect_garbage(places, read_size(options.cache.size));
  if (!removed) throw Error("another process is removing files from " + places.folder.string(), "try again later");
  if (options.json) {
    fmt::print("{}\n", json_text(Json{{"folder", places.folder.string()},
                                      {"removed_files", removed->files},
                                      {"removed_bytes", removed->bytes},
                                      {"bytes", removed->left}},
                                 2));
    return ok;
  }
  fmt::print("removed {} ({}); {} are left\n", counted(removed->files, "file"), size_text(removed->bytes),
             size_text(removed->left));
  return ok;
}

int verify(const CacheArguments& options) {
  const CachePlaces places = places_of(options.cache);
  std::uint64_t checked = 0;
  const auto problems = verify_cache(places, checked);
  Json removed = Json::array();
  Json left = Json::array();
  for (const auto& problem : problems) (problem.removed ? removed : left).push_back(problem.what);
  if (options.json) {
    const Json json{{"folder", places.folder.string()}, {"checked", checked}, {"removed", removed}, {"left", left}};
    fmt::print("{}\n", json_text(json, 2));
  } else {
    for (const auto& problem : problems) fmt::print("{}: {}\n", problem.removed ? "removed" : "left", problem.what);
    fmt::print("{} checked, {} removed{}\n", counted(checked, "file"), removed.size(),
               left.empty() ? "" : fmt::format(", {} could not be checked or removed", left.size()));
  }
  return problems.empty() ? ok : failed;
}

}  // namespace

void add_cache(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand("cache", "What is kept of earlier runs: shows it, makes it smaller, checks it.");
  verb->require_subcommand(1);
  const auto options = std::make_shared<CacheArguments>();
  const auto add = [&](const char* name, const char* text, int (*work)(const CacheArguments&)) {
    auto* sub = verb->add_subcommand(name, text);
    sub->add_option("--cache", options->cache.folder, "its folder (default: as for `atrium run`)")->type_name("DIR");
    sub->add_flag("--json", options->json, "results as JSON on stdout");
    sub->callback([options, &exit_code, work] { exit_code = work(*options); });
    return sub;
  };
  add("stat", "Shows the cache's size by category.", stat);
  auto* garbage = add("gc", "Removes what has not been used for longest.", gc);
  add_size(*garbage, "--cache-size", options->cache.size, "size to shrink it to")->capture_default_str();
  add("verify", "Checks every file; removes those that are damaged.", verify);
}

}  // namespace atrium::cli
