#pragma once
#include "graph/api/node.hpp"
#include "modules/types/ground_truth.hpp"
#include "modules/types/mesh.hpp"
#include "modules/types/metrics.hpp"

namespace atrium::metric {

/// Quality of a reconstructed structure against the true one, after the ISPRS benchmark on indoor modelling
/// (Khoshelham, Tran, Díaz-Vilariño et al., "An evaluation framework for benchmarking indoor modelling methods", 2018):
///
/// - completeness(b): share of the true area with reconstructed surface within b,
/// - correctness(b): share of the reconstructed area with true surface within b,
/// - accuracy(b): median distance to the true surface of the reconstructed area within b.
///
/// Surfaces match only if their normals, whatever their sign, are within max_angle of each other; `oriented` asks for
/// the sign too (a wall then does not match the other side of a thin wall). Areas are sampled evenly; distances are
/// exact.
///
/// Metrics: structure.area.{true,reconstructed} in m2; for each buffer, called after its millimetres (b50mm),
/// structure.<buffer>.{completeness,correctness,accuracy}; where both meshes have classes, the same under
/// structure.{wall,floor,ceiling}, counting only surfaces of the same class on both sides. Triangles of the class
/// object count nowhere. What is undefined is left out: correctness and accuracy of no area, completeness where there
/// is no truth. Errors: neither or both of truth and truth_mesh; a truth without area; a buffer that is no whole
/// millimetre.
struct Structure {
  static constexpr std::string_view type = "metric.structure";
  static constexpr std::string_view summary = "Completeness, correctness and accuracy against the true structure.";
  struct In {
    Input<Mesh> mesh;
    OptionalInput<GroundTruth> truth;
    OptionalInput<Mesh> truth_mesh;
  };
  struct Out {
    Metrics metrics;
  };
  struct Params {
    std::vector<double> buffers{0.02, 0.05, 0.1};
    double max_angle = 30;
    bool oriented = false;
    double spacing = 0.03;
    std::int64_t max_samples = 2'000'000;
  };
  static constexpr auto inputs =
      std::tuple{port(&In::mesh, "mesh", "The reconstructed structure, in the truth's frame."),
                 port(&In::truth, "truth", "The true structure of a simulated scene; this or truth_mesh."),
                 port(&In::truth_mesh, "truth_mesh", "The true structure as a mesh; this or truth.")};
  static constexpr auto outputs = std::tuple{port(&Out::metrics, "metrics", "structure.…: shares and metres.")};
  static constexpr auto params = std::tuple{
      param(&Params::buffers, "buffers", metres, within(0.001, 10),
            "The three distances b within which surfaces match."),
      param(&Params::max_angle, "max_angle", degrees, within(0, 90), "Between the normals of surfaces that match."),
      param(&Params::oriented, "oriented", "Whether surfaces that look the opposite way are no match."),
      param(&Params::spacing, "spacing", metres, within(1e-4, 10), "Of the samples: one per spacing²."),
      param(&Params::max_samples, "max_samples", count, within(1, 1e9),
            "Samples stand further apart if it takes more."),
  };
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::metric
