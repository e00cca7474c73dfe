#include "modules/baseline/extruded_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "modules/baseline/density_plan.hpp"
#include "modules/baseline/ear_clipping.hpp"

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

// The plan with the rooms' heights filled in; floors become rooms where there are none.
FloorPlan completed(const FloorPlan& plan, const std::optional<StoreyHeights>& heights, double height) {
  FloorPlan result = plan;
  std::size_t count = 0;
  for (auto& storey : result.storeys) {
    if (storey.rooms.empty())
      for (const auto& floor : storey.floors) storey.rooms.push_back({"", floor, 0});
    double usual = storey.height > 0 ? storey.height : height;
    if (!(storey.height > 0) && heights) {
      usual = heights->ceiling - heights->floor;
      if (result.storeys.size() == 1) storey.elevation = heights->floor;
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

std::optional<StoreyHeights> heights_of(const ExtrudedPlan::In& in, double percentile) {
  if (!in.cloud) return {};
  StoreyHeights heights = storey_heights(*in.cloud, percentile);
  if (in.plan) {
    const double shift = in.cloud->origin.z() - in.plan->origin.z();
    heights.floor += shift;
    heights.ceiling += shift;
  }
  return heights;
}

FloorPlan drawn_plan(const Cloud& cloud, const StoreyHeights& heights, const ExtrudedPlan::Params& params,
                     const Context& context) {
  const DensityLimits limits{params.percentile,    params.pixel,     params.closing,    params.min_coverage,
                             params.min_room_area, params.tolerance, params.snap_angle, params.reach};
  FloorPlan plan;
  plan.origin = cloud.origin;
  plan.storeys.resize(1);
  plan.storeys[0].elevation = heights.floor;
  plan.storeys[0].height = heights.ceiling - heights.floor;
  plan.storeys[0].rooms = density_rooms(cloud, heights, limits, context);
  if (plan.storeys[0].rooms.empty())
    throw Error("the cloud shows no room",
                "a ceiling must have been seen; 'closing' and 'pixel' may be too small for it");
  return plan;
}

}  // namespace

ExtrudedPlan::Out ExtrudedPlan::run(const In& in, const Params& params, Context& context) {
  if (!in.plan && !in.cloud)
    throw Error("there is neither a plan nor a cloud", "wire 'plan' (io.read_layout reads one) or 'cloud'");
  const auto heights = heights_of(in, params.percentile);
  Out out;
  out.plan = in.plan ? completed(*in.plan, heights, params.height) : drawn_plan(*in.cloud, *heights, params, context);
  out.mesh.origin = out.plan.origin;
  Extrusion extrusion(out.mesh);
  for (const auto& storey : out.plan.storeys)
    for (const auto& room : storey.rooms)
      extrusion.add(room.polygon, storey.elevation, storey.elevation + room.height, storey.index);
  return out;
}

}  // namespace atrium::baseline
