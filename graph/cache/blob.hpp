#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "graph/api/flat.hpp"

namespace atrium {

/// One value in a file: a head of 64 bytes (magic and version, byte order, layout, content hash), the flat form, and at
/// the end the hash of all that precedes it. A file that is cut off, changed, of another layout or of another machine's
/// byte order is refused.
///
/// Writes it (beside, flushed, renamed) and returns what the value shares with others: each wants a file of its own.
/// Throws Error.
std::vector<FlatReference> write_blob(const std::filesystem::path& file, const FlatType& type, const void* value,
                                      const std::string& hash);

/// Maps the file, checks it and copies its arrays. Throws Error (what is wrong with the file).
std::shared_ptr<const void> read_blob(const std::filesystem::path& file, const FlatType& type, const std::string& hash,
                                      const FlatReader::Resolve& resolve);

/// Checks a file without knowing its type. Throws Error.
void check_blob(const std::filesystem::path& file);

/// The hash of a file's bytes. Throws Error if it cannot be read.
std::string hash_of_file(const std::filesystem::path& file);
/// The same; "" if it cannot be read.
std::string hash_if_readable(const std::filesystem::path& file);

}  // namespace atrium
