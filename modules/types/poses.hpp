#pragma once
#include <string_view>
#include <tuple>
#include <vector>

#include "modules/types/plane_primitives.hpp"

namespace atrium {

/// Where several scans stand: transforms[i] leads from the frame of scan i to the common one, that of the first.
struct Poses {
  static constexpr std::string_view port_type = "Poses";
  static constexpr auto members() { return std::tuple{&Poses::transforms}; }
  std::vector<Transform> transforms;
};

}  // namespace atrium
