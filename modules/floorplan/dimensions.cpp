#include "modules/floorplan/dimensions.hpp"

#include <algorithm>
#include <cmath>

#include "modules/floorplan/drawn_openings.hpp"
#include "modules/floorplan/wall_pieces.hpp"

namespace atrium::floorplan {
namespace {

constexpr double same_stop = 0.025;      // metres: wall faces nearer than this get one stop
constexpr double axis_tolerance = 0.05;  // sin 3°
constexpr double behind_facade = 0.50;   // metres: walls that begin further behind another one are not seen
constexpr double shortest = 0.30;        // metres: shorter pieces of wall get no stop

// Millimetres of paper.
constexpr double digits = 2.0, first_line = 9, line_step = 8, row = 2.9, above = 1.7, below = 2.3;

// A wall's face as seen from one side: `at` along the side, from depth `near` to `far` away from it.
struct Edge {
  double at, near, far;
};
struct View {
  std::vector<Edge> across;  // faces that run away from the side
  std::vector<Edge> along;   // faces that run along it: at is their depth, near to far their extent
};

// Coordinates of a side: x along it, y the depth seen from outside.
Eigen::Vector2d seen_from(Side side, const Eigen::Vector2d& p) {
  switch (side) {
    case Side::bottom: return {p.x(), p.y()};
    case Side::top: return {p.x(), -p.y()};
    case Side::left: return {p.y(), p.x()};
    default: return {p.y(), -p.x()};
  }
}

void add_face(View& view, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d d = b - a;
  if (std::abs(d.x()) <= axis_tolerance * d.norm())
    view.across.push_back({a.y() < b.y() ? a.x() : b.x(), std::min(a.y(), b.y()), std::max(a.y(), b.y())});
  else if (std::abs(d.x()) > std::abs(d.y()))
    view.along.push_back({0.5 * (a.y() + b.y()), std::min(a.x(), b.x()), std::max(a.x(), b.x())});
}

// Pieces of one line that touch each other are one.
void merge(std::vector<Edge>& edges) {
  constexpr double same = 0.001;  // metres
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return a.at != b.at ? a.at < b.at : a.near != b.near ? a.near < b.near : a.far < b.far;
  });
  std::vector<Edge> merged;
  for (const auto& edge : edges) {
    const auto touching = std::find_if(merged.rbegin(), merged.rend(), [&](const Edge& other) {
      return edge.at - other.at < same && edge.near < other.far + same && other.near < edge.far + same;
    });
    if (touching == merged.rend()) {
      merged.push_back(edge);
    } else {
      touching->near = std::min(touching->near, edge.near);
      touching->far = std::max(touching->far, edge.far);
    }
  }
  edges = std::move(merged);
}

View view_from(Side side, const PlanStorey& storey, bool inferred = true) {
  View view;
  const auto face = [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    add_face(view, seen_from(side, a), seen_from(side, b));
  };
  // Over its doors and windows a wall goes on.
  for (const auto& opening : storey.openings) {
    if (opening.kind == "slab" || !(opening.width() > 0)) continue;
    const PlanRing gap = gap_of(opening, 0);
    face(gap[0], gap[1]);
    if (opening.thickness > 0) face(gap[2], gap[3]);
  }
  for (const auto& wall : storey.walls) {
    if (wall.inferred && !inferred) continue;
    if (wall.outline.empty()) {
      face(wall.from, wall.to);
    } else {
      face(wall.outline[0], wall.outline[1]);
      face(wall.outline[2], wall.outline[3]);
    }
  }
  merge(view.across);
  merge(view.along);
  std::erase_if(view.across, [](const Edge& edge) { return edge.far - edge.near < shortest; });
  return view;
}

// Where faces across the side were seen, and the ends of doors and windows, which always were.
std::vector<double> seen_stops(Side side, const PlanStorey& storey) {
  std::vector<double> stops;
  for (const auto& edge : view_from(side, storey, false).across) stops.push_back(edge.at);
  for (const auto& opening : storey.openings)
    if (opening.kind != "slab") {
      stops.push_back(seen_from(side, opening.from).x());
      stops.push_back(seen_from(side, opening.to).x());
    }
  return stops;
}

