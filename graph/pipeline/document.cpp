#include "graph/pipeline/document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <unordered_set>

#include "graph/pipeline/file_reader.hpp"
#include "graph/pipeline/png_stamp.hpp"

namespace atrium {
namespace {

constexpr std::string_view name_help = "names are lower-case letters, digits and _, and begin with a letter";

class DocumentReader : FileReader {
 public:
  DocumentReader(Document& document, Findings& findings) : FileReader(document.source, findings), document_(document) {}

  void read(const YamlNode& root) {
    if (const auto* sweep = root.find("sweep"); sweep != nullptr && root.find("nodes") == nullptr) {
      error(sweep->place, "this is a sweep file, not a pipeline", "atrium sweep plan FILE, atrium sweep run FILE");
      return;
    }
    check_keys(root, {"atrium", "summary", "seed", "versions", "vars", "inputs", "nodes", "outputs"},
               "a pipeline file");
    check_format(root);
    if (const auto* entry = root.find("summary")) document_.summary = scalar(*entry).text;
    if (const auto* entry = root.find("seed")) read_seed(*entry);
    read_variables(root.find("vars"));
    read_inputs(root.find("inputs"));
    read_versions(root.find("versions"));
    read_nodes(root);
    read_outputs(root.find("outputs"));
    check_variables();
  }

 private:
  /// Null (`params:` with nothing) is an empty one.
  const std::vector<YamlNode::Entry>& mapping(const YamlNode::Entry* entry) {
    return FileReader::mapping(entry, "write `name: value` lines below it", true);
  }

  bool check_name(const YamlNode::Entry& entry, std::string_view what) {
    if (is_name(entry.key)) return true;
    error(entry.place, fmt::format("'{}' cannot be the name of {}", entry.key, what), std::string(name_help));
    return false;
  }

  void read_seed(const YamlNode::Entry& entry) {
    const Located text = scalar(entry);
    if (text.place.line > 0 && !parse_seed(text.text, document_.seed))
      error(text.place, fmt::format("'{}' is not a seed", text.text), "a whole number from 0 to 18446744073709551615");
  }

  void read_variables(const YamlNode::Entry* vars) {
    for (const auto& entry : mapping(vars)) {
      if (!check_name(entry, "a variable")) continue;
      if (entry.key == "seed") {
        error(entry.place, "a variable cannot be named 'seed'", "the run's seed is set by `seed:` and by -s seed=…");
        continue;
      }
      Setting setting = read_setting({entry.key, entry.place}, entry.value, document_.source, findings_);
      for (const auto& item : setting.value.items) {
        if (!variable_of(item)) continue;
        error(setting.place, fmt::format("the variable '{}' refers to another one", entry.key),
              "a variable's value is written out");
        setting.broken = true;
      }
      document_.variables.push_back(std::move(setting));
    }
  }

  void read_versions(const YamlNode::Entry* section) {
    for (const auto& entry : mapping(section)) {
      if (entry.value.is_scalar())
        document_.versions.emplace_back(Located{entry.key, entry.place}, Located{entry.value.text, entry.value.place});
      else
        error(entry.value.place, fmt::format("'{}' in versions must be a single value", entry.key));
    }
  }

  void read_inputs(const YamlNode::Entry* section) {
    for (const auto& entry : mapping(section)) {
      if (!check_name(entry, "an input")) continue;
      if (entry.value.is_scalar()) {
        document_.inputs.push_back({{entry.key, entry.place}, {entry.value.text, entry.value.place}, std::nullopt});
      } else if (entry.value.is_mapping()) {
        read_input_with_default(entry);
      } else {
        error(entry.value.place, fmt::format("the input '{}' must name a type", entry.key),
              "write the type of the port, as in `cloud: Cloud` or `cloud: {type: Cloud, default: scan.cloud}`");
      }
    }
  }

  void read_input_with_default(const YamlNode::Entry& entry) {
    check_keys(entry.value, {"type", "default"}, fmt::format("the input '{}'", entry.key));
    const auto* type = entry.value.find("type");
    const auto* default_source = entry.value.find("default");
    if (type == nullptr) {
      error(entry.place, fmt::format("the input '{}' has no type", entry.key), "as in `type: Cloud`");
      return;
    }
    DocumentInput input{{entry.key, entry.place}, scalar(*type), std::nullopt};
    if (default_source != nullptr)
      if (const Located text = scalar(*default_source); text.place.line > 0)
        input.default_source = reference(default_source->value);
    document_.inputs.push_back(std::move(input));
  }

