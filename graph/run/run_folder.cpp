#include "graph/run/run_folder.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "graph/api/files.hpp"
#include "graph/api/json_text.hpp"
#include "graph/api/text.hpp"
#include "graph/cache/node_key.hpp"
#include "graph/run/manifest.hpp"
#include "graph/run/node_host.hpp"
#include "graph/run/trace.hpp"

namespace atrium {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// Null unless the folder holds a run of ours.
Json read_manifest(const fs::path& folder) {
  Json manifest = read_json_file(folder / "manifest.json");
  if (!manifest.is_object() || !manifest.contains("atrium")) return nullptr;
  return manifest;
}

/// The path without links; as it is where it has none, as a pipe's.
fs::path without_links(const fs::path& file) {
  std::error_code error;
  fs::path real = fs::weakly_canonical(file, error);
  return error ? file : real;
}

std::set<fs::path> files_read(const Pipeline& pipeline) {
  std::set<fs::path> files;
  for (const std::size_t n : all_nodes(pipeline))
    for (const auto& file : input_files(pipeline[n])) files.insert(without_links(file));
  return files;
}

/// What an earlier run wrote: the files that its manifest lists, with their sizes.
std::vector<std::pair<std::string, std::uint64_t>> written_by(const Json& manifest) {
  std::vector<std::pair<std::string, std::uint64_t>> files;
  try {
    for (const auto& node : manifest.value("nodes", Json::array()))
      for (const auto& artefact : node.value("artefacts", Json::array()))
        files.emplace_back(artefact.value("path", ""), artefact.value("bytes", 0U));
  } catch (const Json::exception&) {
    throw FolderError("the manifest.json of an earlier run cannot be understood",
                      "choose another folder with --out, or empty it");
  }
  return files;
}

/// Throws FolderError if the folder holds anything but a run.
void refuse_what_is_no_run(const fs::path& folder) {
  if (holds_only_unfinished(folder)) return;
  if (fs::exists(folder / sweep_mark))
    throw FolderError(folder.string() + " is the folder of a sweep", "choose another folder with --out");
  if (read_manifest(folder).is_null())
    throw FolderError(folder.string() + " is not empty and is not the folder of a run",
                      "choose another folder with --out, or empty it");
}

}  // namespace

void write_file(const fs::path& target, const std::string& text, bool flush) {
  AtomicFile file(target);
  file.write(text);
  file.publish(flush);
}

void make_out_folder(const fs::path& folder) {
  try {
    make_folder(folder);
  } catch (const Error& problem) {
    throw FolderError(problem.what(), problem.help());
  }
}

void lock_out_folder(const fs::path& folder, FolderLock::Kind kind, std::string_view what,
                     std::optional<FolderLock>& lock) {
  try {
    lock.emplace(folder, kind);
  } catch (const Error& problem) {
    throw FolderError(problem.what(), problem.help());
  }
  if (!lock->held())
    throw FolderError(fmt::format("another {} is writing into {} ({})", what, folder.string(), lock->holder()),
                      "wait for it, or choose another folder with --out");
}

std::vector<fs::path> unfinished_files(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const auto& entry : fs::recursive_directory_iterator(folder, ignored))
    if (!name_of_unfinished(entry.path().filename().string()).empty()) files.push_back(entry.path());
  return files;
}

RunFolder::RunFolder(fs::path folder, const Pipeline& pipeline)
    : folder_(std::move(folder)), pipeline_(pipeline), started_(utc_text()) {
  make_out_folder(folder_);
  refuse_what_is_no_run(folder_);  // before anything, even a lock, is put into it
  lock_out_folder(folder_, FolderLock::Kind::alone, "run", lock_);
  refuse_what_is_no_run(folder_);
  const auto earlier = files_of_earlier_run();
  write_file(folder_ / "manifest.json", unfinished_manifest(pipeline_, started_, earlier));
  std::vector<fs::path> to_remove = unfinished_files(folder_);
  for (const auto& path : earlier) to_remove.push_back(place_inside(folder_, path).value_or(fs::path()));
  std::error_code ignored;
  remove_unless_read(to_remove);
  fs::remove(folder_ / written_journal, ignored);
  fs::remove(folder_ / "trace.json", ignored);
  write_file(folder_ / "resolved.yaml", resolved_yaml(pipeline_));
}

/// As the folder's manifest and journal list them.
std::vector<std::string> RunFolder::files_of_earlier_run() const {
  std::vector<std::string> files;
  if (holds_only_unfinished(folder_)) return files;
  const auto manifest = read_manifest(folder_);
  std::error_code missing;
  for (const auto& [path, bytes] : written_by(manifest))
    if (fs::file_size(place_inside(folder_, path).value_or(fs::path()), missing) == bytes) files.push_back(path);
  // A run that was killed lists what it was going to write and what it has written.
  if (const auto planned = manifest.find("planned"); planned != manifest.end() && planned->is_array())
    for (const auto& path : *planned)
      if (path.is_string()) files.push_back(path.get<std::string>());
  std::ifstream journal(folder_ / written_journal);
  for (std::string path; std::getline(journal, path);) files.push_back(path);
  return files;
}

void RunFolder::remove_unless_read(const std::vector<fs::path>& files) const {
  const auto needed = files_read(pipeline_);
  std::error_code ignored;
  for (const auto& file : files)
    if (fs::is_regular_file(file, ignored) && !needed.contains(without_links(file))) fs::remove(file, ignored);
}

void RunFolder::finish(const RunResult& result) {
  write_file(folder_ / "trace.json", trace_json(result));
  write_file(folder_ / "manifest.json", manifest_json(pipeline_, result, started_));
  std::error_code ignored;
  std::filesystem::remove(folder_ / written_journal, ignored);
}

}  // namespace atrium
