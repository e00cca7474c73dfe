#pragma once
#include "graph/api/node.hpp"
#include "graph/pipeline/registry.hpp"

/// Node types for the tests of the framework: a small world of clouds (their number of points) and planes.
namespace atrium::test {

struct Cloud {
  static constexpr std::string_view port_type = "Cloud";
  static constexpr auto members() { return std::tuple{&Cloud::points}; }
  double points = 0;
};
struct Planes {
  static constexpr std::string_view port_type = "Planes";
  static constexpr auto members() { return std::tuple{&Planes::count}; }
  double count = 0;
};

struct Read {
  static constexpr std::string_view type = "test.read";
  static constexpr std::string_view summary = "Reads a cloud.";
  struct In {};
  struct Out {
    Cloud cloud;
  };
  struct Params {
    InputPath path;
  };
  static constexpr auto inputs = std::tuple{};
  static constexpr auto outputs = std::tuple{port<&Out::cloud>("What the file holds.")};
  static constexpr auto params = std::tuple{param<&Params::path>("The file.")};
  static Out run(const In&, const Params&, Context&) { return {}; }
};

/// Takes no input and no parameter.
struct Make {
  static constexpr std::string_view type = "test.make";
  static constexpr std::string_view summary = "Makes a cloud.";
  struct In {};
  struct Out {
    Cloud cloud;
  };
  struct Params {};
  static constexpr auto inputs = std::tuple{};
  static constexpr auto outputs = std::tuple{port<&Out::cloud>("A cloud.")};
  static constexpr auto params = std::tuple{};
  static Out run(const In&, const Params&, Context&) { return {}; }
};

struct Find {
  static constexpr std::string_view type = "test.find";
  static constexpr std::string_view summary = "Finds planes.";
  static constexpr int version = 2;
  enum class Method { ransac, hough };
  struct In {
    Input<Cloud> cloud;
  };
  struct Out {
    Planes planes;
    Cloud rest;
  };
  struct Params {
    double distance = 0.5;
    double angle = 20;
    std::int64_t max_planes = 70;
    double share = 0.1;
    Method method = Method::ransac;
    bool refit = true;
    std::vector<double> box = {1, 2, 3};
  };
  static constexpr auto inputs = std::tuple{port<&In::cloud>("Points.")};
  static constexpr auto outputs = std::tuple{port<&Out::planes>("Planes."), port<&Out::rest>("Points of no plane.")};
  static constexpr auto params =
      std::tuple{param<&Params::distance>(metres, within(0, 10), "Distance of inliers."),
                 param<&Params::angle>(degrees, within(0, 90), "Angle of inliers."),
                 param<&Params::max_planes>(count, within(1, 1000), "At most so many."),
                 param<&Params::share>(ratio, within(0, 1), "Share of the points."),
                 param<&Params::method>({{"ransac", Method::ransac}, {"hough", Method::hough}}, "How."),
                 param<&Params::refit>("Whether planes are fitted again."),
                 param<&Params::box>(metres, unbounded, "Size of the box.")};
  static Out run(const In&, const Params&, Context&) { return {}; }
};

/// Can stand in for test.find where only `planes` is read.
struct Grow {
  static constexpr std::string_view type = "test.grow";
  static constexpr std::string_view summary = "Grows planes.";
  struct In {
    Input<Cloud> cloud;
  };
  struct Out {
    Planes planes;
  };
  struct Params {
    double distance = 0.05;
    double voxel = 0.02;
  };
  static constexpr auto inputs = std::tuple{port<&In::cloud>("Points.")};
  static constexpr auto outputs = std::tuple{port<&Out::planes>("Planes.")};
  static constexpr auto params = std::tuple{param<&Params::distance>(metres, within(0, 0.4), "Distance of inliers."),
                                            param<&Params::voxel>(metres, within(0.001, 1), "Size of voxels.")};
  static Out run(const In&, const Params&, Context&) { return {}; }
};

/// Stands in for test.find and finds nothing.
struct Leave {
  static constexpr std::string_view type = "test.leave";
  static constexpr std::string_view summary = "Finds no plane.";
  struct In {
    UnusedInput<Cloud> cloud;
  };
  struct Out {
    Planes planes;
  };
  static constexpr auto inputs = std::tuple{port<&In::cloud>("Points.")};
  static constexpr auto outputs = std::tuple{port<&Out::planes>("None.")};
  static Out run() { return {}; }
};

/// Cannot stand in for test.find: its input is of another type.
struct Refine {
  static constexpr std::string_view type = "test.refine";
  static constexpr std::string_view summary = "Refines planes.";
  struct In {
    Input<Planes> planes;
    OptionalInput<Cloud> cloud;
  };
  struct Out {
    SharedOutput<Planes> planes;
  };
  struct Params {};
  static constexpr auto inputs = std::tuple{port<&In::planes>("Planes."), port<&In::cloud>("Their points.")};
  static constexpr auto outputs = std::tuple{port<&Out::planes>("Planes.")};
  static constexpr auto params = std::tuple{};
  static Out run(const In& in, const Params&, Context&) { return {in.planes}; }
};

struct Join {
  static constexpr std::string_view type = "test.join";
  static constexpr std::string_view summary = "Joins clouds.";
  struct In {
    Inputs<Cloud> clouds;
  };
  struct Out {
    Cloud cloud;
  };
  struct Params {
    std::vector<std::string> names;
    std::vector<InputPath> files;
    std::vector<double> weights;
  };
  static constexpr auto inputs = std::tuple{port<&In::clouds>("Clouds.")};
  static constexpr auto outputs = std::tuple{port<&Out::cloud>("All of them.")};
  static constexpr auto params =
      std::tuple{param<&Params::names>("Their names."), param<&Params::files>("Their poses."),
                 param<&Params::weights>(unitless, at_least(0), "Their weights.")};
  static Out run(const In&, const Params&, Context&) { return {}; }
};

struct Write {
  static constexpr std::string_view type = "test.write";
  static constexpr std::string_view summary = "Writes planes.";
  struct In {
    Input<Planes> planes;
  };
  struct Out {};
  struct Params {
    OutputPath path{"planes.vg"};
    std::string title = "planes";
  };
  static constexpr auto inputs = std::tuple{port<&In::planes>("Planes.")};
  static constexpr auto outputs = std::tuple{};
  static constexpr auto params = std::tuple{param<&Params::path>("The file."), param<&Params::title>("Its title.")};
  static Out run(const In&, const Params&, Context&) { return {}; }
};

inline void add_test_nodes(Registry& registry) {
  registry.add(describe_node<Read>());
  registry.add(describe_node<Make>());
  registry.add(describe_node<Find>());
  registry.add(describe_node<Grow>());
  registry.add(describe_node<Leave>());
  registry.add(describe_node<Refine>());
  registry.add(describe_node<Join>());
  registry.add(describe_node<Write>());
}

}  // namespace atrium::test
