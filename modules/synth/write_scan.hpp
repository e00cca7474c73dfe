#pragma once
#include "modules/synth/scan.hpp"

namespace atrium::synth {

/// Scans a scene as synth.scan does, point by point the same with the same seed, and writes the points to a file while
/// they are made: any number of points in little memory (about 100 MB).
///
/// What is not a parameter here has the default of synth.scan. A .e57 has a scan for each scanner position with its
/// pose, where `sensors` is set and the points come position by position (not `uniform_area`); a .ply has the positions
/// as io.write_cloud writes them. .las keeps neither positions nor labels. Errors: another extension, more points than
/// a file may have.
struct WriteScan {
  static constexpr std::string_view type = "synth.write_scan";
  static constexpr std::string_view summary = "Scans a simulated scene into a file, of any number of points.";
  static constexpr bool random = true;
  struct In {
    Input<SimulatedScene> scene;
  };
  struct Out {
    GroundTruth truth;
    Mesh mesh;
  };
  struct Params {
    OutputPath path{"scan.e57"};
    std::int64_t points = 10'000'000;
    Scan::Pattern pattern = Scan::Pattern::spherical;
    std::int64_t positions = 2;
    double noise = 0.008;
    double outliers = 0.01;
    double drift = 0;
    bool outside = true;
    Scan::Windows windows = Scan::Windows::glazed;
    std::int64_t people = 0;
    double yaw = 0;
    double tilt = 0;
    std::vector<double> offset{0, 0, 0};
    bool sensors = true;
  };
  static constexpr auto inputs = std::tuple{port<&In::scene>("What is looked at.")};
  static constexpr auto outputs =
      std::tuple{port<&Out::truth>("The scene's ground truth in the scan's frame."),
                 port<&Out::mesh>("The true structural faces as triangles, in the scan's frame.")};
  static constexpr auto params = std::tuple{
      param<&Params::path>("The file, in the run's folder: .e57, .las or .ply (binary)."),
      param<&Params::points>(count, within(1, 4e9), "Number of points, outliers included; exact."),
      param<&Params::pattern>({{"spherical", Scan::Pattern::spherical},
                               {"uniform_area", Scan::Pattern::uniform_area},
                               {"hand_held", Scan::Pattern::hand_held}},
                              "How points are spread: as by a scanner on a tripod, evenly over what can be seen, or "
                              "from a walk."),
      param<&Params::positions>(count, within(1, 100), "Scanner positions per room, as far as it has room."),
      param<&Params::noise>(metres, within(0, 1), "Standard deviation of the range."),
      param<&Params::outliers>(ratio, within(0, 1), "Share of points that lie on no surface."),
      param<&Params::drift>(metres, within(0, 10), "Misplacement of positions, as in synth.scan."),
      param<&Params::outside>("Whether rays that leave the building meet an outside."),
      param<&Params::windows>(
          {{"void", Scan::Windows::no_return}, {"glazed", Scan::Windows::glazed}, {"open", Scan::Windows::open}},
          "Whether windows give no points at all, are panes that most rays pass, or are open."),
      param<&Params::people>(count, within(0, 100), "How many people walk about."),
      param<&Params::yaw>(degrees, within(-360, 360), "Turn of the scene about its vertical."),
      param<&Params::tilt>(degrees, within(-180, 180), "Then turn about the x axis: how far z is off the vertical."),
      param<&Params::offset>(metres, within(-1e8, 1e8), "Then shift: x, y, z (a georeferenced scan, say)."),
      param<&Params::sensors>("Whether the file says where its scanner stood."),
  };
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::synth
