// What must hold of files and sweeps whatever stands in them, tried on random ones.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <map>
#include <set>

#include "graph/cache/cache.hpp"
#include "graph/pipeline/registry.hpp"
#include "graph/sweep/run.hpp"
#include "tests/graph/folder.hpp"
#include "tests/graph/run_nodes.hpp"

namespace atrium::sweep_properties_test {
namespace {

namespace fs = std::filesystem;
using test::Folder;

/// A sum of nothing.
struct Number {
  static constexpr std::string_view type = "test.number";
  static constexpr std::string_view summary = "Gives a number.";
  struct In {};
  using Out = test::Sum::Out;
  using Params = test::Sum::Params;
  static constexpr auto inputs = std::tuple{};
  static constexpr auto outputs = test::Sum::outputs;
  static constexpr auto params = test::Sum::params;
  static Out run(const In& /*in*/, const Params& params, Context& context) {
    return test::Sum::run({}, params, context);
  }
};

template <class T>
std::vector<T> shuffled(std::vector<T> items) {
  for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[*rc::gen::inRange<std::size_t>(0, i)]);
  return items;
}

std::string joined(const std::vector<std::string>& items, const std::string& separator) {
  std::string text;
  for (const auto& item : items) text += (text.empty() ? "" : separator) + item;
  return text;
}

/// The nodes of a pipeline file: each adds some earlier ones.
struct File {
  struct Node {
    std::vector<std::size_t> terms;
    std::int64_t add;
    bool fail;
  };
  std::vector<Node> nodes;

  /// In any order of keys.
  std::string text() const {
    std::vector<std::string> entries;
    std::vector<std::string> outputs;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      outputs.push_back(fmt::format("o{0}: n{0}.sum", n));
      std::vector<std::string> terms;
      for (const auto t : nodes[n].terms) terms.push_back(fmt::format("n{}.sum", t));
      const auto params =
          shuffled<std::string>({fmt::format("add: {}", nodes[n].add), fmt::format("fail: {}", nodes[n].fail)});
      std::vector<std::string> keys{terms.empty() ? "type: test.number" : "type: test.sum",
                                    "params: {" + joined(params, ", ") + "}"};
      if (!terms.empty()) keys.push_back("in: {terms: [" + joined(terms, ", ") + "]}");
      entries.push_back(fmt::format("  n{}: {{{}}}\n", n, joined(shuffled(keys), ", ")));
    }
    return joined(shuffled<std::string>({"atrium: 1\n", "seed: 3\n", "nodes:\n" + joined(shuffled(entries), ""),
                                         "outputs: {" + joined(shuffled(outputs), ", ") + "}\n"}),
                  "");
  }
};

File random_file(bool may_fail) {
  File file;
  const auto size = *rc::gen::inRange<std::size_t>(1, 8);
  for (std::size_t n = 0; n < size; ++n) {
    File::Node node{{}, *rc::gen::inRange<std::int64_t>(-3, 4), may_fail && *rc::gen::inRange(0, 4) == 0};
    for (std::size_t t = 0; t < n; ++t)
      if (*rc::gen::inRange(0, 3) == 0) node.terms.push_back(t);
    file.nodes.push_back(std::move(node));
  }
  return file;
}

class Types {
 public:
  Types() {
    registry.add(describe_node<Number>());
    registry.add(describe_node<test::Sum>());
  }
  Registry registry{std::vector<fs::path>{}};
};

/// Each node's key, by its address. In place of a value's hash stands where it comes from.
std::map<std::string, std::string> keys_of(const fs::path& file, Registry& registry, Cache& cache) {
  const LoadResult loaded = load_pipeline(file, {}, registry);
  for (const auto& error : loaded.errors) RC_FAIL(to_string(error));
  std::map<std::string, std::string> keys;
  for (const std::size_t n : all_nodes(loaded.pipeline)) {
    const PipelineNode& node = loaded.pipeline[n];
    std::vector<std::vector<std::string>> hashes;
    for (const auto& port : inputs_of(n, loaded.pipeline)) {
      auto& list = hashes.emplace_back();
      for (const Source& source : port) list.push_back(loaded.pipeline[source.node].path);
    }
    keys[node.path] = cache.key_of(node, hashes).hex();
  }
  return keys;
}

