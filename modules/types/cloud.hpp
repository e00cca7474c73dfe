#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace atrium {

using Colour = std::array<std::uint8_t, 3>;  ///< red, green, blue

/// A point cloud as columns: a column is either empty or as long as `points`. Metres. A point's place in the cloud's
/// frame is origin + point: the float columns stay near zero, so that georeferenced clouds keep their millimetres. All
/// coordinates and normals are finite (readers drop what is not, and say so).
struct Cloud {
  static constexpr std::string_view port_type = "Cloud";
  static constexpr auto members() {
    return std::tuple{&Cloud::origin, &Cloud::points,      &Cloud::normals, &Cloud::colours,
                      &Cloud::labels, &Cloud::intensities, &Cloud::source,  &Cloud::sensors,
                      &Cloud::unit,   &Cloud::y_up,        &Cloud::crs};
  }

  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3f> points;
  std::vector<Eigen::Vector3f> normals;  ///< unit length
  std::vector<Colour> colours;
  std::vector<std::int32_t> labels;
  std::vector<float> intensities;
  std::vector<std::uint16_t> source;     ///< index into sensors; empty with one sensor: all points are its
  std::vector<Eigen::Vector3f> sensors;  ///< where the scanner stood, in the same frame as points (origin + sensor)
  double unit = 1;    ///< metres per unit of the file that it was read from; all lengths here are metres
  bool y_up = false;  ///< files of that format usually have y up, not z: a habit, not a fact
  std::string crs;    ///< coordinate reference system of that file: WKT, or "EPSG:25832"; empty: the file names none.
                      ///< Like `unit` it stays what it is when the cloud is turned: writers go back to the file's frame

  std::size_t size() const { return points.size(); }
  bool has_normals() const { return !normals.empty(); }
};

/// The points of `indices`, with every column that the cloud has, in that order.
Cloud select(const Cloud& cloud, const std::vector<std::uint32_t>& indices);

}  // namespace atrium
