#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "graph/api/mapped_file.hpp"

namespace atrium::io {

/// The pages of an E57 file without their checksums. Offsets are logical (checksums not counted) unless they are called
/// physical. Thread-safe.
class E57Pages {
 public:
  /// Reads the file's header. Throws Error if it is not E57's, or promises more than the file holds.
  explicit E57Pages(std::shared_ptr<const MappedFile> file);

  const std::string& path() const { return file_->path(); }
  std::uint64_t size() const { return pages_ * content_; }  ///< logical
  std::uint64_t file_size() const { return file_->size(); }

  /// Copies bytes; every page that they lie in is checked. Throws Error, with the physical offset, for a page whose
  /// checksum is wrong and for what lies beyond the end.
  void read(std::uint64_t offset, std::size_t size, std::byte* to) const;
  template <class T>
  T number(std::uint64_t offset) const {  // E57 is little-endian, as the machines are that Atrium runs on
    T value;
    read(offset, sizeof(T), reinterpret_cast<std::byte*>(&value));
    return value;
  }

  /// `what` names the place for the error if it is none (beyond the end, or within a checksum).
  std::uint64_t logical(std::uint64_t physical, const std::string& what) const;
  std::uint64_t physical(std::uint64_t logical) const { return logical / content_ * page_ + logical % content_; }

  /// See MappedFile.
  void drop_pages() const { file_->drop_pages(); }
  /// The XML section.
  std::string xml() const;

 private:
  void check(std::uint64_t page) const;

  std::shared_ptr<const MappedFile> file_;
  std::uint64_t page_ = 1024, content_ = 1020, pages_ = 0;
  std::uint64_t xml_offset_ = 0, xml_size_ = 0;  ///< physical, logical
};

}  // namespace atrium::io
