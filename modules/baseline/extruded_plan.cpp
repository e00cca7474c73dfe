#include "modules/baseline/extruded_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "graph/api/text.hpp"
#include "modules/baseline/density_plan.hpp"
#include "modules/baseline/storey_heights.hpp"
#include "modules/geometry/ear_clipping.hpp"

namespace atrium::baseline {
namespace {

using Corners = std::array<std::uint32_t, 3>;

/// Adds prisms to a mesh.
class Extrusion {
 public:
  explicit Extrusion(Mesh& mesh) : mesh_(mesh) {}

  void add(const PlanPolygon& polygon, double floor, double ceiling, std::int32_t storey) {
    storey_ = storey;
    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
    std::vector<const PlanRing*> rings{&polygon.outline};
    for (const auto& hole : polygon.holes) rings.push_back(&hole);
    for (const auto* ring : rings)
      for (const auto& p : *ring) {
        mesh_.vertices.emplace_back(p.x(), p.y(), floor);
        mesh_.vertices.emplace_back(p.x(), p.y(), ceiling);
      }
    const auto triangles = clip_ears(polygon);
    const auto low = [&](std::uint32_t k) { return first + 2 * k; };
    const auto high = [&](std::uint32_t k) { return first + 2 * k + 1; };
    for (const auto& t : triangles) face({low(t[0]), low(t[1]), low(t[2])}, SurfaceClass::floor);
    ++primitive_;
    for (const auto& t : triangles) face({high(t[0]), high(t[2]), high(t[1])}, SurfaceClass::ceiling);
    ++primitive_;
    std::uint32_t start = 0;
    for (const auto* ring : rings) {
      const auto size = static_cast<std::uint32_t>(ring->size());
      for (std::uint32_t k = 0; k < size; ++k) {  // the room is on the left
        const std::uint32_t a = start + k, b = start + (k + 1) % size;
        face({low(a), high(a), high(b)}, SurfaceClass::wall);
        face({low(a), high(b), low(b)}, SurfaceClass::wall);
        ++primitive_;
      }
      start += size;
    }
  }

