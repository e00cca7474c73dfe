#include "modules/layout/surest.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <memory>
#include <string>

#include "graph/api/error.hpp"
#include "graph/api/text.hpp"
#include "modules/layout/confidence.hpp"
#include "modules/layout/faces.hpp"

namespace atrium::layout {
namespace {

struct Judgement {
  double confidence = 0;  ///< 0: no building
  double observed = 0;    ///< square metres of its faces that points lie on
  std::size_t rooms = 0;
  std::string refused;  ///< why it is no building
  Building building;
  double confirmed() const { return confidence * observed; }
};

double area_of(const Building& building, const BuildingFace& face) {
  const auto ring = [&](const std::vector<std::uint32_t>& corners) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < corners.size(); ++i)
      sum += building.vertices[corners[i]].cross(building.vertices[corners[(i + 1) % corners.size()]]);
    return sum.norm() / 2;
  };
  double area = ring(face.outline);
  for (const auto& hole : face.holes) area -= ring(hole);
  return area;
}

/// Whether two sets of planes are one: the same object, or a copy of it.
bool same_planes(const PlanePrimitives& a, const PlanePrimitives& b) {
  if (&a == &b) return true;
  return a.cloud->points == b.cloud->points &&
         std::equal(a.primitives.begin(), a.primitives.end(), b.primitives.begin(), b.primitives.end(),
                    [](const PlanePrimitive& p, const PlanePrimitive& q) { return p.inliers == q.inliers; });
}

/// What is wrong with a proposal that is not taken interests nobody, but the run may end.
class QuietHost : public ContextHost {
 public:
  explicit QuietHost(const Context& context) : context_(context) {}
  bool cancelled() override { return context_.cancelled(); }

 private:
  const Context& context_;
};

Judgement judge(const Input<CellComplex>& cells, const Input<Structure>& structure, const Context& context) {
  context.check_cancelled();
  Context quiet(1, std::make_shared<QuietHost>(context));
  Judgement result;
  try {
    auto building = input(Faces::run({cells, structure}, quiet).building);
    Building sure = Confidence::run({building, structure, {}, {}}, {}, quiet).building;
    result.confidence = sure.confidence;
    result.rooms = sure.rooms.size();
    for (const auto& face : sure.faces) result.observed += face.observed * area_of(sure, face);
    result.building = std::move(sure);
  } catch (const Error& e) {
    result.refused = e.what();
  }
  return result;
}

}  // namespace

Surest::Out Surest::run(const In& in, const Params& params, Context& context) {
  if (!same_planes(*in.structure->primitives, *in.other_structure->primitives))
    throw Error("the two proposals are made from different planes", "wire both to the node that makes the planes");
  Judgement first = judge(in.cells, in.structure, context);
  Judgement other = judge(in.other_cells, in.other_structure, context);
  const bool better = other.confirmed() > (1 + params.margin) * first.confirmed();
  const auto say = [](const Judgement& j) {
    if (!j.refused.empty()) return j.refused;
    return fmt::format("{}, confidence {:.2f}, {:.1f} m2 of faces observed", counted(j.rooms, "room"), j.confidence,
                       j.observed);
  };
  context.info(
      fmt::format("the {} proposal: first: {}; other: {}", better ? "other" : "first", say(first), say(other)));
  Judgement& rest = better ? first : other;
  const bool comparable = rest.confirmed() >= params.comparable * (better ? other : first).confirmed();
  Building opinion = comparable ? std::move(rest.building) : Building{};
  if (better) return {in.other_cells, in.other_structure, std::move(opinion)};
  return {in.cells, in.structure, std::move(opinion)};
}

}  // namespace atrium::layout