std::vector<double> distinct(std::vector<double> stops) {
  std::sort(stops.begin(), stops.end());
  std::vector<double> result;
  for (const double stop : stops)
    if (result.empty() || stop - result.back() > same_stop) result.push_back(stop);
  return result;
}

// From the first to the last face across the side, seen or not.
std::vector<double> whole_of(Side side, const PlanStorey& storey, double low, double high) {
  std::vector<double> stops;
  for (const auto& edge : view_from(side, storey).across) stops.push_back(edge.at);
  stops = distinct(std::move(stops));
  return stops.size() > 1 ? std::vector{stops.front(), stops.back()} : distinct({low, high});
}

std::vector<double> stops_of(Side side, const PlanStorey& storey) {
  const View view = view_from(side, storey);
  std::vector<double> stops;
  for (const auto& edge : view.across) {
    const bool hidden = std::any_of(view.along.begin(), view.along.end(), [&](const Edge& wall) {
      return wall.at < edge.near - behind_facade && wall.near < edge.at - same_stop && wall.far > edge.at + same_stop;
    });
    if (!hidden) stops.push_back(edge.at);
  }
  return distinct(std::move(stops));
}

// The ends of the doors and windows in the facades that look to this side, between those of the whole.
std::vector<double> facade_openings(Side side, const PlanStorey& storey, const std::vector<double>& whole) {
  const View view = view_from(side, storey);
  std::vector<double> stops;
  for (const auto& opening : storey.openings) {
    if (opening.kind == "slab" || (opening.room_a >= 0) == (opening.room_b >= 0)) continue;
    Eigen::Vector2d a = seen_from(side, opening.from), b = seen_from(side, opening.to);
    if (opening.room_a < 0) std::swap(a, b);  // the room is now on the left in the plan
    const bool mirrored = side == Side::top || side == Side::left;
    if (std::abs(b.y() - a.y()) > axis_tolerance * (b - a).norm() || (b.x() > a.x()) == mirrored) continue;
    const double low = std::min(a.x(), b.x()), high = std::max(a.x(), b.x());
    const bool hidden = std::any_of(view.along.begin(), view.along.end(), [&](const Edge& wall) {
      return wall.at < a.y() - behind_facade && wall.near < high - same_stop && wall.far > low + same_stop;
    });
    if (!hidden) stops.insert(stops.end(), {low, high});
  }
  if (stops.empty()) return stops;
  stops.insert(stops.end(), {whole.front(), whole.back()});
  return distinct(std::move(stops));
}

bool adds_to(const std::vector<double>& stops, const std::vector<double>& known) {
  return std::any_of(stops.begin(), stops.end(), [&](double stop) {
    return std::none_of(known.begin(), known.end(), [&](double k) { return std::abs(k - stop) <= same_stop; });
  });
}

struct Box {
  double from, to;
  int row;
};

// How lengths are written, and how large.
struct Measure {
  double mm;
  Units units;
  bool plain;
  std::vector<double> seen;  // stops that are not inferred

  bool is_seen(double stop) const {
    return std::any_of(seen.begin(), seen.end(), [&](double other) { return std::abs(other - stop) <= same_stop; });
  }
};

// Texts stand above the line where they fit between their stops, else in the nearest free row outside of it.
void add_labels(DimensionChain& chain, const Measure& measure) {
  const double mm = measure.mm;
  std::vector<Box> taken;
  const double gap = 0.6 * mm;
  // "Above" is to the left of a text that runs upwards.
  const double upwards = chain.upright() ? -1 : 1;
  const bool above_is_outside = upwards == chain.outwards();
  for (const bool wide : {true, false})
    for (std::size_t i = 1; i < chain.stops.size(); ++i) {
      const double a = chain.stops[i - 1], b = chain.stops[i];
      const bool inferred = !measure.is_seen(a) || !measure.is_seen(b);
      const std::string length = dimension_text(b - a, measure.units, measure.plain);
      const std::string text = inferred ? "(" + length + ")" : length;
      const double half = 0.5 * text_width(text, digits * mm), middle = 0.5 * (a + b);
      if ((2 * half + 2 * gap <= b - a) != wide) continue;
      Box box{middle - half, middle + half, wide ? 0 : 1};
      const auto free = [&] {
        return std::none_of(taken.begin(), taken.end(), [&](const Box& other) {
          return other.row == box.row && other.from < box.to + gap && box.from < other.to + gap;
        });
      };
      while (!wide && !free()) ++box.row;
      taken.push_back(box);
      const double outside = above_is_outside ? above + box.row * row : below + (box.row - 1) * row;
      const double aside = box.row == 0 ? upwards * above : chain.outwards() * outside;
      if (box.row > 0) chain.depth = std::max(chain.depth, (outside + digits) * mm);
      chain.labels.push_back(
          {chain.at(middle, chain.line + aside * mm), chain.upright(), digits * mm, text, a, b, box.row > 0, inferred});
    }
}

