#pragma once
#include "graph/api/node.hpp"
#include "modules/types/ground_truth.hpp"
#include "modules/types/mesh.hpp"
#include "modules/types/metrics.hpp"

namespace atrium::metric {

/// Quality of a reconstructed structure against the true one, after the ISPRS benchmark on indoor modelling
/// (Khoshelham, Tran, Díaz-Vilariño, Peter, Kang and Acharya, "An evaluation framework for benchmarking indoor
/// modelling methods", ISPRS Archives XLII-4, 2018; Khoshelham, Tran, Acharya, Díaz-Vilariño, Kang and Dalyot, "Results
/// of the ISPRS benchmark on indoor modelling", 2021). With a buffer b:
///
/// - completeness(b): share of the true area with reconstructed surface within b,
/// - correctness(b): share of the reconstructed area with true surface within b,
/// - accuracy(b): median distance to the true surface of the reconstructed area within b.
///
/// Surfaces match only if their normals, whatever their sign, are within max_angle of each other; `oriented` asks for
/// the sign too: a wall then does not match the other side of a thin wall. The benchmark intersects planar faces with
/// buffers around planes; here areas are sampled, one point per spacing² at least and one per triangle, along a
/// sequence of low discrepancy, and each sample's distance to the other mesh is exact. A share of an area A is thereby
/// known to about the area of one spacing along its border: a few thousandths for a room at 3 cm.
///
/// Metrics: structure.area.{true,reconstructed} in m2; for each buffer, called after its millimetres (b50mm),
/// structure.<buffer>.{completeness,correctness,accuracy}; where both meshes have classes, the same under
/// structure.{wall,floor,ceiling}, counting only surfaces of the same class on both sides. Triangles of the class
/// object count nowhere. The second output holds the same as curves over the buffer, from curve_step to curve_reach:
/// structure_curve.{total,wall,floor,ceiling}.b010mm.completeness and so on, three digits or more, so that names sort.
/// What is undefined is left out: correctness and accuracy of no area, completeness where there is no truth. Errors:
/// neither or both of truth and truth_mesh; a truth without area; a buffer or step that is no whole millimetre.
struct Structure {
  static constexpr std::string_view type = "metric.structure";
  static constexpr int version = 2;
  static constexpr std::string_view summary = "Completeness, correctness and accuracy against the true structure.";
  struct In {
    Input<Mesh> mesh;
    OptionalInput<GroundTruth> truth;
    OptionalInput<Mesh> truth_mesh;
  };
  struct Out {
    Metrics metrics;
    Metrics curve;
  };
  struct Params {
    std::vector<double> buffers{0.02, 0.05, 0.1};
    double curve_step = 0.01;
    double curve_reach = 0.15;
    double max_angle = 30;
    bool oriented = false;
    double spacing = 0.03;
    std::int64_t max_samples = 2'000'000;
  };
  static constexpr auto inputs =
      std::tuple{port<&In::mesh>("The reconstructed structure, in the truth's frame."),
                 port<&In::truth>("The true structure of a simulated scene; this or truth_mesh."),
                 port<&In::truth_mesh>("The true structure as a mesh; this or truth.")};
  static constexpr auto outputs = std::tuple{port<&Out::metrics>("structure.…: shares and metres."),
                                             port<&Out::curve>("structure_curve.…: the same, buffer by buffer.")};
  static constexpr auto params = std::tuple{
      param<&Params::buffers>(metres, within(0.001, 10), "Distances b within which surfaces match."),
      param<&Params::curve_step>(metres, within(0.001, 10), "Between the buffers of the curve."),
      param<&Params::curve_reach>(metres, within(0, 10), "The last buffer of the curve; 0: no curve."),
      param<&Params::max_angle>(degrees, within(0, 90), "Between the normals of surfaces that match."),
      param<&Params::oriented>("Whether surfaces that look the opposite way are no match."),
      param<&Params::spacing>(metres, within(1e-4, 10), "Of the samples: one per spacing²."),
      param<&Params::max_samples>(count, within(1, 1e9), "Samples stand further apart if it takes more."),
  };
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::metric
