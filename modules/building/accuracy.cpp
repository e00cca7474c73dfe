#include "modules/building/accuracy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "graph/api/write_output.hpp"
#include "modules/building/face_distances.hpp"
#include "modules/building/heat_map.hpp"
#include "modules/building/table.hpp"
#include "modules/geometry/quantile.hpp"
#include "modules/types/building_rules.hpp"

namespace atrium::building {
namespace {

constexpr std::size_t few_points = 10;                                   // fewer say nothing
constexpr std::size_t most_squares = 1'000'000;                          // of a face's heat map
constexpr std::array<double, 4> band_limits{0.05, 0.015, 0.005, 0.001};  // metres: of LOA20 to LOA50, USIBD 2016

struct Figures {
  std::size_t points = 0;
  double median = 0, rms = 0, p95 = 0;
};

Figures figures_of(std::vector<float> values) {
  Figures result;
  result.points = values.size();
  if (values.empty()) return result;
  double squares = 0;
  for (const float v : values) squares += static_cast<double>(v) * v;
  result.rms = std::sqrt(squares / static_cast<double>(values.size()));
  result.median = static_cast<double>(quantile(values, 0.5));
  for (float& v : values) v = std::abs(v);
  result.p95 = static_cast<double>(quantile(std::move(values), 0.95));
  return result;
}

/// 1 for LOA10 to 5 for LOA50; 0: not known.
int band_of(const Figures& figures) {
  if (figures.points < few_points) return 0;
  int band = 1;
  for (const double limit : band_limits) band += figures.p95 <= limit ? 1 : 0;
  return band;
}

void check_mesh(const Accuracy::In& in) {
  const Mesh& mesh = *in.mesh;
  if (mesh.primitives.size() != mesh.triangles.size())
    throw Error("the mesh does not say which face each triangle is of", "wire the structure of layout.mesh");
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::int32_t f = mesh.primitives[t];
    if (f < 0 || static_cast<std::size_t>(f) >= in.building->faces.size())
      throw Error(
          fmt::format("triangle {} of the mesh names face {}, the building has {}", t, f, in.building->faces.size()));
    for (const auto v : mesh.triangles[t])
      if (v >= mesh.vertices.size() || !mesh.vertices[v].allFinite())
        throw Error(fmt::format("triangle {} of the mesh has a corner that is not there or not finite", t));
  }
}

std::string millimetres(const Figures& figures, double value) {
  return figures.points == 0 ? std::string() : fmt::format("{:.2f}", 1000 * value);
}

std::string table_of(const Building& building, const std::vector<FaceDistances>& faces, int specified) {
  CsvTable table(std::string("face,class,storey,room,area_m2,points,median_mm,rms_mm,p95_mm,covered,inferred,loa") +
                 (specified > 0 ? ",meets" : ""));
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const BuildingFace& face = building.faces[f];
    const Figures figures = figures_of(faces[f].signed_distances);
    const int band = band_of(figures);
    table << f << std::string(name_of(face.surface)) << static_cast<std::size_t>(face.storey)
          << (face.room < 0 ? std::string() : building.rooms[static_cast<std::size_t>(face.room)].name) << faces[f].area
          << figures.points << millimetres(figures, figures.median) << millimetres(figures, figures.rms)
          << millimetres(figures, figures.p95) << face.observed << std::string(face.primitive < 0 ? "yes" : "no")
          << (band > 0 ? fmt::format("LOA{}", 10 * band) : std::string());
    if (specified > 0) table << std::string(band == 0 ? "" : band >= specified ? "yes" : "no");
    table.end();
  }
  return table.text();
}

