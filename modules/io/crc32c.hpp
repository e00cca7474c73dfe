#pragma once
#include <cstddef>
#include <cstdint>

namespace atrium::io {

/// CRC-32C (Castagnoli), as E57's pages and iSCSI have it: crc32c("123456789") is 0xE3069283. About 8 GB/s with
/// SSE 4.2, else 1.5 GB/s.
std::uint32_t crc32c(const std::byte* data, std::size_t size);

}  // namespace atrium::io
