#pragma once
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace atrium::test {

/// A .glb of this JSON and binary part, each padded to whole words.
inline std::string glb_file(std::string json, std::string binary, std::uint32_t version = 2) {
  const auto number = [](std::uint32_t value) {
    std::string raw(4, '\0');
    std::memcpy(raw.data(), &value, 4);
    return raw;
  };
  json.resize((json.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  std::string parts = number(static_cast<std::uint32_t>(json.size())) + "JSON" + json;
  if (!binary.empty()) parts += number(static_cast<std::uint32_t>(binary.size())) + std::string("BIN\0", 4) + binary;
  return "glTF" + number(version) + number(static_cast<std::uint32_t>(parts.size() + 12)) + parts;
}

inline std::string base64(const std::string& bytes) {
  const char* const letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? letters[bits >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

/// Makes glTF files: accessors over one buffer, and whatever else its JSON is to have.
class GltfBuilder {
 public:
  std::string binary;
  std::string nodes = R"([{"mesh":0}])", more;  ///< more: keys of the root, each with a comma before it
  std::vector<std::string> primitives;

  template <class T>
  static std::string bytes_of(const std::vector<T>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
  }
  /// Adds numbers, and gives the index of their accessor. `more_of_it`: keys with a comma before each.
  template <class T>
  int add(const std::vector<T>& values, const std::string& type, std::size_t width,
          const std::string& more_of_it = "") {
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    const std::string place = std::to_string(binary.size()), bytes = bytes_of(values);
    binary += bytes;
    views_.push_back(R"({"buffer":0,"byteOffset":)" + place + R"(,"byteLength":)" + std::to_string(bytes.size()) + "}");
    accessors_.push_back(R"({"bufferView":)" + std::to_string(views_.size() - 1) + R"(,"componentType":)" +
                         component(T{}) + R"(,"count":)" + std::to_string(values.size() / width) + R"(,"type":")" +
                         type + "\"" + more_of_it + "}");
    return static_cast<int>(accessors_.size()) - 1;
  }
  /// Adds an accessor as it is given.
  int add_accessor(const std::string& json) {
    accessors_.push_back(json);
    return static_cast<int>(accessors_.size()) - 1;
  }

  /// `uri`: of the buffer; empty: it is the file's own.
  std::string json(const std::string& uri = "") const {
    const std::string buffer =
        R"({"byteLength":)" + std::to_string(binary.size()) + (uri.empty() ? "" : R"(,"uri":")" + uri + "\"") + "}";
    return R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":)" + nodes + R"(,"meshes":[{"primitives":[)" +
           joined(primitives) + R"(]}],"accessors":[)" + joined(accessors_) + R"(],"bufferViews":[)" + joined(views_) +
           R"(],"buffers":[)" + buffer + "]" + more + "}";
  }
  std::string glb() const { return glb_file(json(), binary); }
  std::string gltf() const { return json("data:application/octet-stream;base64," + base64(binary)); }

 private:
  static std::string component(std::int8_t /*of*/) { return "5120"; }
  static std::string component(std::uint8_t /*of*/) { return "5121"; }
  static std::string component(std::int16_t /*of*/) { return "5122"; }
  static std::string component(std::uint16_t /*of*/) { return "5123"; }
  static std::string component(std::uint32_t /*of*/) { return "5125"; }
  static std::string component(float /*of*/) { return "5126"; }
  static std::string joined(const std::vector<std::string>& items) {
    std::string text;
    for (const auto& item : items) text += (text.empty() ? "" : ",") + item;
    return text;
  }

  std::vector<std::string> views_, accessors_;
};

}  // namespace atrium::test
