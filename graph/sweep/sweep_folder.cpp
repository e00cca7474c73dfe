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
  make_out_folder(folder);
  if (!fs::exists(folder / sweep_mark) && !holds_only_unfinished(folder))
    throw FolderError(folder.string() + " is not empty and is not the folder of a sweep",
                      "choose another folder with --out, or empty it");
  lock_out_folder(folder, FolderLock::Kind::alone, "sweep", lock_);
  // Nobody else writes here: what is not finished is of a process that was killed.
  std::error_code ignored;
  for (const auto& file : unfinished_files(folder)) fs::remove(file, ignored);
  write_file(folder / sweep_mark, sweep_json(sweep));
}

SweepFolder::SweepFolder(const fs::path& folder) { lock_out_folder(folder, FolderLock::Kind::shared, "sweep", lock_); }

}  // namespace atrium
