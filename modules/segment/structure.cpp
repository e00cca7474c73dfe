#include "modules/segment/structure.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "modules/segment/plane_extent.hpp"
#include "modules/segment/storeys.hpp"
#include "modules/segment/wall_contact.hpp"

namespace atrium::segment {
namespace {

/// The primitives by their angle to the vertical (and height).
struct Sorted {
  std::vector<PlaneExtent> horizontal, walls;
  std::size_t in_gap = 0;
};

Sorted sort(const std::vector<PlaneExtent>& planes, const Structure::Params& params) {
  Sorted result;
  for (const auto& plane : planes) {
    if (plane.points == 0) continue;
    const bool slanted_ceiling = !plane.faces_up && plane.angle < params.slanted_ceiling_angle;
    if (plane.angle < params.horizontal_angle || slanted_ceiling) {
      result.horizontal.push_back(plane);
    } else if (plane.angle > params.wall_angle) {
      if (plane.extent() > params.min_wall_height) result.walls.push_back(plane);
    } else {
      ++result.in_gap;
    }
  }
  return result;
}

void face_by_position(std::vector<PlaneExtent>& horizontal) {
  if (horizontal.empty()) return;
  const auto [low, high] = std::minmax_element(horizontal.begin(), horizontal.end(),
                                               [](const auto& l, const auto& r) { return l.height < r.height; });
  const double middle = (low->height + high->height) / 2;
  for (auto& plane : horizontal) plane.faces_up = plane.height <= middle;
}

std::int32_t storey_of(const PlaneExtent& wall, const std::vector<Storey>& storeys) {
  std::int32_t best = 0;
  double most = -1;
  for (std::size_t k = 0; k < storeys.size(); ++k) {
    const double overlap = std::min(wall.top, storeys[k].high) - std::max(wall.bottom, storeys[k].low);
    if (overlap > most) {
      most = overlap;
      best = static_cast<std::int32_t>(k);
    }
  }
  return best;
}

atrium::Structure classify(const Input<PlanePrimitives>& planes, const Sorted& sorted,
                           const std::vector<Storey>& storeys) {
  atrium::Structure result;
  result.primitives = planes;
  result.classes.assign(planes->primitives.size(), SurfaceClass::object);
  result.storeys.assign(planes->primitives.size(), -1);
  result.storey_count = static_cast<std::int32_t>(storeys.size());
  const auto set = [&](const PlaneExtent& plane, SurfaceClass surface, std::int32_t storey) {
    result.classes[plane.primitive] = surface;
    result.storeys[plane.primitive] = storey;
  };
  for (std::size_t k = 0; k < storeys.size(); ++k) {
    for (const auto& floor : storeys[k].floors) set(floor, SurfaceClass::floor, static_cast<std::int32_t>(k));
    for (const auto& ceiling : storeys[k].ceilings) set(ceiling, SurfaceClass::ceiling, static_cast<std::int32_t>(k));
  }
  for (const auto& wall : sorted.walls) set(wall, SurfaceClass::wall, storey_of(wall, storeys));
  return result;
}

Cloud object_points(const atrium::Structure& structure) {
  const PlanePrimitives& planes = *structure.primitives;
  std::vector<std::uint8_t> structural(planes.cloud->size(), 0);
  for (std::size_t i = 0; i < planes.primitives.size(); ++i)
    if (structure.classes[i] != SurfaceClass::object)
      for (const auto p : planes.primitives[i].inliers) structural[p] = 1;
  std::vector<std::uint32_t> rest;
  for (std::uint32_t p = 0; p < structural.size(); ++p)
    if (structural[p] == 0) rest.push_back(p);
  return select(*planes.cloud, rest);
}

std::size_t number_of(const atrium::Structure& structure, SurfaceClass surface) {
  return static_cast<std::size_t>(std::count(structure.classes.begin(), structure.classes.end(), surface));
}

void check(const Sorted& sorted, const std::vector<Storey>& storeys, const Structure::Params& params,
           Context& context) {
  if (sorted.walls.empty())
    throw Error(
        "no room is in it: no plane is a wall",
        fmt::format("a wall's normal is more than {} deg from the vertical and its points reach over more than {} m; "
                    "check that z is up and lengths are metres, or change wall_angle and min_wall_height",
                    params.wall_angle, params.min_wall_height));
  const bool floor = std::any_of(storeys.begin(), storeys.end(), [](const Storey& s) { return !s.floors.empty(); });
  const bool ceiling = std::any_of(storeys.begin(), storeys.end(), [](const Storey& s) { return !s.ceilings.empty(); });
  if (!floor && !ceiling)
    throw Error(
        "no room is in it: there are walls, but neither a floor nor a ceiling",
        fmt::format(
            "a floor's or ceiling's normal is less than {} deg from the vertical; check that z is up, or change "
            "horizontal_angle",
            params.horizontal_angle));
  const double contact = wall_contact(sorted.walls, storeys, params.contact_distance);
  if (contact < params.min_wall_contact)
    throw Error(
        fmt::format("no room is in it: only {:.0f} % of the walls' length stands on a floor or reaches a ceiling",
                    100 * contact),
        "what was found are furniture and pieces of walls; scan the floor or the ceiling too, lower min_wall_contact "
        "or raise contact_distance");
  if (!floor) context.warn("no floor was found");
  if (!ceiling) context.warn("no ceiling was found");
}

}  // namespace

Structure::Out Structure::run(const In& in, const Params& params, Context& context) {
  if (std::max(params.horizontal_angle, params.slanted_ceiling_angle) > params.wall_angle)
    throw Error(
        "a plane could be both a wall and a floor or ceiling: wall_angle is below horizontal_angle or "
        "slanted_ceiling_angle",
        "keep wall_angle above both");
  Sorted sorted = sort(measure(*in.planes, context), params);
  if (params.sides == Sides::position) face_by_position(sorted.horizontal);
  const std::vector<Storey> storeys = find_storeys(
      sorted.horizontal, sorted.walls,
      {params.ceiling_share, params.floor_share, params.storey_share, params.min_storey_height, params.min_wall_height,
       params.storey_rule == StoreyRule::share, params.ceiling_height == CeilingHeight::mean});
  check(sorted, storeys, params, context);
  Out out;
  out.structure = classify(in.planes, sorted, storeys);
  out.objects = object_points(out.structure);
  const auto add = [&](const char* name, std::size_t value) {
    out.report.values.push_back({fmt::format("structure.{}", name), static_cast<double>(value), ""});
  };
  add("planes", in.planes->primitives.size());
  add("walls", number_of(out.structure, SurfaceClass::wall));
  add("floors", number_of(out.structure, SurfaceClass::floor));
  add("ceilings", number_of(out.structure, SurfaceClass::ceiling));
  add("storeys", storeys.size());
  add("planes_between_angles", sorted.in_gap);
  add("object_points", out.objects.size());
  return out;
}

}  // namespace atrium::segment
