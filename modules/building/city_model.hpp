#pragma once
#include <string>
#include <vector>

#include "modules/types/building.hpp"

namespace atrium::building {

struct CityOptions {
  std::string title;
  int epsg = 0;  ///< code of the coordinate reference system; 0: none
};

struct CityModel {
  std::string text;                   ///< the CityJSON file
  std::vector<std::string> warnings;  ///< of rooms that could not be written whole
};

/// Of a building whose z is up.
CityModel city_model(const Building& building, const CityOptions& options);

}  // namespace atrium::building
