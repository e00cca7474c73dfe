#include "modules/layout/openings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "graph/api/text.hpp"
#include "modules/layout/blank_gaps.hpp"
#include "modules/layout/closed_leaves.hpp"
#include "modules/layout/opening_pairs.hpp"
#include "modules/layout/wall_pairs.hpp"
#include "modules/types/building_rules.hpp"

namespace atrium::layout {
namespace {

/// "3 ‹what› (the largest is 1.60 m wide and 1.20 m high)"
std::string told(const std::vector<BlankGap>& gaps, std::string_view what) {
  const auto largest = std::max_element(gaps.begin(), gaps.end(), [](const BlankGap& a, const BlankGap& b) {
    return a.hole.box.volume() < b.hole.box.volume();
  });
  return fmt::format("{} {} (the largest is {:.2f} m wide and {:.2f} m high)", gaps.size(), what,
                     largest->hole.box.sizes().x(), largest->hole.box.sizes().y());
}

/// Gaps that are windows become holes; of both kinds the user is told.
void take_blank_windows(std::vector<BlankGap> gaps, Found& found, const Context& context) {
  const auto closed = std::stable_partition(gaps.begin(), gaps.end(), [](const BlankGap& gap) { return gap.window; });
  const std::vector<BlankGap> left(closed, gaps.end());
  gaps.erase(closed, gaps.end());
  for (const auto& gap : gaps) found[gap.face].push_back(gap.hole);
  if (!gaps.empty())
    context.warn(told(gaps, "windows show nothing behind them, only a clean rim: screens and mirrors look alike"));
  if (!left.empty())
    context.warn(told(left,
                      "gaps in walls have the size of windows, but nothing was seen behind them: they are left "
                      "closed"));
}

using Leaves = std::vector<std::vector<ClosedLeaf>>;  // per face

Eigen::AlignedBox2d box_of(const FaceHole& hole, const PlaneFrame& frame) {
  Eigen::AlignedBox2d box;
  for (const auto& p : outline_of(hole)) box.extend(frame.to_plane(p));
  return box;
}

/// The confidence of a leaf that shows on the other side of its wall, too, if it does.
double with_twin(const ClosedLeaf& leaf, const FaceEvidence& behind, const std::vector<ClosedLeaf>& leaves) {
  double confidence = leaf.confidence;
  for (const auto& other : leaves)
    if (other.hole.kind == leaf.hole.kind && other.hole.box.intersects(box_of(leaf.hole, behind.frame)))
      confidence = std::max(confidence, 1 - (1 - leaf.confidence) * (1 - other.confidence));
  return confidence;
}

/// Whether the other side of a wall was seen where a leaf stands, and is whole: what stands off the wall is no door.
bool is_whole_behind(const FaceHole& leaf, const FaceEvidence& behind, const std::vector<FaceHole>& holes,
                     const std::vector<ClosedLeaf>& leaves) {
  constexpr double square = 0.15, whole = 0.7;  // metres; share of squares
  if (!behind.looked_at()) return false;
  const Eigen::AlignedBox2d box = box_of(leaf, behind.frame);
  const auto overlaps = [&](const FaceHole& other) { return other.box.intersects(box); };
  if (std::any_of(holes.begin(), holes.end(), overlaps) ||
      std::any_of(leaves.begin(), leaves.end(), [&](const ClosedLeaf& other) { return overlaps(other.hole); }))
    return false;
  // Share of squares with points: how dense they are says nothing.
  const Eigen::Vector2d squares = (box.sizes() / square).array().floor().max(1).matrix();
  std::vector<bool> seen(static_cast<std::size_t>(squares.x() * squares.y()), false);
  for (const auto& p : behind.on) {
    if (!box.contains(p)) continue;
    const Eigen::Vector2d at =
        (p - box.min()).cwiseQuotient(box.sizes()).cwiseProduct(squares).array().floor().matrix();
    const Eigen::Vector2d place = at.cwiseMin(squares - Eigen::Vector2d::Ones());
    seen[static_cast<std::size_t>(place.y() * squares.x() + place.x())] = true;
  }
  return static_cast<double>(std::count(seen.begin(), seen.end(), true)) >= whole * squares.prod();
}

/// Whether what is left of the wall behind a leaf is as thick as leaves are: seen from the room that it opens into, a
/// leaf lies in the face of its wall. Niches are not cut so deep.
bool is_flush_behind(const ClosedLeaf& leaf, const BuildingFace& face, const FaceEvidence& behind) {
  constexpr double thinnest = 0.02, thickest = 0.07, sure = 0.7;  // metres; confidence
  const double left = std::abs(face.plane.signed_distance(behind.frame.origin)) - leaf.step;
  return leaf.hole.kind == "door" && leaf.confidence >= sure && left >= thinnest && left <= thickest;
}

/// Leaves become doors, panes windows, where no hole is one already; holes that are a part of a leaf go. Those that are
/// not clean are told of, or left closed.
void take_leaves(const Building& building, const Evidence& evidence, const Leaves& leaves, Found& found,
                 const Context& context) {
  constexpr double least = 0.5, certain = 0.7, larger = 1.2;  // confidence; volumes
  std::size_t doors = 0, windows = 0, unsure = 0, left = 0;
  const auto behind = opposite_faces(building);
  for (std::size_t f = 0; f < leaves.size(); ++f)
    for (const auto& leaf : leaves[f]) {
      auto& holes = found[f];
      const bool window = leaf.hole.kind == "window";
      const auto overlaps = [&](const FaceHole& hole) { return hole.box.intersects(leaf.hole.box); };
      const auto stays = [&](const FaceHole& hole) {
        return overlaps(hole) && (window || hole.box.volume() > larger * leaf.hole.box.volume() ||
                                  (hole.kind == "door" && leaf.confidence < certain));
      };
      // A wall between two rooms has niches rather than blinds.
      if (std::any_of(holes.begin(), holes.end(), stays) || (window && !behind[f].empty())) continue;
      double confidence = leaf.confidence;
      for (const auto b : behind[f]) confidence = std::max(confidence, with_twin(leaf, evidence[b], leaves[b]));
      const Eigen::Vector2d size = leaf.hole.box.sizes();
      context.info(fmt::format("face {}: a closed {} of {:.2f} x {:.2f} m, {:.1f} cm {} its wall, confidence {:.2f}", f,
                               leaf.hole.kind, size.x(), size.y(), 100 * std::abs(leaf.step),
                               leaf.step > 0 ? "behind" : "before", confidence));
      const bool whole = std::any_of(behind[f].begin(), behind[f].end(), [&](std::size_t b) {
        return is_whole_behind(leaf.hole, evidence[b], found[b], leaves[b]) &&
               !is_flush_behind(leaf, building.faces[f], evidence[b]);
      });
      if (whole || confidence < least) {
        left += window ? 0 : 1;
        continue;
      }
      ++(window ? windows : doors);
      unsure += !window && confidence < certain ? 1 : 0;
      std::erase_if(holes, overlaps);
      holes.push_back(leaf.hole);
    }
  if (doors > 0) context.info(fmt::format("{} leaves of closed doors", doors));
  if (windows > 0)
    context.warn(
        fmt::format("windows seen as a step in their wall alone, as panes behind blinds and niches are: {}", windows));
  if (unsure > 0)
    context.warn(fmt::format("closed doors that may be panels, niches or fronts of cupboards: {}", unsure));
  if (left > 0)
    context.warn(
        fmt::format("what may be closed doors, but has no clean rim, or stands in a wall that is whole on its other "
                    "side, is left closed: {}",
                    left));
}

struct HeightRange {
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
  void add(double z) {
    low = std::min(low, z);
    high = std::max(high, z);
  }
};

double height_of(const BuildingOpening& opening) {
  HeightRange range;
  for (const auto& corner : opening.outline_a) range.add(corner.z());
  return range.high - range.low;
}
double width_of(const BuildingOpening& opening) { return (opening.outline_a[1] - opening.outline_a[0]).norm(); }

/// Which openings are doors or windows by their size only.
void warn_of_doubtful(const JoinedOpenings& all, const Context& context) {
  if (all.blank_doors + all.blank_windows > 0)
    context.warn(fmt::format(
        "openings down to the floor show neither a leaf nor a floor behind them: by their size {} are taken "
        "for doors, {} for windows",
        all.blank_doors, all.blank_windows));
  if (all.hidden_feet > 0)
    context.warn(fmt::format("windows may be doors, as the wall below them is hidden: {}", all.hidden_feet));
  if (all.only_doors > 0)
    context.warn(fmt::format(
        "openings of which the wall below is hidden are taken for doors, as no other leads into their rooms: {}",
        all.only_doors));
}

/// Doors that are too low have upper parts that are hidden, or they are none if they are narrow or hardly higher than
/// furniture: left out, as others have been.
void judge_low_doors(Building& building, double least_height, std::size_t left_out, Context& context) {
  constexpr double least_width = 0.6, over_furniture = 1;  // metres; of a door whose upper part may be hidden
  std::size_t low = 0;
  double lowest = least_height;
  left_out += std::erase_if(building.openings, [&](const BuildingOpening& opening) {
    if (opening.kind != "door" || height_of(opening) >= least_height) return false;
    if (width_of(opening) < least_width || height_of(opening) < over_furniture) return true;
    ++low;
    lowest = std::min(lowest, height_of(opening));
    return false;
  });
  if (left_out > 0)
    context.warn(
        fmt::format("holes in walls down to a floor are left closed, as they are too small for doors: {}", left_out));
  if (low > 0)
    context.warn(fmt::format("{} than {:.2f} m, the lowest {:.2f} m: upper parts may be hidden",
                             counted(low, "door is lower", "doors are lower"), least_height, lowest));
}

/// Whether the opening would be a door if the building stood on its head: it hangs from the ceiling, is as high as a
/// door and ends well above the floor.
bool is_hanging_door(const Building& building, const BuildingOpening& opening) {
  constexpr double at_ceiling = 0.12, off_floor = 0.25, lowest = 1.8, highest = 2.3;  // metres
  if (opening.kind != "window") return false;
  HeightRange hole, wall;
  for (const auto& corner : opening.outline_a) hole.add(corner.z());
  for (const auto v : building.faces[static_cast<std::size_t>(opening.face_a)].outline)
    wall.add(building.vertices[v].z());
  const double height = height_of(opening);
  return wall.high - hole.high < at_ceiling && hole.low - wall.low > off_floor && height > lowest && height < highest;
}

/// Nothing else than its doors shows that an empty flat stands on its head.
void warn_of_hanging_doors(const Building& building, const Context& context) {
  const auto& all = building.openings;
  const bool stands = std::any_of(all.begin(), all.end(), [](const BuildingOpening& opening) {
    return opening.kind == "door" || opening.kind == "passage";
  });
  const auto hanging = std::count_if(
      all.begin(), all.end(), [&](const BuildingOpening& opening) { return is_hanging_door(building, opening); });
  if (!stands && hanging > 0)
    context.warn(
        fmt::format("no door stands on a floor, but {} from the ceiling as doors would if the scan "
                    "stood on its head: if z points down, -s upright.up=[0,0,-1]",
                    counted(static_cast<std::size_t>(hanging), "opening hangs", "openings hang")));
}

}  // namespace

Openings::Out Openings::run(const In& in, const Params& params, Context& context) {
  check(*in.building);
  const Cloud& cloud = *in.structure->primitives->cloud;
  Building building = with_origin(*in.building, cloud.origin);
  building.openings.clear();
  building.walls = wall_pairs(building, params.max_thickness);
  const EvidenceFinder finder(building, cloud, params);
  const auto for_each_face = [&](const auto& work) {
    context.parallel_for(
        building.faces.size(),
        [&](std::size_t begin, std::size_t end) {
          for (std::size_t f = begin; f < end; ++f) {
            context.check_cancelled();
            work(f);
          }
        },
        1);
  };
  Evidence evidence(building.faces.size());
  Leaves leaves(building.faces.size());
  for_each_face([&](std::size_t f) {
    evidence[f] = finder.gather(f);
    leaves[f] = closed_leaves(building.faces[f], evidence[f]);
    std::vector<Eigen::Vector3f>().swap(evidence[f].near);
  });
  take_solid_from_behind(building, evidence);
  for_each_face([&](std::size_t f) { finder.look_through(f, evidence[f]); });
  take_holes_from_behind(building, evidence);
  std::vector<FaceMask> masks;
  for (const auto& e : evidence) masks.push_back(e.mask);
  Found found(building.faces.size());
  for_each_face([&](std::size_t f) { found[f] = face_holes(building.faces[f], evidence[f], params); });
  take_leaves(building, evidence, leaves, found, context);
  take_blank_windows(blank_gaps(building, cloud, masks, evidence, found, params), found, context);
  std::size_t doubtful = 0;
  for (auto& holes : found) doubtful += std::erase_if(holes, [](const FaceHole& hole) { return hole.doubtful; });
  JoinedOpenings all = joined(building, found, params);
  building.openings = std::move(all.openings);
  warn_of_doubtful(all, context);
  judge_low_doors(building, params.min_door_height, all.low_blanks, context);
  const auto count = [&](std::string_view kind, std::string_view called) {
    const auto of_kind = std::count_if(building.openings.begin(), building.openings.end(),
                                       [&](const auto& opening) { return opening.kind == kind; });
    return counted(static_cast<std::size_t>(of_kind), called);
  };
  context.info(fmt::format("{}, {}, {}, {}; {} seen from both sides", count("door", "door"),
                           count("passage", "passage"), count("window", "window"), count("slab", "slab opening"),
                           counted(building.walls.size(), "wall")));
  warn_of_hanging_doors(building, context);
  if (doubtful > 0)
    context.info(fmt::format("{} left out: too little of the faces around was seen", counted(doubtful, "opening")));
  Building relative;  // the openings alone, to the building's own origin
  relative.origin = building.origin;
  relative.openings = std::move(building.openings);
  Out out{*in.building};
  out.building.walls = std::move(building.walls);
  out.building.openings = with_origin(std::move(relative), out.building.origin).openings;
  return out;
}

}  // namespace atrium::layout
