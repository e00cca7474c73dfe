#pragma once
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "graph/api/context.hpp"
#include "graph/api/mapped_file.hpp"
#include "modules/io/json_fields.hpp"

namespace atrium::io {

/// Whether a file begins as a .glb does, or is JSON that may be a .gltf: an object with an "asset".
bool begins_as_gltf(std::string_view text);

/// A glTF 2.0 file, binary (.glb) or JSON (.gltf): its JSON, and the bytes of its buffers, which may be in the file, in
/// data: URIs or in files beside it. Throws Error with the byte or the JSON's key.
class GltfFile {
 public:
  GltfFile(std::shared_ptr<const MappedFile> file, const Context& context);
  ~GltfFile();
  GltfFile(const GltfFile&) = delete;
  GltfFile& operator=(const GltfFile&) = delete;

  const std::string& path() const { return file_->path(); }
  JsonField root() const;
  /// The entry of one of the root's lists that the field `key` of `from` names: an error that names both if there is
  /// none.
  JsonField entry(const char* list, const JsonField& from, const char* key) const;

  struct Bytes {
    const std::byte* data = nullptr;
    std::size_t size = 0;
    std::string place;  ///< where they begin, for messages: "byte 1024"
  };
  /// The bytes of the buffer view that the field `key` of `from` names, and their distance (0: none is given).
  Bytes view(const JsonField& from, const char* key, std::size_t* stride = nullptr);
  /// The bytes that a data: URI, or a file beside this one, holds.
  Bytes resource(const JsonField& uri);
  /// Of the file and of all buffers that were read so far.
  std::size_t bytes() const { return bytes_; }

 private:
  void read_glb(const Context& context);
  void parse(std::string_view json, std::size_t first_byte);
  const Bytes& buffer(std::size_t index);

  std::shared_ptr<const MappedFile> file_;
  std::unique_ptr<const JsonField::Json> json_;
  Bytes chunk_;  ///< the file's own binary part
  std::size_t bytes_ = 0;
  std::vector<std::unique_ptr<const Bytes>> buffers_;
  std::vector<std::shared_ptr<const void>> kept_;  ///< what they point into
};

}  // namespace atrium::io
