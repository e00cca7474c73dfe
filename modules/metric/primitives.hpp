#pragma once
#include "graph/api/node.hpp"
#include "modules/types/ground_truth.hpp"
#include "modules/types/metrics.hpp"
#include "modules/types/plane_primitives.hpp"

namespace atrium::metric {

/// Plane primitives against the true faces, after Hoover et al., "An experimental comparison of range image
/// segmentation algorithms", IEEE PAMI 18(7), 1996: a point belongs to a true region and to a found one, and regions
/// are compared by the points that they share.
///
/// A true region is a face of the truth with at least min_points points of the cloud. A point's face is its label, if
/// the cloud has labels (those of synth.scan: index of the face, negative for objects and outliers); else the nearest
/// true face within max_distance, if the point has no normal or one within 45° of the face's. Found regions are the
/// primitives. Of these, on_objects counts those that have most of their points on no face: furniture is as flat as a
/// wall, and not part of this truth; they count nowhere else.
///
/// For each threshold T (t50: 50 %, t80: 80 %), with shares of both regions' points:
/// - correct: a true and a found region share at least T of each.
/// - oversegmented (a split): a true region and two or more found ones that have at least T of their points in it and
///   together at least T of its points.
/// - undersegmented (a merge): the other way round: a primitive that runs over two or more faces. The coplanar floors
/// of
///   two rooms in one primitive are one.
/// - missed: true regions in none of these; noise: primitives in none.
/// A region is in one of them only: where more than one would hold, that of the highest mean share.
///
/// Metrics: primitives.{true,found,on_objects}; primitives.t80.{correct,oversegmented,undersegmented,missed,noise,
/// recall,precision} and the same for the other thresholds (recall: correct over true; precision: correct over found
/// without on_objects); primitives.purity: share of the primitives' points (without on_objects) that are on the face
/// that has most of the primitive's; primitives.coverage: share of the true regions' points that are in a primitive of
/// which their face has most. Of the correct pairs of the lowest threshold: primitives.normal_error.{median,max} in deg
/// and primitives.offset_error.{median,max} in m (distance between the planes at the middle of the shared points).
/// What is undefined is left out. Errors: a truth without faces; a label beyond its faces, or without labels a truth
/// whose mesh does not tell its faces, or a point that is not finite; a plane with points that do not exist; a
/// threshold that is no whole percent.
struct Primitives {
  static constexpr std::string_view type = "metric.primitives";
  static constexpr std::string_view summary = "Recall, purity, splits and merges of plane primitives (Hoover et al.).";
  struct In {
    Input<PlanePrimitives> planes;
    Input<GroundTruth> truth;
  };
  struct Out {
    Metrics metrics;
  };
  struct Params {
    std::vector<double> thresholds{0.5, 0.8};
    std::int64_t min_points = 50;
    double max_distance = 0.05;
  };
  static constexpr auto inputs = std::tuple{port<&In::planes>("The primitives, with their cloud."),
                                            port<&In::truth>("The true faces, in the frame of that cloud.")};
  static constexpr auto outputs = std::tuple{port<&Out::metrics>("primitives.…: counts, shares, deg, m.")};
  static constexpr auto params = std::tuple{
      param<&Params::thresholds>(ratio, within(0.5, 1), "Shares from which on regions agree (T)."),
      param<&Params::min_points>(count, within(1, 1e9), "Faces with fewer points were not scanned."),
      param<&Params::max_distance>(metres, within(0, 10),
                                   "Without labels: points further from every face belong to none."),
  };
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::metric
