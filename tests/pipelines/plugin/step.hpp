#pragma once
#include "graph/api/node.hpp"

namespace atrium::trial {

/// A step that passes, fails, or waits for the end.
struct Step {
  static constexpr std::string_view type = "trial.step";
  static constexpr std::string_view summary = "Passes, fails, or waits for the run to be cancelled.";
  static constexpr bool random = true;
  enum class Mode { pass, fail, wait, ignore, print };
  struct In {
    OptionalInput<double> after;
  };
  struct Out {
    double value = 0;
    std::string text;
  };
  struct Params {
    double value = 1.5;
    Mode mode = Mode::pass;
  };
  static constexpr auto inputs = std::tuple{port<&In::after>("Added to `value`.")};
  static constexpr auto outputs = std::tuple{port<&Out::value>("The sum, and a random number if `value` is 0."),
                                             port<&Out::text>("The same in words.")};
  static constexpr auto params = std::tuple{
      param<&Params::value>(metres, unbounded, "A length."),
      param<&Params::mode>({{"pass", Mode::pass},
                            {"fail", Mode::fail},
                            {"wait", Mode::wait},
                            {"ignore", Mode::ignore},
                            {"print", Mode::print}},
                           "ignore: waits, and does not listen to a cancellation; print: prints as libraries do.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::trial
