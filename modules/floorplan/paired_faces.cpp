#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "modules/floorplan/wall_pieces.hpp"

namespace atrium::floorplan {
namespace {

struct Candidate {
  double thickness;
  std::size_t a, b;
  Span window;  // along face a
};

// Coordinates along b are turned round with respect to a; both are lines, nearly parallel.
Span window_on(const WallFace& target, const WallFace& source, const Span& span) {
  const double s = target.coordinate(source.at(span.from)), t = target.coordinate(source.at(span.to));
  return {std::min(s, t), std::max(s, t)};
}

// Distance of face b behind face a at coordinate s of a.
double behind(const WallFace& a, const WallFace& b, double s) {
  const Line across{a.at(s), a.normal}, face{b.point, b.along()};
  return -a.distance(meet(face, across));
}

std::vector<Candidate> candidates(const std::vector<WallFace>& faces, const WallLimits& limits) {
  const double opposite = -std::cos(limits.parallel_angle * std::numbers::pi / 180);
  std::vector<Candidate> result;
  for (std::size_t a = 0; a < faces.size(); ++a)
    for (std::size_t b = a + 1; b < faces.size(); ++b) {
      if (faces[a].normal.dot(faces[b].normal) > opposite) continue;
      for (const auto& span : faces[b].spans)
        for (const auto& window : overlap(faces[a].spans, window_on(faces[a], faces[b], span))) {
          const double thickness = behind(faces[a], faces[b], 0.5 * (window.from + window.to));
          if (thickness >= limits.min_thickness && thickness <= limits.max_thickness)
            result.push_back({thickness, a, b, window});
        }
    }
  std::sort(result.begin(), result.end(), [](const Candidate& l, const Candidate& r) {
    return std::tie(l.thickness, l.a, l.b, l.window.from) < std::tie(r.thickness, r.a, r.b, r.window.from);
  });
  return result;
}

WallPiece piece_of(const WallFace& a, const WallFace& b, const Span& span) {
  WallPiece piece;
  piece.left = {a.at(span.from), a.along()};
  piece.right = {b.at(0), -b.along()};
  const Line first{a.at(span.from), a.normal}, last{a.at(span.to), a.normal};
  piece.from = 0.5 * (first.point + meet(piece.right, first));
  piece.to = 0.5 * (last.point + meet(piece.right, last));
  piece.thickness = behind(a, b, 0.5 * (span.from + span.to));
  piece.start = first;
  piece.end = last;
  for (const auto primitive : {a.primitive, b.primitive})
    if (primitive >= 0) piece.primitives.push_back(primitive);
  return piece;
}

WallPiece piece_of(const WallFace& face, const Span& span) {
  WallPiece piece;
  piece.left = piece.right = {face.at(span.from), face.along()};
  piece.from = face.at(span.from);
  piece.to = face.at(span.to);
  piece.start = {piece.from, face.normal};
  piece.end = {piece.to, face.normal};
  if (face.backing > 0) {
    piece.thickness = face.backing;
    piece.given = span.length();
    piece.right.point -= face.backing * face.normal;
    piece.from -= 0.5 * face.backing * face.normal;
    piece.to -= 0.5 * face.backing * face.normal;
  }
  if (face.primitive >= 0) piece.primitives.push_back(face.primitive);
  return piece;
}

}  // namespace

std::vector<WallPiece> paired_faces(const std::vector<WallFace>& faces, const WallLimits& limits) {
  std::vector<std::vector<Span>> free;
  free.reserve(faces.size());
  for (const auto& face : faces) free.push_back(face.spans);
  std::vector<WallPiece> pieces;
  for (const auto& c : candidates(faces, limits)) {
    const WallFace &a = faces[c.a], &b = faces[c.b];
    std::vector<Span> both;
    for (const auto& span : free[c.b]) {
      const Span there = window_on(a, b, span);
      for (const auto& window : overlap(overlap(free[c.a], c.window), there)) both.push_back(window);
    }
    for (const auto& span : merged(std::move(both), 0)) {
      if (span.length() < limits.min_length) continue;
      pieces.push_back(piece_of(a, b, span));
      free[c.a] = without(free[c.a], span);
      free[c.b] = without(free[c.b], window_on(b, a, span));
    }
  }
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (const auto& span : free[f]) pieces.push_back(piece_of(faces[f], span));
  return pieces;
}

}  // namespace atrium::floorplan
