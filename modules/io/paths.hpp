#pragma once
#include <string>

namespace atrium::io {

/// ".ply" of "Scan.PLY": the extension in lower case.
std::string extension_of(const std::string& path);

}  // namespace atrium::io
