#pragma once
#include "graph/api/context.hpp"
#include "modules/io/raw_geometry.hpp"
#include "modules/types/cloud.hpp"
#include "modules/types/mesh.hpp"

namespace atrium::io {

/// A coordinate further than this from zero, after scaling, is taken for a broken one, like NaN and infinity, metres.
inline constexpr double largest_coordinate = 1e9;
/// On an axis whose median coordinate is further than this from zero a cloud gets an origin, metres: float32 resolves
/// 0.06 mm there.
inline constexpr double largest_local_coordinate = 1000.0;

/// Throws Error unless there are three points at least, and not more than can be handled.
void check_count(const RawGeometry& geometry);

/// Where the origin of a geometry is put: 0 on each axis on which the median of (a sample of) the coordinates is within
/// largest_local_coordinate; else that median, rounded down to a whole metre. So files with small coordinates keep
/// their numbers, georeferenced ones keep their millimetres, and stray points far away do not matter.
Eigen::Vector3d choose_origin(const RawGeometry& geometry, double scale);

/// Whether the coordinates in the file, or in one of several, are float32.
bool has_float_positions(const RawGeometry& geometry);
/// Warns where coordinates that are float32 in the file are so far from zero that they lost millimetres. `origin`: as
/// choose_origin gives it.
void warn_of_lost_digits(const RawGeometry& geometry, const Eigen::Vector3d& origin, double scale,
                         const Context& context);

/// The points with the columns that the file has, times `scale`. Points with a coordinate that is not finite are
/// dropped and counted in a warning. Normals are brought to unit length; if any is zero or not finite, the column is
/// left out and a warning says so. Colours of 16 bits or of 0 … 1 become 8 bits. Of sensors only those of
/// geometry.sensors are set, with each point's source. Error if fewer
/// than three points are left.
/// kept: if given, gets the file's indices of the cloud's points, ascending.
Cloud decode_cloud(const RawGeometry& geometry, double scale, const Context& context,
                   std::vector<std::uint32_t>* kept = nullptr);

/// The triangles over their vertices in double. Triangles on vertices that are not finite are dropped, with a warning.
/// No error if nothing is left.
Mesh decode_mesh(const RawGeometry& geometry, double scale, const Context& context);

/// The true bounds of a cloud's points, without its origin.
struct Bounds3 {
  Eigen::Vector3f low = Eigen::Vector3f::Zero(), high = Eigen::Vector3f::Zero();
  Eigen::Vector3f extent() const { return high - low; }
};
Bounds3 bounds_of(const std::vector<Eigen::Vector3f>& points, const Context& context);

}  // namespace atrium::io
