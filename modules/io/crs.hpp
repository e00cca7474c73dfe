#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace atrium::io {

constexpr double us_survey_foot = 1200.0 / 3937.0;  ///< metres

/// What a file says of its coordinate reference system.
struct Crs {
  std::string text;              ///< as Cloud::crs
  std::optional<double> metres;  ///< per unit of x and y, if it is said
  bool degrees = false;          ///< longitude and latitude: no lengths
};

/// Of WKT 1 or 2.
Crs crs_of_wkt(std::string_view text);
/// Of the directory of GeoTIFF keys (LAS record 34735). Keys that are not understood are passed over.
Crs crs_of_geotiff(const std::byte* keys, std::size_t size);

}  // namespace atrium::io
