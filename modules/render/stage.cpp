#include "modules/render/stage.hpp"

#include <cmath>
#include <utility>

#include "graph/api/error.hpp"
#include "modules/types/palette.hpp"

namespace atrium::render {
namespace {

using By = Snapshot::ColourBy;
using Chosen = std::vector<std::uint32_t>;

By settled(By by, const Snapshot::In& in) {
  const Cloud& cloud = *in.cloud;
  if (by == By::automatic) return in.reference ? By::distance : cloud.colours.empty() ? By::height : By::colour;
  if (by == By::colour && cloud.colours.empty())
    throw Error("the cloud has no colours", "colour_by: height draws any cloud");
  if (by == By::label && cloud.labels.empty())
    throw Error("the cloud has no labels", "colour_by: height draws any cloud");
  const bool needs_mesh = by == By::distance || by == By::signed_distance;
  if (needs_mesh && !in.reference)
    throw Error("there is no mesh to measure distances to", "wire the input 'reference'");
  return by;
}

ColourMap map_for(By by, const std::string& name) {
  if (!name.empty()) return load_colour_map(name);
  if (by == By::label) return load_colour_map("okabe_ito");
  return load_colour_map(by == By::signed_distance ? "cool_warm" : by == By::distance ? "cividis" : "viridis");
}

PointColours cloud_colours(const Snapshot::In& in, const Snapshot::Params& params, const Chosen& chosen,
                           const Transform& to_upright, const Context& context) {
  const Cloud& cloud = *in.cloud;
  const By by = settled(params.colour_by, in);
  PointColours result;
  if (by == By::plain) {
    result.colours.assign(chosen.size(), Colour{110, 110, 110});
  } else if (by == By::colour) {
    for (const auto i : chosen) result.colours.push_back(cloud.colours[i]);
  } else if (by == By::label) {
    result = label_colours(cloud, chosen, map_for(by, params.colour_map));
  } else if (by == By::height) {
    result = height_colours(cloud, chosen, to_upright, map_for(by, params.colour_map));
  } else {
    result = distance_colours(cloud, chosen, *in.reference, by == By::signed_distance, params.scale_end,
                              map_for(by, params.colour_map), context);
  }
  return result;
}

void add_primitives(Drawing& drawing, const PlanePrimitives& planes, double cut) {
  std::vector<Colour> colours(planes.cloud->size(), Colour{200, 200, 200});
  for (std::size_t k = 0; k < planes.primitives.size(); ++k)
    for (const auto i : planes.primitives[k].inliers) colours[i] = index_colour(k);
  const Chosen chosen = evenly_chosen(planes.cloud->size(), most_points);
  std::vector<Colour> shown;
  shown.reserve(chosen.size());
  for (const auto i : chosen) shown.push_back(colours[i]);
  drawing.add_points(*planes.cloud, chosen, shown, cut);
}

/// The points of structural primitives, each in the colour of its class.
void add_structure(Drawing& drawing, Overlay& overlay, const Structure& structure, bool ceilings) {
  const PlanePrimitives& planes = *structure.primitives;
  Chosen all;
  std::vector<Colour> colours;
  std::set<SurfaceClass> classes;
  for (std::size_t k = 0; k < planes.primitives.size(); ++k) {
    const SurfaceClass surface = structure.classes[k];
    if (surface == SurfaceClass::object || (surface == SurfaceClass::ceiling && !ceilings)) continue;
    const auto& inliers = planes.primitives[k].inliers;
    all.insert(all.end(), inliers.begin(), inliers.end());
    colours.insert(colours.end(), inliers.size(), class_colour(surface));
    classes.insert(surface);
  }
  Chosen chosen;
  std::vector<Colour> shown;
  for (const auto i : evenly_chosen(all.size(), most_points)) {
    chosen.push_back(all[i]);
    shown.push_back(colours[i]);
  }
  drawing.add_points(*planes.cloud, chosen, shown, 0);
  for (const auto surface : classes) overlay.legend.emplace_back(std::string(name_of(surface)), class_colour(surface));
}

Mesh triangulated(const PlaneMeshes& meshes) {
  Mesh result;
  result.origin = meshes.origin;
  for (const auto& m : meshes.meshes) {
    const auto first = static_cast<std::uint32_t>(result.vertices.size());
    result.vertices.insert(result.vertices.end(), m.corners.begin(), m.corners.end());
    for (std::uint32_t k = 2; k < m.corners.size(); ++k) {
      result.triangles.push_back({first, first + k - 1, first + k});
      result.classes.push_back(m.surface);
      result.primitives.push_back(m.primitive);
    }
  }
  return result;
}

double line_width(const Snapshot::Params& params) {
  return std::max(1.0, std::round(static_cast<double>(params.height) / 480));
}

void add_meshes(Drawing& drawing, const Snapshot::In& in, const Snapshot::Params& params, Camera camera) {
  using Near = Snapshot::NearWalls;
  const bool ceilings = params.ceilings || camera == Camera::inside;
  const bool hidden =
      params.near_walls == Near::automatic ? camera <= Camera::level && !ceilings : params.near_walls == Near::hidden;
  const Drawing::MeshStyle surfaces{line_width(params), params.edges, hidden, ceilings, false};
  if (in.meshes) drawing.add_mesh(triangulated(*in.meshes), surfaces);
  if (in.adjacency) {
    if (!in.meshes) throw Error("an adjacency graph is drawn between meshes", "wire the input 'meshes' too");
    if (in.adjacency->vertices() > in.meshes->meshes.size())
      throw Error("the adjacency graph is not of these meshes: it has more vertices than there are meshes",
                  "wire the meshes that the graph was made from");
    drawing.add_adjacency(*in.meshes, *in.adjacency);
  }
  if (in.textures && !in.mesh) throw Error("images lie on the faces of a mesh", "wire the input 'mesh' too");
  if (in.mesh) drawing.add_mesh(*in.mesh, surfaces, in.textures.get());
  if (in.truth) drawing.add_mesh(in.truth->mesh, surfaces);
  if (in.objects) drawing.add_mesh(*in.objects, {1, false, false, true, true});
}

}  // namespace

void add_inputs(Drawing& drawing, Overlay& overlay, const Snapshot::In& in, const Snapshot::Params& params,
                Camera camera, const Context& context) {
  const Transform to_upright = in.transform ? *in.transform : Transform{};
  const double cut = camera == Camera::above && !params.ceilings ? params.cut_below_top : 0;
  if (in.cloud && !in.cloud->points.empty()) {
    const Chosen chosen = evenly_chosen(in.cloud->size(), most_points);
    PointColours points = cloud_colours(in, params, chosen, to_upright, context);
    drawing.add_points(*in.cloud, chosen, points.colours, cut);
    overlay.colours = std::move(points.scale);
    overlay.legend = std::move(points.legend);
  }
  if (in.planes && !in.planes->cloud->points.empty()) add_primitives(drawing, *in.planes, cut);
  const auto named = overlay.legend.size();
  if (in.structure) add_structure(drawing, overlay, *in.structure, params.ceilings || camera == Camera::inside);
  add_meshes(drawing, in, params, camera);
  const bool by_class = overlay.legend.size() > named;  // structure has named them
  for (const auto surface : {SurfaceClass::wall, SurfaceClass::floor, SurfaceClass::ceiling, SurfaceClass::object})
    if (!by_class && drawing.classes().contains(surface))
      overlay.legend.emplace_back(std::string(name_of(surface)), class_colour(surface));
}

}  // namespace atrium::render
