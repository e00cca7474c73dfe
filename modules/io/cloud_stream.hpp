#pragma once
#include <memory>
#include <string>
#include <vector>

#include "graph/api/context.hpp"
#include "modules/types/cloud.hpp"

namespace atrium::io {

/// A cloud that is written in pieces: what has to be known before its first point.
struct StreamedCloud {
  std::size_t points = 0;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< of all pieces
  bool normals = false, colours = false, intensities = false, labels = false;
  std::int32_t lowest_label = 0, highest_label = 0;
  struct Scan {
    Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< where the scanner stood, true coordinates
    std::size_t points = 0;
  };
  std::vector<Scan> scans;  ///< in the points' order; empty: the scanners' places are not known

  /// What a whole cloud has, without its scans.
  static StreamedCloud of(const Cloud& cloud);
};

/// A file that grows by pieces. Memory: a piece and a few megabytes.
class CloudStream {
 public:
  CloudStream() = default;
  virtual ~CloudStream() = default;
  CloudStream(const CloudStream&) = delete;
  CloudStream& operator=(const CloudStream&) = delete;
  /// The next points, with the columns and the origin that were announced.
  virtual void append(const Cloud& piece) = 0;
  /// Throws Error unless there were as many points as were announced. The file is still to be committed.
  virtual void finish() = 0;
};

/// For ".ply" (binary), ".e57" or ".las"; throws Error for other extensions. E57 has a scan for each of `scans`,
/// without bounds; PLY the places as sensors, and each point's; LAS neither, and no labels. Warns of what the format
/// does not keep.
std::unique_ptr<CloudStream> cloud_stream(const StreamedCloud& cloud, const std::string& extension, AtomicFile& file,
                                          const Context& context);

/// Adds the points of a piece with all their columns.
void add_to(Cloud& cloud, const Cloud& piece);
/// Removes the first points of a cloud with all their columns.
void drop_first(Cloud& cloud, std::size_t points);

}  // namespace atrium::io
