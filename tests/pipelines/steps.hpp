#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace atrium::test {

namespace fs = std::filesystem;

inline const fs::path source = ATRIUM_SOURCE_DIR;
inline const fs::path scans = source.parent_path() / "shared" / "scans";

/// `atrium WORDS…` in the checkout's folder.
inline ProcessResult atrium(std::vector<std::string> words, double timeout = 120) {
  words.insert(words.begin(), ATRIUM_PROGRAM);
  ProcessOptions options;
  options.folder = source;
  options.timeout = timeout;
  return run_process(words, options);
}

/// `atrium run pipelines/NAME -s … --out FOLDER`.
inline ProcessResult run_pipeline_file(const std::string& name, const std::vector<std::string>& settings,
                                       const fs::path& out, const std::vector<std::string>& more = {}) {
  std::vector<std::string> words{"run", "pipelines/" + name, "--quiet", "--out", out.string()};
  for (const auto& setting : settings) words.insert(words.end(), {"-s", setting});
  words.insert(words.end(), more.begin(), more.end());
  return atrium(words);
}

/// The value of a metric by its dotted name, from a run's metrics.json.
inline double metric(const fs::path& file, const std::string& name) {
  nlohmann::json node = nlohmann::json::parse(read_text(file));
  std::stringstream parts(name);
  std::string part;
  while (std::getline(parts, part, '.')) node = node.at(part);
  return node.at("value").get<double>();
}

}  // namespace atrium::test
