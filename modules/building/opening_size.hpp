#pragma once
#include "modules/types/building.hpp"

namespace atrium::building {

/// An opening's rectangle, of both its sides the mean where both are known. Metres.
struct OpeningSize {
  double width = 0;   ///< level
  double height = 0;  ///< along the slope of its face
  double sill = 0;    ///< lower edge over the lowest corner of its face
};
OpeningSize size_of(const Building& building, const BuildingOpening& opening);

}  // namespace atrium::building
