#include "modules/synth/scanner.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace atrium::synth {
namespace {

using V = Eigen::Vector3d;
constexpr double radians_per_degree = std::numbers::pi / 180;
constexpr int attempts = 20000;   // rays for one point before the scanner is said to see nothing
constexpr double grazing = 0.05;  // cosine of the flattest angle at which a surface still answers
constexpr double step = 1e-6;     // behind a pane or before a mirror the ray goes on from here
constexpr double edge = 0.03;     // ranges that differ by more from the surface's plane are across an edge

// A direction at the given angles off another one.
V bent(const V& direction, double right, double up) {
  const V u = direction.unitOrthogonal(), v = direction.cross(u);
  return (direction + right * u + up * v).normalized();
}

}  // namespace

Scanner::Scanner(const SimulatedScene& scene, const Scan::Params& params, const Context& context)
    : params_(params), world_(world_of(scene, params.ceilings)), person_(person_label(scene)) {
  const bool idealized = params.pattern == Scan::Pattern::uniform_area,
             walks = params.pattern == Scan::Pattern::hand_held;
  index(scene);  // areas of the scene alone
  if (walks) {
    World shut = world_;  // nobody climbs through a window
    add_panes(shut, scene);
    stations_ = walk(scene, TriangleTree(shut.vertices, shut.triangles), params, context.random(0));
  } else {
    stations_ = tripods(scene, params, context.random(0));
  }
  if (stations_.empty()) throw Error("the scene has no scanner positions", "give the scene a room to stand in");
  if (stations_.size() > 65535) throw Error("more than 65535 scanner positions", "lower `positions`");
  if (!idealized) {
    if (params.windows != Scan::Windows::open) add_panes(world_, scene);
    if (params.outside) add_outside(world_, scene, context.random(~std::uint64_t{1}));
  }
  tree_ = TriangleTree(world_.vertices, world_.triangles);
  for (std::size_t t = normals_.size(); t < world_.triangles.size(); ++t) {
    const auto& [a, b, c] = world_.triangles[t];
    normals_.push_back(
        (world_.vertices[b] - world_.vertices[a]).cross(world_.vertices[c] - world_.vertices[a]).normalized());
  }
  if (!idealized)
    people_.emplace(static_cast<std::size_t>(params.people), stations_, walks ? 40 : 1, walks ? 1.4 : 1.5, tree_,
                    context.random(~std::uint64_t{2}));
}

void Scanner::index(const SimulatedScene& scene) {
  double area = 0;
  for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
    const auto& [a, b, c] = scene.triangles[t];
    const V &p = scene.vertices[a], &q = scene.vertices[b], &r = scene.vertices[c];
    const V normal = (q - p).cross(r - p);
    if (!world_.silent[t]) area += normal.norm() / 2;
    normals_.push_back(normal.norm() > 0 ? normal.normalized() : V(0, 0, 0));
    areas_.push_back(area);
    for (const auto& corner : {p, q, r}) box_.extend(corner);
  }
}

std::optional<Echo> Scanner::cast(std::size_t station, const V& direction, double share, Random& random) const {
  constexpr int most_bounces = 8;
  V from = stations_[station].place, along = direction;
  Eigen::Matrix3d mirrored = Eigen::Matrix3d::Identity();  // from the real world to what the scanner believes in
  bool real = true;
  double gone = 0;
  for (int bounce = 0; bounce < most_bounces; ++bounce) {
    const auto hit = tree_.cast(from, along, params_.max_range - gone);
    const double person = people_->cast(from, along, station, share);
    if (person < std::min(hit.distance, params_.max_range - gone))
      return Echo{station, direction, gone + person, real ? person_ : -1, {70, 74, 92}, mirrored * -along};
    if (!hit) return {};
    const Material material = world_.materials[hit.triangle];
    if (material == Material::glass) {
      if (params_.windows == Scan::Windows::no_return && world_.two_sided[hit.triangle]) return {};
      if (random.uniform() >= params_.glass) {
        from += (hit.distance + step) * along;
        gone += hit.distance + step;
        continue;
      }
    } else if (!hit.front && !world_.two_sided[hit.triangle]) {
      return {};
    } else if (material == Material::mirror) {
      const V& normal = normals_[hit.triangle];
      const Eigen::Matrix3d reflection = Eigen::Matrix3d::Identity() - 2 * normal * normal.transpose();
      from += (hit.distance - step) * along;
      gone += hit.distance - step;
      along = reflection * along;
      mirrored = mirrored * reflection;
      real = false;
      continue;
    }
    if (world_.silent[hit.triangle]) return {};
    const V& normal = normals_[hit.triangle];
    const V facing = normal.dot(along) > 0 ? V(-normal) : normal;
    return Echo{station,
                direction,
                gone + hit.distance,
                real ? world_.labels[hit.triangle] : -1,
                world_.colours[hit.triangle],
                mirrored * facing};
  }
  return {};
}

