#include "graph/report/view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "graph/api/files.hpp"
#include "graph/api/json_text.hpp"
#include "graph/pipeline/pipeline.hpp"
#include "graph/report/base64.hpp"
#include "graph/report/page.hpp"

namespace atrium::report {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string media_type_in_view(const std::string& path) {
  const std::string extension = fs::path(path).extension().string();
  if (extension == ".json") return "application/json";
  if (extension == ".csv") return "text/csv";
  if (extension == ".svg") return "image/svg+xml";
  if (extension == ".glb") return "model/gltf-binary";
  return "application/octet-stream";
}

class Packer {
 public:
  Packer(const RunRecord& run, std::size_t room) : run_(run), room_(room) {}

  View pack(const ViewWishes& wishes) {
    view_.parts.reserve(wishes.parts.size());
    for (const auto& wish : wishes.parts) {
      view_.parts.push_back(part_of(wish));
      view_.lacking += view_.parts.back().path.empty() ? 1 : 0;
    }
    return std::move(view_);
  }

 private:
  ViewPart part_of(const ViewWish& wish) {
    ViewPart part;
    part.part = wish.part;
    for (const auto& path : candidates(wish)) {
      const std::string problem = add(path);
      if (problem.empty()) {
        part.path = path;
        part.lacking.clear();
        part.file = view_.files.size() - 1;
        return part;
      }
      if (part.lacking.empty()) part.lacking = problem;
    }
    if (part.lacking.empty()) part.lacking = nobody_wrote(wish);
    return part;
  }

  /// Files of the wished names in their order, then others that a node of that type has written.
  std::vector<std::string> candidates(const ViewWish& wish) const {
    std::vector<std::string> found;
    const auto take = [&](const std::string& path) {
      if (std::find(found.begin(), found.end(), path) == found.end()) found.push_back(path);
    };
    for (const auto& name : wish.files)
      for (const auto& file : run_.files)
        if (fs::path(file.path).filename() == name) take(file.path);
    for (const auto& node : run_.nodes)
      for (const auto& file : node.artefacts)
        if (node.type == wish.node && has_extension_of(file.path, wish) && place_inside(run_.folder, file.path))
          take(file.path);
    return found;
  }
  static bool has_extension_of(const std::string& path, const ViewWish& wish) {
    return std::any_of(wish.files.begin(), wish.files.end(), [&](const std::string& name) {
      return fs::path(name).extension() == fs::path(path).extension();
    });
  }

  /// Why the file is not in the page; empty if it is.
  std::string add(const std::string& path) {
    const fs::path file = run_.folder / path;
    std::error_code code;
    const auto bytes = fs::file_size(file, code);
    if (code) return fmt::format("{} is not in the run's folder any more", path);
    const auto too_large = [&](double size) {
      return fmt::format("{} takes {:.1f} MB of the page, which has room for {:.1f} MB: --max-size gives more", path,
                         size / 1e6, static_cast<double>(room_) / 1e6);
    };
    constexpr std::uint64_t best_deflation = 32;
    if (bytes / best_deflation > room_) return too_large(static_cast<double>(bytes));
    Attachment attachment{media_type_in_view(path), true, {}};
    try {
      attachment.base64 = to_base64(deflated(read_text(file)));
    } catch (const std::exception& error) {
      return fmt::format("{} cannot be read: {}", path, error.what());
    }
    if (attachment.base64.size() > room_) return too_large(static_cast<double>(attachment.base64.size()));
    room_ -= attachment.base64.size();
    view_.files.push_back(std::move(attachment));
    return {};
  }

  std::string nobody_wrote(const ViewWish& wish) const {
    const std::string written = fmt::format("{} is lacking: {} writes it", wish.files.front(), wish.node);
    const NodeRecord* node = nullptr;
    for (const auto& other : run_.nodes)
      if (other.type == wish.node && (node == nullptr || node->status == NodeStatus::ok)) node = &other;
    if (node == nullptr) return written + ", and this run has no such node";
    if (node->status == NodeStatus::failed)
      return fmt::format("{}; in this run '{}' failed: {}", written, node->node, node->message);
    if (node->status == NodeStatus::ok)
      return fmt::format("{}; in this run '{}' wrote other files", written, node->node);
    return fmt::format("{}; in this run '{}' was not run", written, node->node);
  }

  const RunRecord& run_;
  std::size_t room_;
  View view_;
};

Json view_data(const RunRecord& run, const ViewWishes& wishes, const View& view) {
  Json parts = Json::array();
  for (const auto& part : view.parts) {
    Json entry{{"part", part.part}};
    if (part.path.empty())
      entry["lacking"] = part.lacking;
    else
      entry.update({{"path", part.path}, {"file", part.file}});
    parts.push_back(std::move(entry));
  }
  Json files = Json::array();
  for (const auto& file : view.files) files.push_back({file.media_type, file.deflated});
  Json parameters = Json::array();
  for (const auto& node : run.nodes)
    for (const auto& [type, name] : wishes.parameters)
      for (const auto& [address, value] : run.parameters)
        if (node.type == type && address == node.node + "." + name)
          parameters.push_back({{"node", node.node}, {"type", type}, {"name", name}, {"value", value}});
  Json warnings = Json::array();
  for (const auto& node : run.nodes)
    for (const auto& warning : node.warnings) warnings.push_back({node.node, warning});
  Json json{{"format", 1},
            {"atrium", framework_version()},
            {"title", title_of(run)},
            {"status", run.status},
            {"message", run.message},
            {"warnings", std::move(warnings)},
            {"parameters", std::move(parameters)},
            {"parts", std::move(parts)},
            {"files", std::move(files)}};
  return json;
}

}  // namespace

ViewWishes read_wishes(std::string_view page, const std::string& name) {
  constexpr std::string_view open = "<script type=\"application/json\" id=\"wishes\">";
  const auto begin = page.find(open);
  const auto end = begin == std::string_view::npos ? begin : page.find("</script>", begin);
  const auto wrong = [&] {
    return Error(name + " is no page of this version of Atrium", "build again: ./share/build");
  };
  if (end == std::string_view::npos) throw wrong();
  const Json json = read_json(page.substr(begin + open.size(), end - begin - open.size()));
  ViewWishes wishes;
  try {
    for (const auto& entry : json.at("parts")) {
      wishes.parts.push_back({entry.at("part").get<std::string>(), entry.at("files").get<std::vector<std::string>>(),
                              entry.at("node").get<std::string>()});
      if (wishes.parts.back().files.empty()) throw wrong();
    }
    for (const auto& entry : json.at("parameters"))
      wishes.parameters.emplace_back(entry.at(0).get<std::string>(), entry.at(1).get<std::string>());
  } catch (const Json::exception&) {
    throw wrong();
  }
  return wishes;
}

View pack_view(const RunRecord& run, const ViewWishes& wishes, std::size_t max_bytes) {
  return Packer(run, max_bytes).pack(wishes);
}

std::pair<View, std::size_t> write_view(const fs::path& target, const RunRecord& run, const fs::path& page,
                                        std::size_t max_bytes) {
  const std::string text = read_page(page);
  const ViewWishes wishes = read_wishes(text, page.string());
  constexpr std::size_t around = 20'000;  // the data, and the files' elements
  View view = pack_view(run, wishes, max_bytes > text.size() + around ? max_bytes - text.size() - around : 0);
  const std::size_t size =
      write_filled_page(target, title_of(run), embedded(view_data(run, wishes, view)), view.files, page, text);
  return {std::move(view), size};
}

}  // namespace atrium::report
