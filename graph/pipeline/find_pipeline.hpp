#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "graph/pipeline/findings.hpp"

namespace atrium {

/// Where the pipeline or sweep lies that a file or the command line names.
struct NamedPipeline {
  std::filesystem::path path;  ///< absolute; where there is none, what it would be in the folder of whoever names it
  bool is_installed = false;   ///< it is one of installed_pipelines(), not in that folder
};

/// The folder of the pipelines that came with this program: share/atrium/pipelines of the installation; the checkout's
/// own in a build tree. Its real path; empty if there is none.
const std::filesystem::path& installed_pipelines();
/// Their names as find_pipeline() takes them, sorted: "ablations/alignment.yaml", "atrium.yaml".
const std::vector<std::string>& installed_pipeline_names();

/// The file `text` in `folder` or, if nothing of that name is there, in installed_pipelines(). What is absolute, begins
/// with "./" or leads out of the folder ("../") means that one place only. A link to nowhere counts as being there.
NamedPipeline find_pipeline(const std::filesystem::path& folder, const std::string& text);

/// For whoever names what find_pipeline() has not found: what was meant most likely, and the places that were looked
/// at.
std::string help_for_missing_pipeline(const std::filesystem::path& folder, const std::string& text, Findings& findings);

/// The file that the command line names, from the working folder: its path, and how messages name it (as it was given,
/// or its real place if it is an installed one). Reports that there is none.
struct GivenPipeline {
  std::filesystem::path path;
  std::string name;
};
GivenPipeline find_given_pipeline(const std::string& text, Findings& findings);

}  // namespace atrium