V Scanner::direction_of(const Station& station, double azimuth, Random& random) const {
  if (params_.pattern == Scan::Pattern::spherical) {
    const double elevation = random.uniform(params_.lowest_elevation, 90) * radians_per_degree;
    return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
  }
  for (;;) {  // the carrier stands behind the device
    const double z = random.uniform(-1, 1), angle = random.uniform(0, 2 * std::numbers::pi), r = std::sqrt(1 - z * z);
    V direction(r * std::cos(angle), r * std::sin(angle), z);
    if (z > 0.5 || direction.head<2>().dot(station.heading.head<2>()) > -0.8 * r) return direction;
  }
}

Echo Scanner::sweep(std::size_t point, std::size_t total, Random& random) const {
  const std::size_t count = stations_.size();
  // Station s has the points [s · total / count, (s + 1) · total / count).
  std::size_t s = point * count / total;
  while ((s + 1) * total / count <= point) ++s;
  const std::size_t first = s * total / count, last = (s + 1) * total / count;
  const double share = (static_cast<double>(point - first) + random.uniform()) / static_cast<double>(last - first);
  double azimuth = 2 * std::numbers::pi * share;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    if (attempt >= 64) azimuth = random.uniform(0, 2 * std::numbers::pi);
    const V direction = direction_of(stations_[s], azimuth, random);
    if (auto echo = cast(s, direction, share, random)) {
      mix(*echo, share, random);
      return *echo;
    }
  }
  throw Error("the scanner sees no surface from position " + std::to_string(s),
              "raise max_range or lower lowest_elevation");
}

// A second ray at the beam's rim tells whether the beam straddles a depth edge.
void Scanner::mix(Echo& echo, double share, Random& random) const {
  if (params_.beam <= 0 || params_.mixed_pixels <= 0) return;
  const double angle = random.uniform(0, 2 * std::numbers::pi), tilt = params_.beam / 2 * radians_per_degree;
  const V rim = bent(echo.direction, tilt * std::cos(angle), tilt * std::sin(angle));
  const bool mixes = random.uniform() < params_.mixed_pixels;
  const double where = random.uniform();
  if (!mixes) return;
  const auto other = cast(echo.station, rim, share, random);
  if (!other || other->label == echo.label) return;
  const double slope = echo.normal.dot(rim);
  const double expected = slope < -1e-3 ? echo.range * echo.normal.dot(echo.direction) / slope : echo.range;
  if (std::abs(other->range - expected) < edge) return;
  echo.range += where * (other->range - echo.range);
  echo.label = -1;
}

Echo Scanner::uniform_area(std::size_t point, std::size_t total, std::size_t& last_station, Random& random) const {
  double share = (static_cast<double>(point) + random.uniform()) / static_cast<double>(total);
  for (int attempt = 0; attempt < attempts; ++attempt) {
    if (attempt > 0) share = random.uniform();
    const auto at = std::upper_bound(areas_.begin(), areas_.end(), share * areas_.back()) - areas_.begin();
    const auto triangle = static_cast<std::uint32_t>(std::min<std::ptrdiff_t>(at, std::ssize(areas_) - 1));
    double u = random.uniform(), v = random.uniform();
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    const auto& [a, b, c] = world_.triangles[triangle];
    const V& corner = world_.vertices[a];
    const V place = corner + u * (world_.vertices[b] - corner) + v * (world_.vertices[c] - corner);
    // The station that saw the point before comes first: it mostly sees this one too.
    for (std::size_t i = 0; i < stations_.size(); ++i) {
      const std::size_t s = (last_station + i) % stations_.size();
      const V ray = place - stations_[s].place;
      const double range = ray.norm();
      if (range > params_.max_range || -ray.dot(normals_[triangle]) < grazing * range) continue;
      if (tree_.blocked(stations_[s].place, ray, 1 - 1e-9)) continue;
      last_station = s;
      return {s, ray / range, range, world_.labels[triangle], world_.colours[triangle], normals_[triangle]};
    }
  }
  throw Error("no scanner position sees a surface", "raise max_range");
}

Echo Scanner::look(std::size_t point, std::size_t total, std::size_t& last_station, Random& random) const {
  return params_.pattern == Scan::Pattern::uniform_area ? uniform_area(point, total, last_station, random)
                                                        : sweep(point, total, random);
}

V Scanner::measure(Echo& echo, Random& random) const {
  const Station& station = stations_[echo.station];
  const double range = echo.range + params_.noise * random.normal(),
               across = params_.angular_noise * radians_per_degree;
  V direction = echo.direction;
  if (across > 0) {
    const double right = across * random.normal(), up = across * random.normal();
    direction = bent(direction, right, up);
  }
  V place = station.place + range * direction;
  if (random.uniform() < params_.outliers) {
    echo.label = -1;
    if (random.uniform() < 0.5) {
      for (int k = 0; k < 3; ++k) place[k] = random.uniform(box_.min()[k], box_.max()[k]);
    } else {
      place = station.place + random.uniform(0.05, 1) * echo.range * echo.direction;
    }
  }
  return station.drift * place;
}

}  // namespace atrium::synth
