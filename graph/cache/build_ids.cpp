#include "graph/cache/build_ids.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "graph/api/plugin.hpp"
#include "graph/api/plugin_data.hpp"
#include "graph/cache/places.hpp"

namespace atrium {
namespace {

namespace fs = std::filesystem;

/// What libraries choose their code by.
std::string processor() {
#if defined(__x86_64__)
  return fmt::format(" on x86-64{}{}{}", __builtin_cpu_supports("avx2") != 0 ? " avx2" : "",
                     __builtin_cpu_supports("fma") != 0 ? " fma" : "",
                     __builtin_cpu_supports("avx512f") != 0 ? " avx512f" : "");
#else
  return "";
#endif
}

bool is_framework(const fs::path& file) { return file.filename().string().starts_with("libatrium.so"); }

/// Whether a program beside the plugins may be one of this plugin's: "atrium-pdf-draw" is that of pdf alone.
bool may_be_program_of(const fs::path& library, const std::string& program) {
  constexpr std::string_view prefix = "atrium-";
  if (!program.starts_with(prefix)) return false;
  const std::string rest = program.substr(prefix.size());
  const std::string owner = fmt::format("libatrium_{}.so", rest.substr(0, rest.find('-')));
  std::error_code ignored;
  return library.filename() == owner || !fs::exists(library.parent_path() / owner, ignored);
}

/// A plugin's library, its second one, and the programs beside them.
std::vector<fs::path> code_of(const fs::path& library) {
  std::error_code ignored;
  std::vector<fs::path> files{library};
  const std::string second = library.stem().string() + "-run.so";
  for (const auto& entry : fs::directory_iterator(library.parent_path(), ignored)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_regular_file(ignored) && !entry.is_symlink(ignored) &&
        (name == second || may_be_program_of(library, name)))
      files.push_back(entry.path());
  }
  return files;
}

std::string fingerprints(const std::vector<fs::path>& files) {
  std::string text;
  for (const auto& file : files) text += FileHashes::fingerprint(file) + "\n";
  return text;
}

}  // namespace

/// A name, and what the linker says of it, or else its contents.
std::string BuildIds::text_of(const fs::path& file) {
  if (!file.is_absolute()) return file.string() + "\n";  // a library that cannot be found
  const std::string id = libraries_.notes(file).build_id;
  return fmt::format("{} {}\n", file.filename().string(), id.empty() ? files_.of(file) : id);
}

const BuildIds::Build& BuildIds::build_of(const std::string& library) {
  const auto [known, fresh] = known_.try_emplace(library);
  Build& build = known->second;
  if (!fresh && !build.hash.empty()) return build;
  const std::vector<fs::path> code =
      library.empty() ? std::vector<fs::path>{fs::canonical("/proc/self/exe")} : code_of(library);
  const auto data = library.empty() ? std::vector<fs::path>{} : plugin_data_files(library);
  build.files = code;
  build.files.insert(build.files.end(), data.begin(), data.end());
  build.fingerprint = fingerprints(build.files);
  std::map<std::string, fs::path> all;  // by name: in the same order everywhere
  for (const auto& file : code)
    for (const auto& linked : libraries_.of(file))
      if (!is_framework(linked)) all.emplace(linked.filename().string(), linked);
  std::string text = fmt::format("{}\n", ATRIUM_STAMP);
  for (const auto& [name, file] : all) text += text_of(file);
  for (const auto& file : data) text += fmt::format("{} {}\n", file.filename().string(), files_.of(file));
  build.hash = hash_of_text(text);
  return build;
}

std::string BuildIds::of(const NodeType& type) { return of_library(type.library) + processor(); }

std::string BuildIds::of_library(const std::string& library) {
  const std::lock_guard lock(mutex_);
  return build_of(library).hash;
}

bool BuildIds::unchanged(const NodeType& type) {
  const std::lock_guard lock(mutex_);
  const Build& build = build_of(type.library);
  return fingerprints(build.files) == build.fingerprint;
}

std::string build_of_all(const Registry& registry) {
  FileHashes files;
  BuildIds builds(files);
  std::string text;
  for (const auto& file : registry.plugin_files())
    text += fmt::format("{} {}\n", file.filename().string(), builds.of_library(file.string()));
  return hash_of_text(text);
}

}  // namespace atrium
