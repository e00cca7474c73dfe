#pragma once
#include "graph/api/node.hpp"

namespace atrium::trial {

struct Write {
  static constexpr std::string_view type = "trial.write";
  static constexpr std::string_view summary = "Writes a number into a file, and warns.";
  struct In {
    Input<double> value;
  };
  struct Out {};
  struct Params {
    OutputPath path{"value.txt"};
  };
  static constexpr auto inputs = std::tuple{port<&In::value>("The number.")};
  static constexpr auto outputs = std::tuple{};
  static constexpr auto params = std::tuple{param<&Params::path>("The file.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::trial
