#pragma once
#include <cstdint>
#include <vector>

#include "graph/api/context.hpp"
#include "modules/io/raw_geometry.hpp"
#include "modules/types/cloud.hpp"

namespace atrium::io {

/// The column's numbers first … first+count-1 as doubles.
void read_numbers(const Column& column, std::size_t first, std::size_t count, double* to);

/// Each fills its column of a cloud if the file has it (all of its parts), else leaves it empty.
void decode_normals(const RawGeometry& geometry, const std::vector<std::uint32_t>& ignored,
                    std::vector<Eigen::Vector3f>& normals, const Context& context);
/// Bytes are taken as they are. Other numbers by the largest there is: to 1 (0 … 1), to 255 (0 … 255), else 16 bits.
/// Where one value in a hundred or less is larger, or all by little, these are cut, with a warning.
void decode_colours(const RawGeometry& geometry, std::vector<Colour>& colours, const Context& context);
/// What colour values have to be multiplied by to lie in 0 … 255, by the same rule.
double colour_factor(const RawGeometry& geometry, const Context& context);
/// What is not finite becomes 0.
void decode_intensities(const RawGeometry& geometry, std::vector<float>& intensities, const Context& context);
/// Indices into geometry.sensors, if the file has such. Throws Error where one is out of range.
void decode_source(const RawGeometry& geometry, std::vector<std::uint16_t>& source, const Context& context);
/// Rounded to whole numbers, clamped to 32 bits; what is not finite becomes -1.
void decode_labels(const RawGeometry& geometry, std::vector<std::int32_t>& labels, const Context& context);

}  // namespace atrium::io
