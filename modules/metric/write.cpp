#include "modules/metric/write.hpp"

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "graph/api/write_output.hpp"

namespace atrium::metric {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> parts_of(const std::string& name) {
  std::vector<std::string> parts{""};
  for (const char c : name) {
    if (c == '.')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  for (const auto& part : parts)
    if (part.empty())
      throw Error("a metric is called '" + name + "'",
                  "names are words joined by single dots: distance.cloud_to_mesh.rms");
  return parts;
}

// Which input (counted from 1) gave a name, as leaf or as group.
struct Names {
  std::map<std::string, std::size_t> leaves, groups;

  void add(const std::string& name, const std::vector<std::string>& parts, std::size_t input) {
    const auto clash = [&](const std::string& other, std::size_t other_input) {
      throw Error("metric '" + name + "' of input " + std::to_string(input) + " and metric" +
                      (other == name ? " of the same name" : " '" + other + "'") + " of input " +
                      std::to_string(other_input) + " of `metrics` exclude each other",
                  "wire each node's metrics once, and two nodes of one type into two files");
    };
    if (const auto leaf = leaves.find(name); leaf != leaves.end()) clash(name, leaf->second);
    if (const auto group = groups.find(name); group != groups.end()) clash(name + ".…", group->second);
    leaves.emplace(name, input);
    std::string prefix;
    for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
      prefix += (i > 0 ? "." : "") + parts[i];
      if (const auto leaf = leaves.find(prefix); leaf != leaves.end()) clash(prefix, leaf->second);
      groups.emplace(prefix, input);
    }
  }
};

std::string number(double value) { return std::isfinite(value) ? Json(value).dump() : ""; }

// A field of a CSV line (RFC 4180): quoted where it has to be.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

bool wants_csv(const std::string& path) { return path.size() >= 4 && path.compare(path.size() - 4, 4, ".csv") == 0; }

}  // namespace

void Write::run(const In& in, const Params& params, Context& context) {
  Json root = Json::object();
  std::string csv = "name,value,unit\n";
  Names names;
  for (std::size_t i = 0; i < in.metrics.size(); ++i)
    for (const auto& metric : in.metrics[i]->values) {
      const auto parts = parts_of(metric.name);
      csv += field(metric.name) + "," + number(metric.value) + "," + field(metric.unit) + "\n";
      names.add(metric.name, parts, i + 1);
      Json* at = &root;
      for (const auto& part : parts) at = &(*at)[part];
      if (!std::isfinite(metric.value))
        context.warn("metric '" + metric.name + "' is not a finite number: written as null");
      *at = {{"value", std::isfinite(metric.value) ? Json(metric.value) : Json()}, {"unit", metric.unit}};
    }
  write_output(context, params.path.path,
               wants_csv(params.path.path) ? csv : root.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  return;
}

}  // namespace atrium::metric
