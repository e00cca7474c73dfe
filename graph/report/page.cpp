#include "graph/report/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "graph/api/context.hpp"
#include "graph/api/files.hpp"
#include "graph/api/json_text.hpp"
#include "graph/api/text.hpp"
#include "graph/pipeline/pipeline.hpp"
#include "graph/run/node_json.hpp"

namespace atrium::report {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr std::string_view data_mark = "<!--atrium:data-->";
constexpr std::string_view files_mark = "<!--atrium:files-->";

Json axes_json(const SweepRecord& record) {
  Json axes = Json::array();
  for (const auto& axis : record.axes) {
    Json choices = Json::array();
    for (const auto& choice : axis.choices) {
      Json set = Json::object();
      for (const auto& [target, value] : choice.set) set[target] = value;
      choices.push_back({{"label", choice.label}, {"set", std::move(set)}});
    }
    axes.push_back({{"name", axis.name}, {"choices", std::move(choices)}});
  }
  return axes;
}

Json metrics_json(const SweepRecord& record) {
  Json metrics = Json::array();
  for (const auto& metric : record.metrics) {
    Json entry{{"name", metric.name}, {"unit", metric.unit}};
    if (metric.digits) entry["digits"] = *metric.digits;
    metrics.push_back(std::move(entry));
  }
  return metrics;
}

/// The parameters that are not the same in all variants: address, distinct values, and which variant has which (-1:
/// it has no such parameter).
Json parameters_json(const SweepRecord& record) {
  std::vector<std::string> order;
  std::unordered_map<std::string, std::vector<const std::string*>> values;
  for (std::size_t v = 0; v < record.variants.size(); ++v)
    for (const auto& [address, value] : record.variants[v].run.parameters) {
      auto [known, fresh] = values.try_emplace(address);
      if (fresh) {
        order.push_back(address);
        known->second.assign(record.variants.size(), nullptr);
      }
      known->second[v] = &value;
    }
  Json parameters = Json::array();
  for (const auto& address : order) {
    const auto& of = values.at(address);
    std::map<std::string, int> index;
    Json distinct = Json::array();
    Json which = Json::array();
    for (const auto* value : of) {
      if (value == nullptr) {
        which.push_back(-1);
        continue;
      }
      const auto [known, fresh] = index.try_emplace(*value, static_cast<int>(distinct.size()));
      if (fresh) distinct.push_back(*value);
      which.push_back(known->second);
    }
    const bool differs = std::any_of(which.begin(), which.end(), [&](const Json& i) { return i != which.front(); });
    if (differs)
      parameters.push_back({{"address", address}, {"values", std::move(distinct)}, {"of", std::move(which)}});
  }
  return parameters;
}

/// Without the path of the variant's folder: a report is read on other machines.
std::string portable(const std::string& message, const fs::path& folder) {
  return replaced(message, fs::absolute(folder).lexically_normal().string() + "/", "");
}

/// Node types by name, and per variant [node, status, wall seconds, CPU seconds, peak memory, 1 if the cache had it].
class NodeNames {
 public:
  Json times_of(const RunRecord& run) {
    Json times = Json::array();
    for (const auto& node : run.nodes) {
      const auto [known, fresh] = index_.try_emplace(node.node, names_.size());
      if (fresh) names_.push_back(node.node);
      times.push_back({known->second, name_of(node.status), rounded_seconds(node.computing_wall()),
                       rounded_seconds(node.computing_cpu()), node.computing_memory(), node.is_from_cache() ? 1 : 0});
    }
    return times;
  }
  const std::vector<std::string>& names() const { return names_; }

