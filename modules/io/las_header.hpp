#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "graph/api/mapped_file.hpp"
#include "modules/io/crs.hpp"

namespace atrium::io {

/// The header of a LAS or LAZ file, checked against the file's size.
struct LasHeader {
  int minor = 0;  ///< version 1.minor
  int type = 0;   ///< of the records, 0 … 10
  bool compressed = false;
  std::uint64_t points = 0;
  std::size_t data = 0;    ///< byte at which the points begin
  std::size_t record = 0;  ///< bytes of a record, uncompressed
  std::size_t extra = 0;   ///< of these behind those of the type
  Eigen::Vector3d scale = Eigen::Vector3d::Ones(), offset = Eigen::Vector3d::Zero();
  Crs crs;

  // Of LAZ:
  int compressor = 0;              ///< 2 pointwise, 3 layered
  std::uint32_t chunk_points = 0;  ///< 0xFFFFFFFF: each chunk has its own number
};

/// Throws Error, with the byte, for what is no LAS file, is not known of it, or does not fit into the file.
LasHeader read_las_header(const MappedFile& file);

}  // namespace atrium::io
