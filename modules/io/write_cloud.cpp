#include "modules/io/write_cloud.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "graph/api/text.hpp"
#include "modules/io/cloud_columns.hpp"
#include "modules/io/e57_writer.hpp"
#include "modules/io/glb_cloud_writer.hpp"
#include "modules/io/las_writer.hpp"
#include "modules/io/paths.hpp"

namespace atrium::io {
namespace {

/// The sensor's true place if there is exactly one.
std::optional<Eigen::Vector3d> single_sensor(const Cloud& cloud) {
  if (cloud.sensors.size() != 1) return std::nullopt;
  return cloud.origin + cloud.sensors[0].cast<double>();
}

void write_cloud_ply(const Cloud& cloud, bool binary, ByteBuffer& out) {
  const auto columns = columns_of(cloud, false);
  write_ply_head(columns, cloud.size(), cloud.sensors.size(), binary, out);
  if (binary)
    write_records(columns, cloud.size(), out);
  else
    write_lines(columns, cloud.size(), ' ', out);
  for (const auto& local : cloud.sensors) {
    const Eigen::Vector3d place = cloud.origin + local.cast<double>();
    if (binary)
      for (int a = 0; a < 3; ++a) out.number(place[a]);
    else
      out.text(fmt::format("{} {} {}\n", place.x(), place.y(), place.z()));
  }
}

void write_pcd(const Cloud& cloud, bool binary, ByteBuffer& out) {
  const auto columns = columns_of(cloud, true);
  const Eigen::Vector3d sensor = single_sensor(cloud).value_or(Eigen::Vector3d::Zero());
  std::string names;
  std::string sizes;
  std::string types;
  std::string counts;
  for (const auto& column : columns) {
    names += fmt::format(" {}", column.name);
    sizes += fmt::format(" {}", size_of(column.type));
    types += is_floating(column.type) ? " F" : column.type == Scalar::i32 ? " I" : " U";
    counts += " 1";
  }
  out.text(fmt::format("# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS{}\nSIZE{}\nTYPE{}\nCOUNT{}\n",
                       names, sizes, types, counts));
  out.text(fmt::format("WIDTH {}\nHEIGHT 1\nVIEWPOINT {} {} {} 1 0 0 0\nPOINTS {}\nDATA {}\n", cloud.size(), sensor.x(),
                       sensor.y(), sensor.z(), cloud.size(), binary ? "binary" : "ascii"));
  if (binary)
    write_records(columns, cloud.size(), out);
  else
    write_lines(columns, cloud.size(), ' ', out);
}

void write_text(const Cloud& cloud, char separator, ByteBuffer& out) {
  const auto columns = columns_of(cloud, false);
  std::string names;
  for (const auto& column : columns)
    names += (names.empty() ? "" : std::string(1, separator)) + std::string(column.name);
  out.text((separator == ',' ? "" : "# ") + names + "\n");
  write_lines(columns, cloud.size(), separator, out);
}

void write_columns(const Cloud& cloud, const std::string& extension, bool binary, AtomicFile& file) {
  ByteBuffer out(file);
  if (extension == ".ply")
    write_cloud_ply(cloud, binary, out);
  else if (extension == ".pcd")
    write_pcd(cloud, binary, out);
  else
    write_text(cloud, extension == ".csv" ? ',' : ' ', out);
  out.flush();
}

/// Which points are written: `most` (0: all), evenly in their order.
std::vector<std::uint32_t> kept_of(std::size_t points, std::int64_t most) {
  std::vector<std::uint32_t> kept(most == 0 ? points : std::min(points, static_cast<std::size_t>(most)));
  for (std::size_t i = 0; i < kept.size(); ++i) kept[i] = static_cast<std::uint32_t>(i * points / kept.size());
  return kept;
}

}  // namespace

void WriteCloud::run(const In& in, const Params& params, Context& context) {
  const std::string extension = extension_of(params.path.path);
  const bool glb = extension == ".glb";
  const auto kept = kept_of(in.cloud->size(), params.max_points);
  const bool thinner = kept.size() < in.cloud->size();
  const Cloud fewer = thinner && !glb ? select(*in.cloud, kept) : Cloud{};
  const Cloud& cloud = thinner && !glb ? fewer : *in.cloud;
  const bool text = extension == ".xyz" || extension == ".txt" || extension == ".csv";
  const bool las = extension == ".las" || extension == ".laz";
  if (!text && !las && !glb && extension != ".ply" && extension != ".pcd" && extension != ".e57")
    throw Error("cannot write a cloud as '" + params.path.path + "'",
                "known extensions: .ply, .pcd, .e57, .las, .laz, .glb, .xyz, .txt, .csv");
  if (cloud.points.empty()) context.warn("the cloud is empty: " + params.path.path + " has no points");
  const bool several = extension == ".ply" || extension == ".e57";
  if ((!several && !glb && cloud.sensors.size() > 1) || ((text || las) && !cloud.sensors.empty()))
    context.warn(fmt::format("{}: the places of {} are not kept by this format", params.path.path,
                             counted(cloud.sensors.size(), "sensor")));
  const bool names_crs = (las || extension == ".e57") && !cloud.crs.empty();
  const std::string crs = names_crs && std::abs(cloud.unit - 1) < 1e-9 ? cloud.crs : std::string();
  if (names_crs && crs.empty())
    context.warn(fmt::format("{}: the reference system is not written: its unit is {:.7g} m, and the file is in metres",
                             params.path.path, cloud.unit));
  const auto target = context.output(params.path.path);
  AtomicFile file(target);
  const Eigen::Vector3d up =
      in.transform ? Eigen::Vector3d(in.transform->rotation.transpose().col(2)) : Eigen::Vector3d::UnitZ();
  if (glb)
    write_glb(cloud, kept, up, file);
  else if (extension == ".e57")
    write_e57(cloud, crs, file);
  else if (las)
    write_las(cloud, crs, params.path.path, extension == ".laz", file, context);
  else
    write_columns(cloud, extension, params.binary, file);
  file.commit();
  context.wrote(target);
}

}  // namespace atrium::io
