#pragma once
#include "graph/api/node.hpp"
#include "modules/types/cloud.hpp"

namespace atrium::trial {

/// Makes a cloud, slowly if told so, or does what a node must not do.
struct Fault {
  static constexpr std::string_view type = "trial.fault";
  static constexpr std::string_view summary = "Makes a cloud, or misbehaves.";
  enum class Mode { pass, abort, hang, nan, flood, fickle, segv, exit, devour };
  struct In {
    OptionalInput<Cloud> after;
  };
  struct Out {
    Cloud cloud;
    double sum = 0;
  };
  struct Params {
    std::int64_t number = 1;
    std::int64_t points = 1000;
    double work = 0;
    Mode mode = Mode::pass;
  };
  static constexpr auto inputs = std::tuple{port<&In::after>("Its first point is added to all of them.")};
  static constexpr auto outputs = std::tuple{port<&Out::cloud>("Points."), port<&Out::sum>("A sum.")};
  static constexpr auto params =
      std::tuple{param<&Params::number>(unitless, unbounded, "Makes the points differ."),
                 param<&Params::points>(count, within(1, 1e8), "How many."),
                 param<&Params::work>(seconds, within(0, 100), "How long it takes."),
                 param<&Params::mode>(
                     {{"pass", Mode::pass},
                      {"abort", Mode::abort},
                      {"hang", Mode::hang},
                      {"nan", Mode::nan},
                      {"flood", Mode::flood},
                      {"fickle", Mode::fickle},
                      {"segv", Mode::segv},
                      {"exit", Mode::exit},
                      {"devour", Mode::devour}},
                     "hang: until the run is cancelled; nan: the sum is no number; flood: prints 100 MB; fickle: the "
                     "points depend on the time; exit: ends the process with 7; devour: takes ever more memory, up to "
                     "1 GB.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::trial
