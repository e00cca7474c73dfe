#pragma once
#include "graph/api/parameter.hpp"

namespace atrium::synth {

/// Rows of the parameter tables that several scenes have. `P` has a double of the row's name.
template <class P>
constexpr auto inner_wall_param() {
  return param<&P::inner_wall>(metres, within(0.02, 0.5), "Thickness of the walls between rooms.");
}
template <class P>
constexpr auto outer_wall_param() {
  return param<&P::outer_wall>(metres, within(0.02, 1), "Depth of the reveals of windows and entrance.");
}
template <class P>
constexpr auto furniture_param() {
  return param<&P::furniture>(unitless, within(0, 3), "How densely it is furnished: 0 empty, 1 an ordinary home.");
}

}  // namespace atrium::synth