Metrics totals(const Building& building, const std::vector<FaceDistances>& faces, int specified) {
  Metrics metrics;
  const auto add = [&](const std::string& name, const std::optional<SurfaceClass>& surface) {
    std::vector<float> values;
    for (std::size_t f = 0; f < faces.size(); ++f)
      if (!surface || building.faces[f].surface == *surface)
        values.insert(values.end(), faces[f].signed_distances.begin(), faces[f].signed_distances.end());
    if (values.empty()) return;
    const Figures figures = figures_of(std::move(values));
    metrics.values.push_back({"accuracy." + name + ".points", static_cast<double>(figures.points), ""});
    metrics.values.push_back({"accuracy." + name + ".median", figures.median, "m"});
    metrics.values.push_back({"accuracy." + name + ".rms", figures.rms, "m"});
    metrics.values.push_back({"accuracy." + name + ".p95", figures.p95, "m"});
  };
  add("all", std::nullopt);
  for (const SurfaceClass surface : {SurfaceClass::wall, SurfaceClass::floor, SurfaceClass::ceiling})
    add(std::string(name_of(surface)), surface);
  std::array<double, 6> areas{};
  double all = 0, meets = 0;
  for (const auto& face : faces) {
    const int band = band_of(figures_of(face.signed_distances));
    areas.at(static_cast<std::size_t>(band)) += face.area;
    all += face.area;
    if (band > 0 && band >= specified) meets += face.area;
  }
  if (!(all > 0)) return metrics;
  for (std::size_t band = 1; band < areas.size(); ++band)
    metrics.values.push_back({fmt::format("accuracy.area.loa{}", 10 * band), areas.at(band) / all, ""});
  metrics.values.push_back({"accuracy.area.unknown", areas[0] / all, ""});
  if (specified > 0) metrics.values.push_back({"accuracy.area.meets", meets / all, ""});
  return metrics;
}

/// How wide squares must be that no face has many more than it may have.
double widened(const std::vector<FaceDistances>& faces, double cell) {
  double result = cell;
  for (const auto& face : faces)
    if (!face.squares.empty())
      result = std::max(result, std::sqrt((face.high - face.low).prod() / static_cast<double>(most_squares)));
  return result;
}

std::vector<HeatMapFace> captions(const Building& building, const std::vector<FaceDistances>& faces) {
  std::vector<HeatMapFace> result;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const BuildingFace& face = building.faces[f];
    if (!(faces[f].area > 0)) continue;
    const Figures figures = figures_of(faces[f].signed_distances);
    HeatMapFace item;
    item.distances = &faces[f];
    item.face = f;
    item.storey = face.storey;
    item.caption = fmt::format("face {} ({}){}", f, name_of(face.surface),
                               face.room < 0 ? "" : ", " + building.rooms[static_cast<std::size_t>(face.room)].name);
    item.figures = figures.points < few_points
                       ? "too few points"
                       : fmt::format("median {:+.1f} mm, 95 % {:.1f} mm, LOA{}", 1000 * figures.median,
                                     1000 * figures.p95, 10 * band_of(figures));
    result.push_back(std::move(item));
  }
  return result;
}

}  // namespace

Accuracy::Out Accuracy::run(const In& in, const Params& params, Context& context) {
  check(*in.building);
  check_mesh(in);
  for (const auto& p : in.cloud->points)
    if (!p.allFinite()) throw Error("a point of the cloud is not finite");
  if (in.cloud->size() == 0) context.warn("the cloud has no points: the accuracy of every face is unknown");
  const auto most = static_cast<std::size_t>(params.max_points);
  const std::size_t step = std::max<std::size_t>(1, (in.cloud->size() + most - 1) / most);
  const auto measured = [&](double cell) {
    return face_distances(*in.mesh, *in.cloud, step, in.building->faces.size(), params.reach, cell, context);
  };
  auto faces = measured(params.cell);
  const double cell = widened(faces, params.cell);
  if (cell > params.cell) {
    context.warn(fmt::format("squares of {:.3f} m instead of {:.3f} m, so that no face has more than about {} of them",
                             cell, params.cell, most_squares));
    faces = measured(cell);
  }
  const int specified = static_cast<int>(params.specified);
  const std::string table = table_of(*in.building, faces, specified);
  const std::string picture = heat_map(captions(*in.building, faces), cell, params.colour_range);
  const std::string squares = heat_map_table(faces, in.mesh->origin, cell, params.colour_range);
  for (const auto& [path, text] :
       {std::pair{&params.path, &table}, {&params.picture, &picture}, {&params.heat_maps, &squares}}) {
    write_output(context, path->path, *text);
  }
  return {totals(*in.building, faces, specified)};
}

}  // namespace atrium::building