  void read_nodes(const YamlNode& root) {
    const auto* section = root.find("nodes");
    const auto& entries = mapping(section);
    if (section == nullptr || (entries.empty() && (section->value.is_null() || section->value.is_mapping())))
      error(section == nullptr ? Place{} : section->place, "the pipeline has no nodes",
            "add `nodes:` with at least one node");
    for (const auto& entry : entries) read_node(entry);
  }

  bool check_id(const YamlNode::Entry& entry) {
    std::string_view rest = entry.key;
    bool good = true;
    while (good) {  // 'shell/translate': an opened sub-pipeline's node in a resolved file
      const std::size_t slash = std::min(rest.find('/'), rest.size());
      good = is_name(rest.substr(0, slash));
      if (slash == rest.size()) break;
      rest.remove_prefix(slash + 1);
    }
    if (!good) error(entry.place, fmt::format("'{}' cannot be the name of a node", entry.key), std::string(name_help));
    if (entry.key != "inputs") return good;
    error(entry.place, "a node cannot be named 'inputs'", "`inputs.name` refers to the inputs of a sub-pipeline");
    return false;
  }

  void read_node(const YamlNode::Entry& entry) {
    if (!check_id(entry)) return;
    DocumentNode node;
    node.id = {entry.key, entry.place};
    if (!entry.value.is_mapping()) {
      error(entry.value.place, fmt::format("the node '{}' must be a mapping", entry.key),
            "as in `{type: io.read_scan, params: {path: scan.ply}}`");
      document_.nodes.push_back(std::move(node));
      return;
    }
    const auto* type = entry.value.find("type");
    const auto* pipeline = entry.value.find("pipeline");
    const auto what = fmt::format("the node '{}'", entry.key);
    if (pipeline != nullptr)
      check_keys(entry.value, {"pipeline", "in", "vars", "type"}, what);
    else
      check_keys(entry.value, {"type", "in", "params", "pipeline"}, what);
    if (type != nullptr && pipeline != nullptr)
      error(pipeline->place, fmt::format("the node '{}' has a type and a pipeline", entry.key), "keep one of them");
    else if (type != nullptr)
      node.type = scalar(*type);
    else if (pipeline != nullptr)
      node.pipeline = scalar(*pipeline);
    else
      error(entry.place, fmt::format("the node '{}' has no type", entry.key),
            "`type: module.name`; atrium nodes lists them");
    for (const auto& port : mapping(entry.value.find("in"))) node.inputs.push_back(read_wiring(port));
    read_settings(entry.value.find(pipeline != nullptr ? "vars" : "params"),
                  pipeline != nullptr ? node.variables : node.params);
    document_.nodes.push_back(std::move(node));
  }

  void read_settings(const YamlNode::Entry* section, std::vector<Setting>& settings) {
    for (const auto& entry : mapping(section)) {
      Setting setting = read_setting({entry.key, entry.place}, entry.value, document_.source, findings_);
      if (setting.unset) {
        error(setting.place, fmt::format("'{}' has no value", entry.key), "write a value, or remove the line");
        setting.broken = true;
      }
      settings.push_back(std::move(setting));
    }
  }

  Reference reference(const YamlNode& node) const {
    const std::size_t dot = node.text.find('.');
    if (dot == std::string::npos) return {node.text, {}, node.place};
    return {node.text.substr(0, dot), node.text.substr(dot + 1), node.place};
  }

  Wiring read_wiring(const YamlNode::Entry& entry) {
    Wiring wiring{{entry.key, entry.place}, {}, entry.value.is_sequence()};
    const auto add = [&](const YamlNode& node) {
      if (node.is_scalar()) {
        wiring.sources.push_back(reference(node));
        return;
      }
      error(node.place, fmt::format("the input '{}' is not wired to a port", entry.key), "as in `cloud: scan.cloud`");
      wiring.broken = true;
    };
    if (!wiring.is_list) add(entry.value);
    for (const auto& item : entry.value.items) add(item);
    if (wiring.is_list && wiring.sources.empty() && !wiring.broken) {
      error(entry.value.place, fmt::format("the input '{}' is wired to an empty list", entry.key));
      wiring.broken = true;
    }
    return wiring;
  }

  void read_outputs(const YamlNode::Entry* section) {
    for (const auto& entry : mapping(section)) {
      if (!check_name(entry, "an output")) continue;
      if (entry.value.is_scalar())
        document_.outputs.push_back({{entry.key, entry.place}, reference(entry.value)});
      else
        error(entry.value.place, fmt::format("the output '{}' is not a port", entry.key), "as in `mesh: scene.mesh`");
    }
  }

