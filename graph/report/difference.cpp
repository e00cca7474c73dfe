#include "graph/report/difference.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "graph/api/fact_json.hpp"
#include "graph/cache/blob.hpp"

namespace atrium::report {
namespace {

namespace fs = std::filesystem;

/// The keys of both lists: those of a in its order, then those that only b has.
template <class Value>
struct Pairs {
  std::vector<std::pair<std::string, std::pair<const Value*, const Value*>>> entries;
  template <class Items, class Key, class Get>
  Pairs(const Items& a, const Items& b, Key key, Get get) {
    std::map<std::string, std::size_t> known;
    for (const auto& item : a)
      if (known.try_emplace(key(item), entries.size()).second) entries.push_back({key(item), {&get(item), nullptr}});
    for (const auto& item : b) {
      const auto [at, fresh] = known.try_emplace(key(item), entries.size());
      if (fresh) entries.push_back({key(item), {nullptr, nullptr}});
      entries[at->second].second.second = &get(item);
    }
  }
};

void compare_parameters(const RunRecord& a, const RunRecord& b, Difference& result) {
  const auto key = [](const auto& item) -> const std::string& { return item.first; };
  const auto value = [](const auto& item) -> const std::string& { return item.second; };
  for (const auto& [address, both] : Pairs<std::string>(a.parameters, b.parameters, key, value).entries) {
    const auto& [of_a, of_b] = both;
    if (of_a != nullptr && of_b != nullptr && *of_a == *of_b) continue;
    auto& entry = result.parameters.emplace_back();
    entry.address = address;
    if (of_a != nullptr) entry.a = *of_a;
    if (of_b != nullptr) entry.b = *of_b;
  }
}

/// One that is not a number is the same as another.
bool same_number(double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); }

void compare_metrics(const RunRecord& a, const RunRecord& b, Difference& result) {
  const auto fact = [](const RunRecord::Metric& metric) -> const Fact& { return metric.fact; };
  for (const auto& [name, both] : Pairs<Fact>(a.metrics, b.metrics, name_of, fact).entries) {
    const auto& [of_a, of_b] = both;
    const bool comparable = of_a != nullptr && of_b != nullptr && of_a->unit == of_b->unit;
    std::optional<std::pair<double, double>> numbers;
    if (comparable)
      if (const auto x = number_of(*of_a), y = number_of(*of_b); x && y) numbers = {*x, *y};
    if (comparable && (of_a->value == of_b->value || (numbers && same_number(numbers->first, numbers->second))))
      continue;
    auto& entry = result.metrics.emplace_back();
    entry.name = name;
    entry.unit = of_a != nullptr ? of_a->unit : of_b->unit;
    if (of_a != nullptr) entry.a = *of_a;
    if (of_b != nullptr) entry.b = *of_b;
    if (numbers) entry.change = numbers->second - numbers->first;
  }
}

std::string content(const RunRecord& run, const Artefact& file) {
  return file.hash.empty() ? hash_if_readable(run.folder / file.path) : file.hash;
}

/// A picture that differs in its bytes; the same pixels are the same picture (a run's stamp is in the file).
void compare_pictures(const fs::path& a, const fs::path& b, const std::string& path, const fs::path& target,
                      Difference& result) {
  Difference::PictureFile entry{path, {}, {}};
  try {
    const Picture of_a = read_picture(a / path);
    const Picture of_b = read_picture(b / path);
    entry.pixels = compare(of_a, of_b);
    if (entry.pixels.comparable && entry.pixels.different == 0) return;
    if (!target.empty() && entry.pixels.comparable) write_picture(target / path, difference_picture(of_a, of_b));
  } catch (const Error& error) {
    if (!target.empty() && entry.pixels.comparable) throw;  // the difference could not be written
    entry.problem = error.what();
  }
  result.pictures.push_back(std::move(entry));
}

void compare_files(const RunRecord& a, const RunRecord& b, const fs::path& target, Difference& result) {
  const auto key = [](const Artefact& file) -> const std::string& { return file.path; };
  const auto self = [](const Artefact& file) -> const Artefact& { return file; };
  for (const auto& [path, both] : Pairs<Artefact>(a.files, b.files, key, self).entries) {
    const auto& [of_a, of_b] = both;
    if (of_a == nullptr || of_b == nullptr) {
      result.files.push_back({path, of_a != nullptr, of_b != nullptr, of_a != nullptr ? of_a->bytes : 0,
                              of_b != nullptr ? of_b->bytes : 0});
      continue;
    }
    const std::string hash = content(a, *of_a);
    if (!hash.empty() && hash == content(b, *of_b)) continue;
    if (fs::path(path).extension() == ".png")
      compare_pictures(a.folder, b.folder, path, target, result);
    else
      result.files.push_back({path, true, true, of_a->bytes, of_b->bytes});
  }
}

/// The first output with another hash; "" if the status differs; nothing if they are the same.
std::optional<std::string> different_output(const NodeRecord& a, const NodeRecord& b, bool& known) {
  if (a.status != b.status) return "";
  for (const auto& output : a.outputs) {
    const auto other =
        std::find_if(b.outputs.begin(), b.outputs.end(), [&](const auto& o) { return o.port == output.port; });
    if (other == b.outputs.end()) return output.port;
    if (output.hash.empty() || other->hash.empty())
      known = false;
    else if (output.hash != other->hash)
      return output.port;
  }
  return std::nullopt;
}

void compare_nodes(const RunRecord& a, const RunRecord& b, Difference& result) {
  std::map<std::string, const NodeRecord*> of_b;
  for (const auto& node : b.nodes) of_b.emplace(node.node, &node);
  for (const auto& node : a.nodes) {
    const auto other = of_b.find(node.node);
    if (other == of_b.end()) continue;
    ++result.compared_nodes;
    bool known = true;
    const auto port = different_output(node, *other->second, known);
    result.unknown_nodes += known || port ? 0 : 1;
    if (!port) continue;
    ++result.different_nodes;
    if (!result.first) result.first = Difference::Node{node.node, other->second->type, *port};
  }
}

}  // namespace

bool Difference::same() const {
  return status_a == status_b && parameters.empty() && metrics.empty() && pictures.empty() && files.empty() && !first;
}

Difference compare(const RunRecord& a, const RunRecord& b, const fs::path& pictures) {
  Difference result;
  result.status_a = a.status;
  result.status_b = b.status;
  compare_parameters(a, b, result);
  compare_metrics(a, b, result);
  compare_files(a, b, pictures, result);
  compare_nodes(a, b, result);
  return result;
}

}  // namespace atrium::report
