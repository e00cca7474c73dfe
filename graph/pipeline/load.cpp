#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <set>

#include "graph/api/suggest.hpp"
#include "graph/pipeline/expansion.hpp"
#include "graph/pipeline/find_pipeline.hpp"
#include "graph/pipeline/pipeline.hpp"

namespace atrium {
namespace {

void check_versions(const Expansion& expansion, Findings& findings) {
  for (const auto& document : expansion.documents) {
    for (const auto& [type, version] : document->versions) {
      const Where where{&document->source, version.place};
      if (type.text == "atrium") {
        if (version.text != framework_version())
          findings.warning(where, fmt::format("written by Atrium {}, this is {}", version.text, framework_version()));
        continue;
      }
      const Dataflow& graph = expansion.graph;
      const auto nodes = all_nodes(graph);
      const auto node = std::find_if(nodes.begin(), nodes.end(), [&, &name = type.text](std::size_t n) {
        return graph[n].type != nullptr && graph[n].type->type == name;
      });
      if (node == nodes.end()) continue;  // swapped for another type
      const std::string present = std::to_string(graph[*node].type->version);
      if (version.text != present)
        findings.error(
            where, fmt::format("the file wants version {} of {}, this is version {}", version.text, type.text, present),
            "its results may differ: to run it with the present version, remove the line");
    }
  }
}

bool is_in_picture(const Scope* scope) {
  for (; scope != nullptr; scope = scope->parent)
    if (scope->document->source.picture) return true;
  return false;
}

/// People take a picture for something that does nothing.
void check_programs(const Expansion& expansion, Findings& findings) {
  for (const std::size_t n : all_nodes(expansion.graph)) {
    const PipelineNode& node = expansion.graph[n];
    if (node.type != nullptr && node.type->runs_programs && is_in_picture(expansion.origins[n].scope))
      findings.error(expansion.origins[n].where(),
                     fmt::format("the picture's pipeline would start a program: '{}' ({})", node.path, node.type->type),
                     "if you know where the picture comes from, run the resolved.yaml beside it");
  }
}

/// Nodes that lead to a file or an output of the outermost file. A sub-pipeline's output that nobody reads is not made.
std::vector<bool> needed_nodes(const Dataflow& graph) {
  std::vector<bool> ends(node_count(graph), false);
  for (const auto& output : graph[whole].outputs) ends[output.from.node] = true;
  for (const std::size_t n : all_nodes(graph)) ends[n] = ends[n] || graph[n].type->sink;
  return with_sources(ends, graph);
}

/// What is read by a node that does not use it (UnusedInput) is not made for it.
void drop_unused_edges(Dataflow& graph) {
  const auto is_unused = [&](const DataflowEdge& edge) {
    return graph[boost::target(edge, graph)].type->inputs[graph[edge].input].unused;
  };
  boost::remove_edge_if(is_unused, graph);
}

Pipeline checked_pipeline(const Dataflow& graph, const std::vector<bool>& needed) {
  std::vector<std::size_t> order = topological_order(graph);
  std::erase_if(order, [&](std::size_t n) { return !needed[n]; });
  Pipeline pipeline = part_of(graph, order);
  for (const std::size_t n : all_nodes(pipeline)) pipeline[n].seed = node_seed(pipeline[whole].seed, pipeline[n].path);
  return pipeline;
}

/// A setting of a node that does not run has no effect.
void check_overrides_matter(const Document& root, const Expansion& expansion, const Overrides& overrides,
                            const std::vector<bool>& needed, Findings& findings) {
  if (overrides.all().empty()) return;
  std::set<std::string_view> idle;
  for (const std::size_t n : all_nodes(expansion.graph))
    if (!needed[n]) idle.insert(expansion.graph[n].path);
  for (const ParsedOverride& set : overrides.all())
    if (idle.contains(set.node))
      findings.warning({&root.source, {}}, fmt::format("'{}' does not run: nothing uses what it gives", set.node),
                       "see `atrium graph` for what runs", {set.note});
}

void read_seed(const Document& root, Overrides& overrides, Findings& findings, std::uint64_t& seed) {
  seed = root.seed;
  const ParsedOverride* set = overrides.take("", "seed");
  if (set == nullptr || set->setting.broken) return;
  const bool single = set->setting.value.items.size() == 1 && !set->setting.value.is_list;
  if (!single || !parse_seed(set->setting.value.items.front(), seed))
    findings.error({&root.source, {}}, "the seed is not a whole number from 0 to 18446744073709551615", {},
                   {set->note});
}

void check_complete(const Document& root, const Expansion& expansion, LoadOptions options,
                    std::vector<std::string>& missing, Findings& findings) {
  const auto open =
      std::find_if(root.inputs.begin(), root.inputs.end(), [](const auto& i) { return !i.default_source; });
  for (const auto& input : root.inputs)
    if (!input.default_source) missing.push_back("inputs." + input.name.text);
  for (const auto& name : expansion.missing_variables) missing.push_back(name);
  if (options.allow_missing) return;
  if (open != root.inputs.end())
    findings.error({&root.source, open->name.place}, "a pipeline with inputs cannot run on its own",
                   "use it in another file: `{pipeline: FILE, in: {…}}`");
  for (const auto& variable : root.variables)
    if (std::find(missing.begin(), missing.end(), variable.name.text) != missing.end())
      findings.error({&root.source, variable.name.place},
                     fmt::format("the variable '{}' has no value", variable.name.text),
                     fmt::format("set it: -s {}=VALUE", variable.name.text));
}

}  // namespace

std::uint64_t node_seed(std::uint64_t run_seed, std::string_view path) {
  return mix_seed(run_seed, XXH3_64bits(path.data(), path.size()));
}

std::string_view framework_version() { return ATRIUM_VERSION; }

LoadResult load_pipeline(const std::filesystem::path& file, const std::vector<Override>& given, Registry& registry,
                         LoadOptions options) {
  Findings findings;
  std::vector<std::string> missing;
  std::vector<bool> needed;  // empty: it cannot run
  Expansion expansion;
  const GivenPipeline found = find_given_pipeline(file.string(), findings);
  ReadDocuments own;
  expansion.any_files = options.any_files;
  expansion.read = options.documents == nullptr ? &own : options.documents;
  auto document = findings.error_count() > 0 ? nullptr : expansion.read->read(found.path, found.name, 0, findings);
  if (document) {
    const Document& root = *document;
    expansion.documents.push_back(std::move(document));
    Overrides overrides(given, root.source, findings);
    PipelineProperties& properties = expansion.graph[whole];
    properties.summary = root.summary;
    properties.file = found.path;
    read_seed(root, overrides, findings, properties.seed);
    Expander(expansion, overrides, registry, findings).expand(root);
    settle_params(expansion, overrides, findings);
    wire(expansion, findings);
    check_use(expansion, findings);
    check_cycles(expansion, findings);
    check_versions(expansion, findings);
    check_programs(expansion, findings);
    check_complete(root, expansion, options, missing, findings);
    if (findings.error_count() == 0) {
      drop_unused_edges(expansion.graph);
      needed = needed_nodes(expansion.graph);
      check_overrides_matter(root, expansion, overrides, needed, findings);
    }
  }
  // Made in its place: Boost's graphs cannot be moved.
  return {needed.empty() ? Pipeline() : checked_pipeline(expansion.graph, needed), findings.errors(),
          findings.warnings(), std::move(missing)};
}

}  // namespace atrium
