#include "modules/synth/scan.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "modules/geometry/triangle_tree.hpp"

namespace atrium::synth {
namespace {

constexpr double radians = std::numbers::pi / 180;
constexpr std::size_t chunk_size = 16384;
constexpr int attempts = 20000;   // rays for one point before the scanner is said to see nothing
constexpr double grazing = 0.05;  // cosine of the flattest angle at which a surface still answers

struct Station {
  Eigen::Vector3d place;
  Eigen::Isometry3d drift;  // true place to where the scanner puts it
};

// What one ray found: the surface point as the scanner measures it, in the scene's frame.
struct Echo {
  std::uint32_t triangle = TriangleTree::none;
  std::size_t station = 0;
  Eigen::Vector3d direction;  // unit length
  double range = 0;
};

std::vector<Station> stations_of(const SimulatedScene& scene, const Scan::Params& params, Random random) {
  std::vector<Station> stations;
  std::vector<std::int64_t> taken(scene.truth.rooms.size() + 1, 0);
  for (const auto& position : scene.positions) {
    if (taken[static_cast<std::size_t>(position.room) + 1]++ >= params.positions) continue;
    Eigen::Isometry3d drift = Eigen::Isometry3d::Identity();
    if (!stations.empty()) {
      Eigen::Vector3d shift, turn;
      for (auto& x : shift) x = params.drift * random.normal();
      for (auto& x : turn) x = params.drift_angle * radians * random.normal();
      if (turn.norm() > 0) drift.rotate(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
      drift = Eigen::Translation3d(position.place + shift) * drift * Eigen::Translation3d(-position.place);
    }
    stations.push_back({position.place, drift});
  }
  if (stations.empty()) throw Error("the scene has no scanner positions", "give the scene a room to stand in");
  if (stations.size() > 65535) throw Error("more than 65535 scanner positions", "lower `positions`");
  return stations;
}

class Scanner {
 public:
  Scanner(const SimulatedScene& scene, const Scan::Params& params, std::vector<Station> stations)
      : params_(params), stations_(std::move(stations)), tree_(scene.vertices, scene.triangles) {
    double area = 0;
    for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
      const auto& [a, b, c] = scene.triangles[t];
      const Eigen::Vector3d &p = scene.vertices[a], &q = scene.vertices[b], &r = scene.vertices[c];
      corners_.push_back({p, q - p, r - p});
      const Eigen::Vector3d normal = (q - p).cross(r - p);
      const auto surface = scene.surfaces[t];
      silent_.push_back(!params.ceilings && surface >= 0 &&
                        scene.truth.faces[static_cast<std::size_t>(surface)].surface == SurfaceClass::ceiling);
      if (!silent_.back()) area += normal.norm() / 2;
      normals_.push_back(normal.norm() > 0 ? normal.normalized() : Eigen::Vector3d(0, 0, 0));
      areas_.push_back(area);
      for (const auto& corner : {p, q, r}) box_.extend(corner);
    }
  }

  const std::vector<Station>& stations() const { return stations_; }
  const Eigen::Vector3d& normal(std::uint32_t triangle) const { return normals_[triangle]; }

  Echo spherical(std::size_t point, std::size_t total, Random& random) const {
    const std::size_t count = stations_.size();
    // Station s has the points [s · total / count, (s + 1) · total / count).
    std::size_t s = point * count / total;
    while ((s + 1) * total / count <= point) ++s;
    const std::size_t first = s * total / count, last = (s + 1) * total / count;
    const double slot = 2 * std::numbers::pi / static_cast<double>(last - first);
    double azimuth = slot * (static_cast<double>(point - first) + random.uniform());
    for (int attempt = 0; attempt < attempts; ++attempt) {
      if (attempt >= 64) azimuth = random.uniform(0, 2 * std::numbers::pi);
      const double elevation = random.uniform(params_.lowest_elevation, 90) * radians;
      const Eigen::Vector3d direction(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                                      std::sin(elevation));
      const auto hit = tree_.cast(stations_[s].place, direction, params_.max_range);
      if (hit && hit.front && !silent_[hit.triangle]) return {hit.triangle, s, direction, hit.distance};
    }
    return {};
  }

  Echo uniform_area(std::size_t point, std::size_t total, std::size_t& station, Random& random) const {
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
      const auto& [corner, ab, ac] = corners_[triangle];
      const Eigen::Vector3d place = corner + u * ab + v * ac;
      // The station that saw the point before comes first: it mostly sees this one too.
      for (std::size_t i = 0; i < stations_.size(); ++i) {
        const std::size_t s = (station + i) % stations_.size();
        const Eigen::Vector3d ray = place - stations_[s].place;
        const double range = ray.norm();
        if (range > params_.max_range || -ray.dot(normals_[triangle]) < grazing * range) continue;
        if (tree_.blocked(stations_[s].place, ray, 1 - 1e-9)) continue;
        station = s;
        return {triangle, s, ray / range, range};
      }
    }
    return {};
  }

