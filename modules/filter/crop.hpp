#pragma once
#include <vector>

#include "graph/api/node.hpp"
#include "modules/types/cloud.hpp"

namespace atrium::filter {

enum class Keep { inside, outside };

/// Keeps the points inside (or outside) an axis-aligned box. The box is given in true coordinates, the cloud's origin
/// included; its faces belong to it. Points keep their order, columns and origin. Throws Error if min exceeds max along
/// an axis; warns if no point is left. An empty cloud gives an empty cloud.
struct Crop {
  static constexpr std::string_view type = "filter.crop";
  static constexpr std::string_view summary = "Keeps the points inside or outside a box.";
  struct In {
    Input<Cloud> cloud;
  };
  struct Out {
    Cloud cloud;
  };
  struct Params {
    std::vector<double> min{-1e9, -1e9, -1e9};
    std::vector<double> max{1e9, 1e9, 1e9};
    Keep keep = Keep::inside;
  };
  static constexpr auto inputs = std::tuple{port<&In::cloud>("Points with any columns.")};
  static constexpr auto outputs = std::tuple{port<&Out::cloud>("The points that were kept.")};
  static constexpr auto params =
      std::tuple{param<&Params::min>(metres, within(-1e9, 1e9), "Lowest x, y and z of the box."),
                 param<&Params::max>(metres, within(-1e9, 1e9), "Highest x, y and z of the box."),
                 param<&Params::keep>({{"inside", Keep::inside}, {"outside", Keep::outside}}, "Which points stay.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::filter
