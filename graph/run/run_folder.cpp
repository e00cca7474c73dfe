#include "graph/run/run_folder.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>

#include "graph/cache/node_key.hpp"
#include "graph/run/manifest.hpp"
#include "graph/run/node_host.hpp"
#include "graph/run/trace.hpp"

namespace atrium {
namespace {

namespace fs = std::filesystem;

// Null unless the folder holds a run of ours.
nlohmann::json read_manifest(const fs::path& folder) {
  std::ifstream file(folder / "manifest.json");
  auto manifest = nlohmann::json::parse(file, nullptr, false);
  if (!manifest.is_object() || !manifest.contains("atrium")) return nullptr;
  return manifest;
}

std::set<fs::path> files_read(const Pipeline& pipeline) {
  std::set<fs::path> files;
  for (const auto& node : pipeline.nodes)
    for (const auto& file : input_files(node)) files.insert(fs::weakly_canonical(file));
  return files;
}

/// What an earlier run wrote: the files that its manifest lists, with their sizes.
std::vector<std::pair<std::string, std::uint64_t>> written_by(const nlohmann::json& manifest) {
  std::vector<std::pair<std::string, std::uint64_t>> files;
  try {
    for (const auto& node : manifest.value("nodes", nlohmann::json::array()))
      for (const auto& artefact : node.value("artefacts", nlohmann::json::array()))
        files.emplace_back(artefact.value("path", ""), artefact.value("bytes", 0U));
  } catch (const nlohmann::json::exception&) {
    throw FolderError("the manifest.json of an earlier run cannot be understood",
                      "choose another folder with --out, or empty it");
  }
  return files;
}

}  // namespace

void write_file(const fs::path& target, const std::string& text, bool flush) {
  AtomicFile file(target);
  file.write(text);
  file.publish(flush);
}

RunFolder::RunFolder(fs::path folder, const Pipeline& pipeline)
    : folder_(std::move(folder)),
      pipeline_(pipeline),
      started_(fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))) {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) throw FolderError("cannot make the folder " + folder_.string() + ": " + error.message());
  lock();
  try {
    remove_earlier_run();
    write_file(folder_ / "manifest.json", unfinished_manifest(pipeline_, started_));
    write_file(folder_ / "resolved.yaml", resolved_yaml(pipeline_));
  } catch (...) {
    ::close(lock_);
    throw;
  }
}

RunFolder::~RunFolder() { ::close(lock_); }

void RunFolder::lock() {
  lock_ = ::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ < 0) throw FolderError("cannot open the folder " + folder_.string() + ": " + std::strerror(errno));
  if (::flock(lock_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  ::close(lock_);
  throw FolderError("another run is writing into " + folder_.string(), "choose another folder with --out");
}

bool holds_only_unfinished(const fs::path& folder) {
  const fs::directory_iterator entries(folder);
  return std::all_of(fs::begin(entries), fs::end(entries), [](const fs::directory_entry& entry) {
    const std::string name = entry.path().filename().string();
    return name.starts_with('.') && name.ends_with(".part");
  });
}

void RunFolder::remove_earlier_run() {
  if (holds_only_unfinished(folder_)) return;
  if (fs::exists(folder_ / sweep_mark))
    throw FolderError(folder_.string() + " is the folder of a sweep", "choose another folder with --out");
  const auto manifest = read_manifest(folder_);
  if (manifest.is_null())
    throw FolderError(folder_.string() + " is not empty and is not the folder of a run",
                      "choose another folder with --out, or empty it");
  const auto needed = files_read(pipeline_);
  const auto place = [&](const std::string& listed) {
    const fs::path relative = fs::path(listed).lexically_normal();
    const bool inside = !relative.empty() && !relative.is_absolute() && *relative.begin() != "..";
    return inside ? folder_ / relative : fs::path();
  };
  std::error_code ignored;
  const auto remove_unless_read = [&](const fs::path& file) {
    if (fs::is_regular_file(file, ignored) && !needed.contains(fs::weakly_canonical(file))) fs::remove(file, ignored);
  };
  for (const auto& [path, bytes] : written_by(manifest)) {
    const fs::path file = place(path);
    if (fs::file_size(file, ignored) == bytes) remove_unless_read(file);
  }
  // A run that was killed lists what it was going to write and what it has written, and may have left unfinished files.
  if (const auto planned = manifest.find("planned"); planned != manifest.end() && planned->is_array())
    for (const auto& path : *planned)
      if (path.is_string()) remove_unless_read(place(path.get<std::string>()));
  std::ifstream journal(folder_ / written_journal);
  for (std::string path; std::getline(journal, path);) remove_unless_read(place(path));
  fs::remove(folder_ / written_journal, ignored);
  std::vector<fs::path> unfinished;
  for (const auto& entry : fs::recursive_directory_iterator(folder_, ignored))
    if (entry.path().extension() == ".part" && entry.path().filename().string().front() == '.')
      unfinished.push_back(entry.path());
  for (const auto& file : unfinished) remove_unless_read(file);
  fs::remove(folder_ / "trace.json", ignored);
}

void RunFolder::finish(const RunResult& result) {
  write_file(folder_ / "trace.json", trace_json(result));
  write_file(folder_ / "manifest.json", manifest_json(pipeline_, result, started_));
  std::error_code ignored;
  std::filesystem::remove(folder_ / written_journal, ignored);
}

}  // namespace atrium
