#include "modules/pcl/write.hpp"

#include <fmt/format.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "graph/api/error.hpp"
#include "modules/pcl/pcl_cloud.hpp"

namespace atrium::pcl_nodes {
namespace {

/// Rows of 4-byte fields, as PCL writes them.
class Rows {
 public:
  explicit Rows(const Cloud& cloud) : cloud_(cloud) {
    result_.height = 1;
    result_.width = static_cast<std::uint32_t>(cloud.size());
    for (const char* name : {"x", "y", "z"}) add(name, pcl::PCLPointField::FLOAT32);
    if (cloud.has_normals())
      for (const char* name : {"normal_x", "normal_y", "normal_z"}) add(name, pcl::PCLPointField::FLOAT32);
    if (!cloud.colours.empty()) add("rgb", pcl::PCLPointField::FLOAT32);
    if (!cloud.intensities.empty()) add("intensity", pcl::PCLPointField::FLOAT32);
    if (!cloud.labels.empty()) add("label", pcl::PCLPointField::INT32);
    result_.row_step = result_.point_step * result_.width;
    result_.is_dense = 1;
    result_.data.resize(static_cast<std::size_t>(result_.point_step) * cloud.size());
    to_ = result_.data.data();
    for (std::size_t i = 0; i < cloud.size(); ++i) row(i);
  }
  const pcl::PCLPointCloud2& cloud() const { return result_; }
  double largest_step() const { return largest_step_; }

 private:
  void add(const char* name, std::uint8_t type) {
    pcl::PCLPointField field;
    field.name = name;
    field.offset = result_.point_step;
    field.datatype = type;
    field.count = 1;
    result_.fields.push_back(field);
    result_.point_step += 4;
  }
  template <class T>
  void put(T value) {
    static_assert(sizeof(T) == 4);
    std::memcpy(to_, &value, sizeof value);
    to_ += sizeof value;
  }
  void row(std::size_t i) {
    const Eigen::Vector3d place = cloud_.origin + cloud_.points[i].cast<double>();
    const Eigen::Vector3f rounded = place.cast<float>();
    largest_step_ = std::max(largest_step_, (rounded.cast<double>() - place).cwiseAbs().maxCoeff());
    for (int k = 0; k < 3; ++k) put(rounded[k]);
    if (cloud_.has_normals())
      for (int k = 0; k < 3; ++k) put(cloud_.normals[i][k]);
    if (!cloud_.colours.empty()) {
      const Colour& c = cloud_.colours[i];
      put(static_cast<std::uint32_t>(c[0]) << 16U | static_cast<std::uint32_t>(c[1]) << 8U | c[2]);
    }
    if (!cloud_.intensities.empty()) put(cloud_.intensities[i]);
    if (!cloud_.labels.empty()) put(cloud_.labels[i]);
  }

  const Cloud& cloud_;
  pcl::PCLPointCloud2 result_;
  std::uint8_t* to_ = nullptr;
  double largest_step_ = 0;
};

int save(const std::string& path, bool pcd, const pcl::PCLPointCloud2& cloud, const Write::Params& params) {
  const Eigen::Vector4f origin = Eigen::Vector4f::Zero();
  const Eigen::Quaternionf turn = Eigen::Quaternionf::Identity();
  constexpr int digits = 9;  // a float's
  if (!pcd && params.binary) return pcl::PLYWriter().writeBinary(path, cloud, origin, turn, false);
  if (!pcd) return pcl::PLYWriter().writeASCII(path, cloud, origin, turn, digits, false);
  if (params.compressed) return pcl::PCDWriter().writeBinaryCompressed(path, cloud, origin, turn);
  if (params.binary) return pcl::PCDWriter().writeBinary(path, cloud, origin, turn);
  return pcl::PCDWriter().writeASCII(path, cloud, origin, turn, digits);
}

/// PCL does not say when a disk is full. A number in text takes two bytes at least, with its blank.
void check_whole(const std::filesystem::path& path, const pcl::PCLPointCloud2& cloud, const Write::Params& params,
                 const std::string& target) {
  if (params.compressed) return;  // PCL maps that file, and it has its size before
  const std::size_t points = static_cast<std::size_t>(cloud.width) * cloud.height;
  const std::size_t least = points * (params.binary ? cloud.point_step : 2 * cloud.fields.size());
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const auto size = static_cast<std::size_t>(std::max<std::streamoff>(0, file.tellg()));
  char last = '\n';
  if (!params.binary && size > 0) {
    file.seekg(-1, std::ios::end);
    file.get(last);
  }
  if (!file || size < least || last != '\n')
    throw Error(fmt::format("{}: only {} bytes could be written", target, size), "is the disk full?");
}

}  // namespace

void Write::run(const In& in, const Params& params, Context& context) {
  const std::string extension = std::filesystem::path(params.path.path).extension();
  if (extension != ".pcd" && extension != ".ply")
    throw Error(fmt::format("{}: pcl.write knows .pcd and .ply", params.path.path), "io.write_cloud writes others");
  if (params.compressed && (extension != ".pcd" || !params.binary))
    throw Error("only binary .pcd files are compressed", "leave `compressed` out, or write a .pcd file");
  if (in.cloud->size() == 0)
    throw Error("the cloud is empty: PCL does not write files without points", "io.write_cloud does");
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  const Rows rows(*in.cloud);
  if (rows.largest_step() > 1e-4)
    context.warn(fmt::format("PCL's coordinates are floats: points are moved by up to {:.3g} m", rows.largest_step()));
  const auto target = context.output(params.path.path);
  AtomicFile file(target);
  int status = -1;
  try {
    status = save(file.path(), extension == ".pcd", rows.cloud(), params);
  } catch (const pcl::PCLException& error) {
    throw Error(fmt::format("{}: {}", target.string(), error.what()));
  }
  if (status < 0) throw Error(fmt::format("{}: PCL cannot write this file", target.string()));
  check_whole(file.path(), rows.cloud(), params, target.string());
  file.commit();
  context.wrote(target);
}

}  // namespace atrium::pcl_nodes