RC_GTEST_PROP(SweepProperties, TheOrderOfKeysInAFileChangesNoKey, ()) {
  const Folder folder;
  Types types;
  Cache cache({folder.path() / "cache"});
  const File file = random_file(true);
  const auto keys = keys_of(folder.write("a.yaml", file.text()), types.registry, cache);
  RC_ASSERT(keys.size() == file.nodes.size());
  RC_ASSERT(keys_of(folder.write("b.yaml", file.text()), types.registry, cache) == keys);
}

struct Done {
  std::map<std::string, VariantResult> variants;  ///< by id
};

Done run(const fs::path& file, const fs::path& out, Cache& cache, Registry& registry) {
  Findings findings;
  const auto sweep = read_sweep(file, file.string(), findings);
  RC_ASSERT(sweep != nullptr);
  const SweepLoad load = plan_sweep(*sweep, {}, registry);
  for (const auto& error : load.errors) RC_FAIL(to_string(error));
  SweepOptions options;
  options.out = out;
  options.threads = 2;
  options.cache = &cache;
  ProgressSink silent;
  SweepResult result = run_sweep(*sweep, load.plan, "build", options, silent);
  Done done;
  for (std::size_t v = 0; v < result.variants.size(); ++v)
    done.variants.emplace(load.plan.variants[v].id, std::move(result.variants[v]));
  return done;
}

void growing_a_sweep_runs_nothing_again() {
  const Folder folder;
  Types types;
  Cache cache({folder.path() / "cache"});
  const File file = random_file(false);
  folder.write("base.yaml", file.text());
  const auto size = file.nodes.size();
  std::set<std::string> axes{fmt::format("n{}.add", *rc::gen::inRange<std::size_t>(0, size)),
                             fmt::format("n{}.add", *rc::gen::inRange<std::size_t>(0, size))};
  std::map<std::string, std::vector<std::string>> few, more;
  for (const auto& axis : axes) {
    std::vector<std::string> all = shuffled<std::string>({"10", "11", "12", "13"});
    all.resize(*rc::gen::inRange<std::size_t>(1, 4));
    more[axis] = shuffled(all);
    all.resize(*rc::gen::inRange<std::size_t>(1, all.size() + 1));
    few[axis] = all;
  }
  const auto write = [&](const std::string& name, const std::map<std::string, std::vector<std::string>>& grid) {
    std::vector<std::string> entries;
    for (const auto& [axis, values] : grid) entries.push_back(axis + ": [" + joined(values, ", ") + "]");
    return folder.write(name, "atrium: 1\nsweep: base.yaml\ngrid: {" + joined(shuffled(entries), ", ") + "}\n");
  };
  const Done before = run(write("few.yaml", few), folder.path() / "a", cache, types.registry);
  const fs::path grown = write("more.yaml", more);
  const Done same = run(grown, folder.path() / "a", cache, types.registry);   // its folder has them
  const Done other = run(grown, folder.path() / "b", cache, types.registry);  // the cache has them
  for (const auto& [id, result] : before.variants) {
    RC_ASSERT(result.status == VariantStatus::ok);
    RC_ASSERT(same.variants.at(id).reused);
    for (const auto& node : other.variants.at(id).nodes) RC_ASSERT(node.is_from_cache());
  }
  for (const auto& [id, result] : same.variants) RC_ASSERT(result.reused == before.variants.contains(id));
}

TEST(SweepProperties, GrowingASweepRunsNothingAgain) {
  rc::detail::TestParams params = rc::detail::configuration().testParams;
  params.maxSuccess = std::min(params.maxSuccess, 20);  // each writes hundreds of files
  const auto result =
      rc::detail::checkTestable(&growing_a_sweep_runs_nothing_again, rc::detail::TestMetadata{}, params);
  std::ostringstream text;
  printResultMessage(result, text);
  EXPECT_TRUE(result.is<rc::detail::SuccessResult>()) << text.str();
}

}  // namespace
}  // namespace atrium::sweep_properties_test
