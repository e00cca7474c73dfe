#include "graph/run/node_host.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>

namespace atrium {
namespace {

Artefact describe(const std::filesystem::path& file, const std::filesystem::path& folder) {
  Artefact artefact;
  const auto absolute = std::filesystem::absolute(file).lexically_normal();
  const auto relative = folder.empty()
                            ? std::filesystem::path()
                            : absolute.lexically_relative(std::filesystem::absolute(folder).lexically_normal());
  const bool inside = !relative.empty() && *relative.begin() != "..";
  artefact.path = (inside ? relative : absolute).generic_string();
  std::error_code gone;
  const auto size = std::filesystem::file_size(absolute, gone);
  artefact.bytes = gone ? 0 : size;
  return artefact;
}

}  // namespace

void NodeHost::log(Level level, std::string_view text) {
  if (level == Level::warning) {
    const std::lock_guard lock(mutex_);
    warnings_.emplace_back(text);
  }
  progress_.message(node_, text, level == Level::warning);
}

void NodeHost::wrote(const std::filesystem::path& file) {
  keep(file);  // before the run's stamp is put into it
  if (is_png(file)) stamp_png(file, stamp_);
  const std::lock_guard lock(mutex_);
  files_.push_back(file);
  if (folder_.empty() || !subfolder_.empty()) return;
  const std::string line = describe(file, folder_).path + "\n";
  const int journal =
      ::open((folder_ / written_journal).c_str(), O_WRONLY | O_CREAT | O_APPEND | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (journal < 0 || ::write(journal, line.data(), line.size()) < 0)
    progress_.message(node_, "cannot note " + line.substr(0, line.size() - 1) + ": a later run would not remove it",
                      true);
  if (journal >= 0) ::close(journal);
}

void NodeHost::keep(const std::filesystem::path& file) {
  if (cache_ == nullptr) return;
  const auto from = std::filesystem::absolute(output_folder()).lexically_normal();
  const auto relative = std::filesystem::absolute(file).lexically_normal().lexically_relative(from);
  if (relative.empty() || *relative.begin() == "..") return;
  std::error_code gone;
  const std::uint64_t bytes = std::filesystem::file_size(file, gone);
  const auto hash = cache_->keep_file(file);
  const std::lock_guard lock(mutex_);
  if (hash && !gone) kept_[relative.generic_string()] = {relative.generic_string(), bytes, *hash};
}

std::vector<Artefact> NodeHost::kept() {
  const std::lock_guard lock(mutex_);
  std::vector<Artefact> files;
  for (const auto& [path, file] : kept_) files.push_back(file);
  return files;
}

void NodeHost::helped(double cpu_seconds) {
  const std::lock_guard lock(mutex_);
  helped_ += cpu_seconds;
}

void NodeHost::finish(NodeRecord& record) {
  const std::lock_guard lock(mutex_);
  record.cpu += helped_;
  record.warnings = std::move(warnings_);
  record.artefacts.clear();
  for (const auto& file : files_) record.artefacts.push_back(describe(file, folder_));
  const auto by_path = [](const Artefact& a, const Artefact& b) { return a.path < b.path; };
  std::sort(record.artefacts.begin(), record.artefacts.end(), by_path);
  const auto same = [](const Artefact& a, const Artefact& b) { return a.path == b.path; };
  record.artefacts.erase(std::unique(record.artefacts.begin(), record.artefacts.end(), same), record.artefacts.end());
}

}  // namespace atrium
