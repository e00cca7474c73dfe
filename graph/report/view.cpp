#include "graph/report/view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "graph/api/files.hpp"
#include "graph/api/json_text.hpp"
#include "graph/pipeline/pipeline.hpp"
#include "graph/report/base64.hpp"
#include "graph/report/page.hpp"
#include "graph/report/thinned_points.hpp"

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
      const std::string problem = add(path, part.note);
      if (problem.empty()) {
        part.path = path;
        part.node = writer_of(path);
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

  std::string writer_of(const std::string& path) const {
    for (const auto& node : run_.nodes)
      for (const auto& file : node.artefacts)
        if (fs::path(file.path).lexically_normal() == fs::path(path).lexically_normal()) return node.node;
    return {};
  }

  /// Why the file is not in the page; empty if it is.
  std::string add(const std::string& path, std::string& note) {
    const fs::path file = run_.folder / path;
    std::error_code code;
    const auto bytes = fs::file_size(file, code);
    if (code) return fmt::format("{} is not in the run's folder any more", path);
    const auto too_large = [&](double size) {
      return fmt::format("{} takes {:.1f} MB of the page, which has room for {:.1f} MB: --max-size gives more", path,
                         size / 1e6, static_cast<double>(room_) / 1e6);
    };
    constexpr std::uint64_t best_deflation = 32, most_to_thin = 1'000'000'000;
    const bool points = file.extension() == ".glb";
    if (bytes / best_deflation > room_ && !(points && bytes <= most_to_thin))
      return too_large(static_cast<double>(bytes));
    Attachment attachment{media_type_in_view(path), true, {}};
    std::size_t whole = 0;
    try {
      const std::string text = read_text(file);
      attachment.base64 = to_base64(deflated(text));
      whole = attachment.base64.size();
      if (points && whole > room_) thin(text, path, attachment.base64, note);
    } catch (const std::exception& error) {
      return fmt::format("{} cannot be read: {}", path, error.what());
    }
    if (attachment.base64.size() > room_) return too_large(static_cast<double>(whole));
    room_ -= attachment.base64.size();
    view_.files.push_back(std::move(attachment));
    return {};
  }

  /// Leaves fewer points, until what stands in the page has room; nothing changes where that cannot be.
  void thin(const std::string& glb, const std::string& path, std::string& base64, std::string& note) const {
    constexpr std::size_t fewest = 1000;
    constexpr int most_tries = 8;
    constexpr double slack = 0.99;
    double share = 1;
    std::size_t size = base64.size();
    for (int i = 0; i < most_tries; ++i) {
      share *= slack * static_cast<double>(room_) / static_cast<double>(size);
      const auto thinned = thinned_points(glb, share);
      if (!thinned || thinned->points < fewest) return;
      std::string text = to_base64(deflated(thinned->glb));
      size = text.size();
      if (size > room_) continue;
      base64 = std::move(text);
      note = fmt::format("{}: {} of its {} points are in the page, as many as have room: --max-size gives more", path,
                         thinned->points, thinned->of);
      return;
    }
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
    if (!part.node.empty()) entry["node"] = part.node;
    if (!part.note.empty()) entry["note"] = part.note;
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

/// The view that has no file.
View nothing_of(const ViewWishes& wishes) {
  View view;
  for (const auto& wish : wishes.parts) view.parts.push_back({wish.part, {}, {}, {}, {}, 0});
  return view;
}

/// What the page takes but for the contents of files, at most.
std::size_t size_without(const std::string& page, const RunRecord& run, const std::string& data,
                         const ViewWishes& wishes) {
  constexpr std::size_t element = 80;  // around a file's contents, or the data
  constexpr std::size_t escaped = 5;   // of a character of the title
  return page.size() + data.size() + element * (wishes.parts.size() + 1) + escaped * title_of(run).size();
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
  // What the data take is known when the files are chosen: where it is more than was kept for it, they are chosen anew.
  View view;
  std::string data;
  const auto check_size = [&](std::size_t bytes, std::string_view what) {
    if (bytes <= max_bytes) return;
    throw Error(fmt::format("the page takes {:.2f} MB {}, --max-size allows {:.2f} MB",
                            static_cast<double>(bytes) / 1e6, what, static_cast<double>(max_bytes) / 1e6),
                fmt::format("--max-size {:.1f} or more: what has no room is left out",
                            std::ceil(static_cast<double>(bytes) / 1e5) / 10 + 0.5));
  };
  const std::size_t least = size_without(text, run, embedded(view_data(run, wishes, nothing_of(wishes))), wishes);
  check_size(least, "without any file of the run");
  constexpr std::size_t told = 300;  // what the data say of a part: its file, or why there is none
  std::size_t besides = least + told * wishes.parts.size();
  for (int i = 0; i < 4; ++i) {
    view = pack_view(run, wishes, max_bytes > besides ? max_bytes - besides : 0);
    data = embedded(view_data(run, wishes, view));
    const std::size_t now = size_without(text, run, data, wishes);
    if (now <= besides) break;
    besides = now;
  }
  std::size_t packed = size_without(text, run, data, wishes);
  for (const auto& file : view.files) packed += file.base64.size();
  check_size(packed, "with what it says of the run's files");
  const std::size_t size = write_filled_page(target, title_of(run), data, view.files, page, text);
  return {std::move(view), size};
}

}  // namespace atrium::report