 private:
  void face(const Corners& corners, SurfaceClass surface) {
    mesh_.triangles.push_back(corners);
    mesh_.classes.push_back(surface);
    mesh_.storeys.push_back(storey_);
    mesh_.primitives.push_back(primitive_);
  }
  Mesh& mesh_;
  std::int32_t storey_ = 0, primitive_ = 0;
};

void check_ring(const PlanRing& ring, std::int32_t storey) {
  if (ring.size() < 3)
    throw Error(fmt::format("a room of storey {} has {} corners", storey, ring.size()), "a room has three at least");
  for (const auto& p : ring)
    if (!p.allFinite()) throw Error(fmt::format("a corner of a room of storey {} is not finite", storey));
}

// Outline counter-clockwise, holes clockwise, whatever they were.
PlanPolygon oriented(PlanPolygon polygon) {
  const auto area = [](const PlanRing& ring) { return PlanPolygon{ring, {}}.area(); };
  if (area(polygon.outline) < 0) std::reverse(polygon.outline.begin(), polygon.outline.end());
  for (auto& hole : polygon.holes)
    if (area(hole) > 0) std::reverse(hole.begin(), hole.end());
  return polygon;
}

// The plan with the rooms' heights filled in; floors become rooms where there are none. `heights`: none, one for all,
// or one per storey.
FloorPlan completed(const FloorPlan& plan, const std::vector<StoreyHeights>& heights, double height) {
  FloorPlan result = plan;
  std::size_t count = 0;
  for (std::size_t k = 0; k < result.storeys.size(); ++k) {
    auto& storey = result.storeys[k];
    if (storey.rooms.empty())
      for (const auto& floor : storey.floors) storey.rooms.push_back({"", floor, 0});
    double usual = storey.height > 0 ? storey.height : height;
    if (!(storey.height > 0) && !heights.empty()) {
      const StoreyHeights& own = heights.size() == result.storeys.size() ? heights[k] : heights.front();
      usual = own.ceiling - own.floor;
      if (heights.size() == result.storeys.size()) storey.elevation = own.floor;
    }
    for (auto& room : storey.rooms) {
      check_ring(room.polygon.outline, storey.index);
      for (const auto& hole : room.polygon.holes) check_ring(hole, storey.index);
      room.polygon = oriented(room.polygon);
      if (!(room.height > 0)) room.height = usual;
      ++count;
    }
    if (!(storey.height > 0)) storey.height = usual;
  }
  if (count == 0) throw Error("the plan has neither rooms nor floors", "give one with the corners of its rooms");
  return result;
}

// The cloud's storeys, lowest first; points of one only if there are several.
std::vector<Cloud> storeys_of(const Cloud& cloud, std::vector<double> bounds) {
  constexpr double beyond = std::numeric_limits<double>::infinity();
  bounds.insert(bounds.begin(), -beyond);
  bounds.push_back(beyond);
  std::vector<Cloud> storeys;
  for (std::size_t k = 0; k + 1 < bounds.size(); ++k)
    storeys.push_back(between_heights(cloud, bounds[k], bounds[k + 1]));
  return storeys;
}

std::vector<StoreyHeights> heights_of(const Cloud& cloud, const FloorPlan& plan, double percentile, Context& context) {
  const auto bounds = storey_bounds(cloud);
  std::vector<StoreyHeights> heights;
  if (bounds.size() + 1 == plan.storeys.size()) {
    for (const auto& storey : storeys_of(cloud, bounds)) heights.push_back(storey_heights(storey, percentile));
  } else {
    heights.push_back(storey_heights(cloud, percentile));
    const bool needed =
        std::any_of(plan.storeys.begin(), plan.storeys.end(), [](const auto& s) { return !(s.height > 0); });
    if (needed)
      context.warn(
          fmt::format("the plan has {}, the cloud shows {}: heights that the plan does not know are "
                      "those of all of the cloud",
                      counted(plan.storeys.size(), "storey"), bounds.size() + 1));
  }
  for (auto& h : heights) {
    const double shift = cloud.origin.z() - plan.origin.z();
    h.floor += shift;
    h.ceiling += shift;
  }
  return heights;
}

PlanStorey drawn_storey(const Cloud& cloud, const ExtrudedPlan::Params& params, const Context& context) {
  const DensityLimits limits{params.percentile,    params.pixel,     params.closing,    params.min_coverage,
                             params.min_room_area, params.tolerance, params.snap_angle, params.reach};
  const StoreyHeights heights = storey_heights(cloud, params.percentile);
  PlanStorey storey;
  storey.elevation = heights.floor;
  storey.height = heights.ceiling - heights.floor;
  storey.rooms = density_rooms(cloud, heights, limits, context);
  return storey;
}

FloorPlan drawn_plan(const Cloud& cloud, const ExtrudedPlan::Params& params, const Context& context) {
  FloorPlan plan;
  plan.origin = cloud.origin;
  const auto bounds = storey_bounds(cloud);
  if (bounds.empty()) {
    plan.storeys.push_back(drawn_storey(cloud, params, context));
  } else {
    for (const auto& storey : storeys_of(cloud, bounds)) plan.storeys.push_back(drawn_storey(storey, params, context));
  }
  std::size_t rooms = 0;
  for (std::size_t k = 0; k < plan.storeys.size(); ++k) {
    plan.storeys[k].index = static_cast<std::int32_t>(k);
    rooms += plan.storeys[k].rooms.size();
  }
  if (rooms == 0)
    throw Error("the cloud shows no room",
                "a ceiling must have been seen; 'closing' and 'pixel' may be too small for it");
  return plan;
}

}  // namespace

ExtrudedPlan::Out ExtrudedPlan::run(const In& in, const Params& params, Context& context) {
  if (!in.plan && !in.cloud)
    throw Error("there is neither a plan nor a cloud", "wire 'plan' (io.read_layout reads one) or 'cloud'");
  Out out;
  if (in.plan) {
    std::vector<StoreyHeights> heights;
    if (in.cloud) heights = heights_of(*in.cloud, *in.plan, params.percentile, context);
    out.plan = completed(*in.plan, heights, params.height);
  } else {
    out.plan = drawn_plan(*in.cloud, params, context);
  }
  out.mesh.origin = out.plan.origin;
  Extrusion extrusion(out.mesh);
  for (const auto& storey : out.plan.storeys)
    for (const auto& room : storey.rooms)
      extrusion.add(room.polygon, storey.elevation, storey.elevation + room.height, storey.index);
  return out;
}

}  // namespace atrium::baseline
