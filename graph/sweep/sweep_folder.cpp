#include "graph/sweep/sweep_folder.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "graph/api/files.hpp"
#include "graph/api/json_text.hpp"
#include "graph/run/run_folder.hpp"

namespace atrium {
namespace {

namespace fs = std::filesystem;

/// What the sweep is of, for programs that read its folder: axes with the labels of their choices in order, and what
/// each sets; metrics with the digits that they are shown with.
std::string sweep_json(const SweepFile& sweep) {
  using Json = nlohmann::ordered_json;
  Json json{{"atrium", framework_version()}, {"sweep", sweep.path.string()}, {"base", sweep.base.string()}};
  if (!sweep.summary.empty()) json["summary"] = sweep.summary;
  json["axes"] = Json::array();
  for (const auto& axis : sweep.axes) {
    Json choices = Json::array();
    for (const auto& choice : axis.choices) {
      Json set = Json::object();
      for (const auto& setting : choice.settings) set[setting.target] = setting.value;
      choices.push_back({{"label", choice.label}, {"set", std::move(set)}});
    }
    json["axes"].push_back({{"name", axis.name}, {"choices", std::move(choices)}});
  }
  json["metrics"] = Json::array();
  for (const auto& metric : sweep.metrics) {
    Json shown{{"name", metric.name}};
    if (metric.digits) shown["digits"] = *metric.digits;
    json["metrics"].push_back(std::move(shown));
  }
  json["pictures"] = Json::array();
  for (const auto& sheet : sweep.sheets) json["pictures"].push_back({{"file", sheet.file}, {"picture", sheet.picture}});
  return json_text(json, 1) + "\n";
}

}  // namespace

SweepFolder::SweepFolder(const fs::path& folder, const SweepFile& sweep) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw FolderError("cannot make the folder " + folder.string() + ": " + error.message());
  if (!fs::exists(folder / sweep_mark) && !holds_only_unfinished(folder))
    throw FolderError(folder.string() + " is not empty and is not the folder of a sweep",
                      "choose another folder with --out, or empty it");
  lock(folder, FolderLock::Kind::alone);
  // Nobody else writes here: what is not finished is of a process that was killed.
  std::vector<fs::path> unfinished;
  for (const auto& entry : fs::recursive_directory_iterator(folder, error))
    if (!name_of_unfinished(entry.path().filename().string()).empty()) unfinished.push_back(entry.path());
  for (const auto& file : unfinished) fs::remove(file, error);
  write_file(folder / sweep_mark, sweep_json(sweep));
}

SweepFolder::SweepFolder(const fs::path& folder) { lock(folder, FolderLock::Kind::shared); }

void SweepFolder::lock(const fs::path& folder, FolderLock::Kind kind) {
  try {
    lock_.emplace(folder, kind);
  } catch (const Error& problem) {
    throw FolderError(problem.what(), problem.help());
  }
  if (!lock_->held())
    throw FolderError(fmt::format("another sweep is writing into {} ({})", folder.string(), lock_->holder()),
                      "wait for it, or choose another folder with --out");
}

}  // namespace atrium
