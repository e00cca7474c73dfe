#include "modules/pcl/read.hpp"

#include <fmt/format.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <optional>

#include "graph/api/error.hpp"
#include "modules/geometry/quantile.hpp"
#include "modules/pcl/pcl_cloud.hpp"

namespace atrium::pcl_nodes {
namespace {

struct File {
  pcl::PCLPointCloud2 cloud;
  Eigen::Vector3f viewpoint = Eigen::Vector3f::Zero();
};

constexpr std::size_t most_points = 4'000'000'000;  // indices have 32 bits

std::size_t points_in(const pcl::PCLPointCloud2& cloud) { return static_cast<std::size_t>(cloud.width) * cloud.height; }

File loaded(const std::string& path) {
  File file;
  Eigen::Vector4f origin = Eigen::Vector4f::Zero();
  Eigen::Quaternionf turn;
  int version = 0;
  int status = -1;
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  const std::string extension = std::filesystem::path(path).extension();
  if (extension != ".pcd" && extension != ".ply")
    throw Error(fmt::format("{}: pcl.read knows .pcd and .ply", path), "io.read_scan reads other formats");
  try {
    if (extension == ".ply") {
      status = pcl::PLYReader().read(path, file.cloud, origin, turn, version);
    } else {  // its header first: without fields or points PCL's reader writes past the end
      int kind = 0;
      unsigned body = 0;
      status = pcl::PCDReader().readHeader(path, file.cloud, origin, turn, version, kind, body);
      if (status >= 0 && file.cloud.fields.empty()) status = -1;
      if (status >= 0 && points_in(file.cloud) > 0)
        status = pcl::PCDReader().read(path, file.cloud, origin, turn, version);
    }
  } catch (const pcl::PCLException& error) {
    throw Error(fmt::format("{}: {}", path, error.what()), "io.read_scan says what is wrong in it");
  }
  if (status < 0 || points_in(file.cloud) > most_points ||
      points_in(file.cloud) * file.cloud.point_step > file.cloud.data.size())
    throw Error(fmt::format("{}: PCL cannot read this file", path), "io.read_scan says what is wrong in it");
  file.viewpoint = origin.head<3>();
  return file;
}

/// One field of a file, as numbers.
class Column {
 public:
  Column(const pcl::PCLPointCloud2& cloud, const pcl::PCLPointField& field) : cloud_(cloud), field_(field) {}
  double operator[](std::size_t i) const {
    switch (field_.datatype) {
      case pcl::PCLPointField::FLOAT32: return static_cast<double>(as<float>(i));
      case pcl::PCLPointField::FLOAT64: return as<double>(i);
      case pcl::PCLPointField::INT8: return as<std::int8_t>(i);
      case pcl::PCLPointField::UINT8: return as<std::uint8_t>(i);
      case pcl::PCLPointField::INT16: return as<std::int16_t>(i);
      case pcl::PCLPointField::UINT16: return as<std::uint16_t>(i);
      case pcl::PCLPointField::INT32: return as<std::int32_t>(i);
      case pcl::PCLPointField::UINT32: return as<std::uint32_t>(i);
      default: return std::numeric_limits<double>::quiet_NaN();
    }
  }
  /// Whether its values have the 32 bits of a packed colour.
  bool is_packed() const {
    return field_.datatype == pcl::PCLPointField::FLOAT32 || field_.datatype == pcl::PCLPointField::UINT32 ||
           field_.datatype == pcl::PCLPointField::INT32;
  }
  /// The field's bytes as they are: packed colours are floats or integers.
  template <class T>
  T as(std::size_t i) const {
    T value;
    std::memcpy(&value, cloud_.data.data() + i * cloud_.point_step + field_.offset, sizeof value);
    return value;
  }

