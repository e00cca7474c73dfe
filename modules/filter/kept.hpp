#pragma once
#include <cstdint>
#include <vector>

#include "modules/types/cloud.hpp"

namespace atrium::filter {

/// The points whose mark is not 0, in their order, with all columns.
inline Cloud kept(const Cloud& cloud, const std::vector<std::uint8_t>& marks) {
  std::vector<std::uint32_t> indices;
  indices.reserve(marks.size());
  for (std::size_t i = 0; i < marks.size(); ++i)
    if (marks[i] != 0) indices.push_back(static_cast<std::uint32_t>(i));
  return select(cloud, indices);
}

}  // namespace atrium::filter
