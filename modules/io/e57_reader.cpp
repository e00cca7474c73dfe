#include "modules/io/e57_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "graph/api/error.hpp"
#include "graph/api/text.hpp"
#include "modules/io/e57_source.hpp"

namespace atrium::io {
namespace {

bool is_unset(const E57Scan& scan) { return !scan.pose || scan.pose->isApprox(Eigen::Isometry3d::Identity()); }

/// The scanners' places, one a scan; empty if that of any scan is not known.
std::vector<Eigen::Vector3d> scanner_places(const E57Source& source) {
  const auto& scans = source.scans();
  const bool any_set = std::any_of(scans.begin(), scans.end(), [](const E57Scan& s) { return !is_unset(s); });
  std::vector<Eigen::Vector3d> places;
  for (std::size_t s = 0; s < scans.size(); ++s) {
    const bool known = !is_unset(scans[s]) || (any_set && scans[s].pose) || source.around_scanner(s);
    if (!known) return {};
    const Eigen::Isometry3d pose = scans[s].pose.value_or(Eigen::Isometry3d::Identity());
    places.emplace_back(pose.translation());
  }
  return places;
}

}  // namespace

RawGeometry read_e57(const std::shared_ptr<const MappedFile>& file, const Context& context) {
  constexpr std::size_t most_scans = 65536;  // a point's source has 16 bits
  const std::string& path = file->path();
  E57Contents contents = read_e57_xml(path, E57Pages(file).xml());
  if (contents.all_scans == 0)
    throw Error(fmt::format("{}: the file has no scans{}", path,
                            contents.images > 0 ? ", only " + counted(contents.images, "image") : ""),
                "export the points as well");
  if (contents.scans.empty())
    throw Error(fmt::format("{}: no points: the file's {} empty", path,
                            contents.all_scans == 1 ? "scan is" : fmt::format("{} scans are", contents.all_scans)),
                "export the points as well");
  if (contents.scans.size() > most_scans)
    throw Error(
        fmt::format("{}: {} scans; the most that can be handled are {}", path, contents.scans.size(), most_scans));
  if (contents.images > 0) context.info(fmt::format("{}: {} passed over", path, counted(contents.images, "image")));
  RawGeometry geometry;
  geometry.path = path;
  geometry.metres_per_unit = 1.0;
  geometry.crs = contents.crs;
  const auto source = std::make_shared<const E57Source>(file, std::move(contents), context);
  geometry.count = source->records();
  geometry.sensors = scanner_places(*source);
  if (!source->uneven().empty())
    context.warn(
        fmt::format("{}: only some of the {} scans have {}: left out", path, source->scans().size(), source->uneven()));
  context.info(fmt::format("{}: {} with {}", path, counted(source->scans().size(), "scan"),
                           counted(source->records(), "record")));
  geometry.source = source;
  return geometry;
}

}  // namespace atrium::io
