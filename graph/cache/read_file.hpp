#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

#include "graph/api/error.hpp"

namespace atrium {

/// The system does not give a file's bytes.
class UnreadableFile : public Error {
 public:
  using Error::Error;
};

/// A regular file that is read piece by piece, not mapped: in a folder that machines share another one may remove or
/// cut it at any time, which is an error here and would end the process there.
class ReadFile {
 public:
  /// Throws UnreadableFile with the system's reason.
  explicit ReadFile(const std::filesystem::path& path);
  ~ReadFile();
  ReadFile(const ReadFile&) = delete;
  ReadFile& operator=(const ReadFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::uint64_t size() const { return size_; }
  /// Throws UnreadableFile, also if the file has become shorter.
  void read(void* to, std::uint64_t at, std::size_t size) const;
  /// The content hash of so many bytes from the beginning.
  std::string hash(std::uint64_t size) const;

 private:
  std::filesystem::path path_;
  int file_ = -1;
  std::uint64_t size_ = 0;
};

/// Writes a copy of the file (beside, renamed; not flushed) and returns the content hash of what was copied. Throws
/// Error, and leaves what was there.
std::string copy_hashed(const ReadFile& from, const std::filesystem::path& to, const std::string& wanted = {});

}  // namespace atrium
