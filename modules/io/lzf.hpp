#pragma once
#include <cstddef>
#include <vector>

namespace atrium::io {

/// Expands LZF data (M. Lehmann's LibLZF, the compression of PCD files) to exactly `size` bytes. False if the data are
/// damaged: a reference before the beginning, or another length. Own code because PCL's stands in a library that links
/// VTK.
bool expand_lzf(const std::byte* data, std::size_t data_size, std::vector<std::byte>& to, std::size_t size);

}  // namespace atrium::io