 private:
  std::vector<std::string> names_;
  std::unordered_map<std::string, std::size_t> index_;
};

Json uses_json(const std::vector<Attachments::Use>& uses) {
  Json json = Json::array();
  for (const auto& use : uses) json.push_back({use.path, use.file});
  return json;
}

Json cell_json(const SweepRecord::Cell& cell) {
  if (const auto* number = std::get_if<double>(&cell)) return *number;
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  return nullptr;
}

Json variant_json(const SweepRecord& record, std::size_t v, const Attachments& attachments, NodeNames& nodes) {
  const auto& variant = record.variants[v];
  Json choices = Json::array();
  for (const auto& axis : record.axes) {
    const auto chosen = std::find_if(variant.run.choices.begin(), variant.run.choices.end(),
                                     [&](const auto& choice) { return choice.first == axis.name; });
    int index = -1;
    for (std::size_t c = 0; c < axis.choices.size() && chosen != variant.run.choices.end(); ++c)
      if (axis.choices[c].label == chosen->second) index = static_cast<int>(c);
    choices.push_back(index);
  }
  Json cells = Json::array();
  for (const auto& cell : variant.cells) cells.push_back(cell_json(cell));
  Json json{{"id", variant.run.id}, {"status", variant.run.status}};
  if (!variant.run.message.empty()) json["message"] = portable(variant.run.message, variant.run.folder);
  json["choices"] = std::move(choices);
  json["cells"] = std::move(cells);
  json["nodes"] = nodes.times_of(variant.run);
  json["pictures"] = uses_json(attachments.variants[v].pictures);
  json["models"] = uses_json(attachments.variants[v].models);
  return json;
}

}  // namespace

fs::path page_template(const std::string& name) {
  const fs::path program = fs::canonical("/proc/self/exe");
  return program.parent_path().parent_path() / "share/atrium" / name;
}

std::string read_page(const fs::path& page) {
  if (!fs::exists(page))
    throw Error("the page that is written into is not there: " + page.string(),
                "esbuild bundles it when Atrium is built: ./share/install-packages, then ./share/build");
  return read_text(page);
}

// In JSON "<" stands in texts only: no text can end the element that the JSON is in.
std::string embedded(const Json& json) { return replaced(json_text(json), "<", "\\u003c"); }

std::string title_of(const RunRecord& run) { return fs::absolute(run.folder / ".").parent_path().filename().string(); }

std::string page_data(const SweepRecord& record, const Attachments& attachments) {
  NodeNames nodes;
  Json variants = Json::array();
  for (std::size_t v = 0; v < record.variants.size(); ++v)
    variants.push_back(variant_json(record, v, attachments, nodes));
  Json files = Json::array();
  for (const auto& file : attachments.files) files.push_back({file.media_type, file.deflated});
  auto notes = record.notes;
  notes.insert(notes.end(), attachments.notes.begin(), attachments.notes.end());
  const Json json{{"format", 1},
                  {"atrium", framework_version()},
                  {"title", record.title},
                  {"summary", record.summary},
                  {"sweep", record.sweep},
                  {"axes", axes_json(record)},
                  {"metrics", metrics_json(record)},
                  {"parameters", parameters_json(record)},
                  {"nodes", nodes.names()},
                  {"files", std::move(files)},
                  {"notes", std::move(notes)},
                  {"variants", std::move(variants)}};
  return embedded(json);
}

std::size_t write_page(const fs::path& target, const SweepRecord& record, const Attachments& attachments,
                       const fs::path& page) {
  return write_filled_page(target, record.title, page_data(record, attachments), attachments.files, page,
                           read_page(page));
}

std::size_t write_filled_page(const fs::path& target, const std::string& title, const std::string& data,
                              const std::vector<Attachment>& files, const fs::path& page, const std::string& text) {
  const auto data_at = text.find(data_mark);
  const auto files_at = text.find(files_mark);
  const auto title_at = text.find("<title>");
  if (data_at == std::string::npos || files_at == std::string::npos || files_at < data_at || title_at > data_at)
    throw Error(page.string() + " is no page of this version of Atrium", "build again: ./share/build");
  AtomicFile file(target);
  std::size_t size = 0;
  const auto write = [&](std::string_view part) {
    file.write(part);
    size += part.size();
  };
  const std::string_view whole = text;
  const std::size_t name = title_at + std::string_view("<title>").size();
  write(whole.substr(0, name));
  write(replaced(replaced(title, "&", "&amp;"), "<", "&lt;") + " – ");
  write(whole.substr(name, data_at - name));
  write("<script type=\"application/json\" id=\"data\">");
  write(data);
  write("</script>");
  const std::size_t after = data_at + data_mark.size();
  write(whole.substr(after, files_at - after));
  for (std::size_t f = 0; f < files.size(); ++f) {
    write(fmt::format("<script type=\"text/plain\" id=\"file-{}\">", f));
    write(files[f].base64);
    write("</script>\n");
  }
  write(whole.substr(files_at + files_mark.size()));
  file.commit();
  return size;
}

}  // namespace atrium::report
