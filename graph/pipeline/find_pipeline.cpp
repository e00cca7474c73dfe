#include "graph/pipeline/find_pipeline.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>

#include "graph/api/broken_link.hpp"
#include "graph/api/plugin_data.hpp"

namespace atrium {

namespace fs = std::filesystem;

namespace {

fs::path folder_beside_this_library() {
  Dl_info info{};
  static const char anchor = 0;
  if (::dladdr(&anchor, &info) == 0 || info.dli_fname == nullptr) return {};
  std::error_code problem;
  const fs::path folder = fs::canonical(data_folder(info.dli_fname, "pipelines"), problem);
  return problem ? fs::path{} : folder;
}

/// Whether the text may name an installed pipeline: a path within a folder, without "./" before it.
bool is_bare(const std::string& text) {
  const fs::path path(text);
  if (text.empty() || path.is_absolute() || text.starts_with("./")) return false;
  const fs::path normal = path.lexically_normal();
  return !normal.empty() && *normal.begin() != ".." && normal != ".";
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code problem;
  fs::recursive_directory_iterator it(folder, problem);
  for (const fs::recursive_directory_iterator end; !problem && it != end; it.increment(problem))
    if (it->path().extension() == ".yaml") names.push_back(it->path().lexically_relative(folder).string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

const fs::path& installed_pipelines() {
  static const fs::path folder = folder_beside_this_library();
  return folder;
}

const std::vector<std::string>& installed_pipeline_names() {
  static const std::vector<std::string> names = names_in(installed_pipelines());
  return names;
}

NamedPipeline find_pipeline(const fs::path& folder, const std::string& text) {
  std::error_code problem;
  NamedPipeline found{(folder / text).lexically_normal()};
  const fs::file_status here = fs::symlink_status(found.path, problem);
  if (here.type() != fs::file_type::not_found || !is_bare(text) || installed_pipelines().empty()) return found;
  fs::path installed = (installed_pipelines() / text).lexically_normal();
  if (fs::is_regular_file(installed, problem)) return {std::move(installed), true};
  return found;
}

std::string help_for_missing_pipeline(const fs::path& folder, const std::string& text, Findings& findings) {
  std::string help = "looked for " + (folder / text).lexically_normal().string();
  if (!is_bare(text) || installed_pipelines().empty()) return help;
  help += " and for " + (installed_pipelines() / text).lexically_normal().string();
  if (!findings.may_suggest()) return help;
  const auto& names = installed_pipeline_names();
  std::string hint = findings.suggest(text, names);
  if (const std::string file = fs::path(text).filename().string(); hint.empty() && file != text)
    hint = findings.suggest(file, names);  // pipelines/atrium.yaml, as in a checkout
  return hint.empty() ? help : fmt::format("{} ({})", hint, help);
}

GivenPipeline find_given_pipeline(const std::string& text, Findings& findings) {
  std::error_code problem;
  const fs::path folder = fs::current_path(problem);
  NamedPipeline found = find_pipeline(folder, text);
  if (found.is_installed) return {found.path, found.path.string()};
  if (!fs::exists(fs::status(found.path, problem))) {
    const SourceFile source{text, folder};
    const std::string link = broken_link(found.path);
    findings.error({&source, {}}, link.empty() ? "no such pipeline file" : "no such pipeline file: it " + link,
                   help_for_missing_pipeline(folder, text, findings));
  }
  return {std::move(found.path), text};
}

}  // namespace atrium
