#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "graph/api/error.hpp"
#include "graph/api/flat.hpp"

namespace atrium {

/// A file whose contents are not what they were when it was written: it is of no use, unlike one that cannot be read
/// just now (no memory, too many open files, no permission).
class DamagedFile : public Error {
 public:
  using Error::Error;
};

/// One value in a file: a head of 64 bytes (magic and version, byte order, layout, content hash), the flat form, and at
/// the end the hash of all that precedes it. A file that is cut off, changed, of another layout or of another machine's
/// byte order is refused.
///
/// Writes it (beside, flushed, renamed) and returns what the value shares with others: each wants a file of its own.
/// Throws Error.
std::vector<FlatReference> write_blob(const std::filesystem::path& file, const FlatType& type, const void* value,
                                      const std::string& hash);

/// How many bytes that is, but for the head. Without what it shares.
std::uint64_t flat_size(const FlatType& type, const void* value);

/// Maps the file, checks it and copies its arrays. Throws DamagedFile (what is wrong with it), Error if it cannot be
/// read, and what `resolve` throws unless that is an Error.
std::shared_ptr<const void> read_blob(const std::filesystem::path& file, const FlatType& type, const std::string& hash,
                                      const FlatReader::Resolve& resolve);

/// Checks a file without knowing its type. Throws DamagedFile, or Error if it cannot be read.
void check_blob(const std::filesystem::path& file);

/// The hash of a file's bytes. Throws Error if it cannot be read.
std::string hash_of_file(const std::filesystem::path& file);
/// The same; "" if it cannot be read.
std::string hash_if_readable(const std::filesystem::path& file);

}  // namespace atrium
