#pragma once
#include <Eigen/Core>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "graph/api/error.hpp"

namespace atrium::io {

/// A value in a JSON file with its place, so that errors name it: "layout.json: planes[3].corners[0] …".
class JsonField {
 public:
  using Json = nlohmann::ordered_json;
  JsonField(const Json& json, std::string path) : json_(&json), path_(std::move(path)) {}

  const Json& json() const { return *json_; }
  [[noreturn]] void fail(const std::string& problem, const std::string& help = {}) const {
    throw Error(path_ + " " + problem, help);
  }
  bool has(const char* key) const { return json_->is_object() && json_->contains(key); }
  JsonField operator[](const char* key) const {
    if (!json_->is_object()) fail("is not an object");
    if (!json_->contains(key)) fail(std::string("has no '") + key + "'");
    return {(*json_)[key], path_ + (path_.back() == ':' ? " " : ".") + key};
  }
  std::vector<JsonField> items() const {
    if (!json_->is_array()) fail("is not a list");
    std::vector<JsonField> result;
    for (std::size_t i = 0; i < json_->size(); ++i)
      result.emplace_back((*json_)[i], path_ + (path_.back() == ':' ? " " : "") + "[" + std::to_string(i) + "]");
    return result;
  }
  std::string text() const {
    if (!json_->is_string()) fail("is not a text");
    return json_->get<std::string>();
  }
  double number() const {
    if (!json_->is_number() || !std::isfinite(json_->get<double>())) fail("is not a number");
    return json_->get<double>();
  }
  /// A whole number from `least` to `most`.
  std::int32_t whole(std::int32_t least, std::int32_t most) const {
    const double value = number();
    if (value != std::floor(value) || value < least || value > most)
      fail("is not a whole number from " + std::to_string(least) + " to " + std::to_string(most));
    return static_cast<std::int32_t>(value);
  }
  /// [x, y, z]; with `flat` [x, y] too, at height `z`.
  Eigen::Vector3d place(bool flat = false, double z = 0) const {
    const auto numbers = items();
    if (numbers.size() != 3 && !(flat && numbers.size() == 2))
      fail(flat ? "is not [x, y] or [x, y, z]" : "is not [x, y, z]");
    return {numbers[0].number(), numbers[1].number(), numbers.size() == 3 ? numbers[2].number() : z};
  }
  /// At least three places.
  std::vector<Eigen::Vector3d> ring(bool flat = false, double z = 0) const {
    std::vector<Eigen::Vector3d> result;
    for (const auto& item : items()) result.push_back(item.place(flat, z));
    if (result.size() > 1 && result.front() == result.back()) result.pop_back();
    if (result.size() < 3) fail("has fewer than three corners");
    return result;
  }

 private:
  const Json* json_;
  std::string path_;
};

}  // namespace atrium::io
