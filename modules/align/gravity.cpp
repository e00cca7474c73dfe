#include "modules/align/gravity.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "graph/api/text.hpp"
#include "modules/geometry/moments.hpp"
#include "modules/geometry/upright_evidence.hpp"
#include "modules/types/turn_between.hpp"

namespace atrium::align {
namespace {

constexpr double per_degree = std::numbers::pi / 180.0;
constexpr double near_axis = 15.0;  // degrees
constexpr double large_turn = 5.0;  // degrees

struct Choice {
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  UprightEvidence evidence;
  double prior = 0, score = 0, probability = 1;
};

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) / per_degree;
}

/// The signed axis of the frame nearest to a direction.
Eigen::Vector3d nearest_axis(const Eigen::Vector3d& direction) {
  Eigen::Index largest = 0;
  direction.cwiseAbs().maxCoeff(&largest);
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();
  axis[largest] = direction[largest] < 0 ? -1 : 1;
  return axis;
}

/// How often files have their up in this direction.
double usual(const Eigen::Vector3d& up, bool y_up) {
  const Eigen::Vector3d axis = nearest_axis(up);
  if (angle_between(up, axis) > near_axis) return 0.002;
  if (axis.z() > 0) return y_up ? 0.36 : 0.87;
  if (axis.y() > 0) return y_up ? 0.60 : 0.09;
  if (axis.y() < 0) return y_up ? 0.006 : 0.015;
  return axis.z() < 0 ? 0.008 : 0.004;
}

std::string name_of(const Eigen::Vector3d& direction) {
  const Eigen::Vector3d axis = nearest_axis(direction);
  if (angle_between(direction, axis) > near_axis)
    return fmt::format("[{:.2f}, {:.2f}, {:.2f}]", direction.x(), direction.y(), direction.z());
  Eigen::Index largest = 0;
  axis.cwiseAbs().maxCoeff(&largest);
  return fmt::format("{}{}", axis[largest] < 0 ? "-" : "+", "xyz"[largest]);
}

std::string setting(const Eigen::Vector3d& direction) {
  const Eigen::Vector3d axis = nearest_axis(direction);
  if (angle_between(direction, axis) > near_axis)
    return fmt::format("-s upright.up=[{:.3f},{:.3f},{:.3f}]", direction.x(), direction.y(), direction.z());
  return fmt::format("-s upright.up=[{},{},{}]", axis.x(), axis.y(), axis.z());
}

/// The planes by area: the number of cells of 10 cm that their points are in. A strip tells little of the direction
/// across it (coarse voxels make steps of a slope, which look like level strips): the square of its width counts.
std::vector<FacedArea> faces_of(const PlanePrimitives& planes, const Context& context) {
  std::vector<FacedArea> faces(planes.primitives.size());
  context.parallel_for(
      faces.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
          const auto& primitive = planes.primitives[k];
          if (primitive.inliers.size() < 3) continue;
          std::vector<SurfacePiece> points;
          Moments moments;
          const Eigen::Vector3d reference = planes.cloud->points[primitive.inliers.front()].cast<double>();
          constexpr std::size_t most = 50000;
          const std::size_t step = std::max<std::size_t>(1, primitive.inliers.size() / most);
          for (std::size_t i = 0; i < primitive.inliers.size(); i += step) {
            const Eigen::Vector3f& point = planes.cloud->points[primitive.inliers[i]];
            points.push_back({point, Eigen::Vector3f::Zero()});
            moments.add(point.cast<double>() - reference);
          }
          constexpr double wide = 0.6;  // metres
          const double width = std::sqrt(std::max(0.0, 12 * fit_plane(moments).variances[1]));
          const double trust = std::min(1.0, (width / wide) * (width / wide));
          const SurfacePieces pieces = thin_to_pieces(points, 0.1);
          faces[k] = {primitive.plane.normal.normalized(),
                      trust * static_cast<double>(pieces.pieces.size()) * pieces.size * pieces.size};
        }
      },
      1);
  std::erase_if(faces, [](const FacedArea& face) { return !(face.area > 0); });
  return faces;
}

/// The whole cloud, with normals where a plane is; every k-th point of a large one.
std::vector<SurfacePiece> points_of(const PlanePrimitives& planes) {
  const Cloud& cloud = *planes.cloud;
  constexpr std::size_t most = 400000;
  const std::size_t step = std::max<std::size_t>(1, cloud.size() / most);
  std::vector<SurfacePiece> pieces;
  pieces.reserve(cloud.size() / step + 1);
  for (std::size_t i = 0; i < cloud.size(); i += step) pieces.push_back({cloud.points[i], Eigen::Vector3f::Zero()});
  for (const auto& primitive : planes.primitives)
    for (const auto i : primitive.inliers)
      if (i % step == 0) pieces[i / step].normal = primitive.plane.normal.cast<float>();
  return pieces;
}

std::vector<Choice> choices_of(const PlanePrimitives& planes, const std::vector<FacedArea>& faces, bool y_up,
                               double prior, const Context& context) {
  std::vector<Choice> choices;
  for (const auto& c : upright_candidates(points_of(planes), faces, 1.0, context)) {
    const double usually = std::log(usual(c.up, y_up));
    // The kinds of evidence are not independent of one another (what hides the floor also is furniture and clutter).
    constexpr double independent = 0.7;
    choices.push_back({c.up, c.evidence, usually, prior * usually + independent * c.evidence.sum(), 0});
  }
  std::stable_sort(choices.begin(), choices.end(), [](const auto& a, const auto& b) { return a.score > b.score; });
  double sum = 0;
  for (const auto& c : choices) sum += std::exp(c.score - choices.front().score);
  for (auto& c : choices) c.probability = std::exp(c.score - choices.front().score) / sum;
  return choices;
}

