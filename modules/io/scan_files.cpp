#include "modules/io/scan_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "graph/api/error.hpp"
#include "modules/io/joined_source.hpp"
#include "modules/io/read_geometry.hpp"

namespace atrium::io {
namespace {

namespace fs = std::filesystem;

class ScanFiles {
 public:
  explicit ScanFiles(const Context& context) : context_(context) {}

  void add(const std::string& path) {
    std::error_code ignored;
    if (fs::is_directory(path, ignored))
      add_folder(path);
    else
      read(path);
  }

  RawGeometry result() {
    if (parts_.size() == 1) return std::move(parts_.front());
    std::string names;
    for (const auto& part : parts_) names += (names.empty() ? "" : ", ") + fs::path(part.path).filename().string();
    context_.info(fmt::format("{} files are one scan: {}", parts_.size(), names));
    return joined(std::move(parts_), context_);
  }

 private:
  void read(const std::string& path) {
    std::error_code ignored;
    const fs::path place = fs::weakly_canonical(path, ignored);
    if (!ignored && fs::is_regular_file(place, ignored) && !places_.insert(place).second)
      throw Error(path + ": this file is given twice", "give each file once");
    parts_.push_back(read_geometry(path, context_, Rows::left));
  }

  void add_folder(const fs::path& folder) {
    std::vector<fs::path> files;
    std::string passed;
    const auto pass = [&](const fs::path& file, const std::string& why) {
      passed += fmt::format("{}{} ({})", passed.empty() ? "" : ", ", file.filename().string(), why);
    };
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
      const std::string name = entry.path().filename().string();
      if (name.starts_with('.')) continue;
      std::error_code ignored;
      if (entry.is_regular_file(ignored))
        files.push_back(entry.path());
      else if (entry.is_directory(ignored))
        pass(name, "a folder");
    }
    if (error) throw Error(fmt::format("cannot read the folder {}: {}", folder.string(), error.message()));
    std::sort(files.begin(), files.end());
    const std::size_t before = parts_.size();
    for (const auto& file : files) {
      const std::string why = why_no_scan(file.string());
      if (why.empty())
        read(file.string());
      else
        pass(file, why);
      if (why.empty() && !parts_.back().triangles.empty()) {
        parts_.pop_back();
        pass(file, "a mesh");
      }
    }
    if (parts_.size() == before)
      throw Error(fmt::format("{}: no file in this folder is a scan{}", folder.string(),
                              passed.empty() ? ": it is empty" : "; there are: " + passed),
                  "give a folder with E57, LAS, LAZ, PTX, PLY, PCD or text files, or the files' names");
    if (!passed.empty()) context_.warn(fmt::format("{}: passed over: {}", folder.string(), passed));
  }

  const Context& context_;
  std::vector<RawGeometry> parts_;
  std::set<fs::path> places_;
};

}  // namespace

RawGeometry read_scan_files(const std::vector<std::string>& paths, const Context& context) {
  if (paths.empty()) throw Error("no scan is given", "give `path`: a file, or several as [a.e57, b.e57]");
  ScanFiles files(context);
  for (const auto& path : paths) files.add(path);
  return files.result();
}

}  // namespace atrium::io