 private:
  const pcl::PCLPointCloud2& cloud_;
  const pcl::PCLPointField& field_;
};

std::optional<Column> find(const pcl::PCLPointCloud2& cloud, std::string_view name) {
  for (const auto& field : cloud.fields)
    if (field.name == name) return Column(cloud, field);
  return {};
}

/// Where the median of a coordinate is far from zero, that.
double origin_of(const Column& column, const std::vector<std::uint32_t>& rows) {
  constexpr double far = 1000;  // metres
  if (rows.empty()) return 0;
  std::vector<double> values;
  values.reserve(rows.size());
  for (const auto i : rows) values.push_back(column[i]);
  const double middle = median(std::move(values));
  return std::abs(middle) > far ? std::round(middle) : 0;
}

void read_normals(const pcl::PCLPointCloud2& file, const std::vector<std::uint32_t>& rows, Cloud& cloud,
                  Context& context) {
  const auto x = find(file, "normal_x"), y = find(file, "normal_y"), z = find(file, "normal_z");
  if (!x || !y || !z) return;
  cloud.normals.reserve(rows.size());
  for (const auto i : rows) {
    const Eigen::Vector3d normal((*x)[i], (*y)[i], (*z)[i]);
    if (!normal.allFinite() || normal.norm() < 0.1) {
      context.warn("some normals are not finite or zero: the normals are left out");
      cloud.normals.clear();
      return;
    }
    cloud.normals.emplace_back(normal.normalized().cast<float>());
  }
}

/// −1 where there is none, or one that does not fit.
std::int32_t label_of(double value) {
  constexpr double most = std::numeric_limits<std::int32_t>::max();
  return value >= -most && value <= most ? static_cast<std::int32_t>(value) : -1;
}

void read_attributes(const pcl::PCLPointCloud2& file, const std::vector<std::uint32_t>& rows, Cloud& cloud) {
  const auto rgb = find(file, "rgb");
  auto colour = rgb ? rgb : find(file, "rgba");
  if (colour && !colour->is_packed()) colour.reset();
  const auto intensity = find(file, "intensity"), label = find(file, "label");
  for (const auto i : rows) {
    if (colour) {
      const auto bits = colour->as<std::uint32_t>(i);
      cloud.colours.push_back({static_cast<std::uint8_t>(bits >> 16U), static_cast<std::uint8_t>(bits >> 8U),
                               static_cast<std::uint8_t>(bits)});
    }
    if (intensity) cloud.intensities.push_back(static_cast<float>((*intensity)[i]));
    if (label) cloud.labels.push_back(label_of((*label)[i]));
  }
}

}  // namespace

Read::Out Read::run(const Params& params, Context& context) {
  const File file = loaded(params.path.path);
  const auto x = find(file.cloud, "x"), y = find(file.cloud, "y"), z = find(file.cloud, "z");
  if (!x || !y || !z) throw Error(fmt::format("{}: no fields x, y and z", params.path.path));
  const std::size_t size = points_in(file.cloud);
  std::vector<std::uint32_t> rows;
  rows.reserve(size);
  for (std::uint32_t i = 0; i < size; ++i)
    if (std::isfinite((*x)[i]) && std::isfinite((*y)[i]) && std::isfinite((*z)[i])) rows.push_back(i);
  if (rows.size() < size)
    context.warn(fmt::format("{} of {} points are not finite: left out", size - rows.size(), size));
  Out out;
  Cloud& cloud = out.cloud;
  cloud.origin = {origin_of(*x, rows), origin_of(*y, rows), origin_of(*z, rows)};
  cloud.points.reserve(rows.size());
  for (const auto i : rows)
    cloud.points.emplace_back((Eigen::Vector3d((*x)[i], (*y)[i], (*z)[i]) - cloud.origin).cast<float>());
  read_normals(file.cloud, rows, cloud, context);
  read_attributes(file.cloud, rows, cloud);
  if (!file.viewpoint.isZero()) cloud.sensors = {(file.viewpoint.cast<double>() - cloud.origin).cast<float>()};
  return out;
}

}  // namespace atrium::pcl_nodes