/// "+z is up with 98.7 %; for it (+) and against it (-): usual direction +0.0, clear heights +2.1, …": what speaks for
/// a direction, in powers of e by which it gets likelier; what says nothing is left out.
std::string told(const Choice& c) {
  const auto& e = c.evidence;
  std::string evidence;
  const auto add = [&](const char* name, double points) {
    constexpr double shown = 0.05;
    if (std::abs(points) >= shown) evidence += fmt::format("{}{} {:+.1f}", evidence.empty() ? "" : ", ", name, points);
  };
  add("usual direction", c.prior);
  add("clear heights", e.heights);
  add("level and upright surfaces", e.structure);
  add("level surfaces over the whole plan", e.cover);
  add("few levels", e.few_levels);
  add("furniture", e.furniture);
  add("doors", e.doors);
  add("clutter on the floor", e.clutter);
  add("what is on no plane lies low", e.rough);
  add("the scanned end is the floor", e.floor);
  add("what one end alone can tell", e.bound);
  return fmt::format("{} is up with {:.1f} %{}{}", name_of(c.up), 100 * c.probability,
                     evidence.empty() ? "" : "; points for it (+) and against it (-): ", evidence);
}

/// First the nearest axis onto +z, by a quarter turn or a half one, then what is left by the least rotation.
Transform upright_turn(const Eigen::Vector3d& up) {
  const Eigen::Vector3d axis = nearest_axis(up);
  Eigen::Quaterniond first = Eigen::Quaterniond::Identity();
  if (axis.z() < 0)
    first = Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitX());
  else if (axis.z() == 0)
    first = turn_between(axis, Eigen::Vector3d::UnitZ());
  Transform turn;
  turn.rotation = (turn_between(first * up, Eigen::Vector3d::UnitZ()) * first).normalized().toRotationMatrix();
  return turn;
}

std::string what_tells(const UprightEvidence& e) {
  std::string text = e.room_height > 0 ? fmt::format("rooms {:.2f} m high", e.room_height) : "no clear height";
  if (e.furniture > 0) text += fmt::format(", {} m² of furniture", e.furniture_seen);
  if (e.doors > 0) text += fmt::format(", {} m² of doors", e.doors_seen);
  return text;
}

/// Says what was found; a warning if the user should know of it.
void report(const std::vector<Choice>& choices, const Context& context) {
  const Choice& best = choices.front();
  const double turn = angle_between(best.up, Eigen::Vector3d::UnitZ());
  const std::string text =
      fmt::format("{} is up ({}), turned by {:.2f} deg", name_of(best.up), what_tells(best.evidence), turn);
  const auto other = std::find_if(choices.begin() + 1, choices.end(),
                                  [&](const Choice& c) { return angle_between(c.up, best.up) > near_axis; });
  constexpr double certain = 0.9;
  if (best.probability < certain && other != choices.end())
    context.warn(fmt::format("{}, but it may be {} ({:.0f} % to {:.0f} %): {} or {} decides", text, name_of(other->up),
                             100 * best.probability, 100 * other->probability, setting(best.up), setting(other->up)));
  else if (turn > large_turn)
    context.warn(fmt::format("{}: {} says so and takes this warning away; -s upright.up=[0,0,1] forces z", text,
                             setting(best.up)));
  else
    context.info(text);
}

/// Up, and how likely it is.
std::pair<Eigen::Vector3d, double> found_up(const PlanePrimitives& planes, const std::vector<FacedArea>& faces,
                                            bool y_up, double prior, const Context& context) {
  const auto choices = choices_of(planes, faces, y_up, prior, context);
  report(choices, context);
  constexpr std::size_t most = 6;
  for (std::size_t i = 0; i < std::min(most, choices.size()); ++i) context.info(told(choices[i]));
  double likely = 0;
  for (const auto& c : choices)
    if (angle_between(c.up, choices.front().up) <= near_axis) likely += c.probability;
  return {choices.front().up, std::min(1.0, likely)};
}

Eigen::Vector3d direction_of(const std::vector<double>& values) {
  if (values.size() != 3)
    throw Error(fmt::format("'up' has {} instead of three", counted(values.size(), "number")), "[0, 0, 1]");
  Eigen::Vector3d direction(values[0], values[1], values[2]);
  if (!direction.allFinite())
    throw Error(fmt::format("'up' is [{}, {}, {}], which is no direction", values[0], values[1], values[2]),
                "[0, 0, 1] where z points up; [0, 0, 0] to find out");
  return direction;
}

}  // namespace

Gravity::Out Gravity::run(const In& in, const Params& params, Context& context) {
  const Eigen::Vector3d given = direction_of(params.up);
  if (in.planes->primitives.empty())
    throw Error("there is no plane, so nothing tells what is level",
                "no flat surface was found: is it a scan of rooms, in metres? align.none leaves the frame as it is");
  const std::vector<FacedArea> faces = faces_of(*in.planes, context);
  const bool forced = !given.isZero(0);
  const bool y_up = params.habit == Habit::automatic ? in.planes->cloud->y_up : params.habit == Habit::y;
  const auto [up, likely] = forced ? std::pair{refined_vertical(faces, given.normalized(), near_axis), 1.0}
                                   : found_up(*in.planes, faces, y_up, params.prior, context);
  Transform turn = upright_turn(up);
  turn.upright = likely;
  return {transformed(*in.planes, turn), chained(in.transform ? *in.transform : Transform{}, turn)};
}

}  // namespace atrium::align
