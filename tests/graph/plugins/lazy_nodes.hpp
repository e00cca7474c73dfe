#pragma once
#include "graph/api/node.hpp"

/// Node types of the module "lazy", whose functions stand in a second library.
namespace atrium::lazy {

struct Double {
  static constexpr std::string_view type = "lazy.double";
  static constexpr std::string_view summary = "Doubles a number.";
  struct In {};
  struct Out {
    double result = 0;
  };
  struct Params {
    double number = 1;
  };
  static constexpr auto inputs = std::tuple{};
  static constexpr auto outputs = std::tuple{port<&Out::result>("")};
  static constexpr auto params = std::tuple{param<&Params::number>(unitless, unbounded, "")};
  static Out run(const In& in, const Params& params, Context& context);
};

/// In the tables only: as if the second library were of an older build.
struct Forgotten {
  static constexpr std::string_view type = "lazy.forgotten";
  static constexpr std::string_view summary = "Has no function.";
  struct In {};
  struct Out {};
  struct Params {};
  static constexpr auto inputs = std::tuple{};
  static constexpr auto outputs = std::tuple{};
  static constexpr auto params = std::tuple{};
  static Out run(const In& in, const Params& params, Context& context);
};

/// Its function stands beside the tables.
struct Light {
  static constexpr std::string_view type = "lazy.light";
  static constexpr std::string_view summary = "Gives one.";
  struct In {};
  struct Out {
    double result = 0;
  };
  struct Params {};
  static constexpr auto inputs = std::tuple{};
  static constexpr auto outputs = std::tuple{port<&Out::result>("")};
  static constexpr auto params = std::tuple{};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::lazy
