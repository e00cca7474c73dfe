#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace atrium {

/// A whole file, read-only in memory: mapped if it is a regular file, else read (pipes). Throws Error with the path and
/// the system's reason. If others cut the file short while it is mapped, the program ends with an error that names it.
class MappedFile {
 public:
  enum class Kinds { all, regular };  ///< regular: others are refused, as reading a pipe would take from it
  explicit MappedFile(const std::filesystem::path& path, Kinds kinds = Kinds::all);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  const std::string& path() const { return path_; }
  const std::byte* data() const { return data_; }
  std::size_t size() const { return size_; }
  std::string_view text() const { return {reinterpret_cast<const char*>(data_), size_}; }

 private:
  void read_all(int descriptor);

  std::string path_;
  const std::byte* data_ = nullptr;
  std::size_t size_ = 0;
  void* mapping_ = nullptr;
  std::vector<std::byte> buffer_;
};

}  // namespace atrium
