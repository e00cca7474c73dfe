#include "modules/io/unit_guess.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "modules/geometry/quantile.hpp"
#include "modules/geometry/upright_evidence.hpp"

namespace atrium::io {
namespace {

struct Unit {
  const char* name;
  const char* setting;
  double metres;
  double usual;  ///< share of files
};
constexpr std::array<Unit, 5> units{{{"metres", "m", 1.0, 0.90},
                                     {"millimetres", "mm", 0.001, 0.04},
                                     {"feet", "ft", 0.3048, 0.025},
                                     {"centimetres", "cm", 0.01, 0.02},
                                     {"inches", "in", 0.0254, 0.015}}};
struct Rated {
  Unit unit;
  double score = 0, height = 0, things = 0;  ///< things: what speaks for furniture and doors
  int furniture = 0, doors = 0;
};

/// Nobody scans rooms that one cannot stand in.
bool is_too_low(const Rated& rated) { return rated.height > 0 && rated.height < 1.8; }

/// Coordinates along one axis of about `most` points, sorted.
std::vector<float> along(const std::vector<Eigen::Vector3f>& points, int axis, std::size_t most) {
  std::vector<float> values;
  const std::size_t step = std::max<std::size_t>(1, points.size() / most);
  for (std::size_t i = 0; i < points.size(); i += step) values.push_back(points[i][axis]);
  return values;
}

/// The distance between the two largest layers of points along an axis that are at least 1.8 apart, layers of 10 cm: of
/// a room in metres the clear height. 0: there are no two of like size, or the extent is not one of rooms in metres.
double clear_height(const std::vector<float>& heights) {
  constexpr double shortest = 1.9, longest = 80, layer = 0.1, apart = 1.8, alike = 0.4, least = 0.06;
  const auto low = static_cast<double>(quantile(heights, 0.002)), high = static_cast<double>(quantile(heights, 0.998));
  if (high - low < shortest || high - low > longest) return 0;
  const auto bins = static_cast<std::size_t>((high - low + 1) / (layer / 2)) + 3;
  std::vector<double> count(bins, 0);
  for (const float h : heights) {
    const double bin = (static_cast<double>(h) - low + 0.5) / (layer / 2);
    if (bin >= 0 && bin < static_cast<double>(bins)) ++count[static_cast<std::size_t>(bin)];
  }
  const auto largest = [&](std::size_t away, std::size_t from) {
    std::size_t best = bins;
    for (std::size_t i = 0; i + 1 < bins; ++i)
      if ((from == bins || std::max(i, from) - std::min(i, from) >= away) &&
          (best == bins || count[i] + count[i + 1] > count[best] + count[best + 1]))
        best = i;
    return best;
  };
  const std::size_t first = largest(0, bins);
  const std::size_t second = largest(static_cast<std::size_t>(apart / (layer / 2)), first);
  if (first == bins || second == bins) return 0;
  const double one = count[first] + count[first + 1], two = count[second] + count[second + 1];
  if (one < least * static_cast<double>(heights.size()) || two < alike * one) return 0;
  return std::abs(static_cast<double>(first) - static_cast<double>(second)) * layer / 2;
}

std::vector<FacedArea> faces_of(const std::vector<SurfacePiece>& pieces) {
  constexpr std::size_t most = 4000;
  std::vector<FacedArea> faces;
  const std::size_t step = std::max<std::size_t>(1, pieces.size() / most);
  for (std::size_t i = 0; i < pieces.size(); i += step)
    if (!pieces[i].normal.isZero()) faces.push_back({pieces[i].normal.cast<double>(), 1.0});
  return faces;
}

/// ln of how often files have their up here; see align.gravity, whose table this is.
double usual_up(const Eigen::Vector3d& up, bool y_up) {
  constexpr double along = 0.9659;  // cosine of 15 degrees
  if (up.z() > along) return std::log(y_up ? 0.36 : 0.87);
  if (up.y() > along) return std::log(y_up ? 0.60 : 0.09);
  if (up.cwiseAbs().maxCoeff() > along) return std::log(0.008);
  return std::log(0.002);
}

double log_extent(double metres) {
  const double z = std::log(metres / 10.0);
  return -0.5 * z * z;
}

Rated rate(const Unit& unit, double extent, const std::vector<SurfacePiece>& pieces,
           const std::vector<FacedArea>& faces, bool y_up, const Context& context) {
  Rated rated{unit, -1e300, 0, 0, 0, 0};
  constexpr double least = 0.8, most = 400;  // metres: what is less is no room, what is more no interior
  if (extent * unit.metres < least || extent * unit.metres > most) return rated;
  double best = -1e300;
  std::vector<double> scores;
  for (const auto& candidate : upright_candidates(pieces, faces, unit.metres, context)) {
    scores.push_back(candidate.evidence.sum() + usual_up(candidate.up, y_up));
    if (scores.back() <= best) continue;
    best = scores.back();
    rated.height = candidate.evidence.room_height;
    rated.things = candidate.evidence.furniture + candidate.evidence.doors;
    rated.furniture = candidate.evidence.furniture_seen;
    rated.doors = candidate.evidence.doors_seen;
  }
  double sum = 0;
  for (const double s : scores) sum += std::exp(s - best);
  rated.score = best + std::log(sum) + std::log(unit.usual) + log_extent(extent * unit.metres);
  return rated;
}

std::string shows(const Rated& r) {
  if (r.height <= 0) return "no floor and ceiling at the distance of a room's";
  return fmt::format("rooms {:.2f} m high, {} m² of furniture and {} m² of doors at usual heights", r.height,
                     r.furniture, r.doors);
}

}  // namespace

UnitGuess guess_unit(const std::vector<Eigen::Vector3f>& points, bool y_up, const Context& context) {
  constexpr std::size_t few = 500, sampled = 60000, some = 50000;
  if (points.size() < few) return {};
  std::array<std::vector<float>, 3> columns;
  double extent = 0;
  for (int k = 0; k < 3; ++k) {
    const auto& values = columns[static_cast<std::size_t>(k)] = along(points, k, some);
    const double low = static_cast<double>(quantile(values, 0.005)),
                 high = static_cast<double>(quantile(values, 0.995));
    extent = std::max(extent, high - low);
  }
  constexpr double lowest = 2.05, highest = 3.6;
  const double height = clear_height(columns[y_up ? 1 : 2]);
  if (height >= lowest && height <= highest)
    return {1, fmt::format(": layers {:.2f} m apart along {}", height, y_up ? 'y' : 'z'), {}};
  const std::vector<SurfacePiece> pieces = pieces_with_normals(points, sampled, context);
  const std::vector<FacedArea> faces = faces_of(pieces);
  std::vector<Rated> rated;
  rated.reserve(std::size(units));
  for (const auto& unit : units) rated.push_back(rate(unit, extent, pieces, faces, y_up, context));
  const Rated& metres = rated.front();
  const Rated* best = nullptr;
  for (const auto& r : rated)
    if (&r != &metres && !is_too_low(r) && (best == nullptr || r.score > best->score)) best = &r;
  if (best == nullptr || best->score < -1e299) return {};
  const double odds = std::exp(std::min(50.0, best->score - metres.score));
  // A hall is as high in metres as a room in feet: furniture or a door has to say which it is.
  constexpr double clear = 4.5, doubt = 0.1, certain = 100, highest_hall = 20, some_things = 0.8;
  const bool may_be_hall = metres.height < highest_hall && odds < certain;
  if (odds > clear && (!may_be_hall || best->things > std::max(0.0, metres.things) + some_things))
    return {best->unit.metres,
            {},
            fmt::format("taken to be in {} ({} in them); -s scan.unit=m forces metres", best->unit.name, shows(*best))};
  if (odds > doubt)
    return {1,
            {},
            fmt::format("taken to be in metres ({}), but {} are possible ({}): -s scan.unit={} forces these, and "
                        "-s scan.unit=m takes this warning away",
                        shows(metres), best->unit.name, shows(*best), best->unit.setting)};
  return {1, ": " + shows(metres), {}};
}

}  // namespace atrium::io