  /// The measured place of an echo: with noise, or an outlier (then the echo's triangle becomes none).
  Eigen::Vector3d measure(Echo& echo, Random& random) const {
    const Station& station = stations_[echo.station];
    Eigen::Vector3d place = station.place + (echo.range + params_.noise * random.normal()) * echo.direction;
    if (random.uniform() < params_.outliers) {
      echo.triangle = TriangleTree::none;
      if (random.uniform() < 0.5) {
        for (int k = 0; k < 3; ++k) place[k] = random.uniform(box_.min()[k], box_.max()[k]);
      } else {
        place = station.place + random.uniform(0.05, 1) * echo.range * echo.direction;
      }
    }
    return station.drift * place;
  }

 private:
  const Scan::Params& params_;
  std::vector<Station> stations_;
  TriangleTree tree_;
  std::vector<std::array<Eigen::Vector3d, 3>> corners_;  // corner and two edges
  std::vector<Eigen::Vector3d> normals_;
  std::vector<double> areas_;  // running sums of those that answer
  std::vector<bool> silent_;   // triangles that give no points
  Eigen::AlignedBox3d box_;
};

std::uint8_t varied(std::uint8_t value, Random& random) {
  return static_cast<std::uint8_t>(
      std::clamp(static_cast<int>(value) + static_cast<int>(random.index(17)) - 8, 0, 255));
}

void allocate(Cloud& cloud, std::size_t total, bool normals) {
  cloud.points.resize(total);
  cloud.colours.resize(total);
  cloud.labels.resize(total);
  cloud.source.resize(total);
  if (normals) cloud.normals.resize(total);
}

// Moves place from[i] of every column to i, with from the same random order for all.
void shuffle(Cloud& cloud, Random random, const Context& context) {
  std::vector<std::uint32_t> from(cloud.size());
  for (std::size_t i = 0; i < from.size(); ++i) {
    const auto k = static_cast<std::size_t>(random.index(i + 1));
    from[i] = from[k];
    from[k] = static_cast<std::uint32_t>(i);
  }
  const auto gather = [&](auto& column) {
    if (column.empty()) return;
    auto moved = column;
    context.parallel_for(from.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) moved[i] = column[from[i]];
    });
    column = std::move(moved);
  };
  gather(cloud.points);
  gather(cloud.colours);
  gather(cloud.labels);
  gather(cloud.source);
  gather(cloud.normals);
}

Cloud scan(const SimulatedScene& scene, const Scanner& scanner, const Scan::Params& params, const Transform& pose,
           const Context& context) {
  Cloud cloud;
  const auto total = static_cast<std::size_t>(params.points);
  allocate(cloud, total, params.normals);
  cloud.origin = pose.translation;
  for (const auto& s : scanner.stations()) cloud.sensors.push_back((pose.rotation * (s.drift * s.place)).cast<float>());
  context.parallel_chunks(total, chunk_size, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    Random random = context.random(chunk + 1);
    std::size_t station = 0;
    for (std::size_t i = begin; i < end; ++i) {
      Echo echo = params.pattern == Scan::Pattern::spherical ? scanner.spherical(i, total, random)
                                                             : scanner.uniform_area(i, total, station, random);
      if (echo.triangle == TriangleTree::none)
        throw Error("the scanner sees no surface from position " + std::to_string(echo.station),
                    "raise max_range or lower lowest_elevation");
      const Colour& colour = scene.colours[echo.triangle];
      cloud.colours[i] = {varied(colour[0], random), varied(colour[1], random), varied(colour[2], random)};
      const Eigen::Matrix3d turn = pose.rotation * scanner.stations()[echo.station].drift.linear();
      if (params.normals) cloud.normals[i] = (turn * scanner.normal(echo.triangle)).cast<float>();
      cloud.points[i] = (pose.rotation * scanner.measure(echo, random)).cast<float>();
      cloud.labels[i] = echo.triangle == TriangleTree::none ? -1 : scene.surfaces[echo.triangle];
      cloud.source[i] = static_cast<std::uint16_t>(echo.station);
    }
  });
  return cloud;
}

}  // namespace

Scan::Out Scan::run(const In& in, const Params& params, Context& context) {
  const SimulatedScene& scene = *in.scene;
  if (params.offset.size() != 3)
    throw Error("offset has " + std::to_string(params.offset.size()) + " numbers", "give three: x, y, z");
  Transform pose;
  pose.rotation = (Eigen::AngleAxisd(params.tilt * radians, Eigen::Vector3d::UnitX()) *
                   Eigen::AngleAxisd(params.yaw * radians, Eigen::Vector3d::UnitZ()))
                      .toRotationMatrix();
  pose.translation = {params.offset[0], params.offset[1], params.offset[2]};
  const Scanner scanner(scene, params, stations_of(scene, params, context.random(0)));
  Out out;
  out.cloud = scan(scene, scanner, params, pose, context);
  if (params.shuffle) shuffle(out.cloud, context.random(~std::uint64_t{0}), context);
  out.truth = transformed(scene.truth, pose);
  out.mesh = out.truth.mesh;
  return out;
}

}  // namespace atrium::synth
