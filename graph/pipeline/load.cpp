#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>

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
      const auto same = [&, &name = type.text](const FlatNode& node) {
        return node.type != nullptr && node.type->type == name;
      };
      const auto node = std::find_if(expansion.nodes.begin(), expansion.nodes.end(), same);
      if (node == expansion.nodes.end()) continue;  // swapped for another type
      const std::string present = std::to_string(node->type->version);
      if (version.text != present)
        findings.error(
            where, fmt::format("the file wants version {} of {}, this is version {}", version.text, type.text, present),
            "its results may differ: to run it with the present version, remove the line");
    }
  }
}

/// Nodes that lead to a file or an output of the outermost file. A sub-pipeline's output that nobody reads is not made.
std::vector<bool> needed_nodes(const Expansion& expansion, const std::vector<std::size_t>& order) {
  std::vector<bool> needed(expansion.nodes.size(), false);
  for (const auto& output : expansion.outputs) needed[output.from.node] = true;
  for (auto it = order.rbegin(); it != order.rend(); ++it) {
    const FlatNode& node = expansion.nodes[*it];
    // A file with inputs is not complete on its own: all that it holds counts.
    needed[*it] = needed[*it] || node.type->sink;
    if (needed[*it])
      for (const auto& port : node.inputs)
        for (const auto& edge : port) needed[edge.from.node] = true;
  }
  return needed;
}

void build_pipeline(Expansion& expansion, const std::vector<std::size_t>& order, Pipeline& pipeline) {
  const std::vector<bool> needed = needed_nodes(expansion, order);
  std::vector<std::size_t> place(expansion.nodes.size(), 0);
  for (const std::size_t index : order) {
    if (!needed[index]) continue;
    place[index] = pipeline.nodes.size();
    FlatNode& flat = expansion.nodes[index];
    PipelineNode node{std::move(flat.path), flat.type, std::move(flat.params), {}};
    node.seed = node_seed(pipeline.seed, node.path);
    for (const auto& port : flat.inputs) {
      auto& edges = node.inputs.emplace_back();
      for (const auto& edge : port) edges.push_back({place[edge.from.node], edge.from.output});
    }
    pipeline.nodes.push_back(std::move(node));
  }
  for (const auto& output : expansion.outputs)
    pipeline.outputs.push_back({output.name, {place[output.from.node], output.from.output}});
}

void read_seed(const Document& root, Overrides& overrides, Findings& findings, Pipeline& pipeline) {
  pipeline.seed = root.seed;
  const ParsedOverride* set = overrides.take("", "seed");
  if (set == nullptr || set->setting.broken) return;
  const bool single = set->setting.value.items.size() == 1 && !set->setting.value.is_list;
  if (!single || !parse_seed(set->setting.value.items.front(), pipeline.seed))
    findings.error({&root.source, {}}, "the seed is not a whole number from 0 to 18446744073709551615", {},
                   {set->note});
}

void check_complete(const Document& root, const Expansion& expansion, LoadOptions options, LoadResult& result,
                    Findings& findings) {
  const auto open = std::find_if(root.inputs.begin(), root.inputs.end(), [](const auto& i) { return !i.standard; });
  for (const auto& input : root.inputs)
    if (!input.standard) result.missing.push_back("inputs." + input.name.text);
  for (const auto& name : expansion.missing_variables) result.missing.push_back(name);
  if (options.allow_missing) return;
  if (open != root.inputs.end())
    findings.error({&root.source, open->name.place}, "a pipeline with inputs cannot run on its own",
                   "use it in another file: `{pipeline: FILE, in: {…}}`");
  for (const auto& variable : root.variables)
    if (std::find(result.missing.begin(), result.missing.end(), variable.name.text) != result.missing.end())
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
  LoadResult result;
  Findings findings;
  Expansion expansion;
  const GivenPipeline found = find_given_pipeline(file.string(), findings);
  ReadDocuments own;
  expansion.read = options.documents == nullptr ? &own : options.documents;
  auto document = findings.error_count() > 0 ? nullptr : expansion.read->read(found.path, found.name, 0, findings);
  if (document) {
    const Document& root = *document;
    expansion.documents.push_back(std::move(document));
    Overrides overrides(given, root.source, findings);
    result.pipeline.summary = root.summary;
    result.pipeline.file = found.path;
    read_seed(root, overrides, findings, result.pipeline);
    Expander(expansion, overrides, registry, findings).expand(root);
    settle_params(expansion, overrides, findings);
    wire(expansion, findings);
    const std::vector<std::size_t> order = run_order(expansion, findings);
    check_versions(expansion, findings);
    check_complete(root, expansion, options, result, findings);
    if (findings.error_count() == 0) build_pipeline(expansion, order, result.pipeline);
  }
  result.errors = findings.errors();
  result.warnings = findings.warnings();
  return result;
}

}  // namespace atrium