DimensionChain chain_of(Side side, const Bounds2& box, std::vector<double> stops, double offset,
                        const Measure& measure) {
  const double mm = measure.mm;
  DimensionChain chain;
  chain.side = side;
  chain.stops = std::move(stops);
  const Eigen::Vector2d& corner = chain.outwards() > 0 ? box.high : box.low;
  const double edge = chain.upright() ? corner.x() : corner.y();
  chain.from_building = edge + chain.outwards() * 2 * mm;
  chain.line = edge + chain.outwards() * offset;
  add_labels(chain, measure);
  return chain;
}

}  // namespace

double text_width(const std::string& text, double height) {
  double width = 0;  // in units of the height of its digits
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    if ((c & 0xC0U) == 0x80U) continue;                                   // not the first byte of a character
    const bool prime = c == 0xE2 && text.compare(i, 2, "\xE2\x80") == 0;  // of feet and inches
    width += c == '.' || c == ' ' || c == 'i' || c == 'l' || c == '\'' || c == '"' || prime ? 0.45
             : c == 0xC2                                                                    ? 1.3
                                                                                            : 0.9;  // ½ is wide
  }
  return width * height;
}

std::vector<DimensionChain> dimensions_of(const PlanStorey& storey, double mm, Units units, bool plain) {
  Measure measure{mm, units, plain, {}};
  const Bounds2 box = bounds(storey), walls = wall_bounds(storey);
  std::vector<DimensionChain> chains;
  if (walls.empty()) return chains;
  const std::vector<double> bottom = stops_of(Side::bottom, storey), left = stops_of(Side::left, storey);
  // Chains of a side one outside of the other. With one of openings, which has many texts, the extension lines of those
  // outside of it begin beyond it.
  const auto stack = [&](Side side, const std::vector<double>& openings,
                         std::initializer_list<std::vector<double>> rows) {
    double offset = first_line * mm;
    measure.seen = seen_stops(side, storey);
    const auto add_row = [&](const std::vector<double>& stops) {
      if (stops.size() < 2) return;
      chains.push_back(chain_of(side, box, stops, offset, measure));
      if (!openings.empty() && offset > first_line * mm)
        chains.back().from_building = chains.back().line - chains.back().outwards() * 2 * mm;
      offset += std::max(line_step * mm, chains.back().depth + 2 * above * mm);
    };
    add_row(openings);
    for (const auto& stops : rows) add_row(stops);
  };
  const auto add = [&](Side side, const std::vector<double>& stops, double low, double high) {
    const std::vector<double> whole = whole_of(side, storey, low, high);
    const bool more = stops.size() > 2 || (stops.size() == 2 && adds_to(stops, whole));
    stack(side, facade_openings(side, storey, whole),
          {more ? stops : std::vector<double>{}, whole.size() == 2 ? whole : std::vector<double>{}});
  };
  add(Side::bottom, bottom, walls.low.x(), walls.high.x());
  add(Side::left, left, walls.low.y(), walls.high.y());
  const auto opposite = [&](Side side, const std::vector<double>& known, double low, double high) {
    const auto stops = stops_of(side, storey);
    stack(side, facade_openings(side, storey, whole_of(side, storey, low, high)),
          {stops.size() > 1 && adds_to(stops, known) ? stops : std::vector<double>{}});
  };
  std::vector<double> known = bottom;
  known.insert(known.end(), {walls.low.x(), walls.high.x()});
  opposite(Side::top, known, walls.low.x(), walls.high.x());
  known = left;
  known.insert(known.end(), {walls.low.y(), walls.high.y()});
  opposite(Side::right, known, walls.low.y(), walls.high.y());
  return chains;
}

}  // namespace atrium::floorplan
