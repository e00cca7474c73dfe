#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "graph/pipeline/findings.hpp"

namespace atrium {

/// `NODE.PARAM: value`, `NODE.type: TYPE`, `NODE.pipeline: FILE` or `VARIABLE: value`, as -s takes it.
struct SweepSetting {
  std::string target;
  std::string value;  ///< as people read it
  YamlNode node;      ///< the value itself
  Place place;
};

/// One value of an axis: what the table calls it, and what it sets.
struct SweepChoice {
  std::string label;
  std::vector<SweepSetting> settings;
  Place place;
};

/// What the variants differ in, one column of the table: `scenes`, `list`, `ablate`, a target of `grid`, a `zip`, the
/// samples of `random`, `seeds`. The variants are all combinations of one choice from each axis.
struct SweepAxis {
  std::string name;  ///< "scene", "variant", "ablation", "translated.max_separation", "seed", …
  std::vector<SweepChoice> choices;
};

/// A column of the table: `NAME: OUTPUT.METRIC`, `NAME: OUTPUT`, or `NAME: {of: …, unit: …, digits: …}`; or what the
/// variant cost: `NAME: {seconds: NODE}` and `{memory: NODE}` (a node, or all of a sub-pipeline).
struct SweepMetric {
  enum class Kind { fact, time, memory };
  std::string name;
  Kind kind = Kind::fact;
  std::string output, fact;  ///< of kind fact
  std::string node;          ///< of the other kinds; "": all of the variant
  std::string unit;          ///< to be shown in; "": as it is
  std::optional<int> digits;
  Place place;
};

/// A sheet of one picture of every variant: `FILE.png: PICTURE.png`, or `{picture: …, columns: …, cell_width: …}`.
struct SweepSheet {
  std::string file, picture;
  std::int64_t columns = 0;  ///< 0: as many as the last axis that varies has choices
  std::int64_t cell_width = 480;
  Place place;
};

/// A sweep file as it stands.
struct SweepFile {
  SourceFile source;
  std::filesystem::path path;
  std::string summary;
  std::filesystem::path base;  ///< absolute
  std::string base_name;       ///< as findings name it
  Place base_place;
  std::vector<SweepSetting> settings;  ///< of every variant
  std::vector<SweepAxis> axes;
  std::vector<std::vector<SweepSetting>> exclude;  ///< target or axis name, and value or label
  std::vector<SweepMetric> metrics;
  std::vector<SweepSheet> sheets;
};

/// Reads a sweep file and checks its shape. Null when there is nothing that could be checked further.
///
///   atrium: 1
///   sweep: ../paper.yaml              # the base: any pipeline file
///   summary: …
///   set: {objects.type: object.none}  # the same in all variants
///   scenes: {flat: {scan: flat.ply}, office: {scan: office.ply}}
///   scenes: {scan: scans/*.ply}       # or so: a scene for each file of a folder or pattern
///   seeds: [1, 2, 3]
///   grid: {translated.max_separation: [10 cm, 50 cm, 1 m]}
///   zip: {a.x: [1, 2], b.y: [3, 4]}   # side by side
///   list: {ransac: {planes.type: plane.ransac}, growing: {planes.type: plane.region_growing}}
///   ablate: {no_clipping: {clipped.type: refine.none}}   # everything, and everything but one
///   random: {samples: 20, seed: 7, of: {planes.distance: {uniform: [1 cm, 4 cm]}}}
///   exclude: [{scene: office, translated.max_separation: 1 m}]
///   metrics: {faces: faces.faces.triangles, completeness: {of: quality.structure.b50mm.completeness, unit: "%"}}
///   pictures: {sheet.png: picture.png}       # of variants that differ in their seed only, the first one's
std::unique_ptr<SweepFile> read_sweep(const std::filesystem::path& path, const std::string& name, Findings& findings);

}  // namespace atrium
