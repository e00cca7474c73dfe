#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "graph/api/context.hpp"
#include "modules/render/colour_map.hpp"
#include "modules/types/cloud.hpp"
#include "modules/types/mesh.hpp"

namespace atrium::render {

/// What a colour bar shows: the map from `low` to `high`, metres.
struct ColourScale {
  ColourMap map;
  double low = 0, high = 1;
  std::string quantity;  ///< "height"
};

/// Colours of some of a cloud's points, and what explains them.
struct PointColours {
  std::vector<Colour> colours;
  std::optional<ColourScale> scale;
  std::vector<std::pair<std::string, Colour>> legend;
};

/// Every n-th point, so that at most `most` are chosen: the same ones in every run.
std::vector<std::uint32_t> evenly_chosen(std::size_t size, std::size_t most);

/// By height in the frame that `to_upright` leads to; the scale leaves out 0.5 % of the points at each end.
PointColours height_colours(const Cloud& cloud, const std::vector<std::uint32_t>& chosen, const Transform& to_upright,
                            const ColourMap& map);
/// By label: one colour each, grey below 0; a legend if there are at most ten labels.
PointColours label_colours(const Cloud& cloud, const std::vector<std::uint32_t>& chosen, const ColourMap& map);
/// By distance to the nearest triangle of a mesh in the same frame. With a sign: positive on the side that the triangle
/// faces. `end` is where the scale ends, metres; 0: the next round length above the 95th percentile.
PointColours distance_colours(const Cloud& cloud, const std::vector<std::uint32_t>& chosen, const Mesh& mesh,
                              bool with_sign, double end, const ColourMap& map, const Context& context);

/// The least of 1, 2, 5, 10, 20 … (times any power of ten) that is not below `value`.
double round_up(double value);

}  // namespace atrium::render
