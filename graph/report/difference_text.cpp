// A Difference as text and as JSON.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "graph/api/fact_json.hpp"
#include "graph/api/json_text.hpp"
#include "graph/api/text.hpp"
#include "graph/report/difference.hpp"

namespace atrium::report {
namespace {

using Json = nlohmann::ordered_json;

std::string shown(const std::optional<Fact>& fact) { return fact ? fact_text(*fact) : "–"; }

std::string section(std::string_view title, const std::vector<std::vector<std::string>>& rows) {
  return rows.empty() ? "" : fmt::format("{}\n{}", title, aligned(rows, {}, "  "));
}

std::string pixels_text(const Difference::PictureFile& picture) {
  if (!picture.problem.empty()) return picture.problem;
  if (!picture.pixels.comparable) return "of different size";
  return fmt::format("{} of {} pixels differ, by {} of 255 at most", picture.pixels.different, picture.pixels.pixels,
                     picture.pixels.largest);
}

std::string nodes_text(const Difference& d) {
  std::string text;
  if (d.first)
    text = fmt::format("first node that differs\n  {} ({}), {}; {} of {} nodes differ\n", d.first->path, d.first->type,
                       d.first->port.empty() ? "its status" : "output " + d.first->port, d.different_nodes,
                       d.compared_nodes);
  if (d.unknown_nodes > 0)
    text += fmt::format("  of {} of {} nodes the outputs cannot be compared: the runs have no hashes of them\n",
                        d.unknown_nodes, d.compared_nodes);
  return text;
}

Json value_json(const std::optional<Fact>& fact) { return fact ? atrium::value_json(*fact) : Json(); }
Json text_json(const std::optional<std::string>& text) { return text ? Json(*text) : Json(); }

Json picture_json(const Difference::PictureFile& picture) {
  Json json{{"path", picture.path}};
  if (!picture.problem.empty()) {
    json["problem"] = picture.problem;
    return json;
  }
  json["same_size"] = picture.pixels.comparable;
  if (!picture.pixels.comparable) return json;
  json["pixels"] = picture.pixels.pixels;
  json["different"] = picture.pixels.different;
  json["largest"] = picture.pixels.largest;
  return json;
}

}  // namespace

std::string as_text(const Difference& d) {
  std::string text;
  if (d.status_a != d.status_b) text += section("status", {{d.status_a, "→", d.status_b}});
  std::vector<std::vector<std::string>> rows;
  for (const auto& p : d.parameters) rows.push_back({p.address, p.a.value_or("–"), "→", p.b.value_or("–")});
  text += section("parameters", rows);
  rows.clear();
  for (const auto& m : d.metrics)
    rows.push_back({m.name, shown(m.a), "→", shown(m.b), m.change ? fmt::format("{:+.4g}", *m.change) : "", m.unit});
  text += section("metrics", rows);
  rows.clear();
  for (const auto& p : d.pictures) rows.push_back({p.path, pixels_text(p)});
  text += section("pictures", rows);
  rows.clear();
  for (const auto& f : d.files)
    rows.push_back({f.path, !f.in_a   ? "only in the second"
                            : !f.in_b ? "only in the first"
                                      : fmt::format("differs ({} → {} bytes)", f.bytes_a, f.bytes_b)});
  text += section("files", rows);
  text += nodes_text(d);
  return d.same() ? "the same\n" + text : text;
}

std::string as_json(const Difference& d) {
  Json json{{"same", d.same()}, {"status", {d.status_a, d.status_b}}};
  json["parameters"] = Json::array();
  for (const auto& p : d.parameters)
    json["parameters"].push_back({{"address", p.address}, {"a", text_json(p.a)}, {"b", text_json(p.b)}});
  json["metrics"] = Json::array();
  for (const auto& m : d.metrics) {
    Json entry{{"name", m.name}, {"a", value_json(m.a)}, {"b", value_json(m.b)}};
    if (m.change) entry["change"] = *m.change;
    if (!m.unit.empty()) entry["unit"] = m.unit;
    json["metrics"].push_back(std::move(entry));
  }
  json["pictures"] = Json::array();
  for (const auto& p : d.pictures) json["pictures"].push_back(picture_json(p));
  json["files"] = Json::array();
  for (const auto& f : d.files)
    json["files"].push_back({{"path", f.path}, {"in", f.in_a && f.in_b ? "both" : f.in_a ? "a" : "b"}});
  json["first_node"] =
      d.first ? Json{{"node", d.first->path}, {"type", d.first->type}, {"output", d.first->port}} : Json();
  json["nodes"] = {{"compared", d.compared_nodes}, {"different", d.different_nodes}, {"unknown", d.unknown_nodes}};
  return json_text(json, 2) + "\n";
}

}  // namespace atrium::report
