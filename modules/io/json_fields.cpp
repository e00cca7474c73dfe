#include "modules/io/json_fields.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "graph/api/error.hpp"
#include "graph/api/mapped_file.hpp"

namespace atrium::io {

void JsonField::fail(const std::string& problem, const std::string& help) const {
  throw Error(path_ + " " + problem, help);
}
bool JsonField::has(const char* key) const { return json_->is_object() && json_->contains(key); }
bool JsonField::is_list() const { return json_->is_array(); }
bool JsonField::is_text() const { return json_->is_string(); }
bool JsonField::is_true() const { return json_->is_boolean() && json_->get<bool>(); }

JsonField JsonField::operator[](const char* key) const {
  if (!json_->is_object()) fail("is not an object");
  if (!json_->contains(key)) fail(std::string("has no '") + key + "'");
  return {(*json_)[key], path_ + (path_.back() == ':' ? " " : ".") + key};
}
std::vector<JsonField> JsonField::items() const {
  if (!json_->is_array()) fail("is not a list");
  std::vector<JsonField> result;
  for (std::size_t i = 0; i < json_->size(); ++i)
    result.emplace_back((*json_)[i], path_ + (path_.back() == ':' ? " " : "") + "[" + std::to_string(i) + "]");
  return result;
}
std::size_t JsonField::size() const {
  if (!json_->is_array()) fail("is not a list");
  return json_->size();
}
JsonField JsonField::at(std::size_t index) const {
  if (index >= size()) fail("has " + std::to_string(json_->size()) + " entries: no [" + std::to_string(index) + "]");
  return {(*json_)[index], path_ + (path_.back() == ':' ? " " : "") + "[" + std::to_string(index) + "]"};
}
std::string JsonField::text() const {
  if (!json_->is_string()) fail("is not a text");
  return json_->get<std::string>();
}
double JsonField::number() const {
  if (!json_->is_number() || !std::isfinite(json_->get<double>())) fail("is not a number");
  return json_->get<double>();
}
std::uint64_t JsonField::natural(const char* key) const {
  constexpr double most = 9007199254740992.0;
  const JsonField field = (*this)[key];
  const double value = field.number();
  if (value != std::floor(value) || value < 0 || value > most) field.fail("is not a whole number from 0");
  return static_cast<std::uint64_t>(value);
}
std::uint64_t JsonField::natural(const char* key, std::uint64_t otherwise) const {
  return has(key) ? natural(key) : otherwise;
}
std::int32_t JsonField::whole(std::int32_t least, std::int32_t most) const {
  const double value = number();
  if (value != std::floor(value) || value < least || value > most)
    fail("is not a whole number from " + std::to_string(least) + " to " + std::to_string(most));
  return static_cast<std::int32_t>(value);
}
Eigen::Vector3d JsonField::place(bool flat, double z) const {
  const auto numbers = items();
  if (numbers.size() != 3 && !(flat && numbers.size() == 2))
    fail(flat ? "is not [x, y] or [x, y, z]" : "is not [x, y, z]");
  return {numbers[0].number(), numbers[1].number(), numbers.size() == 3 ? numbers[2].number() : z};
}
std::vector<Eigen::Vector3d> JsonField::ring(bool flat, double z) const {
  std::vector<Eigen::Vector3d> result;
  for (const auto& item : items()) result.push_back(item.place(flat, z));
  if (result.size() > 1 && result.front() == result.back()) result.pop_back();
  if (result.size() < 3) fail("has fewer than three corners");
  return result;
}

namespace {

JsonField::Json parsed_json(const std::string& path) {
  using Json = JsonField::Json;
  const MappedFile file(path);
  if (file.size() == 0) throw Error(path + ": the file is empty");
  try {
    return Json::parse(file.text());
  } catch (const Json::exception& e) {
    const std::string what = e.what();  // "[json.exception.parse_error.101] parse error at line 1, column 1: …"
    const auto start = what.find("] ");
    throw Error(path + ": not valid JSON: " + (start == std::string::npos ? what : what.substr(start + 2)));
  }
}

}  // namespace

JsonFile::JsonFile(const std::string& path)
    : json_(std::make_unique<const JsonField::Json>(parsed_json(path))), path_(path) {}
JsonFile::~JsonFile() = default;

}  // namespace atrium::io