  void check_variables() {
    std::unordered_set<std::string> declared, used;
    std::vector<std::string> names;
    for (const auto& variable : document_.variables) {
      declared.insert(variable.name.text);
      names.push_back(variable.name.text);
    }
    const auto look = [&](std::vector<Setting>& settings) {
      for (auto& setting : settings) {
        for (const auto& item : setting.value.items) {
          const auto name = variable_of(item);
          if (!name) continue;
          used.insert(*name);
          if (declared.contains(*name) || setting.broken) continue;
          const std::string hint = findings_.suggest(*name, names);
          error(setting.place, fmt::format("unknown variable '{}'", *name),
                hint.empty() ? fmt::format("declare it: `vars: {{{}: …}}`", *name) : hint);
          setting.broken = true;
        }
      }
    };
    for (auto& node : document_.nodes) {
      look(node.params);
      look(node.variables);
    }
    for (const auto& variable : document_.variables)
      if (!used.contains(variable.name.text))
        error(variable.name.place, fmt::format("nothing uses the variable '{}'", variable.name.text),
              fmt::format("use it as \"${{{}}}\", or remove it", variable.name.text));
  }

  Document& document_;
};

/// Files that people hand over in the place of a pipeline: point clouds and meshes.
bool is_other_format(const std::filesystem::path& path, std::string_view text) {
  constexpr std::string_view endings[] = {".xyz", ".txt", ".csv", ".asc", ".pts", ".ptx", ".obj",
                                          ".stl", ".las", ".laz", ".e57", ".ply", ".pcd"};
  if (std::find(std::begin(endings), std::end(endings), path.extension().string()) != std::end(endings)) return true;
  constexpr std::string_view beginnings[] = {"ply\n", "ply\r", "# .PCD",   "VERSION .7", "VERSION 0.7",
                                             "LASF",  "glTF",  "ASTM-E57", "solid "};
  return std::any_of(std::begin(beginnings), std::end(beginnings),
                     [&](std::string_view beginning) { return text.starts_with(beginning); });
}

}  // namespace

bool parse_seed(std::string_view text, std::uint64_t& seed) {
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), seed);
  return problem == std::errc{} && end == text.data() + text.size() && !text.empty();
}

std::unique_ptr<Document> read_document(const std::filesystem::path& path, std::string name, std::size_t order,
                                        Findings& findings) {
  auto document = std::make_unique<Document>();
  std::error_code ignored;
  document->identity = std::filesystem::weakly_canonical(path, ignored).string();
  YamlTree tree;
  const auto text = read_yaml_text(path.string(), tree);
  document->source = {std::move(name), path.parent_path(), order, text && is_png_text(*text)};
  if (document->source.picture) {
    try {
      tree = parse_yaml(read_png_stamp(*text, path).resolved);
    } catch (const Error& error) {
      findings.error({&document->source, {}}, error.what(), error.help());
      return nullptr;
    }
    document->source.folder = std::filesystem::current_path(ignored);
  } else if (text && is_other_format(path, *text)) {
    findings.error({&document->source, {}}, "this is no pipeline file, but data",
                   fmt::format("to run a pipeline on it: atrium run atrium.yaml -s scan={}", document->source.name));
    return nullptr;
  } else if (text) {
    tree = parse_yaml(*text);
  }
  for (const auto& problem : tree.problems)
    findings.error({&document->source, problem.place}, problem.message, problem.help);
  if (!tree.root) return nullptr;
  if (!tree.root->is_mapping()) {
    findings.error({&document->source, tree.root->place}, "a pipeline file is a mapping of keys to values",
                   "it begins with `atrium: 1`");
    return nullptr;
  }
  DocumentReader(*document, findings).read(*tree.root);
  return document;
}

std::shared_ptr<const Document> ReadDocuments::read(const std::filesystem::path& path, const std::string& name,
                                                    std::size_t order, Findings& findings) {
  const std::string key = fmt::format("{}\n{}\n{}", path.string(), name, order);
  if (const auto known = known_.find(key); known != known_.end()) return known->second;
  const std::size_t before = findings.count();
  std::shared_ptr<const Document> document = read_document(path, name, order, findings);
  if (document && findings.count() == before) known_.emplace(key, document);
  return document;
}

}  // namespace atrium
