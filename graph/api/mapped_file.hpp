#pragma once
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace atrium {

/// A whole file, read-only in memory: mapped if it is a regular file; a pipe is read to its end. What came through a
/// pipe without a name in a folder (/dev/stdin, <(…)) is kept until the program ends, so that all who read it get the
/// same. Throws Error with the path and the system's reason: also for devices, and for a pipe that gives more than half
/// of the machine's memory. If others cut the file short while it is mapped, the program ends with an error that names
/// it.
class MappedFile {
 public:
  enum class Kinds { all, regular };  ///< regular: others are refused, as reading a pipe would take from it
  /// most_of_pipe: bytes; 0: half of the memory.
  explicit MappedFile(const std::filesystem::path& path, Kinds kinds = Kinds::all, std::size_t most_of_pipe = 0);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  const std::string& path() const { return path_; }
  const std::byte* data() const { return data_; }
  std::size_t size() const { return size_; }
  bool is_pipe() const { return buffer_ != nullptr; }
  /// Gives back the memory that its pages take in this process (they count as resident). What is needed again comes
  /// from the system's cache of the file, or from the disk. Thread-safe, also beside others that read.
  void drop_pages() const;
  std::string_view text() const { return {reinterpret_cast<const char*>(data_), size_}; }

 private:
  using Bytes = std::vector<std::byte>;
  std::shared_ptr<const Bytes> read_pipe(int descriptor, std::size_t most) const;
  std::shared_ptr<const Bytes> read_once(int descriptor, std::size_t most) const;

  std::string path_;
  const std::byte* data_ = nullptr;
  std::size_t size_ = 0;
  void* mapping_ = nullptr;
  std::shared_ptr<const Bytes> buffer_;  ///< what came through a pipe
};

}  // namespace atrium
