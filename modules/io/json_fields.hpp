#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace atrium::io {

/// A value in a JSON file with its place, so that errors name it: "layout.json: planes[3].corners[0] …". Refers to the
/// file's contents, which must outlive it.
class JsonField {
 public:
  using Json = nlohmann::ordered_json;
  JsonField(const Json& json, std::string path) : json_(&json), path_(std::move(path)) {}

  [[noreturn]] void fail(const std::string& problem, const std::string& help = {}) const;
  bool has(const char* key) const;
  bool is_list() const;
  bool is_text() const;
  bool is_true() const;
  const std::string& where() const { return path_; }  ///< "layout.json: planes[3]"
  JsonField operator[](const char* key) const;
  std::vector<JsonField> items() const;
  /// The number of entries of a list, and one of them: an error if there are fewer.
  std::size_t size() const;
  JsonField at(std::size_t index) const;
  std::string text() const;
  double number() const;
  /// A whole number from 0 to 2⁵³ at `key`, up to which every one can be told from the next; `otherwise` if there is
  /// none.
  std::uint64_t natural(const char* key) const;
  std::uint64_t natural(const char* key, std::uint64_t otherwise) const;
  /// A whole number from `least` to `most`.
  std::int32_t whole(std::int32_t least, std::int32_t most) const;
  /// [x, y, z]; with `flat` [x, y] too, at height `z`.
  Eigen::Vector3d place(bool flat = false, double z = 0) const;
  /// At least three places.
  std::vector<Eigen::Vector3d> ring(bool flat = false, double z = 0) const;

 private:
  const Json* json_;
  std::string path_;
};

/// A file's contents. Errors name the file, and the line and column of what is no JSON.
class JsonFile {
 public:
  explicit JsonFile(const std::string& path);
  ~JsonFile();
  JsonFile(const JsonFile&) = delete;
  JsonFile& operator=(const JsonFile&) = delete;
  JsonField root() const { return {*json_, path_ + ":"}; }

 private:
  std::unique_ptr<const JsonField::Json> json_;
  std::string path_;
};

}  // namespace atrium::io
