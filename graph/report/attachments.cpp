#include "graph/report/attachments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <tuple>

#include "graph/api/files.hpp"
#include "graph/api/suggest.hpp"
#include "graph/cache/blob.hpp"
#include "graph/report/base64.hpp"

namespace atrium::report {
namespace {

namespace fs = std::filesystem;

std::string media_type_of(const std::string& path) {
  const std::string extension = fs::path(path).extension().string();
  if (extension == ".png") return "image/png";
  if (extension == ".jpg" || extension == ".jpeg") return "image/jpeg";
  if (extension == ".svg") return "image/svg+xml";
  if (extension == ".glb") return "model/gltf-binary";
  if (extension == ".ply") return "model/ply";
  return {};
}
/// Whether a file has no place in so many bytes of a page, however well it can be deflated: it need not be read then.
bool is_too_large(const fs::path& file, bool deflated, std::size_t room) {
  constexpr std::uint64_t best_deflation = 16;  // of models and drawings
  return fs::file_size(file) / (deflated ? best_deflation : 1) > room / 4 * 3 + 3;
}

bool is_picture(const std::string& path) { return media_type_of(path).starts_with("image/"); }

/// The header of a PLY file names faces.
bool has_faces(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string line;
  for (int i = 0; i < 200 && std::getline(stream, line) && !line.starts_with("end_header"); ++i)
    if (line.starts_with("element face ") && line.find_first_of("123456789", 13) != std::string::npos) return true;
  return false;
}

bool is_model(const fs::path& folder, const std::string& path) {
  const std::string type = media_type_of(path);
  return type == "model/gltf-binary" || (type == "model/ply" && has_faces(folder / path));
}

/// The paths of models, and which is taken when nobody says.
class ModelPaths {
 public:
  explicit ModelPaths(const SweepRecord& record) {
    for (const auto& variant : record.variants)
      for (const auto& file : variant.run.files) {
        const auto known = found_.find(file.path);
        if (known == found_.end() && !is_model(variant.run.folder, file.path)) continue;
        auto& [variants, bytes] = found_[file.path];
        ++variants;
        bytes += file.bytes;
      }
  }
  std::set<std::string> chosen(const std::vector<std::string>& wanted) const {
    if (found_.empty() && wanted.empty()) return {};
    if (wanted.empty()) return {best()};
    for (const auto& path : wanted) {
      if (found_.contains(path)) continue;
      std::vector<std::string> names;
      for (const auto& [name, count] : found_) names.push_back(name);
      throw Error(
          fmt::format("no variant has the model '{}'", path),
          names.empty() ? "no variant has one (.glb, or .ply with faces)" : "their models: " + join_words(names, 20));
    }
    return {wanted.begin(), wanted.end()};
  }

 private:
  std::string best() const {
    const auto rank = [](const auto& entry) {
      const auto& [path, count] = entry;
      return std::tuple(path.ends_with(".glb"), count.first, -static_cast<double>(count.second));
    };
    return std::max_element(found_.begin(), found_.end(),
                            [&](const auto& a, const auto& b) { return rank(a) < rank(b); })
        ->first;
  }
  std::map<std::string, std::pair<std::size_t, std::uint64_t>> found_;  ///< how many variants have it, bytes of all
};

class Collector {
 public:
  Collector(const SweepRecord& record, const AttachmentOptions& options) : record_(record), options_(options) {
    result_.variants.resize(record.variants.size());
  }

  Attachments collect() {
    const auto models = ModelPaths(record_).chosen(options_.models);
    collect_pictures();
    collect_models(models);
    for (const auto& variant : record_.variants)
      for (const auto& path : variant.run.outside)
        result_.notes.push_back(
            fmt::format("{} is not in the folder {}: it is left out.", path, variant.run.folder.string()));
    for (const auto& path : unreadable_) result_.notes.push_back(fmt::format("{} cannot be read.", path));
    return std::move(result_);
  }

 private:
  void collect_pictures() {
    std::size_t without = 0;
    for (std::size_t v = 0; v < record_.variants.size(); ++v)
      for (const auto& file : record_.variants[v].run.files) {
        if (!is_picture(file.path)) continue;
        const auto index = add(record_.variants[v].run, file, options_.max_bytes / 2);
        if (index) result_.variants[v].pictures.push_back({file.path, *index});
        without += index ? 0 : 1;
        result_.pictures += index ? 1 : 0;
      }
    note(without, without + result_.pictures, "pictures");
  }

  void collect_models(const std::set<std::string>& paths) {
    std::size_t of_variants = 0;
    std::size_t without = 0;
    for (std::size_t v = 0; v < record_.variants.size(); ++v) {
      bool any = false;
      for (const auto& file : record_.variants[v].run.files) {
        if (!paths.contains(file.path)) continue;
        const auto index =
            of_variants < options_.most_models ? add(record_.variants[v].run, file, options_.max_bytes) : std::nullopt;
        if (index) result_.variants[v].models.push_back({file.path, *index});
        any = any || index;
        without += index ? 0 : 1;
        result_.models += index ? 1 : 0;
      }
      of_variants += any ? 1 : 0;
    }
    note(without, without + result_.models, "models");
  }

  void note(std::size_t without, std::size_t all, std::string_view what) {
    if (without > 0)
      result_.notes.push_back(fmt::format(
          "{} of {} {} are not in this file, to keep it small; they are in the variants' folders, and more room "
          "is given with --max-size{}.",
          without, all, what, what == "models" ? " and --most-models" : ""));
  }

  /// The file's index; nothing if there is no room for it or it cannot be read.
  std::optional<std::size_t> add(const RunRecord& run, const Artefact& file, std::size_t room) {
    const fs::path path = run.folder / file.path;
    const std::string hash = file.hash.empty() ? hash_if_readable(path) : file.hash;
    if (const auto known = known_.find(hash); known != known_.end()) return known->second;
    Attachment attachment{media_type_of(file.path), file.path.ends_with(".svg") || !is_picture(file.path), {}};
    std::string text;
    try {
      if (bytes_ >= room || is_too_large(path, attachment.deflated, room - bytes_)) return std::nullopt;
      text = read_text(path);
    } catch (const std::exception&) {
      unreadable_.push_back(path.string());
      return std::nullopt;
    }
    attachment.base64 = to_base64(attachment.deflated ? deflated(text) : text);
    if (bytes_ + attachment.base64.size() > room) return std::nullopt;
    bytes_ += attachment.base64.size();
    result_.files.push_back(std::move(attachment));
    known_.emplace(hash, result_.files.size() - 1);
    return result_.files.size() - 1;
  }

  const SweepRecord& record_;
  const AttachmentOptions& options_;
  Attachments result_;
  std::size_t bytes_ = 0;
  std::map<std::string, std::size_t> known_;  ///< by content
  std::vector<std::string> unreadable_;
};

}  // namespace

Attachments attach(const SweepRecord& record, const AttachmentOptions& options) {
  return Collector(record, options).collect();
}

}  // namespace atrium::report
