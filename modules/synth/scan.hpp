#pragma once
#include "graph/api/node.hpp"
#include "modules/types/cloud.hpp"
#include "modules/types/ground_truth.hpp"
#include "modules/types/simulated_scene.hpp"

namespace atrium::synth {

/// Looks at a scene as a scanner does, and gives the cloud together with the truth in the cloud's frame.
///
/// Patterns. `spherical`: a terrestrial scanner on a tripod; each position gives the same number of points, equally
/// dense in azimuth and elevation (so density falls with the square of the range and rises towards the zenith), with a
/// blind cone below, in the order of the sweep. `hand_held`: a device that somebody carries 1.4 m above the floors
/// through all rooms that can be reached, a place every 10 cm, rays evenly in all directions but towards its carrier,
/// in the order of the walk. `uniform_area`: an idealized fused scan; every surface that at least one position sees is
/// sampled with the same density; no outside, glass, mirrors, people or mixed pixels. Either way rays end at the first
/// surface (what is hidden gives no points), surfaces are seen from their front only, and for a ray that finds nothing
/// another is drawn, so that the count is exact.
///
/// Outside. A ray that leaves through a window or another opening meets ground (0.4 m below the lowest floor), houses
/// across the street with their roofs, hedges and trees. Windows (openings of the kind "window") have a pane in the
/// middle of their reveal: `glazed` throws back the share `glass` of the rays and lets the others pass; `void` gives
/// no points, neither of the pane nor of what is behind; `open` has no pane. Objects called "glass" are panes, too.
/// Objects called "mirror" reflect: what they show is measured behind them. `people` walk about, each seen from about
/// half of the positions (of a walk: during half of its stretches of 4 m).
///
/// Errors. Range noise is Gaussian along the ray, angular noise Gaussian across it. A beam (a cone of `beam`) that
/// meets two surfaces at different ranges gives a mixed pixel in the share `mixed_pixels`: a range anywhere between.
/// Outliers are half spread evenly through the scene's bounding box, half along rays before the surface (dust). Drift
/// of a tripod is one rigid motion per position, none for the first: with `drift` σ, two of the others lie √6 · σ apart
/// (root mean square), and each of them √3 · σ from the first. Drift of a walk grows smoothly: at its end the device
/// believes to be `drift` metres beside where it is and turned by `drift_angle`, half way half of it, into directions
/// that change slowly.
///
/// Frame. cloud place = Rx(tilt) · Rz(yaw) · scene place + offset; the offset becomes the origin of cloud, truth and
/// mesh. A tilt of −90 degrees gives a cloud whose y is up.
///
/// Columns: colours; labels (the surface ids of SimulatedScene: index of the true face; −1 what is no surface at its
/// place: outlier, mixed pixel, mirrored; −2 − k for object k; with n objects −2 − n the outside, −3 − n window panes,
/// −4 − n people). Only if asked for: sensors and source (where the scanner stood by its own, drifted account), which
/// no file of a real device has but some E57 and PTX; and normals.
struct Scan {
  static constexpr std::string_view type = "synth.scan";
  static constexpr std::string_view summary =
      "Scans a simulated scene: rays, occlusion, glass, mirrors, an outside, noise, outliers, drift.";
  static constexpr int version = 2;
  static constexpr bool random = true;
  enum class Pattern { spherical, uniform_area, hand_held };
  enum class Windows { no_return, glazed, open };
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
    std::int64_t most_positions = 0;
    double lowest_elevation = -60;
    double max_range = 60;
    double noise = 0.008;
    double angular_noise = 0.01;
    double beam = 0.03;
    double mixed_pixels = 0.5;
    double outliers = 0.01;
    double drift = 0;
    double drift_angle = 0;
    bool outside = true;
    Windows windows = Windows::glazed;
    double glass = 0.08;
    std::int64_t people = 0;
    double yaw = 0;
    double tilt = 0;
    std::vector<double> offset{0, 0, 0};
    bool sensors = false;
    bool normals = false;
    bool random_signs = false;
    bool ceilings = true;
    bool shuffle = false;
  };
  static constexpr auto inputs = std::tuple{port<&In::scene>("What is looked at.")};
  static constexpr auto outputs =
      std::tuple{port<&Out::cloud>("The scan."), port<&Out::truth>("The scene's ground truth in the scan's frame."),
                 port<&Out::mesh>("The true structural faces as triangles, in the scan's frame.")};
  static constexpr auto params = std::tuple{
      param<&Params::points>(count, within(1, 100e6), "Number of points, outliers included; exact."),
      param<&Params::pattern>(
          {{"spherical", Pattern::spherical},
           {"uniform_area", Pattern::uniform_area},
           {"hand_held", Pattern::hand_held}},
          "How points are spread: as by a scanner on a tripod, evenly over what can be seen, or from a walk."),
      param<&Params::positions>(
          count, within(1, 100),
          "Scanner positions per room, as far as it has room (and as many on stairs); a walk passes them."),
      param<&Params::most_positions>(count, within(0, 65535),
                                     "Scanner positions in all, the first ones of the scene; 0: no limit."),
      param<&Params::lowest_elevation>(degrees, within(-90, 60),
                                       "Spherical pattern: below this elevation the scanner is blind."),
      param<&Params::max_range>(metres, within(0.5, 1000), "Surfaces further away give no points."),
      param<&Params::noise>(metres, within(0, 1), "Standard deviation of the range."),
      param<&Params::angular_noise>(degrees, within(0, 10),
                                    "Standard deviation of the direction, on each of two axes."),
      param<&Params::beam>(degrees, within(0, 5), "Opening angle of the beam."),
      param<&Params::mixed_pixels>(ratio, within(0, 1),
                                   "Share of the rays across a depth edge that measure a range between its two sides."),
      param<&Params::outliers>(ratio, within(0, 1), "Share of points that lie on no surface."),
      param<&Params::drift>(
          metres, within(0, 10),
          "Tripod: standard deviation, per coordinate, of each position's misplacement but the first's; walk: the "
          "misplacement at its end."),
      param<&Params::drift_angle>(
          degrees, within(0, 45),
          "Tripod: standard deviation, per axis, of each position's misorientation but the first's; walk: the turn "
          "about the vertical at its end."),
      param<&Params::outside>("Whether rays that leave the building meet an outside."),
      param<&Params::windows>({{"void", Windows::no_return}, {"glazed", Windows::glazed}, {"open", Windows::open}},
                              "Whether windows give no points at all, are panes that most rays pass, or are open."),
      param<&Params::glass>(ratio, within(0, 1), "Share of the rays that a pane throws back."),
      param<&Params::people>(count, within(0, 100), "How many people walk about."),
      param<&Params::yaw>(degrees, within(-360, 360), "Turn of the scene about its vertical."),
      param<&Params::tilt>(degrees, within(-180, 180), "Then turn about the x axis: how far z is off the vertical."),
      param<&Params::offset>(metres, within(-1e8, 1e8), "Then shift: x, y, z (a georeferenced scan, say)."),
      param<&Params::sensors>("Whether the cloud says for each point where its scanner stood."),
      param<&Params::normals>("Whether the cloud has the surfaces' exact normals, towards the scanner."),
      param<&Params::random_signs>("Whether each normal points to a random side, as normals that nobody oriented do."),
      param<&Params::ceilings>(
          "Whether ceilings are scanned; without, their rays give no points, and the truth keeps them."),
      param<&Params::shuffle>("Whether the same points come in random order."),
  };
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::synth
