#pragma once
#include <nlohmann/json.hpp>
#include <tuple>

namespace atrium {

/// A field of a struct in JSON. What may be left out is, where it is empty, zero or false.
template <class S, class T>
struct JsonField {
  const char* name;
  T S::*member;
  bool may_be_left_out;
};
template <class S, class T>
constexpr JsonField<S, T> json_field(const char* name, T S::*member) {
  return {name, member, false};
}
template <class S, class T>
constexpr JsonField<S, T> optional_json_field(const char* name, T S::*member) {
  return {name, member, true};
}

/// The struct as a JSON object of these fields (a tuple of JsonField), in their order.
template <class S, class... Field>
nlohmann::ordered_json fields_json(const S& value, const std::tuple<Field...>& fields) {
  auto json = nlohmann::ordered_json::object();
  const auto is_nothing = [](const auto& member) {
    if constexpr (requires { member.empty(); })
      return member.empty();
    else
      return member == std::remove_cvref_t<decltype(member)>{};
  };
  const auto add = [&](const auto& field) {
    const auto& member = value.*field.member;
    if (!field.may_be_left_out || !is_nothing(member)) json[field.name] = member;
  };
  std::apply([&](const auto&... field) { (add(field), ...); }, fields);
  return json;
}

/// Reads them back. Throws nlohmann::json::exception if one is lacking or is not what it should be.
template <class S, class... Field>
void read_fields(const nlohmann::ordered_json& json, S& value, const std::tuple<Field...>& fields) {
  const auto read = [&](const auto& field) {
    if (!field.may_be_left_out || json.contains(field.name)) json.at(field.name).get_to(value.*field.member);
  };
  std::apply([&](const auto&... field) { (read(field), ...); }, fields);
}

}  // namespace atrium
