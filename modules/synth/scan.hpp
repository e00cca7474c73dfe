#pragma once
#include "graph/api/node.hpp"
#include "modules/types/simulated_scene.hpp"

namespace atrium::synth {

/// Looks at a scene as a scanner does, and gives the cloud together with the truth in the cloud's frame.
///
/// Patterns. `spherical`: a terrestrial scanner on a tripod; each position gives the same number of points, equally
/// dense in azimuth and elevation (so density falls with the square of the range and rises towards the zenith), with a
/// blind cone below, in the order of the sweep. `uniform_area`: a fused hand-held scan; every surface that at least one
/// position sees is sampled with the same density. Either way rays end at the first surface (what is hidden gives no
/// points), surfaces are seen from their front only, and a ray that leaves through a window gives nothing: another is
/// drawn, so that the count is exact.
///
/// Errors. Range noise is Gaussian along the ray. Outliers are half spread evenly through the scene's bounding box,
/// half along rays before the surface (mixed pixels, dust). Drift is one rigid motion per position, none for the first:
/// with `drift` σ, two of the others lie √6 · σ apart (root mean square), and each of them √3 · σ from the first.
///
/// Frame. cloud place = Rx(tilt) · Rz(yaw) · scene place + offset; the offset becomes the origin of cloud, truth and
/// mesh.
///
/// Columns: colours; labels (the surface ids of SimulatedScene: index of the true face, −1 outlier, −2 − k for object
/// k); sensors and source (where the scanner stood by its own, drifted account); normals only if asked for.
struct Scan {
  static constexpr std::string_view type = "synth.scan";
  static constexpr std::string_view summary = "Scans a simulated scene: rays, occlusion, noise, outliers, drift.";
  static constexpr bool random = true;
  enum class Pattern { spherical, uniform_area };
  struct In {
    Input<SimulatedScene> scene;
  };
  struct Out {
    Cloud cloud;
    GroundTruth truth;
    Mesh mesh;
  };
  struct Params {
    std::int64_t points = 1'000'000;
    Pattern pattern = Pattern::spherical;
    std::int64_t positions = 2;
    double lowest_elevation = -60;
    double max_range = 60;
    double noise = 0.008;
    double outliers = 0.01;
    double drift = 0;
    double drift_angle = 0;
    double yaw = 0;
    double tilt = 0;
    std::vector<double> offset{0, 0, 0};
    bool normals = false;
    bool ceilings = true;
    bool shuffle = false;
  };
  static constexpr auto inputs = std::tuple{port(&In::scene, "scene", "What is looked at.")};
  static constexpr auto outputs =
      std::tuple{port(&Out::cloud, "cloud", "The scan."),
                 port(&Out::truth, "truth", "The scene's ground truth in the scan's frame."),
                 port(&Out::mesh, "mesh", "The true structural faces as triangles, in the scan's frame.")};
  static constexpr auto params = std::tuple{
      param(&Params::points, "points", count, within(1, 100e6), "Number of points, outliers included; exact."),
      param(&Params::pattern, "pattern", {{"spherical", Pattern::spherical}, {"uniform_area", Pattern::uniform_area}},
            "How points are spread: as by a scanner on a tripod, or evenly over what can be seen."),
      param(&Params::positions, "positions", count, within(1, 100),
            "Scanner positions per room, as far as it has room (and as many on stairs)."),
      param(&Params::lowest_elevation, "lowest_elevation", degrees, within(-90, 60),
            "Spherical pattern: below this elevation the scanner is blind."),
      param(&Params::max_range, "max_range", metres, within(0.5, 1000), "Surfaces further away give no points."),
      param(&Params::noise, "noise", metres, within(0, 1), "Standard deviation of the range."),
      param(&Params::outliers, "outliers", ratio, within(0, 1), "Share of points that lie on no surface."),
      param(&Params::drift, "drift", metres, within(0, 10),
            "Standard deviation, per coordinate, of each position's misplacement but the first's."),
      param(&Params::drift_angle, "drift_angle", degrees, within(0, 45),
            "Standard deviation, per axis, of each position's misorientation but the first's."),
      param(&Params::yaw, "yaw", degrees, within(-360, 360), "Turn of the scene about its vertical."),
      param(&Params::tilt, "tilt", degrees, within(-180, 180),
            "Then turn about the x axis: how far z is off the vertical."),
      param(&Params::offset, "offset", metres, within(-1e8, 1e8), "Then shift: x, y, z (a georeferenced scan, say)."),
      param(&Params::normals, "normals", "Whether the cloud has the surfaces' exact normals, towards the scanner."),
      param(&Params::ceilings, "ceilings",
            "Whether ceilings are scanned; without, their rays give no points, and the truth keeps them."),
      param(&Params::shuffle, "shuffle", "Whether the same points come in random order."),
  };
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::synth
