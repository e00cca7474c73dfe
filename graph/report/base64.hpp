#pragma once
#include <string>
#include <string_view>

namespace atrium::report {

/// RFC 4648, with padding.
std::string to_base64(std::string_view bytes);

/// zlib's format (RFC 1950), which browsers call "deflate". Throws Error.
std::string deflated(std::string_view bytes);

}  // namespace atrium::report
