// What graph/ reads: pipeline and sweep files, which give findings and throw nothing, and the files of the cache.
#include <cstdlib>
#include <cstring>

#include "graph/cache/blob.hpp"
#include "graph/cache/record.hpp"
#include "graph/pipeline/findings.hpp"
#include "graph/sweep/plan.hpp"
#include "graph/sweep/sweep_file.hpp"
#include "modules/types/adjacency.hpp"
#include "modules/types/building.hpp"
#include "modules/types/cell_complex.hpp"
#include "modules/types/cloud.hpp"
#include "modules/types/floor_plan.hpp"
#include "modules/types/metrics.hpp"
#include "modules/types/simulated_scene.hpp"
#include "modules/types/textures.hpp"
#include "tests/fuzz/targets.hpp"
#include "tests/graph/test_nodes.hpp"

namespace atrium::fuzz {
namespace {

std::string hash_of(std::string_view bytes) {
  ContentHash hash;
  hash.bytes(bytes.data(), bytes.size());
  return hash.hex();
}

struct TestTypes {
  TestTypes() { test::add_test_nodes(registry); }
  Registry registry{std::vector<std::filesystem::path>{}};
};

Registry& registry() {
  static TestTypes types;
  return types.registry;
}

/// A value of the flat form, in a file of the cache: read, and if it is one, hashed.
template <class T>
void read_blob_of(std::string_view flat) {
  const FlatType& type = *flat_type<T>();
  const std::string name(32, 'a');
  std::string bytes("atriumB1");
  for (const std::uint64_t number : {std::uint64_t{0x0102030405060708}, type.layout})
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  bytes += name + std::string(8, '\0');
  bytes += flat;
  bytes += hash_of(bytes);
  const auto file = put("blob", bytes);
  try {
    const auto nothing = [](const FlatType& /*type*/, const std::string& /*hash*/) -> std::shared_ptr<const void> {
      throw Error("no such value");
    };
    type.hash(read_blob(file, type, name, nothing).get());
  } catch (const DamagedFile&) {
  }
}

}  // namespace

void check_pipeline(std::string_view bytes) {
  static const bool once = [] {
    put("sub.yaml",
        "atrium: 1\nvars: {unit: 3 cm}\ninputs: {cloud: Cloud}\nnodes:\n  again: {type: test.find, in: {cloud: "
        "inputs.cloud}, params: {distance: \"${unit}\"}}\noutputs: {planes: again.planes}\n");
    return true;
  }();
  const auto file = put("fuzz.yaml", bytes);
  const LoadResult loaded = load_pipeline(file, {}, registry(), {once});
  for (const auto& error : loaded.errors) to_string(error);
  if (loaded.errors.empty() && loaded.missing.empty()) resolved_yaml(loaded.pipeline);
}

void plan_sweep_file(std::string_view bytes) {
  static const bool once = [] {
    put("base.yaml",
        "atrium: 1\nvars: {unit: 3 cm}\nnodes:\n  cloud: {type: test.make}\n  planes: {type: test.find, in: {cloud: "
        "cloud.cloud}, params: {distance: \"${unit}\"}}\n  write: {type: test.write, in: {planes: "
        "planes.planes}}\noutputs: {planes: planes.planes}\n");
    return true;
  }();
  const auto file = put("sweep.yaml", bytes);
  Findings findings;
  const auto sweep = once ? read_sweep(file, file.string(), findings) : nullptr;
  if (sweep != nullptr && findings.count() == 0) plan_sweep(*sweep, {}, registry());
}

void read_cache_record(std::string_view bytes) {
  const std::string text = hash_of(bytes) + "\n" + std::string(bytes);
  if (const auto record = read_record(text)) {
    const std::string again = record_text(*record);
    if (!read_record(again) || record_text(*read_record(again)) != again) std::abort();
  }
}

void read_cache_blob(std::string_view bytes) {
  using Reader = void (*)(std::string_view);
  static const Reader readers[] = {read_blob_of<Adjacency>, read_blob_of<Building>,       read_blob_of<CellComplex>,
                                   read_blob_of<Cloud>,     read_blob_of<FloorPlan>,      read_blob_of<GroundTruth>,
                                   read_blob_of<Metrics>,   read_blob_of<SimulatedScene>, read_blob_of<Textures>};
  if (bytes.empty()) return;
  readers[static_cast<unsigned char>(bytes.front()) % std::size(readers)](bytes.substr(1));
}

}  // namespace atrium::fuzz
